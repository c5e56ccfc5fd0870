//! From good integers to ones that no neighbour beats.

use serde::Serialize;

use super::piece::{Judge, Piece, Worst};
use super::propose::propose;

/// Steps of a single coefficient that are looked at beyond the neighbours.
const AXIS: i32 = 4;

/// What was found for one segment of one row. Errors are fractions of full intensity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Found {
    /// The exponent.
    pub n: f64,
    /// 1, or 2.
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
    /// The steps of c0, c1, c2, c3 from the rounded coefficients.
    pub steps: [i32; 4],
}

/// The best integers that were found for a piece.
pub(super) fn search(piece: &Piece<'_>, reach: i32) -> Found {
    let mut search = Search { piece, judge: Judge::new(piece), reach };
    let start = search.judge.below([0; 4], f64::INFINITY);
    let start = start.unwrap_or(Worst { error: f64::INFINITY, x: piece.span.first });
    let mut best = ([0; 4], start);
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
        segment: if piece.span.outer { 2 } else { 1 },
        samples: piece.span.samples(),
        before: start.error,
        after: worst.error,
        x: worst.x,
        method: piece.method,
        steps: piece.steps_in_all(steps),
    }
}

type Best = ([i32; 4], Worst);

struct Search<'a, 'b> {
    piece: &'a Piece<'b>,
    judge: Judge<'a, 'b>,
    reach: i32,
}

impl Search<'_, '_> {
    /// Goes to the first better neighbour until there is none.
    fn descend(&mut self, best: &mut Best) {
        let neighbours = neighbours(self.piece.free);
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
    fn better(&mut self, best: &mut Best, steps: [i32; 4]) -> bool {
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
fn neighbours(free: [bool; 4]) -> Vec<[i32; 4]> {
    let mut all: Vec<[i32; 4]> = (0..81)
        .map(|code: i32| std::array::from_fn(|i| code / 3_i32.pow(i as u32) % 3 - 1))
        .filter(|by| *by != [0; 4])
        .collect();
    all.sort_by_key(|by| by.iter().filter(|step| **step != 0).count());
    for length in 2..=AXIS {
        for index in 0..4 {
            for step in [-length, length] {
                let mut by = [0; 4];
                by[index] = step;
                all.push(by);
            }
        }
    }
    all.retain(|by| by.iter().zip(free).all(|(&step, free)| free || step == 0));
    all
}
