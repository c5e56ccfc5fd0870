//! `blysk claims` from outside, and docs/CLAIMS.md, which it makes.

use std::fs;
use std::path::Path;

use blysk_tests::bench;
use blysk_tests::cli::{csv_rows, number};

#[test]
fn the_page_is_what_its_command_makes() {
    let bench = bench!();
    let made = bench.good("claims --format markdown");
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/CLAIMS.md");
    let kept = fs::read_to_string(page).expect("docs/CLAIMS.md");
    let again = "`make docs` writes docs/CLAIMS.md again; read the difference before you keep it";
    for (line, (made, kept)) in made.lines().zip(kept.lines()).enumerate() {
        assert_eq!(made, kept, "line {}: {again}", line + 1);
    }
    assert_eq!(made, kept, "{again}");
}

#[test]
fn one_claim_is_shown_with_its_numbers() {
    let bench = bench!();
    let shown = bench.good("claims --claim relative-error");
    assert!(shown.contains("holds for n <= 114") && shown.contains("fails from   n = 115"), "{shown}");
    let numbers = csv_rows(&bench.good("claims --claim relative-error --format csv"));
    let of = |column: &str| [0, 1].map(|row: usize| number(&numbers[row], column));
    assert_eq!(of("n"), [114.0, 115.0]);
    let [last, next] = of("value");
    assert!(last < 0.67 && next > 0.67, "{numbers:?}");
}

#[test]
fn every_format_has_every_claim() {
    let bench = bench!();
    let rows = csv_rows(&bench.good("claims --format csv"));
    let json = bench.good("claims --format json");
    let json: Vec<serde_json::Value> = serde_json::from_str(&json).expect("an array");
    let table = bench.good("claims");
    assert!(table.lines().all(|line| line.chars().count() <= 100), "{table}");
    assert!(rows.len() > 15 && rows.len() == json.len());
    for (place, (row, object)) in rows.iter().zip(&json).enumerate() {
        let (claim, verdict) = (&row["claim"], &row["verdict"]);
        assert_eq!((object["id"].as_str(), object["verdict"].as_str()), (Some(claim.as_str()), Some(verdict.as_str())));
        assert!(table.contains(claim), "{claim}");
        // The command of a row shows that row; some of them, because each computes every claim.
        if place % 5 != 0 {
            continue;
        }
        let command = row["command"].strip_prefix("blysk ").expect("a command of blysk");
        assert!(bench.good(command).contains(verdict), "{command}");
    }
}

#[test]
fn files_are_written_together() {
    let bench = bench!();
    let _said = bench.good("claims --out made");
    let names: Vec<String> = bench.tree("made").into_keys().map(|name| name.display().to_string()).collect();
    assert_eq!(names, ["claims.csv", "claims.json", "claims.md", "claims.sha256"]);
}

#[test]
fn a_claim_that_is_not_there_is_an_error_that_names_those_that_are() {
    let bench = bench!();
    bench.refused("claims --claim 17 --out made", &["no such claim", "relative-error"]);
    assert!(!bench.path("made").exists());
}
