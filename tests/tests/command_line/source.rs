//! `blysk coefficients` as source: taken by compilers of its languages, run, and the bits that the library computes.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use analysis::source::{Approximation, Measured, Piecewise, measured};
use blysk_tests::bench;
use blysk_tests::cli::Bench;
use hw_model::fit::{Levels, Method};
use hw_model::highlight::phong;

const EXPONENTS: [f64; 6] = [1.0, 1.5, 3.0, 8.0, 64.0, 1000.0];

/// What is asked of the command, and the same of the library.
fn cases() -> Vec<(String, Approximation)> {
    let method = |method: Method| (method.to_string(), Approximation::Method(method, Levels::default()));
    let segments = |count: usize, degree: usize| {
        (format!("minimax --segments {count} --degree {degree}"), Approximation::Segments { degree, count })
    };
    let mut all: Vec<_> = Method::ALL.into_iter().map(method).collect();
    all.push((
        "hermite --q 0.4".to_owned(),
        Approximation::Method(Method::Hermite, Levels::new(0.4, 1.0 / 18.0).unwrap()),
    ));
    all.extend([segments(1, 1), segments(2, 3), segments(3, 2), segments(8, 4)]);
    all
}

fn printed(bench: &Bench, of: &str, language: &str) -> String {
    let list = EXPONENTS.map(|n| n.to_string()).join(",");
    bench.good(&format!("coefficients --method {of} --exponents {list} --format {language}"))
}

fn function(approximation: Approximation, exponent: f64) -> Piecewise {
    let pieces = approximation.pieces(exponent).unwrap();
    Piecewise::nearest(&pieces, approximation.degree(), exponent).unwrap()
}

/// What is asked of every row: an even spread, all that is near 1, and what lies outside [0, 1].
fn xs() -> Vec<f32> {
    let even = (0..=4096).map(|step| step as f32 / 4096.0);
    let near = (0..400).map(|step| 1.0 - (step as f32).exp2().recip().sqrt());
    even.chain(near).chain([-1.0, -1e-7, 1e-30, 1.0 + f32::EPSILON, 7.0]).collect()
}

fn passes(output: Output, what: &str) -> String {
    let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{what}\n{out}{err}");
    out
}

fn compiled(bench: &Bench, program: &str, arguments: &[&str]) {
    let mut command = Command::new(program);
    let output = command.args(arguments).current_dir(bench.path("")).output();
    let output = output.unwrap_or_else(|error| panic!("{program}: {error}; run scripts/setup"));
    passes(output, &format!("{program} {}", arguments.join(" ")));
}

/// Asks a program that reads `case row bits` a line, and answers the bits of the value.
fn answers(program: &Path, cases: usize) -> Vec<u32> {
    let mut questions = String::new();
    for case in 0..cases {
        for row in 0..EXPONENTS.len() {
            for x in xs() {
                writeln!(questions, "{case} {row} {:x}", x.to_bits()).unwrap();
            }
        }
    }
    let mut child = Command::new(program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let asking = std::thread::spawn(move || stdin.write_all(questions.as_bytes()).unwrap());
    let said = passes(child.wait_with_output().unwrap(), "the compiled source");
    asking.join().unwrap();
    said.lines().map(|line| u32::from_str_radix(line, 16).unwrap()).collect()
}

fn expected(cases: &[Approximation]) -> Vec<u32> {
    let rows = cases.iter().flat_map(|&case| EXPONENTS.map(|n| function(case, n)));
    rows.flat_map(|function| xs().into_iter().map(move |x| function.at(x).to_bits())).collect()
}

/// Functions of C under other names, and a `main` that asks them.
fn c_program(sources: &[String]) -> String {
    let mut text = "#include <stdio.h>\n#include <string.h>\n\
                    static inline float clamp(float v, float low, float high)\n\
                    { return v < low ? low : v > high ? high : v; }\n"
        .to_owned();
    for (case, source) in sources.iter().enumerate() {
        let renamed = source.replace("blysk_highlight(int", &format!("highlight_{case}(int"));
        text += &renamed.replace("blysk_table", &format!("table_{case}"));
    }
    text += "int main(void)\n{\n    unsigned which, row, bits;\n    float x, value = 0;\n\
             while (scanf(\"%u %u %x\", &which, &row, &bits) == 3) {\n    memcpy(&x, &bits, 4);\n\
             switch (which) {\n";
    for case in 0..sources.len() {
        writeln!(text, "    case {case}: value = highlight_{case}((int)row, x); break;").unwrap();
    }
    text + "    }\n    memcpy(&bits, &value, 4);\n    printf(\"%x\\n\", bits);\n    }\n\
            return clamp(0, 0, 0) > 0;\n}\n"
}

/// Constants without a letter are f32 in shaders.
const CC: [&str; 10] = [
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Werror",
    "-O1",
    "-ffp-contract=off",
    "-fsingle-precision-constant",
    "-o",
    "program",
];

fn run_c(bench: &Bench, sources: &[String]) -> Vec<u32> {
    bench.write("program.c", c_program(sources));
    compiled(bench, "cc", &[&CC[..], &["program.c"]].concat());
    answers(&bench.path("program"), sources.len())
}

#[test]
fn c_gives_the_bits_of_the_library() {
    let bench = bench!();
    let (names, cases): (Vec<String>, Vec<Approximation>) = cases().into_iter().unzip();
    let sources: Vec<String> = names.iter().map(|of| printed(&bench, of, "c")).collect();
    let expected = expected(&cases);
    assert!(expected.len() > 300_000 && run_c(&bench, &sources) == expected);
    // The header as C++ takes it.
    bench.write("alone.cpp", format!("{}\nfloat one() {{ return blysk_highlight(0, 1.0f); }}\n", sources[0]));
    compiled(&bench, "c++", &["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-c", "alone.cpp"]);
}

/// Any number of the table that is another one is seen.
#[test]
fn a_wrong_coefficient_is_seen() {
    let bench = bench!();
    let (of, case) = cases().into_iter().find(|(of, _)| of.contains("--segments 2")).unwrap();
    let source = printed(&bench, &of, "c");
    let right = expected(&[case]);
    assert_eq!(run_c(&bench, std::slice::from_ref(&source)), right);
    // Row 4, n = 64, has two lines of numbers.
    let lines: Vec<&str> = source.lines().collect();
    let row = lines.iter().position(|line| line.contains("row 4: n = 64;")).unwrap();
    let mut altered = 0;
    for line in [row + 1, row + 2] {
        let numbers: Vec<&str> = lines[line].trim().trim_end_matches(',').split(", ").collect();
        for (place, number) in numbers.iter().enumerate() {
            let value: f32 = number.trim_end_matches('f').parse().unwrap();
            let mut wrong: Vec<String> = numbers.iter().map(|&number| number.to_owned()).collect();
            wrong[place] = format!("{:?}f", value * 0.99 - 1e-3);
            let mut all: Vec<String> = lines.iter().map(|&line| line.to_owned()).collect();
            all[line] = all[line].replace(&numbers.join(", "), &wrong.join(", "));
            assert_ne!(run_c(&bench, &[all.join("\n") + "\n"]), right, "{number} in line {line}");
            altered += 1;
        }
    }
    assert_eq!(altered, 12);
}

#[test]
fn rust_gives_the_bits_of_the_library() {
    let bench = bench!();
    let (names, cases): (Vec<String>, Vec<Approximation>) = cases().into_iter().unzip();
    let mut text = "#![deny(warnings)]\nuse std::io::{Read, Write};\n".to_owned();
    for (case, of) in names.iter().enumerate() {
        writeln!(text, "mod case_{case} {{\n{}}}", printed(&bench, of, "rust")).unwrap();
    }
    let functions: Vec<String> = (0..cases.len()).map(|case| format!("case_{case}::blysk_highlight")).collect();
    write!(
        text,
        "fn main() {{\n    let functions: [fn(usize, f32) -> f32; {}] = [{}];\n\
         let (mut asked, mut said) = (String::new(), String::new());\n\
         std::io::stdin().read_to_string(&mut asked).unwrap();\n\
         for line in asked.lines() {{\n\
         let words: Vec<&str> = line.split(' ').collect();\n\
         let x = f32::from_bits(u32::from_str_radix(words[2], 16).unwrap());\n\
         let value = functions[words[0].parse::<usize>().unwrap()](words[1].parse().unwrap(), x);\n\
         said += &format!(\"{{:x}}\\n\", value.to_bits());\n}}\n\
         std::io::stdout().write_all(said.as_bytes()).unwrap();\n}}\n",
        functions.len(),
        functions.join(", ")
    )
    .unwrap();
    bench.write("program.rs", text);
    compiled(&bench, "rustc", &["--edition", "2021", "-o", "program", "program.rs"]);
    assert!(answers(&bench.path("program"), cases.len()) == expected(&cases));
}

/// The reference compiler takes the shaders; what they say is run as C, in which their texts differ in the table alone.
#[test]
fn shaders_compile_and_say_what_the_library_computes() {
    let bench = bench!();
    let (names, cases): (Vec<String>, Vec<Approximation>) = cases().into_iter().unzip();
    let expected = expected(&cases);
    for (language, heads, main, arguments) in [
        (
            "glsl",
            &["#version 330\n", "#version 300 es\nprecision highp float;\n"][..],
            "in float x;\nout vec4 colour;\nvoid main() { colour = vec4(blysk_highlight(2, x)); }\n",
            &["-S", "frag"][..],
        ),
        (
            "hlsl",
            &[""][..],
            "float4 main(float x : TEXCOORD0) : SV_Target { return (float4)blysk_highlight(2, x); }\n",
            &["-D", "-e", "main", "-S", "frag", "-V", "-o", "shader.spv"][..],
        ),
    ] {
        let mut as_c = Vec::new();
        for of in &names {
            let source = printed(&bench, of, language);
            for head in heads {
                bench.write("shader.frag", format!("{head}{source}{main}"));
                compiled(&bench, "glslangValidator", &[arguments, &["shader.frag"]].concat());
            }
            as_c.push(match language {
                "glsl" => {
                    let (before, after) = source.split_once("= float[").unwrap();
                    let (_, after) = after.split_once("](").unwrap();
                    format!("static {before}= {{{}", after.replacen("\n);", "\n};", 1)).replace("static //", "//")
                }
                _ => source,
            });
        }
        let as_c: Vec<String> = as_c
            .iter()
            .map(|source| {
                source.replace("\nconst float", "\nstatic const float").replace("\nfloat ", "\nstatic float ")
            })
            .collect();
        assert!(run_c(&bench, &as_c) == expected, "{language}");
    }
    // A shader that is wrong is refused: the compiler looks.
    bench.write("shader.frag", "#version 330\nvoid main() { blysk_highlight(2, 0.5); }\n");
    let wrong = Command::new("glslangValidator").args(["-S", "frag"]).arg(bench.path("shader.frag")).output().unwrap();
    assert!(!wrong.status.success());
}

/// The errors in the comments are those of the values, and no x that is asked here has a greater one.
#[test]
fn comments_say_the_errors_of_the_values() {
    let bench = bench!();
    for (of, case) in cases() {
        let source = printed(&bench, &of, "rust");
        assert!(source.contains(&format!("// Made by: blysk coefficients --method {of} ")), "{source}");
        let mut greatest = BTreeMap::new();
        for (row, n) in EXPONENTS.into_iter().enumerate() {
            let function = function(case, n);
            let Measured { highlight, whole, .. } = measured(&function, n, case.level()).unwrap();
            let said = format!(
                "// row {row}: n = {n}; greatest error {:.3e} on the highlight, {:.3e} on [0, 1]\n",
                highlight.error, whole.error
            );
            assert!(source.contains(&said), "{said}{source}");
            for (region, worst) in [(case.level(), highlight), (0.0, whole)] {
                let error = |x: f32| (f64::from(function.at(x)) - phong(n, x.into())).abs();
                assert_eq!(error(worst.x), worst.error);
                for x in xs().into_iter().filter(|&x| (0.0..=1.0).contains(&x) && phong(n, x.into()) >= region) {
                    assert!(error(x) <= worst.error * 1.0001 + 1e-7, "{of}, n = {n}, x = {x}: {worst:?}");
                }
                let known = greatest.entry(region.to_bits()).or_insert(0.0_f64);
                *known = known.max(worst.error);
            }
        }
        for error in greatest.values() {
            assert!(source.contains(&format!(": {error:.3e} (n = ")), "{error:.3e}: {source}");
        }
    }
}

/// What is best known of the errors: hermite's and that of two segments of minimax.
#[test]
fn errors_are_those_of_the_methods() {
    let worst = |case: Approximation, n: f64| measured(&function(case, n), n, 0.5).unwrap();
    let hermite = worst(Approximation::Method(Method::Hermite, Levels::default()), 64.0);
    assert!((hermite.highlight.error - 0.005_065_108).abs() < 1e-7, "{hermite:?}");
    let two = worst(Approximation::Segments { degree: 3, count: 2 }, 64.0);
    assert!(two.whole.error < 0.004 && two.highlight.error <= two.whole.error, "{two:?}");
}

#[test]
fn segments_have_columns_of_their_own() {
    let bench = bench!();
    let text = bench.good("coefficients --method minimax --segments 2 --exponents 2,64 --format csv");
    assert_eq!(text.lines().next(), Some("n,segment,start,end,c0,c1,c2,c3,error"));
    let fitted = hw_model::fit::minimax::segments(64.0, 3, 2, hw_model::fit::minimax::Range::Balanced).unwrap();
    let rows = blysk_tests::cli::csv_rows(&text);
    // x² is a cubic itself: one segment is everything.
    assert_eq!(rows.len(), 3, "{text}");
    for (row, (segment, end)) in rows[1..].iter().zip(fitted.segments.iter().zip(&fitted.ends)) {
        let column = |name: &str| blysk_tests::cli::number(row, name);
        assert_eq!((column("n"), column("start"), column("end")), (64.0, segment.start, *end));
        let c: Vec<f64> = ["c0", "c1", "c2", "c3"].into_iter().map(column).collect();
        assert_eq!((c.as_slice(), column("error")), (&segment.c[..4], fitted.error));
    }
    let narrow = bench.good("coefficients --method minimax --segments 2 --degree 4 --exponents 2.5,114,1e6");
    assert!(narrow.lines().count() == 7 && narrow.lines().all(|line| line.chars().count() <= 100), "{narrow}");
    let all = bench.good("coefficients --method all --exponents 3,64 --format csv");
    assert_eq!(all.lines().count(), 1 + 2 * (Method::ALL.len() + 1), "{all}");
}

#[test]
fn what_has_no_source_is_refused() {
    let bench = bench!();
    let refused = |options: &str, said: &[&str]| bench.refused(&format!("coefficients {options}"), said);
    refused("--method all --exponents 8 --format glsl", &["one method", "hermite"]);
    refused("--method hermite --segments 2 --exponents 8", &["--method minimax"]);
    refused("--method minimax --segments 9 --exponents 8", &["--segments", "1..=8"]);
    refused("--method minimax --degree 5 --exponents 8", &["--degree", "1..=4"]);
    refused("--method minimax --degree 2 --q 0.4 --exponents 8", &["--q", "--degree"]);
    refused("--method minimax --exponents 1e14 --format c", &["n = 100000000000000", "beyond f32"]);
    refused("--method minimax --segments 8 --exponents 1..=4096 --format c", &["more than 65536", "fewer"]);
    refused("--method hermit --exponents 8", &["hermit", "or all"]);
}
