//! Where x^n crosses a level, computed so that neither x nor 1 − x loses digits.

use super::double_double::DoubleDouble;
use super::error::{FitError, checked};

/// The point of [0, 1] at which x^n has a given value. x + s = 1, each rounded from the real number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// x = level^(1/n), between 0 and 1.
    pub x: f64,
    /// s = 1 − x, correct to the last digits however close x is to 1.
    pub s: f64,
}

/// The same in 32 digits, with what the fits derive from it.
#[derive(Debug, Clone, Copy)]
pub(super) struct WideCrossing {
    /// ln(level), the negative logarithm of a level below 1.
    pub log: DoubleDouble,
    /// x = level^(1/n), between 0 and 1.
    pub x: DoubleDouble,
    /// s = 1 − x = −expm1(ln(level)/n), of size 1/n.
    pub s: DoubleDouble,
    /// level/x = x^(n − 1).
    pub ratio: DoubleDouble,
    /// 1 − level/x = −expm1(ln(level)·(n − 1)/n), which vanishes with n − 1.
    pub shortfall: DoubleDouble,
}

impl WideCrossing {
    pub fn new(exponent: f64, level: f64) -> Self {
        let n = DoubleDouble::from(exponent);
        let log = DoubleDouble::ln(level);
        let log_x = log / n;
        let log_ratio = log * less_one(exponent) / n;
        Self { log, x: log_x.exp(), s: -log_x.exp_m1(), ratio: log_ratio.exp(), shortfall: -log_ratio.exp_m1() }
    }

    pub fn rounded(&self) -> Crossing {
        Crossing { x: self.x.to_f64(), s: self.s.to_f64() }
    }
}

/// Where x^n crosses `level`, 0 < level ≤ 1: x = level^(1/n), and s = 1 − x without cancellation.
///
/// # Errors
/// When the exponent is outside 1..=[`MAX_EXPONENT`](crate::exponents::MAX_EXPONENT), or the level is not above 0 (subnormal numbers
/// included) and at most 1.
pub fn crossing(exponent: f64, level: f64) -> Result<Crossing, FitError> {
    let exponent = checked(exponent)?;
    if !(f64::MIN_POSITIVE..=1.0).contains(&level) {
        return Err(FitError::Level(level));
    }
    Ok(WideCrossing::new(exponent, level).rounded())
}

/// n − 1, exactly.
pub(super) fn less_one(exponent: f64) -> DoubleDouble {
    DoubleDouble::from(exponent) - DoubleDouble::ONE
}
