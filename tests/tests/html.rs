//! Pages of HTML: in Chromium they show what CSV and Markdown of the same command say, and the same command writes the
//! same bytes.

use std::path::Path;
use std::process::Command;

use blysk_tests::bench;
use blysk_tests::cli::Bench;

/// The commands of every page, for a small configuration each. The files go below `place`.
fn made(bench: &Bench, place: &str) {
    for command in [
        format!("document --config small.json --html --out {place}/document"),
        format!("report --config small.json --html --bound 0.2 --range all --out {place}/report"),
        format!("pareto --input UQ1.6 --exponents 1..=4 --no-timing --html --out {place}/pareto"),
    ] {
        let _said = bench.good(&command);
    }
    let certify = "certify --method hermite --exponents 1..=8 --format csv";
    let said = bench.good(&format!("{certify} --html {place}/certify.html"));
    bench.write(&format!("{place}/certify.csv"), said);
}

#[test]
fn pages_show_in_a_browser_what_the_files_beside_them_say() {
    let bench = bench!();
    made(&bench, "pages");
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let python = tests.join("../target/venv/bin/python3");
    let looked = Command::new(&python).arg(tests.join("browser/pages.py")).arg(bench.path("pages")).output();
    let looked = looked.unwrap_or_else(|error| panic!("{}: {error}; run scripts/setup", python.display()));
    let [out, err] = [looked.stdout, looked.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(looked.status.success(), "{out}{err}");
    let count: usize = out.split(' ').next().and_then(|word| word.parse().ok()).expect("a number of checks");
    assert!(count > 200, "{out}");
}

#[test]
fn the_same_command_writes_the_same_page() {
    let bench = bench!();
    made(&bench, "first");
    made(&bench, "second");
    let (first, second) = (bench.tree("first"), bench.tree("second"));
    assert!(first.keys().filter(|name| name.extension().is_some_and(|end| end == "html")).count() == 4);
    for (name, contents) in &first {
        assert!(second.get(name) == Some(contents), "{}", name.display());
    }
}

/// Pages go with the files of the run that made them.
#[test]
fn a_report_without_its_page_removes_that_of_an_earlier_run() {
    let bench = bench!();
    let _said = bench.good("report --config small.json --html --bound 0.2 --out report");
    assert!(bench.path("report/report.html").exists());
    let _said = bench.good("report --config small.json --bound 0.2 --out report");
    assert!(!bench.path("report/report.html").exists());
    bench.refused("report --config small.json --html", &["--out"]);
    bench.refused("certify --method hermite --exponents 2 --out - --html -", &["standard output has one of them"]);
}
