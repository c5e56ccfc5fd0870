//! `blysk check`: right answers pass however they are spelt, and no wrong one does.

use std::io::pipe;
use std::process::Stdio;

use blysk_tests::answers::Log;
use blysk_tests::bench;
use blysk_tests::cli::{Bench, CONFIGURATIONS};

const COUNT: usize = 64;
const CHECK: &str = "check --vectors v --log dut.csv";

/// The right answers to the vectors of a small configuration, which are in `v`.
fn right(bench: &Bench, file: &str) -> Log {
    let vectors = format!("vectors --config {file} --strategy random --count {COUNT} --out v");
    let _summary = bench.good(&vectors);
    Log::right(bench, "v")
}

fn passes(bench: &Bench, log: &Log) {
    bench.write("dut.csv", log.text());
    assert_eq!(bench.good(CHECK), format!("PASS {COUNT} vectors\n"));
}

/// What is said of a log that fails; `said` must be among it.
fn fails(bench: &Bench, log: &Log, said: &[&str]) -> String {
    bench.write("dut.csv", log.text());
    let run = bench.run(CHECK);
    assert!(run.status == 1 && run.stderr.is_empty(), "{run:#?}");
    assert!(run.stdout.starts_with("FAIL vector "), "{run:#?}");
    for said in said {
        assert!(run.stdout.contains(said), "{said:?} is not said: {run:#?}");
    }
    run.stdout
}

#[test]
fn right_answers_pass_however_they_are_written() {
    let bench = bench!();
    for (file, _) in CONFIGURATIONS {
        let log = right(&bench, file);
        assert!(log.columns.len() > 5, "{:?}", log.columns);
        passes(&bench, &log);
        passes(&bench, &log.spelt(|field| field[2..].to_owned()));
        passes(&bench, &log.spelt(|field| field[2..].to_uppercase()));
        let shortest = |field: &str| u64::from_str_radix(&field[2..], 16).unwrap();
        passes(&bench, &log.spelt(|field| format!("0x{:x}", shortest(field))));
        passes(&bench, &log.spelt(|field| format!(" {:x} ", shortest(field))));
        // Registers, status and index may be left out.
        passes(&bench, &log.only(&["intensity"]));
        passes(&bench, &log.only(&["status", "intensity"]));
        passes(&bench, &log.only(&["intensity", "front_end.region", "index"]));
        // With the index the lines may come in any order.
        let mut turned = log.clone();
        turned.lines.reverse();
        passes(&bench, &turned);
        // The columns may have the names of the table's hex columns.
        let mut named = log.only(&["intensity", "front_end.region"]);
        named.columns = vec!["intensity_hex".to_owned(), "front_end.region_hex".to_owned()];
        passes(&bench, &named);
    }
}

#[test]
fn a_wrong_intensity_is_shown_with_its_vector() {
    let bench = bench!();
    let right = right(&bench, "small.json").only(&["intensity", "status"]);
    let table = blysk_tests::cli::csv_rows(&bench.text("v/vectors.csv"));
    let mut log = right.clone();
    log.spoil(40, "intensity");
    log.spoil(17, "intensity");
    let (row, got) = (&table[17], log.field(17, "intensity").clone());
    let said = fails(
        &bench,
        &log,
        &[
            &format!("FAIL vector 17: n = {} (address {})", row["n"], row["address"]),
            &format!("x = {} ({}), line 19 of the log", row["x_hex"], row["x_real"]),
            &format!("intensity: got {got} ("),
            &format!("expected {} ({})", row["intensity_hex"], row["intensity_real"]),
            "2 of 64 vectors fail",
            "2 differ at the ports",
            "Columns of registers",
        ],
    );
    assert!(!said.contains("status"), "the status is right: {said}");
    // Intensity is UQ1.8.
    let real = f64::from(u16::from_str_radix(&got[2..], 16).unwrap()) / 256.0;
    assert!(said.contains(&format!("got {got} ({real}), expected")), "{said}");
}

#[test]
fn a_wrong_status_is_shown_by_its_flags() {
    let bench = bench!();
    let mut log = right(&bench, "small.json").only(&["intensity", "status"]);
    let plain = log.lines.iter().position(|line| line[1] == "0x0").unwrap();
    *log.field(plain, "status") = "0xa".to_owned();
    let said = ["status: got 0xa (above_one+clamped), expected 0x0 (-)", "as expected"];
    fails(&bench, &log, &said);
}

/// The first register in the order of the pipeline, whatever the order of the columns.
#[test]
fn the_first_wrong_register_is_named() {
    let bench = bench!();
    let right = right(&bench, "small.json");
    let mut log = right.only(&["index", "intensity", "stage3.t3", "stage2.t2", "stage1.t1"]);
    for line in 20..30 {
        for column in ["intensity", "stage3.t3", "stage2.t2"] {
            log.spoil(line, column);
        }
    }
    log.spoil(50, "stage3.t3");
    log.lines.reverse();
    let said =
        fails(&bench, &log, &["FAIL vector 20:", "11 of 64", "10 depart first at stage2", "1 depart first at stage3"]);
    let first = format!("departs first at stage2.t2: got {}", log.lines[63 - 20][3]);
    assert!(said.contains(&first), "{said}");
    assert!(!said.contains("stage1") && !said.contains("Columns of"), "{said}");
}

/// One wrong bit anywhere, with everything else right.
#[test]
fn no_register_is_overlooked() {
    let bench = bench!();
    for (file, _) in CONFIGURATIONS {
        let right = right(&bench, file);
        for (line, column) in right.columns.iter().skip(1).enumerate() {
            let mut log = right.clone();
            log.spoil(line, column);
            fails(&bench, &log, &[&format!("FAIL vector {line}:"), column, "1 of 64"]);
        }
    }
}

/// The registers behind the ports have no column of their own in the table.
#[test]
fn registers_that_show_a_port_are_compared() {
    let bench = bench!();
    let mut log = right(&bench, "small.json").only(&["intensity", "status"]);
    let table = blysk_tests::cli::csv_rows(&bench.text("v/vectors.csv"));
    for name in ["fetch.x", "clamp.intensity", "clamp.status"] {
        log.columns.push(name.to_owned());
    }
    for (line, row) in log.lines.iter_mut().zip(&table) {
        let ports = [row["x_hex"].clone(), line[0].clone(), line[1].clone()];
        line.extend(ports);
    }
    passes(&bench, &log);
    for name in ["fetch.x", "clamp.intensity", "clamp.status"] {
        let mut wrong = log.clone();
        wrong.spoil(9, name);
        fails(&bench, &wrong, &["FAIL vector 9:", &format!("departs first at {name}: ")]);
    }
}

#[test]
fn missing_answers_fail() {
    let bench = bench!();
    let right = right(&bench, "small.json");
    let mut short = right.only(&["intensity"]);
    short.lines.truncate(40);
    fails(&bench, &short, &["FAIL vector 40:", "no answer", "24 of 64", "24 have no answer"]);
    let mut hole = right;
    hole.lines.remove(5);
    hole.spoil(60, "intensity");
    fails(&bench, &hole, &["FAIL vector 5:", "no answer", "2 of 64", "1 have no answer"]);
}

/// A value that a simulator does not know is a wrong answer, and never a number.
#[test]
fn unknown_values_fail() {
    let bench = bench!();
    let right = right(&bench, "small.json").spelt(|field| field[2..].to_owned());
    for (text, column) in [("xxx", "intensity"), ("0X0", "intensity"), ("Z", "status"), ("0x", "stage1.t1")] {
        let mut log = right.clone();
        *log.field(3, column) = text.to_owned();
        let said = format!("{column}: got {text} (unknown bits), expected");
        fails(&bench, &log, &["FAIL vector 3:", &said, "1 of 64"]);
    }
    let mut log = self::right(&bench, "small.json");
    *log.field(0, "intensity") = "0xxxx".to_owned();
    fails(&bench, &log, &["FAIL vector 0:", "got 0xxxx (unknown bits)"]);
}

/// Standard output is closed, and the exit status gives the verdict all the same.
#[test]
fn a_closed_pipe_does_not_hide_a_failure() {
    let bench = bench!();
    let mut log = right(&bench, "small.json");
    log.spoil(0, "intensity");
    bench.write("dut.csv", log.text());
    let (reader, writer) = pipe().unwrap();
    drop(reader);
    let mut process = bench.command(&CHECK.split(' ').collect::<Vec<_>>());
    let output = process.stdout(writer).stderr(Stdio::piped()).output().unwrap();
    assert_eq!((output.status.code(), output.stderr.len()), (Some(1), 0));
}
