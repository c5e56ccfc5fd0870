//! Random mutations of the netlist, by Yosys.
//!
//! All of them are in one netlist, each switched on by its number, so that it is compiled once.

use std::path::Path;

use hw_model::datapath::Datapath;
use rayon::prelude::*;

use super::proof::tools::yosys;
use super::proof::{Judgement, Prover};
use super::{Bench, Outcome};
use crate::rtl::simulators::Simulator;
use crate::rtl::{Failure, failed};

/// The netlist with its mutations.
pub const NETLIST: &str = "mutated.v";
/// Tells the wrapper that it wraps a netlist.
const DEFINE: &str = "blysk_netlist.svh";
/// The list of mutations, one Yosys command a line.
const LIST: &str = "mutations.ys";
/// The netlist before it is mutated, for proofs.
pub const RIGHT: &str = "right.il";
/// What registers begin with: anything, then all 0, then all 1. A mutant may leave one without ever loading it.
const POWER_UPS: [&[&str]; 3] = [&[], &["+verilator+rand+reset+0"], &["+verilator+rand+reset+1"]];

/// Writes the netlist with `count` mutations, chosen by `seed`; returns what each is.
///
/// # Errors
/// When Yosys fails, or finds fewer.
pub fn mutate(directory: &Path, count: usize, seed: u64) -> Result<Vec<String>, Failure> {
    let sources = hw_model::rtl::SOURCES.map(|(name, _)| name).join(" ");
    let netlist = format!(
        "read_verilog -sv blysk_pkg.sv {sources}; prep -nordff -flatten -top blysk; wreduce; opt -full; clean; \
         write_rtlil {RIGHT}"
    );
    yosys(directory, &netlist)?;
    let mutations = draw(directory, count, seed)?;
    let io_error = |error: std::io::Error| Failure(error.to_string());
    std::fs::write(directory.join(LIST), mutations.join("\n") + "\n").map_err(io_error)?;
    let mutated = format!("read_rtlil {RIGHT}; script {LIST}; write_verilog -noattr {NETLIST}");
    yosys(directory, &mutated)?;
    std::fs::write(directory.join(DEFINE), "`define BLYSK_NETLIST\n").map_err(io_error)?;
    Ok(mutations)
}

/// Draws mutations until there are enough that are hardware, and numbers them from 1.
fn draw(directory: &Path, count: usize, seed: u64) -> Result<Vec<String>, Failure> {
    /// How many more may have to be drawn.
    const MORE: usize = 50;
    for drawn in count..=count + MORE {
        let list = format!("mutate -list {drawn} -seed {seed} -ctrl mutant 16 1 -o {LIST}");
        yosys(directory, &format!("read_rtlil {RIGHT}; {list}"))?;
        let text = std::fs::read_to_string(directory.join(LIST)).map_err(|error| Failure(error.to_string()))?;
        let sensible = text.lines().filter(|mutation| is_hardware(mutation));
        if sensible.clone().count() >= count {
            return Ok((1..).zip(sensible.take(count)).map(|(n, m)| numbered(m, n)).collect());
        }
    }
    failed(format!("there are not {count} mutations"))
}

/// Yosys's memory cell has clocks, enables and resets for its read ports even where it has none. A wire to
/// them is no hardware, and Yosys cannot write it as Verilog.
fn is_hardware(mutation: &str) -> bool {
    let port = mutation.split_whitespace().skip_while(|&word| word != "-port").nth(1);
    port.is_none_or(|port| !port.starts_with("RD_") || matches!(port, "RD_ADDR" | "RD_DATA"))
}

/// A mutation that is switched on by this number.
fn numbered(mutation: &str, number: usize) -> String {
    let words = mutation.split_whitespace().enumerate();
    // mutate -ctrl <signal> <width> <number> …
    let words = words.map(|(place, word)| match place {
        4 => number.to_string(),
        _ => word.to_owned(),
    });
    words.collect::<Vec<_>>().join(" ")
}

/// The sources of the netlist with its wrapper.
#[must_use]
pub fn sources() -> String {
    format!("{DEFINE} {NETLIST} blysk_mutated.sv")
}

/// Runs each mutation with the built testbench, from every power-up until it is killed.
///
/// # Errors
/// When a run gives no verdict, or the netlist is wrong without a mutation.
pub fn run(bench: &Bench, simulator: &Simulator, mutations: &[String]) -> Result<Vec<Outcome>, Failure> {
    let place = bench.place("netlist", &[])?;
    let killed_by = |number: usize| -> Result<Option<String>, Failure> {
        for power_up in POWER_UPS {
            let power_up = power_up.iter().map(|&argument| argument.to_owned());
            let arguments: Vec<String> = power_up.chain([format!("+mutant={number}")]).collect();
            if let Some(found) = bench.run(simulator, &place, &arguments)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    };
    if let Some(found) = killed_by(0)? {
        return failed(format!("the netlist is wrong without any mutation: {found}"));
    }
    let outcome = |(index, mutation): (usize, &String)| {
        let number = index + 1;
        Ok(Outcome { name: describe(number, mutation), killed_by: killed_by(number)? })
    };
    mutations.par_iter().enumerate().map(outcome).collect()
}

/// Judges the mutations that survived; none for the others. A proof may take so many seconds for each
/// question.
///
/// # Errors
/// When a tool fails, or the netlist is not one that can be judged.
pub fn judge(
    directory: &Path,
    datapath: &Datapath,
    mutations: &[String],
    survives: &[bool],
    seconds: u32,
) -> Result<Vec<Option<Judgement>>, Failure> {
    let prover = Prover::new(directory, RIGHT, datapath, seconds)?;
    let judged = mutations.par_iter().zip(survives).enumerate().map(|(index, (mutation, survives))| {
        survives.then(|| prover.judge(index + 1, &without_control(mutation))).transpose()
    });
    judged.collect()
}

/// `netlist:17 inv t1 …`: what Yosys was told, without what is the same in all.
fn describe(number: usize, mutation: &str) -> String {
    let mut words = mutation.split_whitespace();
    let mut parts = Vec::new();
    while let Some(word) = words.next() {
        if let "-mode" | "-cell" | "-port" | "-portbit" | "-wire" | "-wirebit" | "-ctrlbit" = word {
            parts.extend(words.next());
        }
    }
    format!("netlist:{number} {}", parts.join(" "))
}

/// A mutation that is always on: without what Yosys was told of the control input.
#[must_use]
pub fn without_control(mutation: &str) -> String {
    let words: Vec<&str> = mutation.split_whitespace().collect();
    match words.iter().position(|&word| word == "-ctrl") {
        Some(at) => [&words[..at], &words[at + 4..]].concat().join(" "),
        None => words.join(" "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_hardware_is_not_drawn_and_the_rest_is_numbered() {
        let mutation = |port| format!("mutate -ctrl mutant 16 7 -mode inv -cell rom -port {port}");
        let kept = ["RD_ADDR", "RD_DATA", "A"].map(|port| is_hardware(&mutation(port)));
        assert_eq!(kept, [true; 3]);
        let dropped = ["RD_ARST", "RD_SRST", "RD_CLK", "RD_EN"];
        assert_eq!(dropped.map(|port| is_hardware(&mutation(port))), [false; 4]);
        let first = numbered(&mutation("A"), 1);
        assert_eq!(first, "mutate -ctrl mutant 16 1 -mode inv -cell rom -port A");
        assert_eq!(without_control(&first), "mutate -mode inv -cell rom -port A");
    }
}
