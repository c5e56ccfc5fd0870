//! One pipeline, clocked, with a receiver that takes a result in every third cycle only: stalls hold every result, none
//! is lost, and none overtakes another.
//!
//! `cargo run -p sim --example stalled_pipeline`

use std::error::Error;

use hw_model::design::Design;
use hw_model::quantise::real;
use sim::pipeline::{Inputs, Pipeline};

/// Requests five highlights and prints when each comes out.
///
/// # Errors
/// When there is no such preset.
pub fn main() -> Result<(), Box<dyn Error>> {
    let design = Design::preset("compact")?;
    let (datapath, output) = (design.datapath(), design.config().output);
    let address = design.rom().address_of(64.0);
    // x from 1 downwards, a hundredth apart.
    let requests: Vec<i64> = (0..5).map(|i| design.config().input.one() * (100 - i) / 100).collect();
    let mut pipeline = Pipeline::new(datapath);
    let (mut sent, mut results, mut cycle) = (0, Vec::new(), 0);
    while results.len() < requests.len() {
        let inputs = Inputs {
            in_valid: sent < requests.len(),
            address,
            x: requests.get(sent).copied().unwrap_or_default(),
            out_ready: cycle % 3 == 0,
            reset: false,
        };
        let outputs = pipeline.combinational(&inputs);
        if inputs.in_valid && outputs.in_ready {
            println!("cycle {cycle:2}: request {sent} is taken");
            sent += 1;
        }
        if outputs.out_valid {
            let what = if inputs.out_ready { "is taken" } else { "waits" };
            let intensity = real(outputs.intensity, output);
            println!("cycle {cycle:2}: result {} {what}, intensity {intensity}", results.len());
        }
        if outputs.out_valid && inputs.out_ready {
            results.push(outputs.intensity);
        }
        pipeline.clock();
        cycle += 1;
    }
    for (&x, result) in requests.iter().zip(results) {
        assert_eq!(result, design.intensity_bits(address, x)?);
    }
    Ok(())
}
