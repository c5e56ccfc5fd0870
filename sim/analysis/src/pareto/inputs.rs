//! The x and n at which every contender is measured.

use hw_model::exponents::Exponents;
use hw_model::fit::{FitError, Levels, crossing};
use hw_model::format::QFormat;
use hw_model::quantise::round_scaled;
use hw_model::rounding::Rounding;
use thiserror::Error;
use vectors::limits::{Sweep, TooManyInputs};

/// x with more fraction bits is no f64.
const MOST_FRACTION: u32 = 52;

/// Why inputs are refused.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InputsError {
    /// x is not an f64.
    #[error("the input {0} has more than {MOST_FRACTION} fraction bits, and its x are no f64; use fewer")]
    TooFine(QFormat),
    /// x cannot be what it must.
    #[error("the input {0} is none for x in [0, 1]; use UQ0.n, UQ1.n or Q2.n with n of 1 to {MOST_FRACTION}")]
    NotX(QFormat),
    /// More inputs than one run may go through.
    #[error(transparent)]
    TooMany(#[from] TooManyInputs),
}

/// The inputs of a comparison: every `every`-th representable x in [0, 1] from 0 on, and the last, for
/// each exponent.
#[derive(Debug, Clone, PartialEq)]
pub struct Inputs {
    /// The format of x.
    pub format: QFormat,
    /// The exponents, one ROM row or table row each.
    pub exponents: Exponents,
    /// 1 for every x.
    pub every: u64,
}

impl Inputs {
    /// Checks them.
    ///
    /// # Errors
    /// When x is no f64 or not in [0, 1], or there are too many.
    pub fn new(format: QFormat, exponents: Exponents, every: u64) -> Result<Self, InputsError> {
        if format.fraction_bits() > MOST_FRACTION {
            return Err(InputsError::TooFine(format));
        }
        if format.fraction_bits() == 0 || format.max_bits() < format.one() - 1 {
            return Err(InputsError::NotX(format));
        }
        let inputs = Self { format, exponents, every: every.max(1) };
        let count = u128::from(inputs.per_exponent()) * inputs.exponents.len() as u128;
        Sweep::Pareto.within(count, format)?;
        Ok(inputs)
    }

    /// Every representable x is seen.
    #[must_use]
    pub const fn exhaustive(&self) -> bool {
        self.every == 1
    }

    /// The greatest x, in bits.
    #[must_use]
    pub fn greatest(&self) -> i64 {
        self.format.max_bits().min(self.format.one())
    }

    /// How many x there are for each exponent.
    #[must_use]
    pub fn per_exponent(&self) -> u64 {
        (self.greatest() as u64).div_ceil(self.every) + 1
    }

    /// How many there are of all exponents.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.per_exponent().saturating_mul(self.exponents.len() as u64)
    }

    /// The x at this place, in bits; places count from 0 to [`per_exponent`](Self::per_exponent).
    #[must_use]
    pub fn x(&self, place: u64) -> i64 {
        place.saturating_mul(self.every).min(self.greatest() as u64) as i64
    }

    /// The x at this many bits.
    #[must_use]
    pub fn real(&self, bits: i64) -> f64 {
        bits as f64 * self.format.ulp()
    }

    /// For each exponent the least x with x^n ≥ Q, in bits: 1 − ⌊p⌋, p = 1 − q.
    ///
    /// # Errors
    /// When an exponent is out of range.
    pub fn epicentres(&self) -> Result<Vec<i64>, FitError> {
        let q = Levels::default().q();
        let first = |n: f64| {
            let p = crossing(n, q)?.s;
            let floor = round_scaled(p, self.format.fraction_bits(), Rounding::Floor).unwrap_or(0);
            Ok(self.format.one() - floor as i64)
        };
        self.exponents.iter().map(first).collect()
    }
}

/// Some x, in every form that a contender takes.
#[derive(Debug, Clone, Default)]
pub struct Samples {
    /// Bits in the input format.
    pub bits: Vec<i64>,
    /// The nearest f32: x itself where it has at most 24 bits.
    pub single: Vec<f32>,
    /// The x as f64, exactly.
    pub double: Vec<f64>,
}

impl Samples {
    /// Replaces the samples by these x, given as bits in the input format.
    pub fn fill(&mut self, inputs: &Inputs, bits: impl Iterator<Item = i64>) {
        self.bits.clear();
        self.bits.extend(bits);
        self.double.clear();
        self.double.extend(self.bits.iter().map(|&bits| inputs.real(bits)));
        self.single.clear();
        self.single.extend(self.double.iter().map(|&x| x as f32));
    }
}
