//! Where a certificate is wrong, and in what.

use thiserror::Error;

/// A field that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{field}: {problem}")]
pub struct Fault {
    /// Such as `claims[0] (hermite, n = 4, epicentre), absolute.upper`.
    pub field: String,
    /// What is wrong.
    pub problem: String,
}

impl Fault {
    pub(super) fn new(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self { field: field.into(), problem: problem.into() }
    }

    pub(super) fn within(self, place: &str) -> Self {
        Self { field: format!("{place}{}", self.field), ..self }
    }
}
