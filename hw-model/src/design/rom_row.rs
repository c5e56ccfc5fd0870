//! The functions one ROM row stands for: the polynomial and the ratio with the ROM's own integers.
//!
//! They tell coefficient quantisation (against the real row) from data-path rounding (against the
//! integers of the pipeline). The polynomial is kept around x = 1, where it does not cancel: for the
//! power form the coefficients of s are exact integer sums of the ROM's, so that evaluating them in
//! f64 is good to a few 2^−53, also where a, b and c are in the ten thousands and their sum is 1.

use crate::config::Form;
use crate::datapath::formats::PolynomialFormats;
use crate::fit::minimax::binomial;
use crate::highlight::{Rational, Segment};
use crate::quantise::real;
use crate::registers::{MAX_DEGREE, Register};
use crate::rom::Row;

use super::whole::Design;

/// One ROM row as real functions.
#[derive(Debug, Clone, PartialEq)]
pub struct RomRow {
    /// From x = 1 downwards, each clamped to [0, 1].
    segments: Vec<Segment>,
    tail: Option<Rational>,
}

impl Design {
    /// The functions of the ROM row at `address`; of the first row where there is none.
    #[must_use]
    pub fn rom_row(&self, address: u32) -> RomRow {
        let row = self.datapath.row(address);
        let formats = self.datapath.formats();
        let segments = formats.polynomial.iter().flat_map(|polynomial| {
            (0..self.datapath.segment_count()).map(|index| match self.config.form {
                Form::Centred => {
                    let start = formats
                        .hand_over
                        .filter(|_| index > 0)
                        .map_or(0.0, |format| 1.0 - real(row.get(Register::HandOver(index)), format));
                    Segment { start, c: centred(&row, index, polynomial) }
                }
                Form::Power => Segment { start: 0.0, c: around_one(&row, polynomial) },
            })
        });
        let tail = formats.tail.as_ref().map(|formats| {
            let a = real(row.get(Register::TailA), formats.a);
            let b = real(row.get(Register::TailB), formats.b);
            // Both are multiples of one power of two and have few bits: the difference is exact.
            Rational { a, b, at_one: a - b }
        });
        RomRow { segments: segments.collect(), tail }
    }
}

impl RomRow {
    /// A segment, 0 for the first, where the row has it: not clamped.
    #[must_use]
    pub fn segment(&self, index: usize) -> Option<Segment> {
        self.segments.get(index).copied()
    }

    /// The value at x = 1 − s, through the polynomials or through what answers below the cut.
    #[must_use]
    #[inline]
    pub fn value_at_s(&self, s: f64, above_cut: bool) -> f64 {
        match (self.segments.split_first(), &self.tail) {
            (Some((first, further)), _) if above_cut => {
                further.iter().rev().find(|segment| s > segment.start).unwrap_or(first).value_at_s(s).clamp(0.0, 1.0)
            }
            (_, Some(tail)) => tail.value_at_s(s).min(1.0),
            _ => 0.0,
        }
    }
}

/// The integer of c_i of a segment as a real number times 2^scale.
fn scaled(row: &Row, register: Register, scale: f64) -> f64 {
    row.get(register) as f64 * scale.exp2()
}

/// c_i·v^i = (c_i·2^ie)·s^i: a change of exponent, exact.
fn centred(row: &Row, segment: usize, formats: &PolynomialFormats) -> [f64; MAX_DEGREE + 1] {
    let mut c = [0.0; MAX_DEGREE + 1];
    for (power, (c, format)) in c.iter_mut().zip(formats.coefficients()).enumerate() {
        let moved = f64::from(power as u32 * row.shift(segment));
        let scale = moved - f64::from(format.fraction_bits());
        *c = scaled(row, Register::C(segment, power), scale);
    }
    c
}

/// Σ c_i·x^i at x = 1 − s, in integers of the finest fraction: h_j = Σ (i over j)·c_i over i ≥ j, of (−s)^j. 63-bit
/// coefficients moved up by at most 63 places and summed with weights up to 6 could pass 127 bits; such a row is summed
/// in f64, whose error it cannot show.
fn around_one(row: &Row, formats: &PolynomialFormats) -> [f64; MAX_DEGREE + 1] {
    let fractions: Vec<u32> = formats.coefficients().iter().map(|f| f.fraction_bits()).collect();
    let finest = fractions.iter().copied().max().unwrap_or(0);
    let degree = formats.degree();
    let exact = fractions.iter().all(|fraction| finest - fraction <= 60);
    let mut h = [0.0; MAX_DEGREE + 1];
    for (j, h) in h.iter_mut().enumerate().take(degree + 1) {
        // The highest power first.
        let powers = (j..=degree).rev().map(|i| (i, Register::C(0, i), binomial(i, j)));
        *h = if exact {
            let terms = powers.map(|(i, register, weight)| {
                i128::from(weight) * (i128::from(row.get(register)) << (finest - fractions[i]))
            });
            terms.sum::<i128>() as f64 * (-f64::from(finest)).exp2()
        } else {
            powers
                .map(|(i, register, weight)| f64::from(weight) * scaled(row, register, -f64::from(fractions[i])))
                .sum()
        };
    }
    h
}
