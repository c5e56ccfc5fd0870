//! From good integers to ones that no neighbour beats.

use hw_model::steps::Steps;
use serde::Serialize;

use super::piece::{Judge, Piece, Worst};
use super::propose::propose;

/// Steps of a single coefficient that are looked at beyond the neighbours.
const AXIS: i32 = 4;

/// What was found for one segment of one row. Errors are fractions of full intensity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Found {
    /// The exponent.
    pub n: f64,
    /// Counted from 1.
    pub segment: u32,
    /// Representable x that were judged.
    pub samples: u64,
    /// The greatest error before.
    pub before: f64,
    /// The same with the integers that were found.
    pub after: f64,
    /// The x (bits in the input format) where.
    pub x: i64,
    /// The greatest error of the method with real coefficients at the same x: what no integers are better than
    /// where the method is `minimax`, but for what rounding happens to mend.
    pub method: f64,
    /// The steps of c0, c1, … from the rounded coefficients, as many as the polynomial has.
    pub steps: Vec<i32>,
}

/// The best integers that were found for a piece.
pub(super) fn search(piece: &Piece<'_>, reach: i32) -> Found {
    let mut search = Search { piece, judge: Judge::new(piece), reach };
    let start = search.judge.below(Steps::default(), f64::INFINITY);
    let start = start.unwrap_or(Worst { error: f64::INFINITY, x: piece.span.first });
    let mut best = (Steps::default(), start);
    if reach > 0 {
        search.descend(&mut best);
        for steps in propose(piece, reach) {
            search.better(&mut best, steps);
        }
        search.descend(&mut best);
    }
    let (steps, worst) = best;
    Found {
        n: piece.exponent,
        segment: piece.span.segment as u32 + 1,
        samples: piece.span.samples(),
        before: start.error,
        after: worst.error,
        x: worst.x,
        method: piece.method,
        steps: piece.steps_in_all(steps)[..=piece.degree].to_vec(),
    }
}

type Best = (Steps, Worst);

struct Search<'a, 'b> {
    piece: &'a Piece<'b>,
    judge: Judge<'a, 'b>,
    reach: i32,
}

impl Search<'_, '_> {
    /// Goes to the first better neighbour until there is none.
    fn descend(&mut self, best: &mut Best) {
        let neighbours = neighbours(self.piece);
        'again: loop {
            let from = best.0;
            for by in &neighbours {
                let steps = std::array::from_fn(|i| from[i] + by[i]);
                if self.better(best, steps) {
                    continue 'again;
                }
            }
            return;
        }
    }

    /// Takes these integers if they are better and no register overflows with them.
    fn better(&mut self, best: &mut Best, steps: Steps) -> bool {
        if steps.iter().any(|step| step.abs() > self.reach) || !self.piece.within_formats(steps) {
            return false;
        }
        let Some(worst) = self.judge.below(steps, best.1.error) else { return false };
        if self.piece.overflows(steps) {
            return false;
        }
        *best = (steps, worst);
        true
    }
}

/// Every mixture of −1, 0 and 1, single steps first; then longer steps of one coefficient.
fn neighbours(piece: &Piece<'_>) -> Vec<Steps> {
    let count = piece.degree + 1;
    let digit = |code: i32, i: usize| if i < count { code / 3_i32.pow(i as u32) % 3 - 1 } else { 0 };
    let mut all: Vec<Steps> = (0..3_i32.pow(count as u32))
        .map(|code| std::array::from_fn(|i| digit(code, i)))
        .filter(|by| *by != Steps::default())
        .collect();
    all.sort_by_key(|by| by.iter().filter(|step| **step != 0).count());
    for length in 2..=AXIS {
        for index in 0..count {
            for step in [-length, length] {
                let mut by = Steps::default();
                by[index] = step;
                all.push(by);
            }
        }
    }
    all.retain(|by| by.iter().zip(piece.free).all(|(&step, free)| free || step == 0));
    all
}
