//! What is printed: narrow enough for a terminal, and into any kind of standard output.

use std::fs::File;
use std::io::{pipe, read_to_string};
use std::path::Path;
use std::process::Stdio;

use blysk_tests::bench;
use blysk_tests::cli::CONFIGURATIONS;

const PRESETS: [&str; 6] = ["paper", "blooming", "tangent", "compact", "precise", "schlick"];

/// Columns of a terminal that a table may take.
const WIDTH: usize = 100;

fn narrow(command: &str, text: &str) {
    assert!(!text.is_empty(), "{command}");
    for line in text.lines() {
        let columns = line.chars().count();
        assert!(columns <= WIDTH, "{command}: {columns} columns: {line}");
        assert!(line.chars().all(|c| !c.is_control()), "{command}: {line:?}");
    }
}

#[test]
fn tables_fit_a_terminal() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n2,0.25\n");
    let mut commands: Vec<String> = ["presets", "presets list"].map(str::to_owned).to_vec();
    let presets = PRESETS.map(|preset| format!("--preset {preset}"));
    let small = CONFIGURATIONS.map(|(file, _)| format!("--config {file}"));
    for which in presets.iter().chain(&small) {
        commands.push(format!("rom {which}"));
        commands.push(format!("simulate {which} --stimulus in.csv"));
        commands.push(format!("vectors {which} --count 64 --out v"));
        commands.push(format!("document {which} --out d"));
    }
    for which in &small {
        commands.push(format!("report {which} --bound 1 --out r"));
        commands.push(format!("report {which} --bound 1"));
        commands.push(format!("stability {which} --samples 50 --out s"));
    }
    for method in ["hermite", "three_point", "tangent", "quadratic", "rational", "composite", "schlick"] {
        commands.push(format!("coefficients --method {method} --exponents 1,2.5,114,1e6,1e15"));
    }
    for preset in &presets {
        commands.push(format!("stability {preset} --part edges"));
    }
    let odd: Vec<String> = (1..80).step_by(2).map(|n| n.to_string()).collect();
    commands.push(format!("pareto --input UQ1.10 --exponents {} --rounds 15", odd.join(",")));
    commands.push("stability --part seams --preset compact --exponents 1,100".to_owned());
    for command in &commands {
        narrow(command, &bench.good(command));
    }
    for command in [
        "",
        "report",
        "vectors",
        "check",
        "simulate",
        "coefficients",
        "rom",
        "document",
        "stability",
        "pareto",
        "presets",
    ] {
        let command = format!("{command} --help");
        narrow(&command, &bench.good(&command));
    }
}

/// A long description and a long list of exponents do not break the lines.
#[test]
fn long_texts_are_folded() {
    let bench = bench!();
    let odd: Vec<String> = (1..120).step_by(2).map(|n| n.to_string()).collect();
    let long = CONFIGURATIONS[0].1.replace("few bits", &"many words ".repeat(30)).replace("1..=8", &odd.join(","));
    bench.write("long.json", long);
    bench.write("in.csv", "n,x\n1,0.5\n");
    for command in ["report --bound 1", "rom", "vectors --count 64 --out v"] {
        let command = format!("{command} --config long.json");
        narrow(&command, &bench.good(&command));
    }
    let report = bench.good("report --bound 1 --config long.json");
    assert!(report.contains("60 exponents (1 to 119)"), "{report}");
}

/// Every line of every preset's report, whether or not its bound holds.
#[test]
fn reports_of_presets_fit_a_terminal() {
    let bench = bench!();
    for preset in PRESETS {
        let run = bench.run(&format!("report --preset {preset} --out r"));
        narrow(&run.command, &run.stdout);
    }
    narrow("report", &bench.run("report --all-presets").stdout);
}

/// Whoever reads may stop: that is no error, and what was to be written is there.
#[test]
fn a_closed_pipe_is_no_error() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n");
    let commands = [
        "presets",
        "presets show paper",
        "--help",
        "rom --preset paper",
        "rom --preset paper --format csv --out rom",
        "rom --preset paper --format json",
        "coefficients --method hermite --exponents 1..=2000",
        "coefficients --method hermite --exponents 1..=2000 --format csv",
        "coefficients --method hermite --exponents 1..=2000 --format json",
        "report --config small.json --out report",
        "report --config small.json --format csv",
        "report --config small.json --format json",
        "stability --config small.json --samples 9 --out stability",
        "stability --config small.json --part seams --format csv",
        "simulate --config small.json --stimulus in.csv --out run",
        "vectors --config small.json --count 9 --out vectors",
    ];
    for command in commands {
        let arguments: Vec<&str> = command.split(' ').collect();
        let (reader, writer) = pipe().unwrap();
        drop(reader);
        let mut process = bench.command(&arguments);
        let output = process.stdout(writer).stderr(Stdio::piped()).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), stderr.as_str()), (Some(0), ""), "{command}");
    }
    for file in
        ["rom/rom.csv", "report/error_vs_n.csv", "run/trace.csv", "vectors/manifest.json", "stability/seams.json"]
    {
        assert!(!bench.read(file).is_empty(), "{file}");
    }
}

/// A closed pipe does not change the verdict in the exit status.
#[test]
fn the_first_line_of_a_long_table_can_be_had_alone() {
    use std::io::{BufRead, BufReader};
    let bench = bench!();
    let arguments: Vec<&str> = "rom --preset paper --format csv".split(' ').collect();
    let mut process = bench.command(&arguments);
    let mut child = process.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.starts_with("address,n,word,"), "{line}");
    let stderr = read_to_string(child.stderr.take().unwrap()).unwrap();
    assert_eq!((child.wait().unwrap().code(), stderr.as_str()), (Some(0), ""));
}

#[test]
fn a_full_standard_output_is_an_error() {
    let full = Path::new("/dev/full");
    if !full.exists() {
        return;
    }
    let bench = bench!();
    for command in ["rom --preset paper", "rom --preset paper --format csv", "presets"] {
        let arguments: Vec<&str> = command.split(' ').collect();
        let mut process = bench.command(&arguments);
        let full = File::options().write(true).open(full).unwrap();
        let output = process.stdout(full).stderr(Stdio::piped()).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{command}: {stderr}");
        assert!(stderr.contains("standard output") && stderr.contains("space"), "{stderr}");
        assert!(!stderr.contains("panicked"), "{stderr}");
    }
}
