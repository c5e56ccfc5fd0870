//! What is asked of the search.

use hw_model::clock::Clock;
use hw_model::exponents::Exponents;
use hw_model::format::QFormat;

/// Over which x the error is to be kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Over {
    /// All of [0, 1].
    All,
    /// Where x^n is at least this, above 0 and below 1.
    Level(f64),
}

impl Over {
    /// The least x^n of the range; none where the range is all of [0, 1].
    pub(super) const fn level(self) -> Option<f64> {
        match self {
            Self::All => None,
            Self::Level(level) => Some(level),
        }
    }
}

/// What is to be built.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The ROM's exponents.
    pub exponents: Exponents,
    /// Format of x.
    pub input: QFormat,
    /// Format of the intensity.
    pub output: QFormat,
    /// The greatest error allowed, as a fraction of full intensity.
    pub error: f64,
    /// Over which x.
    pub over: Over,
    /// How many designs are narrowed.
    pub finalists: usize,
    /// A clock that the design reaches, by as many ranks of registers as that takes.
    pub clock: Option<Clock>,
}

impl Request {
    /// What the configuration is called, after what is asked: `designed_UQ1p10_UQ1p10_0p01`. Names of files have no
    /// point.
    pub(super) fn name(&self) -> String {
        format!("designed_{}_{}_{}", self.input, self.output, self.error).replace('.', "p")
    }
}
