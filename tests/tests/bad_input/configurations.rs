//! Configurations that are none, or cannot be used.

use blysk_tests::bench;
use blysk_tests::cli::{Bench, SMALL};

use super::edited;

/// Every command that takes a configuration refuses this one, and says so.
fn refused_by_all(bench: &Bench, json: &str, said: &[&str]) {
    bench.write("bad.json", json);
    bench.write("in.csv", "n,x\n1,0.5\n");
    let mut said = said.to_vec();
    said.push("bad.json");
    for command in [
        "rom --config bad.json --out new/deep",
        "vectors --config bad.json --out new/deep",
        "simulate --config bad.json --stimulus in.csv --out new/deep",
        "report --config bad.json --out new/deep",
    ] {
        bench.refused(command, &said);
    }
}

#[test]
fn json_that_is_none() {
    let bench = bench!();
    for (json, said) in [
        ("", "the file is empty"),
        ("\n", "line 2 column 0"),
        (&SMALL.replace("3\n}", "3,\n  \"q\": 0,5\n}"), "`0,5` a decimal comma? write 0.5"),
        ("{", "line 1 column 1"),
        ("[]", "line 1 column 2"),
        ("{\"name\": \"a\",\n \"method\": hermite}", "line 2 column 12"),
        ("not json", "line 1 column 2"),
    ] {
        refused_by_all(&bench, json, &[said]);
    }
    let cut = &SMALL[..SMALL.len() / 2];
    refused_by_all(&bench, cut, &["EOF", "line 5 column"]);
    bench.write("bad.json", [0xff, 0xfe, b'{']);
    bench.refused("rom --config bad.json", &["bad.json", "UTF-8"]);
}

#[test]
fn fields_that_are_unknown_missing_or_of_another_kind() {
    let bench = bench!();
    for (from, to, said) in [
        ("\"method\"", "\"methods\"", &["`methods`", "`method`", "line 4 column 11"][..]),
        ("\"tail\"", "\"tail_policy\"", &["`tail_policy`", "`tail`", "line 9 column 15"]),
        ("  \"method\": \"hermite\",\n", "", &["missing field `method`"]),
        ("\"hermite\"", "\"hermit\"", &["`hermit`", "`hermite`, ", "`schlick` at line 4 column"]),
        ("\"hermite\"", "3", &["`\"method\": 3`", "line 4 column 13"]),
        ("\"power\"", "\"horner\"", &["`horner`", "`power`", "`centred`", "line 8 column"]),
        ("\"rational\"", "\"none\"", &["`none`", "`zero`", "line 9 column"]),
        ("3\n}", "3,\n \"method\": \"tangent\"\n}", &["duplicate field `method`", "line 11"]),
        ("3\n}", "\"3\"\n}", &["quotient_bits_per_stage", "string \"3\"", "line 10 column"]),
        ("3\n}", "-3\n}", &["quotient_bits_per_stage", "integer `-3`", "line 10 column"]),
        ("3\n}", "3,\n \"widths\": {\"t9\": \"Q1.2\"}\n}", &["`t9`", "`t1`", "line 11 column"]),
        ("3\n}", "3,\n \"widths\": {\"t1\": \"Q1\"}\n}", &["\"Q1\"", "t1", "line 11 column"]),
        ("3\n}", "3,\n \"error_budget_ulp\": NaN\n}", &["error_budget_ulp", "line 11 column"]),
        ("3\n}", "3,\n \"q\": 1e999\n}", &["\"q\"", "number out of range", "line 11 column"]),
    ] {
        refused_by_all(&bench, &edited(from, to), said);
    }
}

#[test]
fn exponents_that_are_none() {
    let bench = bench!();
    for (list, said) in [
        ("0.5", "0.5"),
        ("0..=4", "0"),
        ("-2", "-2"),
        ("NaN", "NaN"),
        ("inf", "inf"),
        ("1e16", "1e16"),
        ("", "missing"),
        ("1..4", "1..=4"),
        ("4..=1", "smaller bound first"),
        ("1,1", "once"),
        ("2,1", "increasing"),
        ("1..=1e9", "65536"),
        ("two", "\"two\""),
    ] {
        refused_by_all(&bench, &edited("1..=8", list), &[said, "exponents", "line 5 column"]);
        let arguments = ["coefficients", "--method", "hermite", "--exponents", list];
        bench.refused_list(&arguments, &[said, "--exponents"]);
    }
    let wrong_type = edited("\"1..=8\"", "[1, 2]");
    refused_by_all(&bench, &wrong_type, &["sequence", "exponents", "line 5 column"]);
}

#[test]
fn values_that_cannot_be_used() {
    let bench = bench!();
    let more = |field: &str| edited("3\n}", &format!("3,\n {field}\n}}"));
    for (json, said) in [
        (more("\"q\": 0.05"), &["q", "0 < g < q < 1"][..]),
        (more("\"q\": 0.5, \"g\": 0.5"), &["g", "0 < g < q < 1"]),
        (more("\"q\": 1.0"), &["q", "0 < g < q < 1"]),
        (more("\"g\": -0.1"), &["g", "0 < g < q < 1"]),
        (more("\"error_budget_ulp\": 0"), &["error_budget_ulp", "above 0"]),
        (more("\"error_budget_ulp\": -1"), &["error_budget_ulp", "above 0"]),
        (more("\"cut\": \"minimum\""), &["`cut`", "\"epicentre\""]),
        (more("\"widths\": {\"u\": \"UQ1.9\"}"), &["`widths.u`", "centred"]),
        (edited("\"small\"", "\"../up\""), &["`name`", "letters"]),
        (edited("\"small\"", "\"\""), &["`name`", "letters"]),
        (edited("\"hermite\"", "\"composite\""), &["`method`", "\"hermite\""]),
        (edited("\"hermite\"", "\"rational\""), &["`method`", "tail"]),
        (edited("stage\": 3", "stage\": 0"), &["`quotient_bits_per_stage`", "1 to 8"]),
        (edited("stage\": 3", "stage\": 9"), &["`quotient_bits_per_stage`", "1 to 8"]),
    ] {
        refused_by_all(&bench, &json, said);
    }
}

#[test]
fn formats_that_cannot_be_used_or_could_overflow() {
    let bench = bench!();
    let more = |field: &str| edited("3\n}", &format!("3,\n \"widths\": {{{field}}}\n}}"));
    for (json, said) in [
        (edited("Q2.9", "Q2,9"), &["\"Q2,9\"", "line 6 column"][..]),
        (edited("Q2.9", "Q40.40"), &["Q40.40", "63", "line 6 column"]),
        (edited("Q2.9", "Q-1.9"), &["`input`", "UQ1.n"]),
        (edited("UQ1.8", "Q2.8"), &["`output`", "UQ1.15"]),
        (edited("UQ1.8", "UQ1.0"), &["`output`", "UQ1.n"]),
        (edited("UQ1.8", "UQ1.61"), &["error budget", "error_budget_ulp"]),
        // 2 integer bits do not hold a coefficient of 200 and more.
        (more("\"c2\": \"Q2.20\""), &["c2", "Q2.20", "overflow", "n = "]),
        (more("\"t1\": \"Q1.20\""), &["t1", "Q1.20", "overflow", "needs"]),
        (more("\"t2\": \"UQ0.20\""), &["t2", "UQ0.20", "overflow", "needs"]),
        (more("\"tail_a\": \"UQ1.9\""), &["tail_a", "UQ1.9", "overflow"]),
        (more("\"divisor\": \"UQ1.9\""), &["divisor", "UQ1.9"]),
        // Compared with x: between 0 and 1, in no finer unit.
        (more("\"cut\": \"Q2.5\""), &["`widths.cut`", "unsigned"]),
        (more("\"cut\": \"UQ2.5\""), &["`widths.cut`", "one integer bit"]),
        (more("\"cut\": \"UQ1.10\""), &["`widths.cut`", "fraction bits than the input's"]),
        (more("\"hand_over\": \"UQ1.9\""), &["`widths.hand_over`", "two segments"]),
        // Wide enough, and too coarse for the error budget.
        (more("\"t2\": \"Q9.1\""), &["error budget", "error_budget_ulp"]),
    ] {
        refused_by_all(&bench, &json, said);
    }
}
