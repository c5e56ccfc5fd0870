//! Options that contradict each other, are missing, or out of range.

use blysk_tests::bench;

use super::edited;

#[test]
fn which_configuration() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n");
    for (command, rest) in
        [("report", ""), ("rom", ""), ("vectors", "--out new"), ("simulate", "--stimulus in.csv --out new")]
    {
        let both = format!("{command} --preset paper --config small.json {rest}");
        bench.refused(&both, &["--preset", "--config", "cannot be used with"]);
        bench.refused(&format!("{command} {rest}"), &["--preset", "--config", "required"]);
        bench.refused(
            &format!("{command} --preset papre {rest}"),
            &["\"papre\"", "paper, blooming, tangent, compact, precise, schlick"],
        );
        bench.refused(
            &format!("{command} --config nowhere.json {rest}"),
            &["cannot read", "nowhere.json", "No such file"],
        );
        bench.refused(&format!("{command} --config . {rest}"), &["cannot read", "directory"]);
    }
    bench.refused("presets show papre", &["\"papre\"", "paper, blooming"]);
    bench.refused("report --all-presets --preset paper", &["--all-presets", "cannot be used with"]);
}

#[test]
fn options_that_are_out_of_range() {
    let bench = bench!();
    for bound in ["0", "-0.1", "NaN", "inf", "1.01", "1e-400", "0.67%", ""] {
        let bound = format!("--bound={bound}");
        bench.refused_list(
            &["report", "--config", "small.json", "--out", "new", &bound],
            &["--bound", "0.0067 for 0.67 %"],
        );
    }
    for (option, said) in [
        ("--count 0", "0 vectors"),
        ("--count -1", "-1"),
        ("--count 1e3", "1e3"),
        ("--count 4194305", "4194304"),
        ("--count 99999999999999999999", "--count"),
        ("--seed -1", "-1"),
        ("--seed 18446744073709551616", "--seed"),
        ("--strategy all", "mixed, compact, corners, even, random or exhaustive"),
    ] {
        bench.refused(&format!("vectors --config small.json --out new {option}"), &[said]);
    }
    // 2^33 vectors.
    bench.refused("vectors --preset paper --strategy exhaustive --out new", &["8589934592", "4194304", "narrower"]);
    for (levels, said) in [
        ("--q NaN", "q = NaN"),
        ("--q inf", "q = inf"),
        ("--q 1", "q = 1"),
        ("--q 0.05", "0 < g < q < 1"),
        ("--g 0", "g = 0"),
        ("--g 0.5", "0 < g < q < 1"),
        ("--q half", "half"),
    ] {
        bench.refused(&format!("coefficients --method hermite --exponents 4 {levels}"), &[said]);
    }
    bench.refused("coefficients --method phong --exponents 4", &["phong", "hermite"]);
    bench.refused("coefficients --method hermite", &["--exponents"]);
    bench.refused("presets --format xml", &["xml", "table", "csv", "json"]);
}

#[test]
fn exponents_the_rom_does_not_have() {
    let bench = bench!();
    for exponents in ["9", "2.5", "1,2,300"] {
        let missing = exponents.rsplit(',').next().unwrap();
        bench.refused(
            &format!("rom --config small.json --exponents {exponents} --out new"),
            &[&format!("n = {missing}"), "1..=8"],
        );
    }
    for exponent in ["9", "2.5"] {
        bench.refused(
            &format!("report --config small.json --curves {exponent} --out new"),
            &["--curves", exponent, "1..=8"],
        );
    }
    for exponent in ["0.5", "NaN", "many"] {
        bench.refused(&format!("report --config small.json --curves {exponent} --out new"), &["--curves", exponent]);
    }
}

/// 2^50 x for each exponent would take years and, to begin with, more memory than there is.
#[test]
fn an_exhaustive_report_that_would_never_end() {
    let bench = bench!();
    for input in ["UQ1.50", "UQ1.62"] {
        let wide = edited("Q2.9", input).replace("\"rational\"", "\"zero\"");
        bench.write("wide.json", wide.replace("1..=8", "1,2"));
        bench.refused("report --config wide.json --exhaustive --out new", &["--exhaustive", "narrower input format"]);
    }
}
