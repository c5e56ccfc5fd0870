//! Work against precision: what everybody's error costs in time, multipliers and memory, and who is
//! dominated.
//!
//! | file | holds |
//! |---|---|
//! | `inputs.rs` | which x and n |
//! | `contender.rs` | who is compared |
//! | `functions.rs`, `kernel.rs` | what a processor computes for a sample, and for many |
//! | `error.rs` | the errors of all over all inputs |
//! | `timing.rs` | run time, side by side |
//! | `hardware.rs`, `synthesis.rs` | what hardware costs, derived and measured |
//! | `front.rs` | the non-dominated set |
//! | `table.rs` | the lines of the tables |
//! | `check.rs` | whether a table that was kept still holds |

pub mod check;
pub mod contender;
mod error;
pub(crate) mod front;
mod functions;
pub mod inputs;
mod kernel;
pub mod synthesis;
mod table;
pub mod timing;

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
    /// Somebody cannot take part.
    #[error(transparent)]
    Contender(#[from] ContenderError),
    /// An exponent.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A time.
    #[error(transparent)]
    Timing(#[from] TimingError),
}

/// How run time is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TimingOptions {
    /// Rounds, in each of which everybody has a turn.
    pub rounds: u64,
    /// What x and n are drawn from.
    pub seed: u64,
}

/// Measures everybody. `synthesis` are the lines of `synth.csv`, where there are any.
///
/// # Errors
/// When a contender cannot be made for these inputs, or is not, in the loops that are timed, what was measured.
pub fn compare(
    inputs: &Inputs,
    timing: Option<TimingOptions>,
    synthesis: &[Synthesis],
    progress: &dyn Progress,
) -> Result<ParetoReport, ParetoError> {
    let Contenders { list, left_out } = Contenders::new(inputs)?;
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
