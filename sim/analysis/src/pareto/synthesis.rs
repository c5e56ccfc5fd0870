//! What `make synth` found, where it was made of the same hardware.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::contender::{Contender, Engine};
use hw_model::presets;

/// A line of `synth.csv`: those of its columns that are shown.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Synthesis {
    /// The preset, or another configuration.
    pub configuration: String,
    /// The name of the FPGA.
    pub device: String,
    /// Clock cycles from a request to its result.
    pub latency: u64,
    /// The number of look-up tables with four inputs.
    pub luts: u64,
    /// The number of flip-flops.
    pub flip_flops: u64,
    /// The number of multiplier blocks of the FPGA.
    pub dsp_blocks: u64,
    /// The number of memory blocks of the FPGA.
    pub block_rams: u64,
    /// The clock frequency of the median placement; none where it does not fit.
    pub f_max_mhz: Option<f64>,
}

/// A file that is not what `make synth` writes.
#[derive(Debug, Error)]
#[error("it is not what `make synth` writes: {0}")]
pub struct SynthesisError(#[from] csv::Error);

/// Reads `synth.csv`.
///
/// # Errors
/// When a column is missing or a cell is not what belongs there.
pub fn read(text: &str) -> Result<Vec<Synthesis>, SynthesisError> {
    Ok(csv::Reader::from_reader(text.as_bytes()).deserialize().collect::<Result<_, _>>()?)
}

/// The lines that belong to these contenders, each with the place of its contender: presets as they are
/// shipped, of the latency that they have now.
#[must_use]
pub(crate) fn matching(contenders: &[Contender], rows: &[Synthesis]) -> Vec<(usize, Synthesis)> {
    let of = |row: &Synthesis| {
        contenders.iter().position(|contender| match &contender.engine {
            Engine::Hardware(design) => {
                let shipped = presets::find(&contender.family)
                    .and_then(|preset| preset.config().ok())
                    .is_some_and(|config| config == *design.config());
                shipped && row.configuration == contender.family && row.latency == design.datapath().latency() as u64
            }
            _ => false,
        })
    };
    rows.iter().filter_map(|row| Some((of(row)?, row.clone()))).collect()
}
