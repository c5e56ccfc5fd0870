//! `blysk certify`: what it prints, and what it says to certificates that were tampered with.

use blysk_tests::bench;
use blysk_tests::cli::{csv_rows, number};

/// The supremum of the hermite error over every n, by 60-digit arithmetic: in the limit the
/// parabola 1 − s/(2L) − (1/2 − 1/(2L))·s·(s − L)/L, L = ln 2, against e^−s.
const SUPREMUM: f64 = 0.005_544_539_929_022_122;

#[test]
fn every_real_exponent_at_once() {
    let bench = bench!();
    let screen = bench.good("certify --all-real-n --bound 0.00555 --out hermite.json");
    for said in ["hermite", "n -> infinity", "at most 0.00555: proved", "hermite.json"] {
        assert!(screen.contains(said), "{said}: {screen}");
    }
    let rows = csv_rows(&bench.good("certify --all-real-n --format csv"));
    assert_eq!(rows.len(), 2);
    let absolute = rows.iter().find(|row| row["error"] == "absolute").unwrap();
    let (lower, upper) = (number(absolute, "lower"), number(absolute, "upper"));
    assert!(0.005544 < lower && lower <= upper && upper < 0.005546, "{absolute:?}");
    assert!(lower <= SUPREMUM && SUPREMUM <= upper, "{absolute:?}");
    assert!((upper - lower) / lower <= 1e-6);
    assert_eq!(number(absolute, "h"), 0.0);

    let accepted = bench.good("certify --check hermite.json");
    assert!(accepted.contains("ACCEPTED 2 enclosures"), "{accepted}");
    let run = bench.run("certify --all-real-n --bound 0.0055");
    assert_eq!(run.status, 1, "{run:#?}");
    assert!(run.stdout.contains("NOT PROVED"), "{run:#?}");
}

/// A bound on the epicentre is not proved by what is said of tails, and what is accepted is shown.
#[test]
fn nothing_is_proved_of_nothing() {
    let bench = bench!();
    let tail = "certify --method rational --exponents 64 --bound 0.001 --out tail.json";
    bench.refused(tail, &["--bound", "epicentre", "rational"]);
    let _said = bench.good("certify --method rational --exponents 64 --out tail.json");
    assert_eq!(bench.run("certify --check tail.json --bound 0.9").status, 1);
    let _said = bench.good("certify --method hermite --exponents 3.0001,7 --out some.json");
    let accepted = bench.good("certify --check some.json --bound 0.0021");
    for said in ["0.00203390", "wider than", "ACCEPTED", "at most 0.0021: proved"] {
        assert!(accepted.contains(said), "{said}: {accepted}");
    }
    assert_eq!(bench.run("certify --check some.json --bound 0.002").status, 1);
    bench.refused("certify --exponents -3", &["exponent -3", "1 to 1e15"]);
}

/// Digits all over a certificate of each kind are made other ones; that every single one counts, the library's
/// test of the seal shows.
#[test]
fn no_digit_can_be_another() {
    let bench = bench!();
    for (arguments, step) in [
        ("--exponents 1,2.5 --method schlick", 11),
        ("--all-real-n --method schlick", 5),
        ("--all-real-n", 1499),
        ("--config divider.json", 7),
    ] {
        let _screen = bench.good(&format!("certify {arguments} --out good.json"));
        let _accepted = bench.good("certify --check good.json");
        let good = bench.read("good.json");
        let digits = (0..good.len()).filter(|&at| good[at].is_ascii_digit());
        let mut refused = 0;
        for at in digits.step_by(step) {
            let mut bad = good.clone();
            bad[at] = if bad[at] == b'9' { b'0' } else { bad[at] + 1 };
            bench.write("bad.json", &bad);
            let run = bench.run("certify --check bad.json");
            // A sealed digit is refused; an exponent "0" or a version "2" is no certificate.
            assert!(run.status == 1 || run.status == 2, "byte {at} of {arguments}: {run:#?}");
            let said = if run.status == 1 { &run.stdout } else { &run.stderr };
            assert!(said.starts_with("REFUSED") || said.starts_with("error"), "{run:#?}");
            refused += 1;
        }
        assert!(refused >= 20, "{refused} digits of {arguments}");
    }
}

#[test]
fn a_refusal_names_the_field() {
    let bench = bench!();
    let _screen = bench.good("certify --exponents 4 --method hermite --out good.json");
    let good = bench.text("good.json");
    let lower = good.lines().find(|line| line.contains("\"lower\"")).unwrap();
    let raised = lower.replace("0.00056", "0.00066");
    assert_ne!(lower, raised);
    bench.write("bad.json", good.replace(lower, &raised));
    let run = bench.run("certify --check bad.json");
    assert_eq!(run.status, 1);
    for said in ["REFUSED", "claims[0] (hermite, n = 4, epicentre), absolute.lower", "sha256"] {
        assert!(run.stdout.replace('\n', " ").contains(said), "{said}: {run:#?}");
    }
    // One more empty line is not the certificate either.
    bench.write("bad.json", good.clone() + "\n");
    let run = bench.run("certify --check bad.json");
    assert!(run.status == 1 && run.stdout.contains("line"), "{run:#?}");
}

#[test]
fn every_method_has_its_regions() {
    let bench = bench!();
    let rows = csv_rows(&bench.good("certify --exponents 1,2.5,64 --format csv"));
    assert_eq!(rows.len(), 10 * 3);
    let mut wide = 0;
    for row in &rows {
        if row["exact"] == "true" {
            assert_eq!((row["n"].as_str(), number(row, "absolute_upper")), ("1", 0.0));
            continue;
        }
        let (lower, upper) = (number(row, "absolute_lower"), number(row, "absolute_upper"));
        assert!(0.0 < lower && lower <= upper && (upper - lower) / lower <= 1e-6, "{row:?}");
        assert_eq!(row["relative_lower"].is_empty(), row["region"] == "tail");
        wide += 1;
    }
    assert_eq!(wide, 10 * 2);
    let json = bench.good("certify --exponents 2.5 --method tangent --format json");
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json[0]["method"], "tangent");
    // More exponents than a screen holds are summed up.
    let screen = bench.good("certify --exponents 1..=30 --method composite");
    assert!(screen.contains("greatest") && screen.lines().count() < 12, "{screen}");
    assert!(screen.lines().all(|line| line.chars().count() <= 100), "{screen}");
}

#[test]
fn hardware_down_to_its_bits() {
    let bench = bench!();
    for name in ["small", "centred", "divider"] {
        let screen = bench.good(&format!("certify --config {name}.json --out certificate.json"));
        assert!(screen.contains("by exhaustion"), "{screen}");
        let accepted = bench.good("certify --check certificate.json");
        let rows = csv_rows(&bench.good(&format!("certify --config {name}.json --format csv")));
        // The report's own figures, by floating point.
        let report = bench.run(&format!("report --config {name}.json --exhaustive --format csv"));
        let report = csv_rows(&report.stdout);
        assert_eq!(rows.len(), report.len());
        for (row, measured) in rows.iter().zip(&report) {
            for (part, column) in [("epicentre", "total_abs"), ("full_range", "full_range_abs")] {
                let measured = number(measured, column);
                let lower = number(row, &format!("{part}_lower"));
                let upper = number(row, &format!("{part}_upper"));
                assert!(lower <= measured + 1e-15 && measured <= upper, "{row:?}");
                assert!(upper - lower <= 1e-15, "{row:?}");
            }
        }
        let points = accepted.lines().find(|line| line.starts_with("ACCEPTED")).unwrap();
        let points: u64 = points.split(' ').nth(1).unwrap().parse().unwrap();
        assert!(points >= 2048, "{accepted}");
    }
    let run = bench.run("certify --config small.json --bound 0.004");
    assert!(run.status == 1 && run.stdout.contains("NOT PROVED"), "{run:#?}");
}

#[test]
fn the_same_command_writes_the_same_bytes() {
    let bench = bench!();
    for arguments in ["--exponents 1..=8", "--all-real-n --method all", "--config small.json"] {
        let first = bench.good(&format!("certify {arguments} --out a.json"));
        let second = bench.good(&format!("certify {arguments} --out b.json"));
        assert_eq!(first.replace("a.json", "b.json"), second);
        assert!(bench.read("a.json") == bench.read("b.json"));
    }
}

#[test]
fn what_is_no_certificate_or_no_claim() {
    let bench = bench!();
    bench.write("text.json", "nothing");
    bench.write("empty.json", "");
    bench.write("other.json", "{\"format\": \"blysk certificate\"}");
    bench.write("bytes.json", [0xff, 0xfe]);
    for name in ["text.json", "empty.json", "other.json", "small.json", "bytes.json", "."] {
        bench.refused(&format!("certify --check {name}"), &[name, "certificate"]);
    }
    bench.refused("certify --check nowhere.json", &["nowhere.json", "No such file"]);
    let _screen = bench.good("certify --exponents 4 --out good.json");
    let later = bench.text("good.json").replace("\"version\": 1", "\"version\": 2");
    bench.write("later.json", later);
    bench.refused("certify --check later.json", &["later.json", "version 2", "version 1"]);
    bench.refused("certify", &["--exponents", "--all-real-n", "--check", "required"]);
    bench.refused("certify --exponents 4 --all-real-n", &["cannot be used with"]);
    bench.refused("certify --check good.json --out new.json", &["cannot be used with"]);
    bench.refused("certify --preset paper --method hermite", &["cannot be used with"]);
    bench.refused("certify --exponents 4 --method cubic", &["\"cubic\"", "schlick, or all"]);
    bench.refused("certify --exponents 0.5", &["0.5", "1 to 1e15"]);
    bench.refused("certify --exponents 4 --q 1", &["0 < g < q < 1"]);
    bench.refused("certify --all-real-n --method rational", &["tail", "epicentre"]);
    bench.refused("certify --exponents 4 --out small.json/new", &["a file is in the way"]);
    bench.refused("certify --exponents 4 --out .", &["not the name of a file"]);
    let wide = blysk_tests::cli::CENTRED.replace("UQ1.10", "UQ1.54");
    bench.write("wide.json", wide.replace("1,2.5,3,9.75,31", "1"));
    bench.refused("certify --config wide.json", &["54", "53"]);
    let many = blysk_tests::cli::CENTRED.replace("UQ1.10", "UQ1.45");
    bench.write("many.json", many.replace("1,2.5,3,9.75,31", "1"));
    bench.refused("certify --config many.json --out new", &["narrower"]);
}
