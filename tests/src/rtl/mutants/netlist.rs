//! Random mutations of the netlist, by Yosys.
//!
//! All of them are in one netlist, each switched on by its number, so that it is compiled once.

use std::path::Path;
use std::process::Command;

use rayon::prelude::*;

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
const RIGHT: &str = "right.il";

/// Writes the netlist with `count` mutations, chosen by `seed`; returns what each is.
///
/// # Errors
/// When Yosys fails, or finds fewer.
pub fn mutate(directory: &Path, count: usize, seed: u64) -> Result<Vec<String>, Failure> {
    let sources = hw_model::rtl::SOURCES.map(|(name, _)| name).join(" ");
    let script = format!(
        "read_verilog -sv blysk_pkg.sv {sources}; prep -flatten -top blysk; wreduce; opt -full; clean; \
         write_rtlil {RIGHT}; mutate -list {count} -seed {seed} -ctrl mutant 16 1 -o {LIST}; \
         script {LIST}; write_verilog -noattr {NETLIST}"
    );
    yosys(directory, &script)?;
    std::fs::write(directory.join(DEFINE), "`define BLYSK_NETLIST\n")
        .map_err(|error| Failure(error.to_string()))?;
    let list = std::fs::read_to_string(directory.join(LIST))
        .map_err(|error| Failure(error.to_string()))?;
    let mutations: Vec<String> = list.lines().map(str::to_owned).collect();
    if mutations.len() != count {
        return failed(format!("{} mutations instead of {count}", mutations.len()));
    }
    Ok(mutations)
}

/// The sources of the netlist with its wrapper.
#[must_use]
pub fn sources() -> String {
    format!("{DEFINE} {NETLIST} blysk_mutated.sv")
}

fn yosys(directory: &Path, script: &str) -> Result<String, Failure> {
    let output = Command::new("yosys").args(["-q", "-p", script]).current_dir(directory).output();
    let output = output.map_err(|error| Failure(format!("cannot run yosys: {error}")))?;
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    if output.status.success() { Ok(text) } else { failed(text) }
}

/// Runs each mutation with the built testbench.
///
/// # Errors
/// When a run gives no verdict, or the netlist is wrong without a mutation.
pub fn run(
    bench: &Bench,
    simulator: &Simulator,
    mutations: &[String],
) -> Result<Vec<Outcome>, Failure> {
    let place = bench.place("netlist", &[])?;
    if let Some(found) = bench.run(simulator, &place, &["+mutant=0".to_owned()])? {
        return failed(format!("the netlist is wrong without any mutation: {found}"));
    }
    let outcome = |(index, mutation): (usize, &String)| {
        let number = index + 1;
        let killed_by = bench.run(simulator, &place, &[format!("+mutant={number}")])?;
        Ok(Outcome { name: describe(number, mutation), killed_by })
    };
    mutations.par_iter().enumerate().map(outcome).collect()
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

/// Whether a mutation changes anything: by SAT, over all states and inputs, with what is common to
/// both netlists shared. `None` when the solver does not finish in `seconds`.
///
/// # Errors
/// When Yosys cannot be run.
pub fn is_equivalent(
    directory: &Path,
    mutation: &str,
    seconds: u32,
) -> Result<Option<bool>, Failure> {
    let plain = without_control(mutation);
    let script = format!(
        "read_rtlil {RIGHT}; rename blysk right; read_rtlil {RIGHT}; rename blysk blysk_; \
         rename blysk_ blysk; {plain}; rename blysk wrong; \
         miter -equiv -flatten -make_outputs -ignore_gold_x right wrong miter; \
         hierarchy -top miter; memory_map -rom-only; opt -full -share_all; opt -full -share_all; \
         sat -timeout {seconds} -tempinduct -set-def-inputs -prove trigger 0 -verify miter"
    );
    let output = Command::new("yosys").args(["-q", "-p", &script]).current_dir(directory).output();
    let output = output.map_err(|error| Failure(format!("cannot run yosys: {error}")))?;
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    Ok(if output.status.success() {
        Some(true)
    } else if text.contains("proof did fail") {
        Some(false)
    } else {
        None
    })
}

fn without_control(mutation: &str) -> String {
    let words: Vec<&str> = mutation.split_whitespace().collect();
    match words.iter().position(|&word| word == "-ctrl") {
        Some(at) => [&words[..at], &words[at + 4..]].concat().join(" "),
        None => words.join(" "),
    }
}
