//! Consecutive x of one exponent: a sweep.
//!
//! x need not be stored, and needs no region of its own: between two of the places 0, cut, hand-over and
//! greatest x one part answers for all. So each piece of the run is a loop without a choice in it, and a piece whose
//! answer is zero is filled. What is known of a configuration (its rounding mode, that its lines are
//! plain, how wide a lane they need) is settled before the loop, which is compiled for each case.

use multiversion::multiversion;

use crate::rom::{FieldName, Row};
use crate::rounding::{Lane, Rounding};

use super::block::{Lines, Segment};
use super::clamp::clamp;
use super::front_end::Region;
use super::lanes::Half;
use super::ranks::Datapath;
use super::stage::MultiplyAdd;
use super::tail::Division;

/// Divisions under way together: their registers stay in the first-level cache.
const DIVISIONS: usize = 128;

impl Datapath {
    /// Evaluates x, x + 1, … at one address, one x for each place of `intensities`. An address without
    /// a word gives zeros.
    pub fn evaluate_run(&self, address: u32, x: i64, intensities: &mut [i64]) {
        let Some(row) = self.rom.row(address) else {
            intensities.fill(0);
            return;
        };
        let lines = Lines::of(self);
        match (self.narrow, self.operands_fit_half(), self.division_fits_i32()) {
            (false, _, _) => lines.run::<i128, i128>(row, x, intensities),
            (true, true, true) => half_run(lines, row, x, intensities),
            (true, true, false) => half_run_long(lines, row, x, intensities),
            (true, false, true) => narrow_run(lines, row, x, intensities),
            (true, false, false) => narrow_run_long(lines, row, x, intensities),
        }
    }
}

// Each compiled for the vector widths named, the first that the machine has chosen at run time. Integers give the same
// bits in all of them. `long` are those whose division needs as wide a lane as their products.

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn half_run(lines: Lines, row: &Row, x: i64, intensities: &mut [i64]) {
    lines.run::<Half, i32>(row, x, intensities);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn half_run_long(lines: Lines, row: &Row, x: i64, intensities: &mut [i64]) {
    lines.run::<Half, i64>(row, x, intensities);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn narrow_run(lines: Lines, row: &Row, x: i64, intensities: &mut [i64]) {
    lines.run::<i64, i32>(row, x, intensities);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn narrow_run_long(lines: Lines, row: &Row, x: i64, intensities: &mut [i64]) {
    lines.run::<i64, i64>(row, x, intensities);
}

/// What is known of the lines when a loop over them is compiled.
pub(super) trait Known {
    /// The same lines, with what is known of them as constants.
    fn lines(lines: Lines) -> Lines;
}

/// Nothing is known: the lines are evaluated as they are, whatever the configuration.
pub(super) struct Anything;

/// Every line rounds to the nearest, a tie up (otherwise down), and is plain, in the centred form, which subtracts
/// (otherwise in the power form).
pub(super) struct Plain<const NEAREST: bool, const SUBTRACT: bool>;

impl Known for Anything {
    #[inline(always)]
    fn lines(lines: Lines) -> Lines {
        lines
    }
}

impl<const NEAREST: bool, const SUBTRACT: bool> Known for Plain<NEAREST, SUBTRACT> {
    #[inline(always)]
    fn lines(lines: Lines) -> Lines {
        let mode = if NEAREST { Rounding::NearestUp } else { Rounding::Floor };
        let Lines { front_end, stages, divider, .. } = lines;
        Lines {
            front_end: front_end.known_plain(SUBTRACT, mode),
            stages: stages
                .map(|stages| stages.map(|stage| stage.rounded_by(mode).known_plain(SUBTRACT))),
            divider: divider.map(|divider| divider.rounded_by(mode)),
            ..lines
        }
    }
}

impl Lines {
    /// The mode of every line, and whether they are of the centred form, where they have one in common and are
    /// plain.
    pub(super) fn plainly_rounded(&self) -> Option<(Rounding, bool)> {
        let mode = self.rounding()?;
        let plain = |centred: &bool| {
            let alike = |stage: &MultiplyAdd| stage.is_plain() && stage.subtracts() == *centred;
            self.front_end.is_plain(*centred) && self.stages.iter().flatten().all(alike)
        };
        [true, false].into_iter().find(plain).map(|centred| (mode, centred))
    }

    /// A run, products in lanes `L` and divisions in lanes `D`.
    #[inline(always)]
    fn run<L: Lane, D: Lane>(&self, row: &Row, x: i64, intensities: &mut [i64]) {
        match self.plainly_rounded() {
            Some((Rounding::NearestUp, true)) => {
                self.pieces::<L, D, Plain<true, true>>(row, x, intensities);
            }
            Some((Rounding::NearestUp, false)) => {
                self.pieces::<L, D, Plain<true, false>>(row, x, intensities);
            }
            Some((Rounding::Floor, true)) => {
                self.pieces::<L, D, Plain<false, true>>(row, x, intensities);
            }
            Some((Rounding::Floor, false)) => {
                self.pieces::<L, D, Plain<false, false>>(row, x, intensities);
            }
            _ => self.pieces::<L, D, Anything>(row, x, intensities),
        }
    }

    #[inline(always)]
    fn pieces<L: Lane, D: Lane, K: Known>(&self, row: &Row, mut x: i64, mut rest: &mut [i64]) {
        let end = self.front_end.greatest + 1;
        let (cut, hand_over) = (self.front_end.cut(row), self.front_end.hand_over(row));
        for until in [0, cut.min(end), hand_over.min(end), end, i64::MAX] {
            let count = usize::try_from(until.saturating_sub(x)).unwrap_or(0).min(rest.len());
            let (piece, others) = rest.split_at_mut(count);
            if !piece.is_empty() {
                self.piece::<L, D, K>(row, x, piece);
            }
            (x, rest) = (x + count as i64, others);
        }
    }

    /// A piece in which one part answers for every x.
    #[inline(always)]
    fn piece<L: Lane, D: Lane, K: Known>(&self, row: &Row, x: i64, piece: &mut [i64]) {
        let region = self.front_end.region(x, self.front_end.cut(row));
        // Above the greatest x all are taken as it.
        let above = x > self.front_end.greatest;
        let computed = if above { 1 } else { piece.len() };
        let (computed, same) = piece.split_at_mut(computed);
        match region {
            Region::Zero => computed.fill(0),
            Region::Polynomial => self.polynomial_piece::<L, K>(row, x, computed),
            Region::Tail => self.tail_piece::<L, D, K>(row, x, computed),
        }
        same.fill(computed[0]);
    }

    #[inline(always)]
    fn polynomial_piece<L: Lane, K: Known>(&self, row: &Row, first: i64, piece: &mut [i64]) {
        // Copies: a loop that writes must not have to read these again.
        let Self { front_end, stages: Some([stage1, stage2, stage3]), output_one, .. } =
            K::lines(*self)
        else {
            return;
        };
        // One segment answers for all of the piece: see `pieces`.
        let clamped = front_end.clamp_input(L::from_bits(first));
        let hand_over = L::from_bits(front_end.hand_over(row));
        let Segment { start, shift, c: [c0, c1, c2, c3] } =
            if front_end.is_outer(clamped, Region::Polynomial, hand_over) {
                Segment::outer(row, hand_over)
            } else {
                Segment::first(row, L::from_bits(front_end.one))
            };
        let one = L::from_bits(output_one);
        for (index, intensity) in piece.iter_mut().enumerate() {
            let x = front_end.clamp_input(L::from_bits(first + index as i64));
            let v = front_end.variable(x, Region::Polynomial, start, shift);
            let t1 = stage1.apply(c3, v, c2);
            let t2 = stage2.apply(t1, v, c1);
            let t3 = stage3.apply(t2, v, c0);
            *intensity = clamp(t3, one).to_bits();
        }
    }

    #[inline(always)]
    fn tail_piece<L: Lane, D: Lane, K: Known>(&self, row: &Row, first: i64, piece: &mut [i64]) {
        let Self { front_end, divider: Some(divider), output_one, .. } = K::lines(*self) else {
            return;
        };
        let a = L::from_bits(row.get(FieldName::TailA));
        let b = L::from_bits(row.get(FieldName::TailB));
        let one = D::from_bits(output_one);
        let mut divisors = [D::ONE; DIVISIONS];
        let mut remainders = [D::ZERO; DIVISIONS];
        let mut digits = [D::ZERO; DIVISIONS];
        for (first, chunk) in (first..).step_by(DIVISIONS).zip(piece.chunks_mut(DIVISIONS)) {
            let lanes = divisors.iter_mut().zip(&mut remainders).zip(&mut digits);
            for (x, ((divisor, remainder), digits)) in (first..).zip(lanes).take(chunk.len()) {
                let x = front_end.clamp_input(L::from_bits(x));
                let begun = divider.begin(x, a, b);
                *divisor = D::from_bits(begun.divisor.to_bits());
                *remainder = D::from_bits(begun.remainder.to_bits());
                *digits = D::from_bits(begun.digits.to_bits());
            }
            for _ in 0..divider.digit_count {
                divider.digit_of_all(&divisors, &mut remainders, &mut digits);
            }
            let lanes = divisors.iter().zip(&remainders).zip(&digits);
            for (intensity, ((&divisor, &remainder), &digits)) in chunk.iter_mut().zip(lanes) {
                let division = Division { divisor, remainder, digits };
                *intensity = divider.finish(division, one).to_bits();
            }
        }
    }
}
