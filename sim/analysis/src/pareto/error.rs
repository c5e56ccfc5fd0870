//! The errors of all contenders over all inputs, in one pass: a block of x stays in the first-level cache
//! while n rises, and with it the running product that is the reference for all of them.
//!
//! The result does not depend on the number of threads: the x are cut into pieces of one size, each
//! piece is summed up in one order, and the pieces are added in theirs.

use multiversion::multiversion;
use rayon::prelude::*;

use super::contender::{Contender, Work};
use super::inputs::{Inputs, Samples};
use crate::reference_product::ReferenceProduct;
use vectors::progress::Progress;

/// x that stay in the cache together.
const BLOCK: u64 = 512;
/// x that make one piece of work for a thread.
const PIECE: u64 = 1 << 14;
/// Sums that are kept side by side, because a compiler may not reorder additions by itself.
const LANES: usize = 16;

/// A greatest error, and where it is: of equal errors the one at the least n, and then at the least x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// |value − x^n|, as a fraction of full intensity.
    pub error: f64,
    /// The place of n.
    pub row: usize,
    /// The x where, as bits in the input format.
    pub x: i64,
}

impl Worst {
    fn or(self, other: Self) -> Self {
        let nearer = (other.row, other.x) < (self.row, self.x);
        let replaced = other.error > self.error || (other.error == self.error && nearer);
        if replaced { other } else { self }
    }
}

/// The errors over a set of samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// The greatest; none without samples.
    pub worst: Option<Worst>,
    /// The sum of the squares of all errors.
    pub squares: f64,
    /// How many there are.
    pub count: u64,
}

impl Errors {
    const NONE: Self = Self { worst: None, squares: 0.0, count: 0 };

    fn and(self, other: Self) -> Self {
        let worst = match (self.worst, other.worst) {
            (Some(a), Some(b)) => Some(a.or(b)),
            (a, b) => a.or(b),
        };
        Self { worst, squares: self.squares + other.squares, count: self.count + other.count }
    }

    /// The root of the mean square.
    #[must_use]
    pub fn rms(&self) -> f64 {
        if self.count == 0 { 0.0 } else { (self.squares / self.count as f64).sqrt() }
    }

    /// Sees some errors of one exponent, at rising x.
    fn see(&mut self, found: Found, row: usize, xs: &[i64]) {
        let Some(&first) = xs.first() else { return };
        self.squares += found.squares;
        self.count += xs.len() as u64;
        let x = found.place.map_or(first, |place| xs[place]);
        let here = Worst { error: found.greatest, row, x };
        self.worst = Some(self.worst.map_or(here, |worst| worst.or(here)));
    }

    fn greatest(&self) -> f64 {
        self.worst.map_or(-1.0, |worst| worst.error)
    }
}

/// The errors of one contender.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContenderErrors {
    /// Where x^n ≥ Q.
    pub epicentre: Errors,
    /// The errors on all of [0, 1].
    pub whole: Errors,
}

/// Measures every contender. `epicentres` are the least x of each exponent's epicentre, in bits.
#[must_use]
pub(super) fn errors(
    contenders: &[Contender],
    inputs: &Inputs,
    epicentres: &[i64],
    progress: &dyn Progress,
) -> Vec<ContenderErrors> {
    let pieces = inputs.per_exponent().div_ceil(PIECE);
    let measured: Vec<Vec<[Errors; 2]>> = (0..pieces)
        .into_par_iter()
        .map(|piece| measure_piece(contenders, inputs, epicentres, piece, progress))
        .collect();
    (0..contenders.len())
        .map(|contender| {
            let sum = |part: usize| measured.iter().fold(Errors::NONE, |sum, piece| sum.and(piece[contender][part]));
            let (tail, epicentre) = (sum(0), sum(1));
            ContenderErrors { epicentre, whole: tail.and(epicentre) }
        })
        .collect()
}

/// Errors of tail and epicentre for each contender.
fn measure_piece(
    contenders: &[Contender],
    inputs: &Inputs,
    epicentres: &[i64],
    piece: u64,
    progress: &dyn Progress,
) -> Vec<[Errors; 2]> {
    let mut sums = vec![[Errors::NONE; 2]; contenders.len()];
    let (mut samples, mut powers, mut work) = (Samples::default(), ReferenceProduct::default(), Work::default());
    let end = (piece * PIECE + PIECE).min(inputs.per_exponent());
    let mut place = piece * PIECE;
    while place < end {
        let next = (place + BLOCK).min(end);
        samples.fill(inputs, (place..next).map(|place| inputs.x(place)));
        powers.start(&samples.double);
        for (row, n) in inputs.exponents.iter().enumerate() {
            let (high, low) = powers.at(n);
            let first = samples.bits.partition_point(|&x| x < epicentres[row]);
            for (contender, sums) in contenders.iter().zip(&mut sums) {
                contender.engine.values(row, &samples, &mut work);
                for (part, sum) in [0..first, first..samples.bits.len()].into_iter().zip(sums) {
                    let (values, high, low) = (&work.wide[part.clone()], &high[part.clone()], &low[part.clone()]);
                    let found = look(values, high, low, sum.greatest());
                    sum.see(found, row, &samples.bits[part]);
                }
            }
        }
        progress.advance((next - place) * inputs.exponents.len() as u64);
        place = next;
    }
    sums
}

/// What a look at some errors finds.
struct Found {
    greatest: f64,
    /// Where, if it is not less than what was known.
    place: Option<usize>,
    squares: f64,
}

/// The greatest of |value − (high + low)|, and the sum of squares. The first difference is exact where it
/// is small, and the second rounds once: a relative error of 2⁻⁵² at most. The place is only looked for
/// where the greatest may be a new one, which is rare.
#[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512dq+avx512vl"))]
fn look(values: &[f64], high: &[f64], low: &[f64], known: f64) -> Found {
    let error = |value: f64, high: f64, low: f64| ((value - high) - low).abs();
    let more = |a: f64, b: f64| if a > b { a } else { b };
    let (mut greatest, mut squares) = ([0.0; LANES], [0.0; LANES]);
    let ((values16, values1), (high16, high1), (low16, low1)) =
        (values.as_chunks::<LANES>(), high.as_chunks::<LANES>(), low.as_chunks::<LANES>());
    for ((values, high), low) in values16.iter().zip(high16).zip(low16) {
        for lane in 0..LANES {
            let error = error(values[lane], high[lane], low[lane]);
            greatest[lane] = more(error, greatest[lane]);
            squares[lane] += error * error;
        }
    }
    for (lane, ((&value, &high), &low)) in values1.iter().zip(high1).zip(low1).enumerate() {
        let error = error(value, high, low);
        greatest[lane] = more(error, greatest[lane]);
        squares[lane] += error * error;
    }
    let greatest = greatest.into_iter().fold(0.0, more);
    let place = (greatest >= known).then(|| {
        let errors = values.iter().zip(high).zip(low).map(|((&v, &h), &l)| error(v, h, l));
        errors.into_iter().position(|error| error == greatest)
    });
    Found { greatest, place: place.flatten(), squares: squares.into_iter().sum() }
}
