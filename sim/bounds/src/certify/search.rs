//! From an error function to an enclosure of its maximum, with the proof.
//!
//! A pattern search finds a witness, whose rigorous error is the lower bound. The upper bound is a little
//! more, and bisection proves it: a box whose bound exceeds it is halved, until none is left. Where a box
//! holds a point that exceeds it, that point is the better witness, and the proof begins again. Where the
//! rounding of intervals leaves no room (errors near 10⁻¹⁵, next to an n where a method is exact), the upper
//! bound moves away from the lower one.

use hw_model::fit::{FitError, Levels, Method};
use thiserror::Error;

use super::claim::{Enclosure, EveryClaim, ExponentClaim, Finding, Measure, Stretch, Witness};
use super::curve::is_exact;
use super::error::{ErrorFunction, EveryExponent, OneExponent};
use super::partition::{Cell, LEAF};

/// The first upper bound is this part above the lower one; 10⁻⁶ is asked for.
const MARGIN: f64 = 5e-7;

/// What both margins grow by where a proof fails.
const GROWTH: f64 = 8.0;

/// The absolute margin after the first failure.
const NOISE: f64 = 1e-17;

/// Proofs tried: the last has an absolute margin of 9·10⁻⁸. Boxes whose error is bounded to order w² must
/// be narrower than the root of the margin, so that errors far below 10⁻⁹ take too many for a tighter one.
const ATTEMPTS: u32 = 12;

/// Restarts with a better witness.
const RESTARTS: u32 = 64;

/// Boxes of a proof for one exponent, and for all: a hundred times what they take.
const MOST_BOXES: (usize, usize) = (20_000, 2_000_000);

/// The grid that the search for a witness begins with, in σ and (for every exponent) in h.
const SIGMA_STEPS: u32 = 64;
const H_STEPS: u32 = 24;

/// Tails: how far beyond the edge of the epicentre the grid goes. f is below its maximum long before.
const TAIL: f64 = 48.0;

/// Where a grid point is not under its neighbours, it is improved; that many of them.
const STARTS: usize = 3;

/// Halvings of the pattern's step: 2⁻³⁰ of the grid's.
const HALVINGS: u32 = 30;

/// No enclosure was found.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum NotProved {
    /// The search came to the end of f64.
    #[error(
        "no bound could be proved: rounding leaves no room; the levels q and g are too close to 0, to 1 \
         or to each other"
    )]
    NoRoom,
    /// There is no such exponent.
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// Every claim about one exponent: a method on one of its regions.
///
/// # Errors
/// When nothing could be proved.
pub fn claim_exponent(method: Method, n: f64, region: Stretch, levels: Levels) -> Result<ExponentClaim, NotProved> {
    let find = |measure| {
        if is_exact(method, region, n) {
            return Ok(Finding::Exact);
        }
        let error = OneExponent::new(method, n, region, measure, levels)?;
        enclose(&error, false).map(Finding::Enclosed)
    };
    let absolute = find(Measure::Absolute)?;
    let bounded = region == Stretch::Epicentre;
    let relative = bounded.then(|| find(Measure::Relative)).transpose()?;
    Ok(ExponentClaim { method, n, region, absolute, relative })
}

/// Every claim about every real exponent at once.
///
/// # Errors
/// When nothing could be proved.
pub fn claim_every_exponent(method: Method, levels: Levels) -> Result<EveryClaim, NotProved> {
    let find = |measure| enclose(&EveryExponent::new(method, measure, levels), true);
    Ok(EveryClaim { method, absolute: find(Measure::Absolute)?, relative: find(Measure::Relative)? })
}

#[derive(Clone, Copy)]
struct Point {
    h: f64,
    sigma: f64,
    error: f64,
}

fn enclose(error: &impl ErrorFunction, every: bool) -> Result<Enclosure, NotProved> {
    let mut witness = find_witness(error, every);
    let mut restarts = 0;
    let mut attempt = 0;
    while attempt < ATTEMPTS && restarts < RESTARTS {
        let growth = GROWTH.powi(attempt as i32);
        let noise = if attempt == 0 { 0.0 } else { NOISE * growth };
        let upper = witness.error * (1.0 + MARGIN * growth) + noise;
        match prove(error, every, upper) {
            Proof::Done { partition, far } => {
                let h = every.then_some(witness.h);
                let witness_at = Witness { h, sigma: witness.sigma };
                return Ok(Enclosure { lower: witness.error, upper, witness: witness_at, far, partition });
            }
            Proof::Exceeded(point) => {
                witness = climb(error, every, point, 1e-3);
                restarts += 1;
            }
            Proof::NoRoom => attempt += 1,
        }
    }
    Err(NotProved::NoRoom)
}

enum Proof {
    Done { partition: String, far: Option<f64> },
    Exceeded(Point),
    NoRoom,
}

fn prove(error: &impl ErrorFunction, every: bool, upper: f64) -> Proof {
    let span = error.span();
    let mut far = None;
    if span.outer.high().is_infinite() {
        let within = |&far: &f64| error.beyond(far) <= upper;
        far = (0..40).map(|k| span.outer.low() + f64::from(k).exp2()).find(within);
        if far.is_none() {
            return Proof::NoRoom;
        }
    }
    let most = if every { MOST_BOXES.1 } else { MOST_BOXES.0 };
    let mut waiting = vec![span.root(error.h(), far)];
    let mut partition = String::new();
    while let Some(cell) = waiting.pop() {
        let (greatest, axis) = error.greatest(cell);
        if greatest <= upper {
            partition.push(LEAF);
            continue;
        }
        let middle = point(error, cell);
        if middle.error > upper && span.inner.holds(middle.sigma) {
            return Proof::Exceeded(middle);
        }
        let Some([first, second]) = cell.halves(axis) else { return Proof::NoRoom };
        if partition.len() > most {
            return Proof::NoRoom;
        }
        partition.push(axis.symbol());
        waiting.extend([second, first]);
    }
    Proof::Done { partition, far }
}

fn point(error: &impl ErrorFunction, cell: Cell) -> Point {
    at(error, cell.h.low(), cell.sigma.middle())
}

fn at(error: &impl ErrorFunction, h: f64, sigma: f64) -> Point {
    Point { h, sigma, error: error.least_at(h, sigma) }
}

/// The best of a grid's peaks, each improved.
fn find_witness(error: &impl ErrorFunction, every: bool) -> Point {
    let inner = error.span().inner;
    let (low, high) = (inner.low(), inner.high().min(inner.low() + TAIL));
    let step = (high - low) / f64::from(SIGMA_STEPS);
    // Squared, the steps are finer where h → 0 and where a tail begins.
    let hs: Vec<f64> = if every {
        (0..=H_STEPS).map(|i| (f64::from(i) / f64::from(H_STEPS)).powi(2)).collect()
    } else {
        vec![error.h().low()]
    };
    let fine = |i: u32| {
        let part = f64::from(i) / f64::from(SIGMA_STEPS);
        let bent = if inner.high() == f64::MAX { part * part } else { part };
        (low + (high - low) * bent).min(inner.high())
    };
    let mut points: Vec<Point> = hs
        .iter()
        .flat_map(|&h| {
            let row: Vec<Point> = (0..=SIGMA_STEPS).map(|i| at(error, h, fine(i))).collect();
            peaks(&row)
        })
        .collect();
    points.sort_by(|a, b| b.error.total_cmp(&a.error));
    points.truncate(STARTS);
    let climbed = points.into_iter().map(|point| climb(error, every, point, step));
    let best = climbed.reduce(|best, point| if point.error > best.error { point } else { best });
    best.unwrap_or_else(|| at(error, hs[0], low))
}

fn peaks(row: &[Point]) -> Vec<Point> {
    let error = |i: usize| row.get(i).map_or(0.0, |point| point.error);
    (0..row.len())
        .filter(|&i| error(i) >= error(i.wrapping_sub(1)) && error(i) >= error(i + 1))
        .map(|i| row[i])
        .collect()
}

/// Steps to a better neighbour while there is one, then halves the step.
fn climb(error: &impl ErrorFunction, every: bool, start: Point, step: f64) -> Point {
    let (inner, hs) = (error.span().inner, error.h());
    let mut best = start;
    let mut step = step;
    for _ in 0..HALVINGS {
        // A step that helps is repeated, at most as often as it takes to cross the grid's cell twice.
        for _ in 0..4 {
            let mut moves = vec![(best.h, best.sigma - step), (best.h, best.sigma + step)];
            if every {
                moves.extend([(best.h - step, best.sigma), (best.h + step, best.sigma)]);
            }
            let found = moves
                .into_iter()
                .map(|(h, sigma)| (h.clamp(hs.low(), hs.high()), sigma.clamp(inner.low(), inner.high())))
                .map(|(h, sigma)| at(error, h, sigma))
                .reduce(|best, point| if point.error > best.error { point } else { best });
            match found {
                Some(found) if found.error > best.error => best = found,
                _ => break,
            }
        }
        step *= 0.5;
    }
    // Steps approach an end of h, and do not reach it.
    let end = at(error, hs.low(), best.sigma);
    if end.error > best.error { end } else { best }
}
