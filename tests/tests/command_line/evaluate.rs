//! `blysk evaluate`: the answers of the golden model are those of the vectors, however the questions come.

use std::fmt::Write as _;
use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};

use blysk_tests::bench;
use blysk_tests::cli::{Bench, CONFIGURATIONS, csv_rows, number};

/// Vectors of a configuration in `v`, as rows of their table.
fn vectors(bench: &Bench, file: &str) -> Vec<std::collections::BTreeMap<String, String>> {
    let _summary = bench.good(&format!("vectors --config {file} --count 300 --out v"));
    let rows = csv_rows(&bench.text("v/vectors.csv"));
    assert_eq!(rows.len(), 300);
    rows
}

#[test]
fn one_question_has_four_lines() {
    let bench = bench!();
    let said = bench.good("evaluate --preset paper --n 64 --x 0.99");
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 4, "{said}");
    assert!(lines[0].starts_with("intensity  0.5257568359375  (UQ1.15: 17228, 0x434c)"), "{said}");
    // 0.99 is 8304722 of 2^23 in the input format, and that is what the reference is of.
    let reference = (8_304_722.0_f64 / 8_388_608.0).powi(64);
    let shown: f64 = lines[1].split_whitespace().nth(1).unwrap().parse().unwrap();
    assert!((shown / reference - 1.0).abs() < 1e-14, "{said}");
    let ulp: f64 = lines[2].split_whitespace().nth(1).unwrap().parse().unwrap();
    assert!((ulp - (17228.0 - reference * 32768.0)).abs() < 1e-4, "{said}");
    assert!(lines[3].starts_with("region     polynomial"), "{said}");
    let bits = bench.good("evaluate --preset paper --n 64 --x-bits 8304722");
    assert_eq!(bits, said);
    assert_eq!(bench.good("evaluate --preset paper --n 64 --x-bits 0x7eb852"), said);
    let csv = bench.good("evaluate --preset paper --n 64 --x 0.99 --format csv");
    assert_eq!(number(&csv_rows(&csv)[0], "intensity_bits"), 17228.0);
    assert_eq!(bench.good("evaluate --preset paper --n 64 --x 0.99 --format hex"), "0434c\n");
}

#[test]
fn a_stream_of_lines_has_the_answers_of_the_vectors() {
    for (file, _) in CONFIGURATIONS {
        let bench = bench!();
        let rows = vectors(&bench, file);
        let mut asked = "x_bits,address\n".to_owned();
        for row in &rows {
            writeln!(asked, "{},{}", row["x_bits"], row["address"]).unwrap();
        }
        bench.write("asked.csv", asked);
        let answers = csv_rows(&bench.good(&format!("evaluate --config {file} asked.csv")));
        assert_eq!(answers.len(), rows.len());
        for (answer, row) in answers.iter().zip(&rows) {
            for column in ["n", "intensity_bits", "status"] {
                assert_eq!(answer[column], row[column], "{answer:?} {row:?}");
            }
            assert_eq!(number(answer, "x"), number(row, "x_real"));
            assert_eq!(number(answer, "intensity"), number(row, "intensity_real"));
            if !row["n"].is_empty() {
                let (ours, theirs) = (number(answer, "reference"), number(row, "reference"));
                assert!((ours - theirs).abs() <= 1e-15 * theirs, "{answer:?} {row:?}");
                let (ours, theirs) = (number(answer, "error_ulp"), number(row, "error_ulp"));
                assert!((ours - theirs).abs() < 1e-6, "{answer:?} {row:?}");
            } else {
                assert_eq!((&*answer["reference"], &*answer["error_ulp"]), ("", ""), "{answer:?}");
            }
        }
        // Words as those of the memory files, comments and all.
        let words = bench.good(&format!("evaluate --config {file} --format hex v/stimulus.mem"));
        let expected = bench.text("v/expected.mem");
        let expected: Vec<&str> = expected.lines().filter(|line| !line.starts_with("//")).collect();
        assert_eq!(words.lines().collect::<Vec<_>>(), expected);
    }
}

#[test]
fn every_register_of_every_rank_is_the_one_of_the_vectors() {
    let bench = bench!();
    let rows = vectors(&bench, "small.json");
    let mut compared = 0;
    for row in rows.iter().filter(|row| !row["n"].is_empty()).step_by(29) {
        let (n, x) = (&row["n"], &row["x_bits"]);
        let said = bench.good(&format!("evaluate --config small.json --n {n} --x-bits={x} --ranks"));
        let table = said.split_once("\n\n").expect("answer and ranks").1;
        for line in table.lines().skip(1) {
            let fields: Vec<&str> = line.split_whitespace().collect();
            let [rank, register, _, hex, bits, value] = fields[..] else { panic!("{line}") };
            if let Some(column) = row.get(&format!("{rank}.{register}_hex")) {
                assert_eq!(hex, column, "{line}");
                assert_eq!(bits, row[&format!("{rank}.{register}")], "{line}");
                assert!(value.parse::<f64>().is_ok(), "{line}");
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

/// Who asks and waits is answered before the next question.
#[test]
fn questions_are_answered_as_they_come() {
    let bench = bench!();
    let mut child = bench
        .command(&["evaluate", "--config", "small.json", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the command");
    let (mut to, from) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
    let mut lines = BufReader::new(from).lines().map(|line| line.expect("a line"));
    to.write_all(b"n,x\r\n").unwrap();
    for (index, x) in ["1", "0.5", "0.25"].into_iter().enumerate() {
        // In two pieces, as they may come.
        to.write_all(b"1,").and_then(|()| to.flush()).unwrap();
        writeln!(to, "{x}").unwrap();
        if index == 0 {
            assert!(lines.next().unwrap().starts_with("n,x,intensity,"));
        }
        assert!(lines.next().unwrap().starts_with(&format!("1,{x},{x},{x},0,")));
    }
    drop(to);
    assert_eq!(lines.next(), None);
    assert!(child.wait().unwrap().success());
}

#[test]
fn a_wrong_line_is_named_and_those_before_it_are_answered() {
    let bench = bench!();
    for (asked, answers, said) in [
        ("n,x\n1,0.5\n2,seven\n", 2, "asked:3: field `x`: \"seven\" is not a number"),
        ("n,x\n1,0.5\n,0.5\n", 2, "asked:3: field `n`: "),
        ("n,x\n1,0.5\n0.5,0.5\n", 2, "asked:3: field `n`: 0.5 is not an exponent"),
        ("n,x\n1,0.5\n1,0.5,7\n", 2, "asked:3: there are 3 fields, the first line names 2"),
        ("address,x_bits\n0,0x40\n99,0\n", 2, "asked:3: field `address`: \"99\" is not an address"),
        ("n,y\n1,0.5\n", 0, "asked:1: there is no column \"y\""),
        ("n,x,n\n", 0, "asked:1: \"n\" is one column too many"),
        ("n\n", 0, "asked:1: a column is missing"),
        ("n,x\n", 0, "asked: there is no question; write a line `n,x`"),
        ("", 0, "asked: there is no question"),
        // No text: nothing of the piece that was read is believed.
        ("n,x\n1,0.5\n\0\n", 0, "asked:3: there is a byte of 0"),
    ] {
        bench.write("asked", asked);
        let run = bench.run("evaluate --config small.json asked");
        assert_eq!(run.status, 2, "{run:#?}");
        assert!(run.stderr.contains(said), "{said}: {run:#?}");
        assert_eq!(run.stdout.lines().count(), answers, "{run:#?}");
    }
    bench.write("asked", b"\xff\xfen\0,\0x\0\n\0");
    bench.refused("evaluate --config small.json asked", &["asked", "UTF-16LE"]);
    bench.write("asked", "00\nxyz\n");
    let run = bench.run("evaluate --config small.json --format hex asked");
    assert!(run.stderr.contains("asked:2: \"xyz\" is not a word"), "{run:#?}");
    bench.refused("evaluate --config small.json nowhere.csv", &["nowhere.csv"]);
    bench.refused("evaluate --config small.json --n 3", &["give x too"]);
    bench.refused("evaluate --config small.json --n 0.5 --x 1", &["--n: 0.5 is not an exponent"]);
    bench.refused("evaluate --config small.json --n 3 --x 100", &["--x: 100 does not fit"]);
}

/// A mark of an editor, quotes of a spreadsheet and space around fields are no part of a question.
#[test]
fn questions_come_from_everywhere() {
    let bench = bench!();
    bench.write("asked", "n,x\n2,0.5\n7,1\n");
    let plain = bench.good("evaluate --config small.json asked");
    bench.write("asked", "\u{feff}\"n\", x\r\n# a comment\r\n\r\n\"2\",\"0.5\"\r\n7 , 1");
    assert_eq!(bench.good("evaluate --config small.json asked"), plain);
}

/// More than one piece of input, in one go and as a pipe gives it: every line as it would be on its own.
#[test]
fn many_questions_have_the_answers_of_each() {
    let bench = bench!();
    let mut asked = "n,x\n".to_owned();
    for line in 0_u32..20_000 {
        // Every so often a line that is not read the short way, or asks nothing.
        let space = if line % 97 == 0 { " " } else { "" };
        let x = f64::from(line * 7919 % 20_011) / 20_011.0;
        writeln!(asked, "{},{space}{x:.6}", 1 + line % 9).unwrap();
        if line % 1000 == 0 {
            asked.push_str("# a comment\n\n");
        }
    }
    bench.write("asked", &asked);
    let answers = bench.good("evaluate --config small.json asked");
    assert_eq!(answers.lines().count(), 20_001);
    let questions = asked.lines().filter(|line| line.contains(',')).skip(1);
    for (line, answer) in questions.zip(answers.lines().skip(1)).step_by(1999) {
        bench.write("one", format!("n,x\n{line}\n"));
        let one = bench.good("evaluate --config small.json one");
        assert_eq!(one.lines().nth(1), Some(answer), "{line}");
    }
    let script = "{ head -c 1000 asked; sleep 0.1; tail -c +1001 asked; } | \"$0\" evaluate --config small.json -";
    let mut shell = Command::new("bash");
    let shell = shell.args(["-c", script, env!("CARGO_BIN_EXE_blysk-under-test")]);
    let output = shell.current_dir(bench.path("")).output().expect("a shell");
    assert_eq!(String::from_utf8(output.stdout).unwrap(), answers);
}

/// A stream of questions without end stops when the reader of the answers is gone.
#[test]
fn questions_without_end_end_with_their_reader() {
    let bench = bench!();
    let script = "{ echo n,x; yes 3,0.75; } | \"$0\" evaluate --config small.json - | head -3; echo ${PIPESTATUS[1]}";
    let mut shell = Command::new("bash");
    let shell = shell.args(["-c", script, env!("CARGO_BIN_EXE_blysk-under-test")]);
    let output = shell.current_dir(bench.path("")).output().expect("a shell");
    let text = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.len() == 4 && lines[1] == lines[2] && lines[3] == "0", "{text}");
}
