//! Consecutive x of one exponent: a sweep.
//!
//! x need not be stored, and needs no region of its own: between two of the places 0, cut, hand-overs and
//! greatest x one part answers for all. So each piece of the run is a loop without a choice in it, and a piece whose
//! answer is zero is filled. What is known of a configuration (its rounding mode, that its lines are
//! plain, how wide a lane they need) is settled before the loop, which is compiled for each case.

use multiversion::multiversion;

use crate::registers::{MAX_DEGREE, Register};
use crate::rom::{Fetched, Row};
use crate::rounding::{Lane, Rounding};

use super::compose::{Anything, Cubics, Known, Lines, Plain};
use super::front_end::{FrontEnd, Region};
use super::keep::{Registers, Whole};
use super::lanes::Half;
use super::parts::Datapath;

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

/// One segment of a row, as the row of one segment: it answers for every x of a piece.
struct OneSegment {
    shift: i64,
    c: [i64; MAX_DEGREE + 1],
}

impl OneSegment {
    fn of(row: &Row, segment: usize) -> Self {
        let c = std::array::from_fn(|power| row.get(Register::C(segment, power)));
        Self { shift: row.get(Register::Shift(segment)), c }
    }
}

impl Fetched for OneSegment {
    #[inline(always)]
    fn get(&self, field: Register) -> i64 {
        match field {
            Register::C(_, power) => self.c[power],
            Register::Shift(_) => self.shift,
            _ => 0,
        }
    }
    #[inline(always)]
    fn known(&self) -> bool {
        true
    }
    #[inline(always)]
    fn is_polynomial(&self) -> bool {
        true
    }
}

impl Lines {
    /// A run, products in lanes `L` and divisions in lanes `D`.
    #[inline(always)]
    fn run<L: Lane, D: Lane>(&self, row: &Row, x: i64, intensities: &mut [i64]) {
        match (self.plainly_rounded(), self.are_cubics()) {
            (Some((Rounding::NearestUp, true)), _) => {
                self.pieces::<L, D, Plain<true, true, 1>>(row, x, intensities);
            }
            (Some((Rounding::NearestUp, false)), _) => {
                self.pieces::<L, D, Plain<true, false, 1>>(row, x, intensities);
            }
            (Some((Rounding::Floor, true)), _) => {
                self.pieces::<L, D, Plain<false, true, 1>>(row, x, intensities);
            }
            (Some((Rounding::Floor, false)), _) => {
                self.pieces::<L, D, Plain<false, false, 1>>(row, x, intensities);
            }
            (_, true) => self.pieces::<L, D, Cubics>(row, x, intensities),
            (_, false) => self.pieces::<L, D, Anything>(row, x, intensities),
        }
    }

    #[inline(always)]
    fn pieces<L: Lane, D: Lane, K: Known>(&self, row: &Row, mut x: i64, mut rest: &mut [i64]) {
        let end = self.front_end.greatest + 1;
        let cut = self.front_end.cut(row);
        let starts = (1..self.front_end.segments).rev().map(|k| self.front_end.hand_over(row, k));
        let within = std::iter::once(cut).chain(starts).map(|place| place.min(end));
        for until in std::iter::once(0).chain(within).chain([end, i64::MAX]) {
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
        let index = self.front_end.segment_of(row, self.front_end.clamp_input(first));
        // Copies: a loop that writes must not have to read these again.
        let segment = OneSegment::of(row, index);
        let one = self.front_end.start(row, index);
        let front_end = FrontEnd { one, segments: 1, ..self.front_end };
        let lines = K::lines(Self { front_end, ..*self });
        for (index, intensity) in piece.iter_mut().enumerate() {
            let x = L::from_bits(first + index as i64);
            let composed = lines.compose::<L, K, Whole>(&segment, x, &Registers::WHOLE);
            *intensity = composed.intensity.to_bits();
        }
    }

    #[inline(always)]
    fn tail_piece<L: Lane, D: Lane, K: Known>(&self, row: &Row, first: i64, piece: &mut [i64]) {
        let Self { front_end, divider: Some(divider), output_one, .. } = K::lines(*self) else {
            return;
        };
        let [a, b] = [Register::TailA, Register::TailB].map(|name| L::from_bits(row.get(name)));
        for (first, chunk) in (first..).step_by(DIVISIONS).zip(piece.chunks_mut(DIVISIONS)) {
            let operands = |index: usize| [front_end.clamp_input(L::from_bits(first + index as i64)), a, b];
            let divisions = divider.divide::<L, D, Whole, DIVISIONS>(
                chunk.len(),
                operands,
                output_one,
                &Registers::WHOLE,
                |_, _| {},
            );
            for (intensity, quotient) in chunk.iter_mut().zip(divisions.quotients()) {
                *intensity = quotient.to_bits();
            }
        }
    }
}
