//! `blysk simulate`: the answers are those of the golden model, and a stimulus may come from a pipe.

use std::fmt::Write as _;
use std::process::Command;

use blysk_tests::bench;
use blysk_tests::cli::{Bench, csv_rows};

/// Requests, bubbles and stalls; a reset, which loses what is under way.
fn stimulus(cycles: u32, reset: Option<u32>) -> String {
    let mut text = "n,x,valid,ready,reset\n".to_owned();
    for cycle in 0..cycles {
        let (n, x) = (1 + cycle % 9, f64::from(cycle * 37 % 101) / 100.0);
        let (valid, ready) = (u32::from(cycle % 7 != 3), u32::from(cycle % 5 != 1));
        writeln!(text, "{n},{x},{valid},{ready},{}", u32::from(reset == Some(cycle))).unwrap();
    }
    text
}

fn from_pipe(bench: &Bench, arguments: &str) -> String {
    let script = format!("cat in.csv | \"$0\" simulate --config small.json --stimulus - {arguments}");
    let mut shell = Command::new("bash");
    let shell = shell.args(["-c", &script, env!("CARGO_BIN_EXE_blysk-under-test")]);
    let output = shell.current_dir(bench.path("")).output().expect("a shell");
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_answer_is_that_of_the_golden_model() {
    let bench = bench!();
    bench.write("in.csv", stimulus(200, None));
    let simulate = "simulate --config small.json --stimulus in.csv";
    let printed = bench.good(&format!("{simulate} --out -"));
    let answers = csv_rows(&printed);
    let counts = &csv_rows(&bench.good(&format!("{simulate} --format csv")))[0];
    assert_eq!(counts["results"], answers.len().to_string());
    let mut asked = "address,x_bits\n".to_owned();
    for answer in &answers {
        writeln!(asked, "{},{}", answer["address"], answer["x_bits"]).unwrap();
    }
    bench.write("asked.csv", asked);
    let wanted = csv_rows(&bench.good("evaluate --config small.json asked.csv"));
    for (answer, wanted) in answers.iter().zip(&wanted) {
        for column in ["n", "x", "intensity", "intensity_bits", "status"] {
            assert_eq!(answer[column], wanted[column], "{answer:?}");
        }
    }
    // In the order in which they were requested.
    let requested: Vec<String> =
        (0..200_u32).filter(|cycle| cycle % 7 != 3).map(|cycle| (cycle % 9).min(8).to_string()).collect();
    let addresses: Vec<String> = answers.iter().map(|answer| answer["address"].clone()).collect();
    assert_eq!(addresses, requested);
    assert_eq!(from_pipe(&bench, "--out -"), printed);
    assert_eq!(from_pipe(&bench, ""), bench.good(simulate));
}

#[test]
fn people_see_the_first_answers() {
    let bench = bench!();
    bench.write("in.csv", stimulus(60, Some(20)));
    let counts = &csv_rows(&from_pipe(&bench, "--format csv"))[0];
    let results: usize = counts["results"].parse().unwrap();
    assert!(counts["lost_to_reset"] != "0", "{counts:?}");
    let said = from_pipe(&bench, "");
    let (_, shown) = said.split_once("\n\n").expect("counts and answers");
    let lines: Vec<&str> = shown.lines().collect();
    assert_eq!(lines.len(), 22, "{said}");
    assert!(lines[0].starts_with("cycle"), "{said}");
    let more = format!("... and {} more answers; --out - prints all of them as CSV", results - 20);
    assert_eq!(lines[21], more);
    let all = csv_rows(&from_pipe(&bench, "--out -"));
    assert_eq!(all.len(), results);
    for (line, answer) in lines[1..21].iter().zip(&all) {
        assert_eq!(line.split_whitespace().next(), Some(&*answer["cycle"]), "{said}");
    }
    // Few of them need no note.
    bench.write("in.csv", "n,x\n1,0.5\n");
    let said = from_pipe(&bench, "");
    assert_eq!(said.split_once("\n\n").unwrap().1.lines().count(), 2, "{said}");
}
