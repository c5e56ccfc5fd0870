//! x^n of a case, and what the golden model answers.

use hw_model::datapath::Datapath;
use hw_model::format::QFormat;
use hw_model::highlight::{phong, phong_at_s};
use hw_model::quantise::real;

use crate::case::Case;

/// x^n at the bits `x`, with x clamped to [0, 1] as the pipeline clamps it.
///
/// In the upper half x is taken through 1 − x, which is an f64 there where x itself, of up to 63
/// bits, need not be.
#[must_use]
pub fn reference(exponent: f64, x: i64, format: QFormat) -> f64 {
    let x = x.clamp(0, format.one());
    if x > format.one() / 2 {
        phong_at_s(exponent, real(format.one() - x, format))
    } else {
        phong(exponent, real(x, format))
    }
}

/// What the output ports show for a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Expected {
    /// The intensity, in the unit of the output format.
    pub intensity: i64,
    /// The status flags, as [`hw_model::datapath::Status::bits`].
    pub status: u8,
}

impl Expected {
    /// The golden model's answer.
    #[must_use]
    pub fn of(datapath: &Datapath, case: Case) -> Self {
        let last = datapath.evaluate(case.address, case.x);
        Self { intensity: last.intensity, status: last.status.bits() }
    }
}
