//! `blysk vectors --cases`: the vectors of the user's own list, in its order, from each way to write it.

use std::io::Write;
use std::process::Stdio;

use ::vectors::{Strategy, verify};
use blysk_tests::bench;
use blysk_tests::cli::{Bench, SMALL};
use hw_model::config::Config;
use hw_model::design::Design;

/// Exponents and x of the list: an end, one twice, one outside [0, 1], and an exponent without a ROM word.
const LIST: [(f64, f64); 6] = [(1.0, 1.0), (8.0, 0.75), (8.0, 0.75), (3.0, -0.5), (200.0, 0.5), (7.0, 1.001953125)];

/// The list as CSV with these columns first.
fn csv(header: &str, line: impl Fn(f64, f64) -> String) -> String {
    let lines: Vec<String> = LIST.iter().map(|&(n, x)| line(n, x)).collect();
    format!("{header}\n# a comment\n\n{}\n", lines.join("\n"))
}

/// Checks the bundle of the list in `directory`, and gives its `vectors.csv`.
fn checked(bench: &Bench, directory: &str) -> String {
    let design = Design::new(Config::from_json(SMALL).unwrap()).unwrap();
    let verified = verify(bench.path(directory)).unwrap();
    assert_eq!((verified.manifest.strategy, verified.manifest.counts.requested), (Strategy::List, 6));
    for (row, (n, x)) in verified.vectors.iter().zip(LIST) {
        let asked = (row.case.exponent, row.case.x, row.kind.as_str());
        assert_eq!(asked, (Some(n).filter(|_| row.case.exponent.is_some()), (x * 512.0) as i64, "listed"));
        assert_eq!(row.case.address, if n > 8.0 { 8 } else { n as u32 - 1 });
        let wanted = design.datapath().evaluate(row.case.address, row.case.x);
        assert_eq!((row.expected.intensity, row.expected.status), (wanted.intensity, wanted.status.bits()));
    }
    bench.text(&format!("{directory}/vectors.csv"))
}

#[test]
fn every_way_to_write_the_list_gives_its_vectors() {
    let bench = bench!();
    bench.write("real.csv", csv("n,x", |n, x| format!("{n},{x}")));
    bench.write("bits.csv", csv("x_bits,n", |n, x| format!("{},{n}", x * 512.0)));
    bench.write("cycles.csv", csv("valid,n,x,ready,reset", |n, x| format!("0,,,1,1\n1,{n},{x},0,0")));
    let said = bench.good("vectors --config small.json --cases real.csv --out real");
    assert!(said.contains("6 vectors") && said.contains("6 listed"), "{said}");
    let real = checked(&bench, "real");
    let manifest = verify(bench.path("real")).unwrap().manifest;
    assert_eq!(manifest.command, "blysk vectors --config small.json --cases real.csv --seed 1");
    for (list, more) in [("bits.csv", ""), ("cycles.csv", "--cases-format stimulus")] {
        let _summary = bench.good(&format!("vectors --config small.json --cases {list} {more} --out other"));
        assert_eq!(checked(&bench, "other"), real);
    }
    // What a bundle has as stimulus is a list too; of an address past the words no exponent is known.
    let command = "vectors --config small.json --cases real/stimulus.mem --cases-format hex --out again";
    let _summary = bench.good(command);
    let _table = checked(&bench, "again");
    for name in ["expected.mem", "stimulus.mem"] {
        let words = |place: &str| -> Vec<String> {
            let text = bench.text(&format!("{place}/{name}"));
            text.lines().filter(|line| !line.starts_with("//")).map(str::to_owned).collect()
        };
        assert_eq!(words("again"), words("real"));
    }
}

#[test]
fn a_list_comes_from_standard_input() {
    let bench = bench!();
    let arguments = ["vectors", "--config", "small.json", "--cases", "-", "--format", "csv", "--out", "-"];
    let mut child =
        bench.command(&arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the command is built");
    child.stdin.take().expect("a pipe").write_all(b"address,x\n2,0.5\n").unwrap();
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.lines().count() == 2, "{text}");
    assert!(text.lines().nth(1).is_some_and(|line| line.starts_with("0,listed,3,2,256,")), "{text}");
}

/// The emitted testbench runs over the list.
#[test]
fn the_testbench_takes_the_list() {
    let bench = bench!();
    bench.write("real.csv", csv("n,x", |n, x| format!("{n},{x}")));
    let said = bench.good("rtl --config small.json --cases real.csv --out rtl");
    assert!(said.contains("6 vectors"), "{said}");
    let mut make = std::process::Command::new("make");
    make.arg("-C").arg(bench.path("rtl")).arg("icarus").env_remove("MAKEFLAGS").env_remove("MAKELEVEL");
    let output = make.output().expect("make is there");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && text.contains("PASS 6 vectors"), "{text}");
}

#[test]
fn a_list_with_a_mistake() {
    let bench = bench!();
    let refused = |list: &str, more: &str, said: &[&str]| {
        bench.write("list", list);
        bench.refused(&format!("vectors --config small.json --cases list {more} --out new"), said);
        bench.refused(&format!("rtl --config small.json --cases list {more} --out new"), said);
    };
    refused("n,x\n1,0.5\n0.5,1\n", "", &["list:3:", "`n`", "from 1 up"]);
    refused("n,x\n1,2\n", "", &["list:2:", "`x`", "1.998"]);
    refused("n,y\n1,1\n", "", &["list:1:", "\"y\"", "x or x_bits"]);
    refused("address,x\n16,1\n", "", &["list:2:", "`address`", "0 to 15"]);
    refused("n,x\n", "", &["no question", "64,0.99"]);
    refused("7fff\nfffff\n", "--cases-format hex", &["list:2:", "15 bits"]);
    refused("n,x,valid\n1,1,2\n", "--cases-format stimulus", &["list:2:", "`valid`", "neither 0 nor 1"]);
    refused("n,x,valid\n1,1,0\n", "--cases-format stimulus", &["0 vectors"]);
    refused("n,x\n1,0.5\n", "--count 5", &["--cases", "--count", "cannot be used with"]);
    bench.refused("vectors --config small.json --cases nowhere.csv --out new", &["nowhere.csv", "No such file"]);
    bench.refused("vectors --config small.json --cases-format hex --out new", &["--cases"]);
    bench.refused("vectors --config small.json --format csv --cases list --out list", &["list"]);
}
