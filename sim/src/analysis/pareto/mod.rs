//! Work against precision: what everybody's error costs in time, multipliers and memory, and who is
//! dominated.
//!
//! | file | holds |
//! |---|---|
//! | `inputs.rs` | which x and n |
//! | `contender.rs`, `kernel.rs` | who is compared, and what each computes |
//! | `error.rs` | the errors of all over all inputs |
//! | `timing.rs` | run time, side by side |
//! | `hardware.rs`, `synthesis.rs` | what hardware costs, derived and measured |
//! | `front.rs` | the non-dominated set |
//! | `check.rs` | whether a table that was kept still holds |

pub mod check;
pub mod contender;
pub mod error;
pub mod front;
pub mod hardware;
pub mod inputs;
pub mod kernel;
pub mod synthesis;
pub mod timing;

use hw_model::fit::FitError;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use self::contender::{ContenderError, Contenders};
use self::error::{ContenderErrors, Errors};
use self::front::dominators;
use self::inputs::Inputs;
use self::synthesis::Synthesis;
use self::timing::{ContenderTimes, TimingError};
use super::error_report::Progress;

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

/// One contender: a line of `pareto.csv`. Errors are fractions of full intensity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its name.
    pub contender: String,
    /// `f32` or `f64` on a processor, or `hardware`.
    pub kind: String,
    /// The greatest error where x^n ≥ Q.
    pub epicentre_worst: Option<f64>,
    /// Where.
    pub epicentre_worst_n: Option<f64>,
    /// Where.
    pub epicentre_worst_x: Option<f64>,
    /// The root of the mean square there.
    pub epicentre_rms: Option<f64>,
    /// The greatest error on all of [0, 1].
    pub whole_worst: Option<f64>,
    /// Where.
    pub whole_worst_n: Option<f64>,
    /// Where.
    pub whole_worst_x: Option<f64>,
    /// The root of the mean square.
    pub whole_rms: Option<f64>,
    /// Bits of table or ROM, all exponents together.
    pub storage_bits: u64,
    /// Clock cycles.
    pub latency: Option<u64>,
    /// The operands of every multiplier.
    pub multipliers: Option<String>,
    /// Partial-product bits.
    pub multiplier_bits: Option<u64>,
    /// Quotient digits times divisor bits.
    pub divider_bits: Option<u64>,
    /// Not dominated in error on the epicentre, multipliers, divider, ROM and latency.
    pub hardware_epicentre_front: Option<bool>,
    /// By whom, if it is.
    pub hardware_epicentre_dominated_by: Option<String>,
    /// The same with the error on all of [0, 1].
    pub hardware_whole_front: Option<bool>,
    /// By whom, if it is.
    pub hardware_whole_dominated_by: Option<String>,
    /// What it computes.
    pub what: String,
}

/// The times of one contender: a line of `pareto_timing.csv`, in ns per sample.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TimingRow {
    /// Its name.
    pub contender: String,
    /// Blocks of one exponent: the median.
    pub block_median: f64,
    /// A quarter of the rounds took at most this.
    pub block_lower_quartile: f64,
    /// Three quarters.
    pub block_upper_quartile: f64,
    /// The quickest round.
    pub block_least: f64,
    /// An exponent for each sample: the median.
    pub mixed_median: f64,
    /// A quarter of the rounds took at most this.
    pub mixed_lower_quartile: f64,
    /// Three quarters.
    pub mixed_upper_quartile: f64,
    /// The quickest round.
    pub mixed_least: f64,
    /// Not dominated in time over blocks and in error on the epicentre.
    pub block_epicentre_front: Option<bool>,
    /// By whom, if it is.
    pub block_epicentre_dominated_by: Option<String>,
    /// The same with the error on all of [0, 1].
    pub block_whole_front: Option<bool>,
    /// By whom, if it is.
    pub block_whole_dominated_by: Option<String>,
    /// With the time over mixed exponents.
    pub mixed_epicentre_front: Option<bool>,
    /// By whom, if it is.
    pub mixed_epicentre_dominated_by: Option<String>,
    /// With both.
    pub mixed_whole_front: Option<bool>,
    /// By whom, if it is.
    pub mixed_whole_dominated_by: Option<String>,
}

/// Run times: what depends on the machine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TimingReport {
    /// Rounds.
    pub rounds: u64,
    /// What x and n were drawn from.
    pub seed: u64,
    /// Different samples, each timed several times a round.
    pub samples: u64,
    /// Samples of one exponent in a row.
    pub block: u64,
    /// One for each contender, in the same order.
    pub rows: Vec<TimingRow>,
}

/// Everybody.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParetoReport {
    /// The format of x.
    pub input: String,
    /// The exponents.
    pub exponents: String,
    /// Every so many x.
    pub every: u64,
    /// Every representable x was seen.
    pub exhaustive: bool,
    /// Samples that each contender was measured at.
    pub samples: u64,
    /// Those of them on the epicentre.
    pub epicentre_samples: u64,
    /// Who does not take part, and why.
    pub left_out: Vec<String>,
    /// One for each contender.
    pub contenders: Vec<Row>,
    /// What was synthesised.
    pub synthesis: Vec<Synthesis>,
    /// Run times, where they were measured.
    pub timing: Option<TimingReport>,
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
                rows: timing_rows(&list, &errors, &times),
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
        contenders: rows(&list, &errors, inputs),
        synthesis: matching.into_iter().map(|(_, row)| row).collect(),
        timing,
    })
}

/// On the front, or dominated by the one of this name; nothing for those that are not compared.
type Standing = (Option<bool>, Option<String>);

/// The standing of everybody who has these coordinates.
fn standings<const AXES: usize>(
    list: &[contender::Contender],
    points: &[Option<[f64; AXES]>],
) -> Vec<Standing> {
    let present: Vec<usize> = (0..points.len()).filter(|&at| points[at].is_some()).collect();
    let compared: Vec<[f64; AXES]> = points.iter().flatten().copied().collect();
    let mut standings = vec![(None, None); points.len()];
    for (&place, dominator) in present.iter().zip(dominators(&compared)) {
        let name = dominator.map(|by| list[present[by]].name.clone());
        standings[place] = (Some(name.is_none()), name);
    }
    standings
}

fn worst(errors: &Errors) -> Option<f64> {
    errors.worst.map(|worst| worst.error)
}

fn rows(list: &[contender::Contender], errors: &[ContenderErrors], inputs: &Inputs) -> Vec<Row> {
    let costs: Vec<_> = list.iter().map(|contender| contender.engine.cost()).collect();
    let standing = |part: fn(&ContenderErrors) -> &Errors| {
        let points: Vec<_> = costs
            .iter()
            .zip(errors)
            .map(|(cost, errors)| {
                let cost = cost.as_ref()?;
                let own = [cost.multiplier_bits(), cost.divider_bits, cost.rom_bits, cost.latency];
                let [a, b, c, d] = own.map(|bits| bits as f64);
                Some([a, b, c, d, worst(part(errors))?])
            })
            .collect();
        standings(list, &points)
    };
    let (epicentre, whole) = (standing(|e| &e.epicentre), standing(|e| &e.whole));
    let exponents = inputs.exponents.as_slice();
    (0..list.len())
        .map(|at| {
            let (contender, errors, cost) = (&list[at], &errors[at], costs[at].as_ref());
            let some = |errors: &Errors| (errors.count > 0).then(|| errors.rms());
            let n = |errors: &Errors| errors.worst.map(|worst| exponents[worst.row]);
            let x = |errors: &Errors| errors.worst.map(|worst| inputs.real(worst.x));
            let listed = |cost: &hardware::HardwareCost| {
                let all: Vec<String> = cost.multipliers.iter().map(ToString::to_string).collect();
                all.join(" ")
            };
            Row {
                contender: contender.name.clone(),
                kind: contender.engine.kind().to_owned(),
                epicentre_worst: worst(&errors.epicentre),
                epicentre_worst_n: n(&errors.epicentre),
                epicentre_worst_x: x(&errors.epicentre),
                epicentre_rms: some(&errors.epicentre),
                whole_worst: worst(&errors.whole),
                whole_worst_n: n(&errors.whole),
                whole_worst_x: x(&errors.whole),
                whole_rms: some(&errors.whole),
                storage_bits: contender.engine.storage_bits(),
                latency: cost.map(|cost| cost.latency),
                multipliers: cost.map(listed),
                multiplier_bits: cost.map(hardware::HardwareCost::multiplier_bits),
                divider_bits: cost.map(|cost| cost.divider_bits),
                hardware_epicentre_front: epicentre[at].0,
                hardware_epicentre_dominated_by: epicentre[at].1.clone(),
                hardware_whole_front: whole[at].0,
                hardware_whole_dominated_by: whole[at].1.clone(),
                what: contender.what.clone(),
            }
        })
        .collect()
}

fn timing_rows(
    list: &[contender::Contender],
    errors: &[ContenderErrors],
    times: &[ContenderTimes],
) -> Vec<TimingRow> {
    let standing = |time: fn(&ContenderTimes) -> f64, part: fn(&ContenderErrors) -> &Errors| {
        let points: Vec<_> = times
            .iter()
            .zip(errors)
            .map(|(times, errors)| Some([time(times), worst(part(errors))?]))
            .collect();
        standings(list, &points).into_iter()
    };
    let [block, mixed]: [fn(&ContenderTimes) -> f64; 2] = [|t| t.block.median, |t| t.mixed.median];
    let [epicentre, whole]: [fn(&ContenderErrors) -> &Errors; 2] = [|e| &e.epicentre, |e| &e.whole];
    let blocks = standing(block, epicentre).zip(standing(block, whole));
    let mixtures = standing(mixed, epicentre).zip(standing(mixed, whole));
    list.iter()
        .zip(times)
        .zip(blocks.zip(mixtures))
        .map(|((contender, times), ((b_epicentre, b_whole), (m_epicentre, m_whole)))| TimingRow {
            contender: contender.name.clone(),
            block_median: times.block.median,
            block_lower_quartile: times.block.lower_quartile,
            block_upper_quartile: times.block.upper_quartile,
            block_least: times.block.least,
            mixed_median: times.mixed.median,
            mixed_lower_quartile: times.mixed.lower_quartile,
            mixed_upper_quartile: times.mixed.upper_quartile,
            mixed_least: times.mixed.least,
            block_epicentre_front: b_epicentre.0,
            block_epicentre_dominated_by: b_epicentre.1,
            block_whole_front: b_whole.0,
            block_whole_dominated_by: b_whole.1,
            mixed_epicentre_front: m_epicentre.0,
            mixed_epicentre_dominated_by: m_epicentre.1,
            mixed_whole_front: m_whole.0,
            mixed_whole_dominated_by: m_whole.1,
        })
        .collect()
}
