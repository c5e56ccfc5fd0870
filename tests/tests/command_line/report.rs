//! `blysk report`: verdict, formats, files, and every preset against 32-digit values.

use std::collections::BTreeMap;
use std::path::Path;

use blysk_tests::cli::{csv_rows, number};
use blysk_tests::{bench, reference};
use serde_json::Value;

const COLUMNS: &str = "n,approximation_abs,approximation_rel,approximation_x,coefficient_abs,\
                       datapath_abs,input_abs,total_abs,total_x,full_range_abs,full_range_x,holds,\
                       full_range_holds";

/// Ten significant digits are promised of the method's own error.
const DIGITS: f64 = 1e-10;

/// Where the method is x^n itself, what is left is the noise of evaluating it.
const NOISE: f64 = 1e-15;

#[test]
fn the_exit_status_is_the_verdict() {
    let bench = bench!();
    let holds = bench.good("report --config small.json --bound 0.02");
    assert!(holds.contains("2.0000000 % holds for every exponent"), "{holds}");
    for format in ["csv", "json"] {
        let rows = |bound| bench.good(&format!("report --config small.json --bound {bound} --format {format}"));
        let (both, one) = (rows("0.2"), rows("0.02"));
        assert!(!both.contains("false") && both.contains("true"), "{both}");
        // On all of [0, 1] 2 % do not hold.
        assert!(one.contains("false") && one.matches("true").count() >= 8, "{one}");
    }
    for format in ["table", "csv", "json"] {
        let run = bench.run(&format!("report --config small.json --bound 1e-9 --format {format}"));
        assert_eq!((run.status, run.stderr.as_str()), (1, ""), "{run:#?}");
        let said = if format == "table" { "DOES NOT HOLD" } else { "false" };
        assert!(run.stdout.contains(said), "{run:#?}");
    }
}

/// A verdict names its range, and that on the other range stands beside it.
#[test]
fn both_ranges_have_a_verdict() {
    let bench = bench!();
    let held = bench.good("report --config small.json --bound 0.02");
    let verdicts: Vec<&str> = held.lines().filter(|line| line.starts_with("bound on ")).collect();
    assert_eq!(verdicts.len(), 2, "{held}");
    assert!(verdicts[0].starts_with("bound on the epicentre ") && verdicts[0].contains("holds"));
    assert!(verdicts[1].starts_with("bound on all of [0, 1] ") && verdicts[1].contains("DOES NOT HOLD for "));
    let run = bench.run("report --config small.json --bound 0.02 --range all");
    assert_eq!((run.status, run.stdout), (1, held));
    let both = bench.good("report --config small.json --bound 0.2 --range all");
    assert_eq!(both.matches("holds for every exponent").count(), 2, "{both}");
    // Of every preset only `precise` keeps 0.67 % on all of [0, 1].
    let all = bench.run("report --all-presets");
    assert_eq!(all.status, 1);
    let holds = |name: &str| {
        let line = all.stdout.lines().find(|line| line.contains(name)).expect("a line of it");
        line.matches("holds").count()
    };
    assert_eq!((holds("precise "), holds("compact "), holds("schlick ")), (2, 1, 0), "{all:#?}");
    assert!(all.stdout.lines().all(|line| line.chars().count() <= 100), "{all:#?}");
}

/// One part in 10^15 decides: the bound is inclusive.
#[test]
fn the_bound_itself_still_holds() {
    let bench = bench!();
    let rows = csv_rows(&bench.good("report --config small.json --bound 1 --format csv"));
    let worst = rows.iter().map(|row| number(row, "total_abs")).fold(0.0, f64::max);
    assert!(worst > 1e-4, "{worst}");
    let _held = bench.good(&format!("report --config small.json --bound {worst}"));
    let run = bench.run(&format!("report --config small.json --bound {} --format csv", worst.next_down()));
    assert_eq!(run.status, 1);
    for row in csv_rows(&run.stdout) {
        let holds = number(&row, "total_abs") < worst;
        assert_eq!(row["holds"], holds.to_string(), "{row:?}");
    }
}

#[test]
fn the_files_of_a_report() {
    let bench = bench!();
    let screen = bench.good("report --config small.json --bound 0.02 --out deep/results");
    let names: Vec<String> = bench.tree("deep/results").into_keys().map(|name| name.display().to_string()).collect();
    let wanted = [
        "curves.png",
        "curves.svg",
        "error_full_range.png",
        "error_full_range.svg",
        "error_vs_n.csv",
        "error_vs_n.json",
        "error_vs_n.png",
        "error_vs_n.svg",
        "report.sha256",
    ];
    assert_eq!(names, wanted);
    for name in ["error_vs_n.csv", "error_vs_n.json", "curves", "deep/results"] {
        assert!(screen.contains(name), "{name}: {screen}");
    }
    let csv = bench.text("deep/results/error_vs_n.csv");
    assert_eq!(csv.lines().next(), Some(COLUMNS));
    let rows = csv_rows(&csv);
    assert_eq!(rows.len(), 8);

    let json: Value = serde_json::from_slice(&bench.read("deep/results/error_vs_n.json")).unwrap();
    assert_eq!(
        (&json["configuration"], &json["bound"], &json["exhaustive"]),
        (&"small".into(), &0.02.into(), &false.into())
    );
    same_rows(&rows, json["rows"].as_array().unwrap());
    // What is printed is what is written.
    let printed = bench.good("report --config small.json --bound 0.02 --format csv");
    assert_eq!(printed.lines().next(), Some(COLUMNS));
    let json = bench.good("report --config small.json --bound 0.02 --format json");
    let json: Vec<Value> = serde_json::from_str(&json).unwrap();
    same_rows(&csv_rows(&printed), &json);
    same_rows(&rows, &json);

    for name in wanted.iter().filter(|name| name.ends_with(".png")) {
        let png = bench.read(&format!("deep/results/{name}"));
        assert!(png.starts_with(b"\x89PNG\r\n\x1a\n") && png.len() > 5000, "{name}");
    }
    for name in wanted.iter().filter(|name| name.ends_with(".svg")) {
        let svg = bench.text(&format!("deep/results/{name}"));
        assert!(svg.contains("<svg") && svg.trim_end().ends_with("</svg>"), "{name}");
        assert!(svg.len() > 2000, "{name}");
    }
}

fn same_rows(csv: &[BTreeMap<String, String>], json: &[Value]) {
    assert_eq!(csv.len(), json.len());
    assert!(!csv.is_empty());
    for (csv, json) in csv.iter().zip(json) {
        let object = json.as_object().unwrap();
        assert_eq!(object.len(), csv.len());
        for column in COLUMNS.split(',') {
            match &object[column] {
                Value::Bool(flag) => assert_eq!(csv[column], flag.to_string()),
                value => assert_eq!(value.as_f64(), Some(number(csv, column)), "{column}"),
            }
        }
    }
}

/// The same report again gives the same bytes, whatever the threads do; another exponent of the plot
/// changes that plot only.
#[test]
fn a_report_is_repeatable() {
    let bench = bench!();
    for (place, more) in [("a", ""), ("b", ""), ("c", "--curves 2")] {
        let _screen = bench.good(&format!("report --config small.json --bound 1 --out {place} {more}"));
    }
    let (a, b, c) = (bench.tree("a"), bench.tree("b"), bench.tree("c"));
    assert!(a == b);
    for (name, contents) in &a {
        // The list has the plot's SHA-256.
        let name = name.to_string_lossy();
        let curves = name.starts_with("curves") || name == "report.sha256";
        assert_eq!(c[Path::new(&*name)] != *contents, curves, "{name}");
    }
}

/// Every preset at once: one row for each of 256 exponents and six presets, in one table.
#[test]
fn every_preset_has_the_methods_own_error() {
    let bench = bench!();
    let run = bench.run("report --all-presets --format csv --out all");
    assert_eq!(run.status, 1, "Schlick is 8 % off: {}", run.stderr);
    let rows = csv_rows(&run.stdout);
    assert_eq!(rows.len(), 6 * 256);
    let mut of = BTreeMap::new();
    for row in &rows {
        of.insert((row["preset"].clone(), row["n"].clone()), row);
        parts_bound_the_total(row);
    }
    let known = reference::rows();
    let mut compared = 0;
    for (preset, method) in [
        ("paper", "hermite"),
        ("compact", "hermite"),
        ("blooming", "three_point"),
        ("tangent", "tangent"),
        ("schlick", "schlick"),
    ] {
        for wanted in known.iter().filter(|row| row.method == method) {
            let key = (preset.to_owned(), wanted.exponent.to_string());
            let Some(row) = of.get(&key) else { continue };
            for (column, reference) in [("approximation_abs", "epi_abs"), ("approximation_rel", "epi_rel")] {
                let (found, wanted) = (number(row, column), wanted.value(reference).unwrap());
                let error = (found - wanted).abs();
                assert!(error <= (DIGITS * wanted).max(NOISE), "{key:?}: {found:e}, {wanted:e}");
                compared += 1;
            }
        }
        let csv = bench.text(&format!("all/{preset}/error_vs_n.csv"));
        assert_eq!((csv.lines().next(), csv.lines().count()), (Some(COLUMNS), 257));
    }
    // 20 exponents of the table are integers up to 256.
    assert_eq!(compared, 5 * 20 * 2, "errors compared");

    // The two figures that the paper is quoted for.
    for (n, printed) in [("64", "0.00506510790"), ("256", "0.00542237003")] {
        let found = number(of[&("paper".to_owned(), n.to_owned())], "approximation_abs");
        assert_eq!(format!("{found:.11}"), printed, "n = {n}");
    }
}

/// Method, coefficients and data path together are at least the total.
pub(crate) fn parts_bound_the_total(row: &BTreeMap<String, String>) {
    let part = |column| number(row, column);
    let parts = part("approximation_abs") + part("coefficient_abs") + part("datapath_abs") + 1e-12;
    assert!(part("total_abs") <= parts, "{row:?}");
    assert!(part("total_abs") <= part("full_range_abs"), "{row:?}");
    assert!(part("input_abs") > 0.0, "{row:?}");
    for place in ["approximation_x", "total_x", "full_range_x"] {
        assert!((0.0..=1.0).contains(&part(place)), "{row:?}");
    }
}

/// Each part has its x, and one that is greater than the total is explained.
#[test]
fn parts_are_greatest_at_an_x_of_their_own() {
    let bench = bench!();
    let shown = bench.good("presets show compact");
    // So few x that none lies where the method errs most.
    let lines = shown.lines().filter(|line| !line.contains("multiplier_operand") && !line.contains("\"widths\""));
    let coarse = lines.collect::<Vec<_>>().join("\n").replace("1..=256", "200,256").replace("UQ1.23", "UQ1.9");
    bench.write("coarse.json", coarse);
    for (which, explained) in [("--preset compact", false), ("--config coarse.json", true)] {
        let text = bench.run(&format!("report {which}")).stdout;
        let percent = |name: &str| -> f64 {
            let line = text.lines().find(|line| line.trim_start().starts_with(name)).unwrap();
            assert!(line.contains(" % at ") && line.contains("x = "), "{line}");
            line.split(" %").next().unwrap().split_whitespace().last().unwrap().parse().unwrap()
        };
        let total = percent("worst total error");
        let above = ["method  ", "ROM coefficients", "data path"].into_iter().any(|part| percent(part) > total);
        assert_eq!((above, text.contains("(a part is greater than the total")), (explained, explained), "{text}");
    }
}
