//! Cycles a second of the emitted RTL in Verilator, for each preset that is named, beside which bindings are measured
//! (`hw-model/bindings/python/speed.py`). Prints a line of JSON for each: random requests, one in every cycle, in time
//! of the processor.

use std::process::ExitCode;

use blysk_tests::bench::Pattern;
use blysk_tests::bench::verilator::Verilated;
use blysk_tests::rtl::{Failure, ended, failed};
use hw_model::design::Design;

const CYCLES: u64 = 2_000_000;
/// Of so many runs the fastest counts, as others may use the machine too.
const RUNS: usize = 5;

fn rate(preset: &str) -> Result<f64, Failure> {
    let design = Design::preset(preset).map_err(|error| Failure(error.to_string()))?;
    let program = Verilated::build(&design, false)?;
    let rates = (0..RUNS).map(|_| program.run(Pattern::Random, CYCLES, None).map(|run| run.rate()));
    rates.collect::<Result<Vec<_>, _>>().map(|rates| rates.into_iter().fold(0.0, f64::max))
}

fn run() -> Result<(), Failure> {
    let presets: Vec<String> = std::env::args().skip(1).collect();
    if presets.is_empty() {
        return failed("name presets: verilated PRESET …");
    }
    for preset in presets {
        println!("{{\"preset\": \"{preset}\", \"cycles\": {}}}", rate(&preset)?);
    }
    Ok(())
}

fn main() -> ExitCode {
    ended(run())
}
