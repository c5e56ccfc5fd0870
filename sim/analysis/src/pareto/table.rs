//! The lines of the tables, and the order of the contenders in them.

use serde::{Deserialize, Serialize};

use super::contender::Contender;
use super::error::{ContenderErrors, Errors};
use super::front::{Timed, dominators, dominators_in_time, overlap};
use super::inputs::Inputs;
use super::synthesis::Synthesis;
use super::timing::{ContenderTimes, Times};
use crate::hardware_cost::HardwareCost;

/// One contender: a line of `pareto.csv`. Errors are fractions of full intensity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContenderRow {
    /// The name of the contender.
    pub contender: String,
    /// `f32` or `f64` on a processor, or `hardware`.
    pub kind: String,
    /// 1 where every representable x was seen, K where every K-th was: then greater errors may lie between.
    pub every: u64,
    /// The greatest error where x^n ≥ Q.
    pub epicentre_worst: Option<f64>,
    /// The exponent at which `epicentre_worst` is reached.
    pub epicentre_worst_n: Option<f64>,
    /// The x at which `epicentre_worst` is reached.
    pub epicentre_worst_x: Option<f64>,
    /// The root of the mean square there.
    pub epicentre_rms: Option<f64>,
    /// The greatest error on all of [0, 1].
    pub whole_worst: Option<f64>,
    /// The exponent at which `whole_worst` is reached.
    pub whole_worst_n: Option<f64>,
    /// The x at which `whole_worst` is reached.
    pub whole_worst_x: Option<f64>,
    /// The root of the mean square.
    pub whole_rms: Option<f64>,
    /// Bits of table or ROM, all exponents together.
    pub storage_bits: u64,
    /// Hardware: clock cycles from a request to its result.
    pub latency: Option<u64>,
    /// The operands of every multiplier.
    pub multipliers: Option<String>,
    /// Hardware: partial-product bits, the products of both operands' widths, summed.
    pub multiplier_bits: Option<u64>,
    /// Quotient digits times divisor bits.
    pub divider_bits: Option<u64>,
    /// Not dominated in error on the epicentre, multipliers, divider, ROM and latency.
    pub hardware_epicentre_front: Option<bool>,
    /// The contender that dominates it, if one does.
    pub hardware_epicentre_dominated_by: Option<String>,
    /// The same with the error on all of [0, 1].
    pub hardware_whole_front: Option<bool>,
    /// The contender that dominates it, if one does.
    pub hardware_whole_dominated_by: Option<String>,
    /// What the contender computes, in a sentence.
    pub what: String,
}

/// The times of one contender: a line of `pareto_timing.csv`, in ns per sample.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TimingRow {
    /// The name of the contender.
    pub contender: String,
    /// As in the table of errors: how many x the errors are of that the fronts are about.
    pub every: u64,
    /// Blocks of one exponent: the median.
    pub block_median: f64,
    /// A quarter of the rounds took at most this.
    pub block_lower_quartile: f64,
    /// Three quarters of the rounds took at most this.
    pub block_upper_quartile: f64,
    /// The time of the quickest round.
    pub block_least: f64,
    /// An exponent for each sample, where there is such a way: the median.
    pub mixed_median: Option<f64>,
    /// A quarter of the rounds took at most this.
    pub mixed_lower_quartile: Option<f64>,
    /// Three quarters of the rounds took at most this.
    pub mixed_upper_quartile: Option<f64>,
    /// The time of the quickest round.
    pub mixed_least: Option<f64>,
    /// Not dominated in time over blocks and in error on the epicentre; times whose quartiles overlap are the same.
    pub block_epicentre_front: Option<bool>,
    /// The contender that dominates it, if one does.
    pub block_epicentre_dominated_by: Option<String>,
    /// The same with the error on all of [0, 1].
    pub block_whole_front: Option<bool>,
    /// The contender that dominates it, if one does.
    pub block_whole_dominated_by: Option<String>,
    /// With the time over mixed exponents.
    pub mixed_epicentre_front: Option<bool>,
    /// The contender that dominates it, if one does.
    pub mixed_epicentre_dominated_by: Option<String>,
    /// The same with the time over mixed exponents and the error on all of [0, 1].
    pub mixed_whole_front: Option<bool>,
    /// The contender that dominates it, if one does.
    pub mixed_whole_dominated_by: Option<String>,
}

impl TimingRow {
    /// Whether the times of two contenders over blocks are the same within their quartiles.
    #[must_use]
    pub fn same_block_time(&self, other: &Self) -> bool {
        let quartiles = |row: &Self| [row.block_lower_quartile, row.block_upper_quartile];
        overlap(quartiles(self), quartiles(other))
    }

    /// The same over mixed exponents; not where one has no such time.
    #[must_use]
    pub fn same_mixed_time(&self, other: &Self) -> bool {
        let quartiles = |row: &Self| Some([row.mixed_lower_quartile?, row.mixed_upper_quartile?]);
        quartiles(self).zip(quartiles(other)).is_some_and(|(one, other)| overlap(one, other))
    }
}

/// Run times: what depends on the machine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TimingReport {
    /// The number of rounds, in each of which every contender has a turn.
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

/// A whole comparison: inputs, contenders, costs and times.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParetoReport {
    /// The format of x.
    pub input: String,
    /// The list of exponents.
    pub exponents: String,
    /// K where every K-th x was seen, 1 for every x.
    pub every: u64,
    /// Every representable x was seen.
    pub exhaustive: bool,
    /// Samples that each contender was measured at.
    pub samples: u64,
    /// Those of them on the epicentre.
    pub epicentre_samples: u64,
    /// Contenders that cannot take part, each with the reason in a sentence.
    pub left_out: Vec<String>,
    /// One for each contender.
    pub contenders: Vec<ContenderRow>,
    /// What synthesis found for the presets, a line for each preset and device.
    pub synthesis: Vec<Synthesis>,
    /// Run times, where they were measured.
    pub timing: Option<TimingReport>,
}

/// On the front, or dominated by the one of this name; nothing for those that are not compared.
type Standing = (Option<bool>, Option<String>);

/// The standing of every contender that has these coordinates.
fn standings<P: Copy>(
    names: &[String],
    points: &[Option<P>],
    dominators: fn(&[P]) -> Vec<Option<usize>>,
) -> Vec<Standing> {
    let present: Vec<usize> = (0..points.len()).filter(|&at| points[at].is_some()).collect();
    let compared: Vec<P> = points.iter().flatten().copied().collect();
    let mut standings = vec![(None, None); points.len()];
    for (&place, dominator) in present.iter().zip(dominators(&compared)) {
        let name = dominator.map(|by| names[present[by]].clone());
        standings[place] = (Some(name.is_none()), name);
    }
    standings
}

fn worst(errors: &Errors) -> Option<f64> {
    errors.worst.map(|worst| worst.error)
}

/// The lines of `pareto.csv`.
pub(super) fn rows(list: &[Contender], errors: &[ContenderErrors], inputs: &Inputs) -> Vec<ContenderRow> {
    let mut rows: Vec<ContenderRow> =
        list.iter().zip(errors).map(|(contender, errors)| row(contender, errors, inputs)).collect();
    stand(&mut rows);
    rows
}

/// Fills in which contenders are on the fronts of hardware, which follows from the other columns.
pub(super) fn stand(rows: &mut [ContenderRow]) {
    let names: Vec<String> = rows.iter().map(|row| row.contender.clone()).collect();
    let standing = |error: fn(&ContenderRow) -> Option<f64>| {
        let points: Vec<_> = rows.iter().map(|row| point(row, error(row))).collect();
        standings(&names, &points, dominators)
    };
    let epicentre = standing(|row| row.epicentre_worst);
    let whole = standing(|row| row.whole_worst);
    for ((row, epicentre), whole) in rows.iter_mut().zip(epicentre).zip(whole) {
        (row.hardware_epicentre_front, row.hardware_epicentre_dominated_by) = epicentre;
        (row.hardware_whole_front, row.hardware_whole_dominated_by) = whole;
    }
}

/// What hardware is compared by, the error last; none for a processor.
fn point(row: &ContenderRow, error: Option<f64>) -> Option<[f64; 5]> {
    let bits = [row.multiplier_bits?, row.divider_bits?, row.storage_bits, row.latency?];
    let [multipliers, divider, rom, latency] = bits.map(|bits| bits as f64);
    Some([multipliers, divider, rom, latency, error?])
}

/// A line without its standings.
fn row(contender: &Contender, errors: &ContenderErrors, inputs: &Inputs) -> ContenderRow {
    let ContenderErrors { epicentre, whole } = errors;
    let cost = contender.engine.cost();
    let cost = cost.as_ref();
    let rms = |errors: &Errors| (errors.count > 0).then(|| errors.rms());
    let n = |errors: &Errors| Some(inputs.exponents.as_slice()[errors.worst?.row]);
    let x = |errors: &Errors| Some(inputs.real(errors.worst?.x));
    let listed = |cost: &HardwareCost| {
        let all: Vec<String> = cost.multipliers.iter().map(ToString::to_string).collect();
        all.join(" ")
    };
    ContenderRow {
        contender: contender.name.clone(),
        kind: contender.engine.kind().to_owned(),
        every: inputs.every,
        epicentre_worst: worst(epicentre),
        epicentre_worst_n: n(epicentre),
        epicentre_worst_x: x(epicentre),
        epicentre_rms: rms(epicentre),
        whole_worst: worst(whole),
        whole_worst_n: n(whole),
        whole_worst_x: x(whole),
        whole_rms: rms(whole),
        storage_bits: contender.engine.storage_bits(),
        latency: cost.map(|cost| cost.latency),
        multipliers: cost.map(listed),
        multiplier_bits: cost.map(HardwareCost::multiplier_bits),
        divider_bits: cost.map(|cost| cost.divider_bits),
        hardware_epicentre_front: None,
        hardware_epicentre_dominated_by: None,
        hardware_whole_front: None,
        hardware_whole_dominated_by: None,
        what: contender.what.clone(),
    }
}

/// The lines of `pareto_timing.csv`.
pub(super) fn timing_rows(
    list: &[Contender],
    errors: &[ContenderErrors],
    times: &[ContenderTimes],
    every: u64,
) -> Vec<TimingRow> {
    let names: Vec<String> = list.iter().map(|contender| contender.name.clone()).collect();
    let standing = |time: fn(&ContenderTimes) -> Option<Times>, part: fn(&ContenderErrors) -> &Errors| {
        let point = |(times, errors): (&ContenderTimes, &ContenderErrors)| {
            let Times { lower_quartile, upper_quartile, .. } = time(times)?;
            Some(Timed { quartiles: [lower_quartile, upper_quartile], error: worst(part(errors))? })
        };
        let points: Vec<_> = times.iter().zip(errors).map(point).collect();
        standings(&names, &points, dominators_in_time).into_iter()
    };
    let [block, mixed]: [fn(&ContenderTimes) -> Option<Times>; 2] = [|times| Some(times.block), |times| times.mixed];
    let [epicentre, whole]: [fn(&ContenderErrors) -> &Errors; 2] = [|e| &e.epicentre, |e| &e.whole];
    let blocks = standing(block, epicentre).zip(standing(block, whole));
    let mixtures = standing(mixed, epicentre).zip(standing(mixed, whole));
    list.iter()
        .zip(times)
        .zip(blocks.zip(mixtures))
        .map(|((contender, times), ((b_epicentre, b_whole), (m_epicentre, m_whole)))| TimingRow {
            contender: contender.name.clone(),
            every,
            block_median: times.block.median,
            block_lower_quartile: times.block.lower_quartile,
            block_upper_quartile: times.block.upper_quartile,
            block_least: times.block.least,
            mixed_median: times.mixed.map(|mixed| mixed.median),
            mixed_lower_quartile: times.mixed.map(|mixed| mixed.lower_quartile),
            mixed_upper_quartile: times.mixed.map(|mixed| mixed.upper_quartile),
            mixed_least: times.mixed.map(|mixed| mixed.least),
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
