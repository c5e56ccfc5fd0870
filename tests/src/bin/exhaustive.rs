//! `make exhaustive`: every x of every exponent of a preset through the RTL, against the model.
//!
//! `exhaustive PRESET…`; with no preset named, compact and paper. The results are streamed from the
//! verilated RTL and compared, not stored; two runs side by side, each with half of the exponents.

use std::process::ExitCode;
use std::time::Instant;

use blysk_tests::rtl::exhaustive::{Counts, build, compare};
use blysk_tests::rtl::workspace::emit;
use blysk_tests::rtl::{Failure, failed};
use hw_model::design::Design;
use hw_model::presets;
use rayon::prelude::*;
use vectors::Strategy;

/// Runs of consecutive addresses. More than the cores, so that both stay busy to the end.
const SHARDS: u32 = 8;

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
    let program = build(&emitted.directory)?;
    let datapath = design.datapath();
    let depth = datapath.rom().depth() as u32;
    let started = Instant::now();
    let shards = SHARDS.min(depth);
    let counts = (0..shards)
        .into_par_iter()
        .map(|shard| {
            let range = (shard * depth / shards, (shard + 1) * depth / shards - 1);
            compare(&program, &emitted.directory, datapath, range)
        })
        .collect::<Result<Vec<_>, _>>()?
        .into_iter()
        .fold(Counts::default(), |sum, part| Counts {
            compared: sum.compared + part.compared,
            different: sum.different + part.different,
        });
    let seconds = started.elapsed().as_secs_f64();
    println!(
        "{preset}: {} results of the RTL compared with the model, {} differences ({seconds:.0} s)",
        counts.compared, counts.different
    );
    Ok(counts)
}
