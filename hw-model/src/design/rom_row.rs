//! The functions one ROM row stands for: the polynomial and the ratio with the ROM's own integers.
//!
//! They tell coefficient quantisation (against the real row) from data-path rounding (against the
//! integers of the pipeline). The polynomial is kept around x = 1, where it does not cancel: for the
//! power form the coefficients of s are exact integer sums of the ROM's, so that evaluating them in
//! f64 is good to a few 2^−53, also where a, b and c are in the ten thousands and their sum is 1.

use crate::config::Form;
use crate::format::QFormat;
use crate::highlight::{Rational, Segment};
use crate::quantise::real;
use crate::rom::{FieldName, Row};

use super::Design;

/// One ROM row as real functions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RomRow {
    /// h0 − s·(h1 − s·(h2 − s·h3)), clamped to [0, 1].
    polynomial: Option<[f64; 4]>,
    /// c0 − v·(c1 − v·(c2 − v·c3)), v = s − start, the same.
    outer: Option<Segment>,
    tail: Option<Rational>,
}

impl Design {
    /// The functions of the ROM row at `address`; of the first row where there is none.
    #[must_use]
    pub fn rom_row(&self, address: u32) -> RomRow {
        let row = self.datapath.row(address);
        let formats = self.datapath.formats();
        let polynomial = formats.polynomial.as_ref().map(|formats| {
            let formats = formats.coefficients;
            match self.config.form {
                Form::Centred => centred(&row, row.shift(), formats.map(QFormat::fraction_bits)),
                Form::Power => around_one(&row, formats.map(|format| format.fraction_bits())),
            }
        });
        let outer =
            formats.polynomial.as_ref().zip(formats.hand_over).map(|(formats, hand_over)| {
                let fractions = formats.coefficients.map(QFormat::fraction_bits);
                let start = 1.0 - real(row.get(FieldName::HandOver), hand_over);
                Segment { start, c: centred(&row.in_outer(), row.shift_outer(), fractions) }
            });
        let tail = formats.tail.as_ref().map(|formats| {
            let a = real(row.get(FieldName::TailA), formats.a);
            let b = real(row.get(FieldName::TailB), formats.b);
            // Both are multiples of one power of two and have few bits: the difference is exact.
            Rational { a, b, at_one: a - b }
        });
        RomRow { polynomial, outer, tail }
    }
}

impl RomRow {
    /// The value at x = 1 − s, through the polynomial or through what answers below the cut.
    #[must_use]
    #[inline]
    pub fn value_at_s(&self, s: f64, above_cut: bool) -> f64 {
        match (&self.polynomial, &self.tail) {
            (Some([h0, h1, h2, h3]), _) if above_cut => match &self.outer {
                Some(segment) if s > segment.start => segment.value_at_s(s),
                _ => h0 - s * (h1 - s * (h2 - s * h3)),
            }
            .clamp(0.0, 1.0),
            (_, Some(tail)) => tail.value_at_s(s).min(1.0),
            _ => 0.0,
        }
    }
}

const FIELDS: [FieldName; 4] = [FieldName::C0, FieldName::C1, FieldName::C2, FieldName::C3];

/// c_i·u^i = (c_i·2^ie)·s^i: a change of exponent, exact.
fn centred(row: &Row, shift: u32, fractions: [u32; 4]) -> [f64; 4] {
    std::array::from_fn(|power| {
        let scale = f64::from(power as u32 * shift) - f64::from(fractions[power]);
        row.get(FIELDS[power]) as f64 * scale.exp2()
    })
}

/// d + c·x + b·x² + a·x³ at x = 1 − s, in integers of the finest fraction: h0 = a + b + c + d,
/// h1 = 3a + 2b + c, h2 = 3a + b, h3 = a. 63-bit coefficients moved up by at most 63 places and summed
/// with weights up to 3 could pass 127 bits; such a row is summed in f64, whose error it cannot show.
fn around_one(row: &Row, fractions: [u32; 4]) -> [f64; 4] {
    let finest = fractions.into_iter().max().unwrap_or(0);
    let aligned = |power: usize| {
        let up = finest - fractions[power];
        let bits = i128::from(row.get(FIELDS[power]));
        (bits << up.min(60), up)
    };
    let terms: [(i128, u32); 4] = std::array::from_fn(aligned);
    let scale = (-f64::from(finest)).exp2();
    if terms.iter().all(|&(_, up)| up <= 60) {
        let [d, c, b, a] = terms.map(|(bits, _)| bits);
        return [a + b + c + d, 3 * a + 2 * b + c, 3 * a + b, a].map(|sum| sum as f64 * scale);
    }
    let [d, c, b, a]: [f64; 4] = std::array::from_fn(|power| {
        row.get(FIELDS[power]) as f64 * (-f64::from(fractions[power])).exp2()
    });
    [a + b + c + d, 3.0 * a + 2.0 * b + c, 3.0 * a + b, a]
}
