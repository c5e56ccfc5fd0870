//! Why a certificate of specialised hardware does not hold.

use bounds::seal::{BrokenSeal, Unreadable};
use hw_model::config::ConfigError;
use hw_model::design::DesignError;
use thiserror::Error;
use vectors::limits::TooManyInputs;

/// Why a certificate does not hold.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Refused {
    /// It cannot be read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// It is not as it was sealed.
    #[error(transparent)]
    Seal(#[from] BrokenSeal),
    /// One of the configurations.
    #[error("configuration: {0}")]
    Config(#[from] ConfigError),
    /// One of the configurations has no hardware.
    #[error("configuration: {0}")]
    Design(#[from] DesignError),
    /// More x than are gone through.
    #[error(transparent)]
    TooMany(#[from] TooManyInputs),
    /// An exponent that one of the two has not, or another domain than the configuration's.
    #[error("parts[{index}], n = {n}: {problem}")]
    Part {
        /// Its place.
        index: usize,
        /// n.
        n: f64,
        /// What is wrong.
        problem: String,
    },
    /// It is about something else than what the user asked about.
    #[error("{field}: the certificate is about {said}, and {asked} was asked about")]
    Asked {
        /// Which field.
        field: &'static str,
        /// What stands there.
        said: String,
        /// What the user gave.
        asked: String,
    },
    /// A field says what cannot be.
    #[error("{field}: {problem}")]
    Field {
        /// Which field.
        field: String,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// Going through every x again finds something else.
    #[error("{field}: the certificate says {said}, and every x says {found}")]
    Found {
        /// Which field.
        field: String,
        /// What stands there.
        said: String,
        /// What is so.
        found: String,
    },
}
