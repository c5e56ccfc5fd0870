//! `blysk refine`: the table, and the configuration it writes.

use blysk_tests::bench;
use blysk_tests::cli::{csv_rows, number};

const MINIMAX: &str = r#"{
  "name": "fitted", "method": "minimax", "exponents": "2,5,9", "input": "UQ1.11", "output": "UQ1.10",
  "cut": "balanced", "segments": 2
}"#;

#[test]
fn the_written_configuration_has_the_error_that_was_printed() {
    let bench = bench!();
    bench.write("fitted.json", MINIMAX);
    let text = bench.good("refine --config fitted.json --out better.json --format csv");
    let rows = csv_rows(&text);
    assert_eq!(rows.len(), 6, "{text}");
    assert!(rows.iter().any(|row| number(row, "after") < number(row, "before")), "{text}");
    let again = csv_rows(&bench.good("refine --config better.json --reach 0 --format csv"));
    for (row, again) in rows.iter().zip(&again) {
        assert_eq!(row["after"], again["before"], "{row:?}");
        assert_eq!(row["steps"], again["steps"], "{row:?}");
        let gap = (number(row, "after") - number(row, "method")) * 1024.0;
        assert!((gap - number(row, "gap_after")).abs() < 1e-9, "{row:?}");
    }
    assert!(bench.text("better.json").contains("coefficient_steps"));
    // What follows uses them.
    let _vectors = bench.good("vectors --config better.json --count 64 --out vectors");
    assert_ne!(
        bench.good("rom --config better.json --format csv"),
        bench.good("rom --config fitted.json --format csv")
    );
}

#[test]
fn the_table_is_for_people_and_the_same_every_time() {
    let bench = bench!();
    bench.write("fitted.json", MINIMAX);
    let text = bench.good("refine --config fitted.json --exponents 5 --out one.json");
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    assert!(text.contains("mean gap") && text.contains("written to one.json"), "{text}");
    assert!(!text.contains("gap_before"), "{text}");
    // The rows come on demand, below the summary.
    let rows = bench.good("refine --config fitted.json --exponents 5 --out one.json --rows");
    let (summary, table) = rows.split_once("\n\n").unwrap();
    assert!(text.starts_with(summary) && table.contains("gap_before"), "{rows}");
    let first = bench.text("one.json");
    assert_eq!(text, bench.good("refine --config fitted.json --exponents 5 --out one.json"));
    assert_eq!(first, bench.text("one.json"));
    assert!(!first.contains("\"n\": 2.0") && !first.contains("\"n\": 9.0"), "{first}");
}

#[test]
fn what_cannot_be_searched_is_refused() {
    let bench = bench!();
    bench.refused("refine --config divider.json", &["schlick", "no polynomial"]);
    bench.refused("refine --config small.json --exponents 99 --out x.json", &["n = 99"]);
    bench.refused("refine --config small.json --reach 300", &["--reach", "256"]);
}
