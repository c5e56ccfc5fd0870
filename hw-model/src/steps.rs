//! Corrections of single ROM integers.
//!
//! The real coefficients are rounded to their formats one by one, and a row's integers are then not the best
//! ones together, least of all through lines that round as well. A search over the neighbouring integers
//! says by how many units of its format a coefficient is moved; the configuration carries it.

use serde::{Deserialize, Serialize};

use crate::config::{Config, ConfigError};
use crate::fit::Method;
use crate::rom::FieldName;

/// The farthest a coefficient is moved either way. Beyond it is no correction.
pub const MOST_STEPS: i32 = 1 << 16;

/// The steps of one exponent, in units of the last place of each field.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CoefficientSteps {
    /// The exponent of the row, one of the configuration's.
    pub n: f64,
    /// Of c3.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub c3: i32,
    /// Of c2.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub c2: i32,
    /// Of c1.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub c1: i32,
    /// Of c0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub c0: i32,
    /// Of c3 of the second segment.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub c3_outer: i32,
    /// Of c2 of the second segment.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub c2_outer: i32,
    /// Of c1 of the second segment.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub c1_outer: i32,
    /// Of c0 of the second segment.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub c0_outer: i32,
}

// serde hands over a reference.
#[allow(clippy::trivially_copy_pass_by_ref)]
const fn is_zero(steps: &i32) -> bool {
    *steps == 0
}

impl CoefficientSteps {
    /// No steps for this exponent.
    #[must_use]
    pub fn none(n: f64) -> Self {
        Self { n, ..Self::default() }
    }

    /// Of c0, c1, c2, c3 of the first segment.
    #[must_use]
    pub const fn first(&self) -> [i32; 4] {
        [self.c0, self.c1, self.c2, self.c3]
    }

    /// The same of the second.
    #[must_use]
    pub const fn outer(&self) -> [i32; 4] {
        [self.c0_outer, self.c1_outer, self.c2_outer, self.c3_outer]
    }

    /// With these steps of c0, c1, c2, c3 of the first segment, or of the second.
    #[must_use]
    pub const fn with(self, outer: bool, [c0, c1, c2, c3]: [i32; 4]) -> Self {
        if outer {
            Self { c0_outer: c0, c1_outer: c1, c2_outer: c2, c3_outer: c3, ..self }
        } else {
            Self { c0, c1, c2, c3, ..self }
        }
    }

    /// True where nothing is moved.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::none(self.n)
    }

    /// Every field that is moved, with its steps.
    pub fn moved(&self) -> impl Iterator<Item = (FieldName, i32)> {
        let first = FieldName::COEFFICIENTS.into_iter().zip(self.first());
        let outer = FieldName::OUTER_COEFFICIENTS.into_iter().zip(self.outer());
        first.chain(outer).filter(|&(_, steps)| steps != 0)
    }
}

/// Checks the steps of a configuration against its exponents, method and segments.
///
/// # Errors
/// Names the exponent and what would be right.
pub(crate) fn check(config: &Config) -> Result<(), ConfigError> {
    let steps = &config.coefficient_steps;
    let wrong = |problem: String| Err(ConfigError::Field { field: "coefficient_steps", problem });
    if !steps.is_empty() && config.method == Method::Schlick {
        return wrong("schlick has no polynomial; leave them out".to_owned());
    }
    let mut seen = vec![false; config.exponents.len()];
    for of_row in steps {
        let n = of_row.n;
        let Some(seen) = config.exponents.position(n).and_then(|at| seen.get_mut(at)) else {
            return wrong(format!("the ROM has no row for n = {n}; it has {}", config.exponents));
        };
        if std::mem::replace(seen, true) {
            return wrong(format!("n = {n} comes twice; say all of its steps at once"));
        }
        if let Some((field, steps)) =
            of_row.moved().find(|(_, steps)| steps.unsigned_abs() > MOST_STEPS.unsigned_abs())
        {
            return wrong(format!(
                "n = {n}: {steps} steps of {field} are too many; use -{MOST_STEPS} to {MOST_STEPS}"
            ));
        }
        if config.segments < 2 && of_row.outer() != [0; 4] {
            return wrong(format!(
                "n = {n}: there is no second segment; leave out the steps of its fields, or say \
                 \"segments\": 2"
            ));
        }
    }
    Ok(())
}
