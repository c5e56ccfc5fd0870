//! The same polynomials in other widths. Their ends are those that the widths of cut and hand-over can say.
//!
//! Rows are what takes time to fit, and a search tries thousands of widths and integers.

use crate::exponents::Exponents;
use crate::registers::Register;
use crate::rounding::Rounding;
use crate::steps::CoefficientSteps;
use crate::widths::{STATED, StatedWidths};

use super::error::DesignError;
use super::whole::Design;

/// What may change while the real rows stay.
#[derive(Debug, Clone, PartialEq)]
pub struct Revision {
    /// Formats stated by hand.
    pub widths: StatedWidths,
    /// The rounding of every line.
    pub rounding: Rounding,
    /// What coefficients and data path together may add to the error, in output ulp.
    pub error_budget_ulp: f64,
    /// Coefficients moved away from the nearest integers.
    pub coefficient_steps: Vec<CoefficientSteps>,
}

impl Design {
    /// What the configuration says of that.
    #[must_use]
    pub fn revision(&self) -> Revision {
        Revision {
            widths: self.config.widths,
            rounding: self.config.rounding,
            error_budget_ulp: self.config.error_budget_ulp,
            coefficient_steps: self.config.coefficient_steps.clone(),
        }
    }

    /// The design of the configuration with these changes.
    ///
    /// # Errors
    /// As [`Design::new`].
    pub fn revised(&self, revision: Revision) -> Result<Self, DesignError> {
        let mut config = self.config.clone();
        revision.put_into(&mut config);
        config.check()?;
        Self::of_rows(config, self.fitted.clone())
    }

    /// The design of one row alone, with these changes; of the steps only its own count.
    ///
    /// # Errors
    /// As [`Design::new`], or when there is no such row.
    pub fn row_alone(&self, address: u32, mut revision: Revision) -> Result<Self, DesignError> {
        let row = self.fitted.get(address as usize).cloned();
        let exponent = row.as_ref().map_or(f64::NAN, |row| row.exponent);
        revision.coefficient_steps.retain(|steps| steps.n == exponent);
        let mut config = self.config.clone();
        config.exponents = Exponents::new(vec![exponent])
            .map_err(|source| crate::config::ConfigError::Field { field: "exponents", problem: source.to_string() })?;
        config.domain.retain(|presented| presented.n == exponent);
        revision.put_into(&mut config);
        config.check()?;
        Self::of_rows(config, row.into_iter().collect())
    }

    /// The formats of every register that a configuration can state, as this design has them.
    #[must_use]
    pub fn widths(&self) -> StatedWidths {
        let formats = self.datapath.formats();
        let mut widths = StatedWidths::default();
        for (register, _) in STATED {
            widths.set(register, formats.get(register));
        }
        if let Some(polynomial) = &formats.polynomial {
            widths.set(Register::T(polynomial.degree()), None);
        }
        if !self.is_centred() {
            widths.set(Register::V, None);
        }
        // With a domain the register holds its least x, and what is stated is not its format.
        if !self.config.domain.is_empty() {
            widths.set(Register::Cut, self.config.widths[Register::Cut]);
        }
        widths
    }
}

impl Revision {
    fn put_into(self, config: &mut crate::config::Config) {
        config.widths = self.widths;
        config.rounding = self.rounding;
        config.error_budget_ulp = self.error_budget_ulp;
        config.coefficient_steps = self.coefficient_steps;
    }
}
