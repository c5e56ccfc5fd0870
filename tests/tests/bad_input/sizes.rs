//! Numbers that would size work or memory without end.

use blysk_tests::bench;
use blysk_tests::cli::Bench;

use super::edited;

const SCENE: &str = r#"{
  "name": "ball",
  "image": { "width": 8, "height": 8 },
  "camera": { "position": [0, 0, 5], "look_at": [0, 0, 0], "field_of_view_degrees": 40 },
  "lights": [{ "directional": { "towards": [1, 2, 3], "colour": [1, 1, 1] } }],
  "materials": [{ "name": "m", "exponent": 4, "diffuse": [0, 0, 0], "specular": [1, 1, 1] }],
  "geometry": [{ "sphere": { "centre": [0, 0, 0], "radius": 1, "material": "m" } }]
}"#;

/// The centred polynomial alone, with exponents 1 to 8 and another x.
fn wide(bench: &Bench, input: &str) {
    let wide = edited("Q2.9", input).replace("\"rational\"", "\"zero\"");
    bench.write("wide.json", wide.replace("\"power\"", "\"centred\""));
    bench.write("scene.json", SCENE);
}

/// Every command that goes over inputs says how many there are, how many it goes through, and what would fit.
#[test]
fn inputs_without_end() {
    let bench = bench!();
    for bits in [40, 48, 62] {
        wide(&bench, &format!("UQ1.{bits}"));
        for (command, most, fits) in [
            ("report --config wide.json --exhaustive", 40, 36),
            ("stability --config wide.json --part seams", 40, 36),
            ("specialise scene.json --config wide.json --out new", 36, 35),
            ("specialise scene.json --config wide.json --allow-codes 1 --out new", 36, 35),
            ("vectors --config wide.json --strategy compact --out new", 36, 32),
        ] {
            let most = format!("{} (2^{most})", 1_u64 << most);
            let fits = format!("{fits} fraction bits or fewer");
            bench.refused(command, &["are more than the", &most, &fits, "UQ1"]);
        }
        bench.refused(
            "refine --config wide.json --range polynomial --out new.json",
            &["samples are more than the 67108864 (2^26)", "kept in memory", "fraction bits or fewer"],
        );
        let design = format!("design --exponents 1..=8 --input UQ1.{bits} --output UQ1.8 --error 0.01");
        bench.refused(&design, &["17179869184 (2^34)", "fraction bits or fewer", "--exponents"]);
        if bits < 53 {
            let pareto = format!("pareto --input UQ1.{bits} --exponents 1..=8 --no-timing");
            bench.refused(&pareto, &["1099511627776 (2^40)", "36 fraction bits", "--every K"]);
            let said = ["1099511627776 (2^40)", "36 fraction bits or fewer"];
            bench.refused("certify --config wide.json --out new.json", &said);
        }
        let said = ["4194304", "narrower input format"];
        bench.refused("vectors --config wide.json --strategy exhaustive --out new", &said);
    }
}

/// One exponent with as many bits as refine was stopped by memory at.
#[test]
fn a_refinement_that_would_not_fit_the_memory() {
    let bench = bench!();
    for bits in [32, 36, 62] {
        wide(&bench, &format!("UQ1.{bits}"));
        bench.refused(
            "refine --config wide.json --exponents 1 --range polynomial --out new.json",
            &["kept in memory", "use a narrower input format of 26 fraction bits or fewer"],
        );
    }
}

/// The number of vectors is refused before the work for the scene is done.
#[test]
fn vectors_beside_specialised_hardware() {
    let bench = bench!();
    bench.write("scene.json", SCENE);
    for count in ["0", "4194305", "18446744073709551615"] {
        let command = format!("specialise scene.json --config small.json --out new --count {count}");
        bench.refused(&command, &["vectors", count]);
    }
}

/// Sizes of pictures and lists that would not fit.
#[test]
fn pictures_and_lists_without_end() {
    let bench = bench!();
    bench.write("scene.json", SCENE);
    for size in ["4294967295x4294967295", "16385x1", "16384x16384"] {
        let command = format!("render scene.json --config small.json --size {size} --out new");
        bench.refused(&command, &["--size", size, "use"]);
    }
    bench.refused("render scene.json --config small.json --size 99999999999x1", &["--size"]);
    for exponents in ["1..=1000000000", "1..=1e15"] {
        let command = format!("certify --exponents {exponents} --method hermite");
        bench.refused(&command, &[exponents, "65536"]);
    }
}

/// Each number of a manifest that sizes memory or a shift, beyond its range.
#[test]
fn a_manifest_with_numbers_out_of_range() {
    let bench = bench!();
    let _ = bench.good("vectors --config small.json --count 16 --out bundle");
    bench.write("dut.csv", "intensity\n0\n");
    let whole = bench.text("bundle/manifest.json");
    let refused = |from: &str, to: &str, said: &[&str]| {
        assert_eq!(whole.matches(from).count(), 1, "{from:?}");
        bench.write("bundle/manifest.json", whole.replace(from, to));
        bench.refused("check --vectors bundle --log dut.csv", said);
        bench.refused("check --vectors bundle --registers dut.csv", said);
    };
    for count in ["0", "65537", "9223372036854775808", "18446744073709551615"] {
        let said = ["manifest.json: counts.rom_words", count, "1 to 65536"];
        refused("\"rom_words\": 8", &format!("\"rom_words\": {count}"), &said);
    }
    for count in ["4194305", "18446744073709551615"] {
        let said = ["manifest.json: counts.vectors", count, "1 to 4194304"];
        refused("\"vectors\": 16", &format!("\"vectors\": {count}"), &said);
    }
    let said = ["words.stimulus", "field `x`", "to 0"];
    refused(
        "\"lsb\": 0\n        }\n      ]\n    },\n    \"expected\"",
        "\"lsb\": 4294967295\n        }\n      ]\n    },\n    \"expected\"",
        &said,
    );
    let words: serde_json::Value = serde_json::from_str(&whole).unwrap();
    for name in ["stimulus", "expected", "rom"] {
        let width = words["words"][name]["width"].as_u64().unwrap();
        let layout = format!("\"{name}\": {{\n      \"width\": {width}");
        for wrong in [0, width - 1, 129, 4_294_967_295] {
            let altered = layout.replace(&format!(" {width}"), &format!(" {wrong}"));
            let field = format!("words.{name}: width: {wrong}");
            refused(&layout, &altered, &[&field, &format!("{width} bits together")]);
        }
    }
}

/// Near the top of a line of 60 bits neighbouring x cannot be told apart: what registers take is then not found, and
/// the page says what their formats hold.
#[test]
fn a_page_about_very_wide_registers() {
    let bench = bench!();
    let wide = r#"{"name": "wide", "method": "minimax", "exponents": "2,3", "input": "UQ1.62",
        "output": "UQ1.60", "segments": 2, "cut": "balanced", "error_budget_ulp": 1e6}"#;
    bench.write("wide.json", wide);
    let _ = bench.good("document --config wide.json --out page");
    assert!(bench.text("page/wide.md").contains("| `t3` |"));
}
