//! `make exhaustive`: every x of every exponent of a preset through the RTL, against the model.
//!
//! `exhaustive PRESET…`; with no preset named, compact and paper. The results are streamed from the
//! verilated RTL and compared, not stored. `blysk shard` does the same in shards, on many machines.

use std::process::ExitCode;
use std::time::Instant;

use analysis::pieces::Pieces;
use blysk_tests::rtl::workspace::emit;
use blysk_tests::rtl::{Failure, failed};
use hw_model::design::Design;
use hw_model::presets;
use rayon::prelude::*;
use shard::rtl::{Counts, build, compare};
use vectors::Strategy;

/// x of a run of the harness.
const LENGTH: i64 = 1 << 22;

fn main() -> ExitCode {
    let named: Vec<String> = std::env::args().skip(1).collect();
    let presets = if named.is_empty() { vec!["compact".into(), "paper".into()] } else { named };
    let mut failed = false;
    for preset in &presets {
        match run(preset) {
            Ok(counts) => failed |= counts.different > 0 || counts.compared == 0,
            Err(error) => {
                eprintln!("error: {preset}: {error}");
                failed = true;
            }
        }
    }
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

fn run(preset: &str) -> Result<Counts, Failure> {
    let Some(found) = presets::find(preset) else {
        return failed("there is no such preset; blysk presets lists them");
    };
    let config = found.config().map_err(|error| Failure(error.to_string()))?;
    let design = Design::new(config).map_err(|error| Failure(error.to_string()))?;
    let emitted = emit(&design, &format!("exhaustive-{preset}"), Strategy::Corners, 16)?;
    let program = build(&emitted.directory).map_err(|error| Failure(error.to_string()))?;
    let started = Instant::now();
    let pieces = Pieces::new(&design, LENGTH);
    let counts = (0..pieces.count())
        .into_par_iter()
        .map(|index| compare(&program, &emitted.directory, design.datapath(), pieces.at(index)))
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| Failure(error.to_string()))?
        .into_iter()
        .fold(Counts::default(), Counts::and);
    let seconds = started.elapsed().as_secs_f64();
    println!(
        "{preset}: {} results of the RTL compared with the model, {} differences ({seconds:.0} s)",
        counts.compared, counts.different
    );
    Ok(counts)
}
