//! Waves replayed in the emitted RTL by Yosys, to their end.

use std::fmt::Write;

use blysk_tests::bench;
use blysk_tests::cli::Bench;
use blysk_tests::rtl::replay::replay;
use hw_model::design::Design;

use super::designs;
use crate::stimulus::patterns;

/// Runs that end in all ways: with a result that is taken, after bubbles, in a reset, with one behind a stall; and some
/// that begin without a reset.
const ENDS: [&str; 5] = [
    "n,x,valid,ready,reset\n,,0,1,1\n2,0.9,1,1,0\n3,0.8,1,1,0\n1,0.99,1,0,0\n",
    "n,x,valid,ready,reset\n2,0.9,1,1,0\n,,0,1,0\n,,0,0,0\n,,0,1,0\n,,0,1,0\n,,0,1,0\n,,0,1,0\n,,0,1,0\n,,0,1,0\n\
     ,,0,1,0\n,,0,1,0\n,,0,1,0\n,,0,1,0\n,,0,1,0\n,,0,1,0\n",
    "n,x,valid,ready,reset\n2,0.9,1,1,0\n7,0.5,1,0,0\n,,0,1,1\n",
    "n,x,valid,ready,reset\n,,0,1,0\n",
    "n,x,valid,ready,reset\n,,0,0,1\n2,0.9,1,0,0\n,,0,0,0\n,,0,0,0\n,,0,0,0\n,,0,0,0\n,,0,0,0\n,,0,0,0\n",
];

fn replays(bench: &Bench, which: &str, design: &Design) -> Result<(), String> {
    let _counts = bench.good(&format!("simulate {which} --stimulus in.csv --waves run.fst"));
    let (rtl, waves) = (bench.path("rtl"), bench.path("run.fst"));
    replay(&rtl, design.datapath(), &waves, &design.config().name).map_err(|error| error.0)
}

#[test]
fn yosys_agrees_to_the_end_of_the_waves() {
    let bench = bench!();
    let mut runs = 0;
    for (which, design) in designs().into_iter().take(3) {
        let _rtl = bench.good(&format!("rtl {which} --count 1 --out rtl"));
        let exponents = design.rom().exponents().as_slice();
        let mut stimuli: Vec<String> = ENDS.iter().map(|text| of_the_rom(text, exponents)).collect();
        stimuli.push(patterns(&design).pop().expect("a pattern").1.to_csv());
        for stimulus in stimuli {
            bench.write("in.csv", &stimulus);
            if let Err(error) = replays(&bench, &which, &design) {
                panic!("{which}: {error}\n{stimulus}");
            }
            runs += 1;
        }
    }
    assert_eq!(runs, 3 * 6, "runs");
}

/// The stimulus with exponents that there are.
fn of_the_rom(text: &str, exponents: &[f64]) -> String {
    let mut lines = String::new();
    for line in text.lines() {
        let (n, rest) = line.split_once(',').expect("columns");
        match n.parse::<usize>() {
            Ok(place) => writeln!(lines, "{},{rest}", exponents[place % exponents.len()]),
            Err(_) => writeln!(lines, "{line}"),
        }
        .expect("a String");
    }
    lines
}

/// The comparison is one: another ROM gives other registers.
#[test]
fn yosys_finds_a_difference() {
    let bench = bench!();
    let (which, design) = designs().swap_remove(0);
    let _rtl = bench.good(&format!("rtl {which} --count 1 --out rtl"));
    bench.write("in.csv", "n,x\n2,0.9\n");
    replays(&bench, &which, &design).expect("no difference");
    let image = bench.text("rtl/rom.mem");
    let words: Vec<&str> = image.lines().filter(|line| !line.starts_with("//")).collect();
    let other: String = words.iter().rev().map(|word| format!("{word}\n")).collect();
    bench.write("rtl/rom.mem", other);
    let error = replays(&bench, &which, &design).expect_err("a difference");
    assert!(error.contains("Signal difference"), "{error}");
}
