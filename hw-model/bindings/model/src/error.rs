//! What a caller can do wrong, as one type.

use hw_model::design::{DesignError, HighlightError};
use hw_model::format::DoesNotFit;
use hw_model::quantise::QuantiseError;
use thiserror::Error;
use vectors::configuration_file::ConfigurationError;

/// Why a call is refused. The sentence is that of the `blysk` command where the command refuses the same.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A preset that is none.
    #[error(transparent)]
    NoPreset(DesignError),
    /// A text or a file that is no configuration, or a file that cannot be read.
    #[error(transparent)]
    Configuration(#[from] ConfigurationError),
    /// A configuration that gives no hardware.
    #[error("{origin}: {error}")]
    Design {
        /// Where the configuration comes from.
        origin: String,
        /// Why it gives none.
        error: DesignError,
    },
    /// An exponent without a ROM word.
    #[error(transparent)]
    Exponent(HighlightError),
    /// A real x that is not finite.
    #[error("x: {0}")]
    X(QuantiseError),
    /// Bits that the input format does not hold.
    #[error("x: {0}")]
    Bits(DoesNotFit),
    /// One of several values is refused.
    #[error("sample {index}: {error}")]
    Sample {
        /// Which, counted from 0.
        index: usize,
        /// Why.
        error: Box<Self>,
    },
    /// An address that is no whole number from 0 to 2³² − 1.
    #[error("an address is a whole number from 0 to 4294967295")]
    Address,
    /// Arrays whose lengths do not go together.
    #[error("{what} has {got} elements and x has {wanted}; give as many")]
    Length {
        /// Which array.
        what: &'static str,
        /// Its length.
        got: usize,
        /// The length of x.
        wanted: usize,
    },
}

/// The kind of an [`enum@Error`], as a number that does not change from version to version.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[repr(i32)]
pub enum Code {
    /// There is no such preset.
    NoPreset = 1,
    /// The text is no configuration, or the file cannot be read.
    Configuration = 2,
    /// The configuration gives no hardware.
    Design = 3,
    /// The ROM has no word for the exponent.
    Exponent = 4,
    /// x is not finite, or its bits do not fit the input format.
    X = 5,
    /// An address is out of range, or arrays differ in length.
    Argument = 6,
}

impl Error {
    /// The kind of the error.
    #[must_use]
    pub fn code(&self) -> Code {
        match self {
            Self::NoPreset(_) => Code::NoPreset,
            Self::Configuration(_) => Code::Configuration,
            Self::Design { .. } => Code::Design,
            Self::Exponent(_) => Code::Exponent,
            Self::X(_) | Self::Bits(_) => Code::X,
            Self::Sample { error, .. } => error.code(),
            Self::Address | Self::Length { .. } => Code::Argument,
        }
    }

    /// The same error, of one of several values.
    #[must_use]
    pub fn at(self, index: usize) -> Self {
        Self::Sample { index, error: Box::new(self) }
    }
}
