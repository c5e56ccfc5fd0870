//! The run times of all contenders, side by side: in every round each contender has a turn with the same x, in an
//! order that is drawn anew. What disturbs the machine for a while then falls on all alike, and no contender
//! always follows the same other one. A turn begins with a pass that is not timed, so that the caches hold
//! what they hold in a long run.
//!
//! Two ways to be asked: blocks of one exponent, as a renderer that sorts by material does, and an
//! exponent for each sample, as pixels come. Of the hardware the block engine is timed, which is a model and
//! not the hardware, and which takes one exponent at a time: it has no second way.

use std::hint::black_box;
use std::time::Instant;

use hw_model::highlight::phong;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use serde::Serialize;
use thiserror::Error;

use super::contender::{Contender, Engine, Work};
use super::error::ContenderErrors;
use super::functions::Real;
use super::inputs::{Inputs, Samples};
use super::kernel::Loops;

/// Samples of a pass: with what comes out, they fit into a second-level cache.
pub(crate) const SAMPLES: usize = 1 << 14;
/// Timed passes of a turn.
pub(crate) const PASSES: usize = 4;
/// Samples of one exponent in a row.
pub const BLOCK: usize = 1 << 10;
/// The fewest rounds of which a median and quartiles are taken.
pub const FEWEST_ROUNDS: u64 = 15;

/// Why a time would mean nothing.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "{contender}: what was to be timed is off by {error:e} at n = {exponent}, x = {x}, and by {known:e} at most \
     where its error was measured"
)]
pub struct TimingError {
    /// The name of the contender.
    pub contender: String,
    /// The exponent at which it is off.
    pub exponent: f64,
    /// The x at which it is off.
    pub x: f64,
    /// The error found in the loop that was to be timed.
    pub error: f64,
    /// The greatest error known.
    pub known: f64,
}

/// Times of one contender, in ns per sample.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Times {
    /// Half the rounds took at most this.
    pub median: f64,
    /// A quarter of them.
    pub lower_quartile: f64,
    /// Three quarters of them.
    pub upper_quartile: f64,
    /// The time of the quickest round.
    pub least: f64,
}

/// Times of one contender, for blocks of one exponent and for an exponent for each sample.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContenderTimes {
    /// Blocks of one exponent.
    pub block: Times,
    /// An exponent for each sample; none for the block engine.
    pub mixed: Option<Times>,
}

/// Times every contender in turn.
///
/// # Errors
/// When a contender, in the loops that are timed, is further off than its errors say.
pub fn times(
    contenders: &[Contender],
    errors: &[ContenderErrors],
    inputs: &Inputs,
    rounds: u64,
    seed: u64,
) -> Result<Vec<ContenderTimes>, TimingError> {
    let task = Task::new(inputs, seed);
    let mut work = Work::default();
    for (contender, errors) in contenders.iter().zip(errors) {
        task.blocks(&contender.engine, &mut work);
        task.check(contender, errors, &work, |sample| task.row_of_block(sample / BLOCK))?;
        if task.mixture(&contender.engine, &mut work) {
            task.check(contender, errors, &work, |sample| task.mixed[sample] as usize)?;
        }
    }
    let mut measured = vec![[Vec::new(), Vec::new()]; contenders.len()];
    let mut dice = ChaCha8Rng::seed_from_u64(seed);
    let mut order: Vec<usize> = (0..contenders.len()).collect();
    for _ in 0..rounds {
        shuffle(&mut order, &mut dice);
        for &place in &order {
            let engine = &contenders[place].engine;
            let [block, mixed] = &mut measured[place];
            block.push(timed(&mut work, |work| task.blocks(black_box(engine), work)));
            if !matches!(engine, Engine::Hardware(_)) {
                let run = |work: &mut Work| _ = task.mixture(black_box(engine), work);
                mixed.push(timed(&mut work, run));
            }
        }
    }
    let both = measured.into_iter().map(|measured| {
        let [block, mixed] = measured;
        let mixed = (!mixed.is_empty()).then(|| Times::of(mixed));
        ContenderTimes { block: Times::of(block), mixed }
    });
    Ok(both.collect())
}

/// Runs the work once untimed and [`PASSES`] times timed, and returns the time in ns per sample.
fn timed(work: &mut Work, run: impl Fn(&mut Work)) -> f64 {
    let pass = |work: &mut Work| {
        run(work);
        black_box(&*work);
    };
    pass(work);
    let start = Instant::now();
    for _ in 0..PASSES {
        pass(work);
    }
    start.elapsed().as_secs_f64() * 1e9 / (SAMPLES * PASSES) as f64
}

/// Every order is as likely as another, but for less than one in 2⁵⁰.
fn shuffle(order: &mut [usize], dice: &mut impl Rng) {
    for last in (1..order.len()).rev() {
        order.swap(last, (dice.next_u64() % (last as u64 + 1)) as usize);
    }
}

impl Times {
    fn of(mut rounds: Vec<f64>) -> Self {
        rounds.sort_by(f64::total_cmp);
        let part = |quarters: usize| {
            let place = rounds.len().saturating_sub(1) * quarters / 4;
            rounds.get(place).copied().unwrap_or(f64::NAN)
        };
        Self { median: part(2), lower_quartile: part(1), upper_quartile: part(3), least: part(0) }
    }
}

/// The samples that every contender computes.
struct Task<'a> {
    inputs: &'a Inputs,
    samples: Samples,
    /// The place of the exponent of each block.
    blocks: Vec<u32>,
    /// The place of the exponent of each sample, in mixed order.
    mixed: Vec<u32>,
}

impl<'a> Task<'a> {
    /// x and n are drawn from those whose errors are known. A remainder of 64 bits favours some by less
    /// than one in 2³⁰, which no clock sees.
    fn new(inputs: &'a Inputs, seed: u64) -> Self {
        let mut dice = ChaCha8Rng::seed_from_u64(seed);
        let mut below = |bound: u64| dice.next_u64() % bound;
        let xs: Vec<i64> = (0..SAMPLES).map(|_| inputs.x(below(inputs.per_exponent()))).collect();
        let mut samples = Samples::default();
        samples.fill(inputs, xs.into_iter());
        let rows = inputs.exponents.len() as u64;
        let blocks = (0..SAMPLES / BLOCK).map(|_| below(rows) as u32).collect();
        let mixed = (0..SAMPLES).map(|_| below(rows) as u32).collect();
        Self { inputs, samples, blocks, mixed }
    }

    fn row_of_block(&self, block: usize) -> usize {
        self.blocks[block] as usize
    }

    fn blocks(&self, engine: &Engine, work: &mut Work) {
        work.wide.resize(SAMPLES, 0.0);
        work.single.resize(SAMPLES, 0.0);
        for (index, &row) in self.blocks.iter().enumerate() {
            let part = index * BLOCK..(index + 1) * BLOCK;
            match engine {
                Engine::Single(kernel) => {
                    let xs = &self.samples.single[part.clone()];
                    f32::block(kernel, row as usize, xs, &mut work.single[part]);
                }
                Engine::Double(kernel) => {
                    let xs = &self.samples.double[part.clone()];
                    f64::block(kernel, row as usize, xs, &mut work.wide[part]);
                }
                Engine::Hardware(design) => {
                    let xs = &self.samples.bits[part.clone()];
                    design.datapath().evaluate_block(row, xs, &mut work.block);
                    work.bits.resize(SAMPLES, 0);
                    work.bits[part].copy_from_slice(&work.block.intensities);
                }
            }
        }
    }

    /// False where there is no such way.
    fn mixture(&self, engine: &Engine, work: &mut Work) -> bool {
        work.wide.resize(SAMPLES, 0.0);
        work.single.resize(SAMPLES, 0.0);
        match engine {
            Engine::Single(kernel) => {
                f32::mixture(kernel, &self.mixed, &self.samples.single, &mut work.single);
            }
            Engine::Double(kernel) => {
                f64::mixture(kernel, &self.mixed, &self.samples.double, &mut work.wide);
            }
            Engine::Hardware(_) => return false,
        }
        true
    }

    /// Holds what a run left against x^n. The reference is off by half an ulp of 1 at most.
    fn check(
        &self,
        contender: &Contender,
        errors: &ContenderErrors,
        work: &Work,
        row: impl Fn(usize) -> usize,
    ) -> Result<(), TimingError> {
        let known = errors.whole.worst.map_or(0.0, |worst| worst.error);
        for sample in 0..SAMPLES {
            let value = match &contender.engine {
                Engine::Single(_) => work.single[sample].wide(),
                Engine::Double(_) => work.wide[sample],
                Engine::Hardware(design) => work.bits[sample] as f64 * design.config().output.ulp(),
            };
            let (exponent, x) = (self.inputs.exponents.as_slice()[row(sample)], self.samples.double[sample]);
            let error = (value - phong(exponent, x)).abs();
            // Also where it is not a number.
            let good = error <= known + f64::EPSILON;
            if !good {
                let contender = contender.name.clone();
                return Err(TimingError { contender, exponent, x, error, known });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_are_those_of_the_sorted_rounds() {
        let times = Times::of(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        let expected = Times { median: 3.0, lower_quartile: 2.0, upper_quartile: 4.0, least: 1.0 };
        assert_eq!(times, expected);
    }
}
