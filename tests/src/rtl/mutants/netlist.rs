//! Random mutations of the netlist, by Yosys.
//!
//! All of them are in one netlist, each switched on by its number, so that it is compiled once.

use std::path::Path;
use std::process::Command;

use hw_model::format::QFormat;
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
        "read_verilog -sv blysk_pkg.sv {sources}; prep -nordff -flatten -top blysk; wreduce; opt -full; clean; \
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

/// Whether a mutation changes nothing, by SAT: from any state and inputs the mutated netlist takes
/// the same next state into every register and shows the same outputs. (That is more than is needed: one
/// that only differs in states that never occur is not found to be equivalent.) `states` are values of
/// registers of which one always holds; the proof is made for each of them.
///
/// # Errors
/// When Yosys cannot be run.
pub fn is_equivalent(
    directory: &Path,
    mutation: &str,
    states: &[String],
    seconds: u32,
) -> Result<bool, Failure> {
    let plain = without_control(mutation);
    let proofs: Vec<String> = if states.is_empty() {
        vec![sat("", seconds)]
    } else {
        states.iter().map(|state| sat(state, seconds)).collect()
    };
    // The flip-flops become inputs and outputs, bit by bit; what both netlists share is merged.
    let script = format!(
        "read_rtlil {RIGHT}; rename blysk right; read_rtlil {RIGHT}; {plain}; rename blysk wrong; \
         dffunmap; simplemap t:$dff; splitnets; opt_clean; expose -dff -evert-dff right wrong; opt_clean; \
         miter -equiv -flatten -make_outputs right wrong miter; hierarchy -top miter; \
         memory_map -rom-only; opt -full -nodffe -nosdff; opt_merge -share_all; \
         opt -full -nodffe -nosdff; {}",
        proofs.join("; ")
    );
    let output = Command::new("yosys").args(["-q", "-p", &script]).current_dir(directory).output();
    let output = output.map_err(|error| Failure(format!("cannot run yosys: {error}")))?;
    Ok(output.status.success())
}

fn sat(state: &str, seconds: u32) -> String {
    format!("sat -timeout {seconds} {state} -prove trigger 0 -verify miter")
}

/// The values of t3 where no input makes the clamp act: below 1, and 1.
#[must_use]
pub fn unclamped(t3: QFormat, one: i64) -> Vec<String> {
    let set = |place: u32, bit: i64| format!("-set \\in_clamp.t3_i[{place}].q {bit}");
    let above = (0..t3.width()).filter(|&place| 1 << place >= one + one % 2);
    let below_one: Vec<String> = above.map(|place| set(place, 0)).collect();
    let is_one: Vec<String> = (0..t3.width()).map(|place| set(place, one >> place & 1)).collect();
    vec![below_one.join(" "), is_one.join(" ")]
}

fn without_control(mutation: &str) -> String {
    let words: Vec<&str> = mutation.split_whitespace().collect();
    match words.iter().position(|&word| word == "-ctrl") {
        Some(at) => [&words[..at], &words[at + 4..]].concat().join(" "),
        None => words.join(" "),
    }
}
