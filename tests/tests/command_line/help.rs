//! Help: complete, and its examples can be typed as they stand.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::Stdio;

use blysk_tests::answers::Log;
use blysk_tests::bench;
use blysk_tests::cli::Bench;

const COMMANDS: [&str; 23] = [
    "report",
    "vectors",
    "rtl",
    "check",
    "certify",
    "claims",
    "simulate",
    "coefficients",
    "rom",
    "refine",
    "design",
    "document",
    "stability",
    "pareto",
    "presets",
    "render",
    "mesh",
    "scene",
    "specialise",
    "shard",
    "serve",
    "completions",
    "man",
];

/// The command lines after "Example:" or "Examples:".
fn examples(help: &str) -> Vec<String> {
    let (_, examples) = help.split_once("Example").expect("there is an example");
    let lines = examples.lines().filter_map(|line| line.find("blysk ").map(|at| &line[at..]));
    lines.map(str::to_owned).collect()
}

/// The files that the examples speak of.
fn with_files(bench: &Bench) {
    bench.write("in.csv", "n,x\n64,0.99\n300,1\n2,-0.0\n");
    let _summary = bench.good("vectors --config small.json --count 8 --out vectors");
    bench.write("dut.csv", Log::right(bench, "vectors").text());
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scenes");
    let scene = std::fs::read_to_string(scenes.join("one_material.json")).unwrap();
    bench.write("scene.json", scene.replace("\"exponent\": 12", "\"exponent\": 4"));
    let shown = bench.good("presets show compact");
    // The example says --exhaustive, and 2^23 x for each of 256 exponents take a while.
    let mine = shown.replace("UQ1.23", "UQ1.13").replace("1..=256", "1..=4");
    assert_ne!(shown, mine);
    bench.write("mine.json", mine);
    bench.write("mine.csv", "n,x\n64,0.99\n1,1\n");
    bench.write("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let work = "{\"errors\": {\"configuration\": {\"file\": \"small.json\"}, \"bound\": 0.5}}";
    bench.write("job.json", format!("{{\"format\": \"blysk job\", \"version\": 1, \"work\": {work}}}"));
}

#[test]
fn every_command_is_listed_and_has_an_example() {
    let bench = bench!();
    let general = bench.good("--help");
    assert!(general.contains("Start with: blysk presets"), "{general}");
    for command in COMMANDS {
        assert!(general.contains(&format!("\n  {command} ")), "{command} is not listed: {general}");
        let help = bench.good(&format!("{command} --help"));
        assert!(!examples(&help).is_empty(), "{help}");
        // The list says it in a line, the command's own help at length.
        let (_, listed) = general.split_once(&format!("\n  {command} ")).unwrap();
        let listed = listed.lines().next().unwrap().trim();
        assert!(help.starts_with(listed), "{listed:?} does not begin {help}");
        let (described, _) = help.split_once("\nUsage: ").expect("a usage");
        assert!(described.lines().count() > 2, "no more than the list says: {described}");
        let without = ["vectors", "rtl", "check", "document", "mesh", "shard", "serve", "completions", "man"];
        let has_no_format = without.contains(&command);
        assert!(help.contains("--format") || has_no_format, "{help}");
    }
    assert_eq!(bench.good("--version"), format!("blysk {}\n", env!("CARGO_PKG_VERSION")));
    bench.refused("", &["Usage: blysk"]);
    bench.refused("polish", &["polish", "Usage: blysk"]);
}

/// A server has no end of its own: its examples are begun, and stopped once they have printed their address.
fn begins(bench: &Bench, arguments: &str) {
    // On a free port, as another program may have the one of the example.
    let mut words: Vec<&str> = arguments.split_whitespace().collect();
    if let Some(place) = words.iter().position(|word| *word == "--port") {
        words.drain(place..place + 2);
    }
    words.extend(["--port", "0"]);
    let mut child = bench.command(&words).stdout(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(line.starts_with("http://127.0.0.1:"), "{arguments}: {line:?}");
}

/// Every example runs. A report may find that its bound does not hold, which is status 1.
#[test]
fn every_example_runs() {
    let mut ran = 0;
    for command in COMMANDS {
        let bench = bench!();
        with_files(&bench);
        let help = bench.good(&format!("{command} --help"));
        for example in examples(&help) {
            let (line, _redirected) = example.split_once(" > ").unwrap_or((&example, ""));
            if command == "serve" {
                begins(&bench, line.strip_prefix("blysk ").unwrap());
                ran += 1;
                continue;
            }
            let run = bench.run(line.strip_prefix("blysk ").unwrap());
            assert!(run.status == 0 || (command == "report" && run.status == 1), "{run:#?}");
            assert!(!run.stdout.is_empty() && run.stderr.is_empty(), "{run:#?}");
            ran += 1;
        }
    }
    assert!(ran >= 10, "{ran} examples ran");
}
