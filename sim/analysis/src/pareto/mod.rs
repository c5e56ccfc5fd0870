//! Work against precision: what the error of each contender costs in time, multipliers and memory, and which contenders
//! are dominated.
//!
//! | file | holds |
//! |---|---|
//! | `inputs.rs` | the x and n that are measured |
//! | `contender.rs` | the contenders |
//! | `functions.rs`, `kernel.rs` | what a processor computes for a sample, and for many |
//! | `error.rs` | the errors of all contenders over all inputs |
//! | `timing.rs` | run time, side by side |
//! | `hardware.rs`, `synthesis.rs` | what hardware costs, derived and measured |
//! | `front.rs` | the non-dominated set |
//! | `table.rs` | the lines of the tables |
//! | `check.rs` | whether a table that was kept still holds |

pub mod check;
pub mod contender;
mod error;
pub(crate) mod front;
pub(crate) mod functions;
pub mod inputs;
mod kernel;
pub mod synthesis;
mod table;
pub mod timing;

use hw_model::config::Config;
use hw_model::fit::FitError;
use thiserror::Error;

use self::contender::{ContenderError, Contenders};
use self::error::{ContenderErrors, Errors};
use self::inputs::Inputs;
use self::synthesis::Synthesis;
use self::timing::TimingError;
use vectors::progress::Progress;

pub use self::table::{ContenderRow, ParetoReport, TimingReport, TimingRow};

/// Why there is no comparison.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ParetoError {
    /// A contender cannot be made for these inputs.
    #[error(transparent)]
    Contender(#[from] ContenderError),
    /// A method has no fit for one of the exponents.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A contender, as it is timed, does not compute what was measured.
    #[error(transparent)]
    Timing(#[from] TimingError),
}

/// How run time is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TimingOptions {
    /// Rounds, in each of which every contender has a turn.
    pub rounds: u64,
    /// What x and n are drawn from.
    pub seed: u64,
}

/// Measures every contender. `own` are configurations beside the presets, and `synthesis` the lines of `synth.csv`,
/// where there are any.
///
/// # Errors
/// When a contender cannot be made for these inputs, or gives other values in the timed loops than were measured.
pub fn compare(
    inputs: &Inputs,
    own: &[Config],
    timing: Option<TimingOptions>,
    synthesis: &[Synthesis],
    progress: &dyn Progress,
) -> Result<ParetoReport, ParetoError> {
    let Contenders { list, left_out } = Contenders::new(inputs, own)?;
    let errors = error::errors(&list, inputs, &inputs.epicentres()?, progress);
    let timing = match timing {
        None => None,
        Some(TimingOptions { rounds, seed }) => {
            let times = timing::times(&list, &errors, inputs, rounds, seed)?;
            Some(TimingReport {
                rounds,
                seed,
                samples: timing::SAMPLES as u64,
                block: timing::BLOCK as u64,
                rows: table::timing_rows(&list, &errors, &times, inputs.every),
            })
        }
    };
    let count = |part: fn(&ContenderErrors) -> Errors| errors.first().map_or(0, |e| part(e).count);
    let matching = synthesis::matching(&list, synthesis);
    Ok(ParetoReport {
        input: inputs.format.to_string(),
        exponents: inputs.exponents.to_string(),
        every: inputs.every,
        exhaustive: inputs.exhaustive(),
        samples: count(|errors| errors.whole),
        epicentre_samples: count(|errors| errors.epicentre),
        left_out,
        contenders: table::rows(&list, &errors, inputs),
        synthesis: matching.into_iter().map(|(_, row)| row).collect(),
        timing,
    })
}
