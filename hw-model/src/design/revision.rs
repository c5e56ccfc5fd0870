//! The same polynomials in other widths. Their ends are those that the widths of cut and hand-over can say.
//!
//! Rows are what takes time to fit, and a search tries thousands of widths and integers.

use crate::config::StatedWidths;
use crate::exponents::Exponents;
use crate::rounding::Rounding;
use crate::steps::CoefficientSteps;

use super::{Design, DesignError};

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
        let row = self.fitted.get(address as usize).copied();
        let exponent = row.map_or(f64::NAN, |row| row.exponent);
        revision.coefficient_steps.retain(|steps| steps.n == exponent);
        let mut config = self.config.clone();
        config.exponents = Exponents::new(vec![exponent]).map_err(|source| {
            crate::config::ConfigError::Field { field: "exponents", problem: source.to_string() }
        })?;
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
        if let Some(polynomial) = &formats.polynomial {
            let [c0, c1, c2, c3] = polynomial.coefficients.map(Some);
            let u = self.is_centred().then_some(polynomial.v);
            let (t1, t2) = (Some(polynomial.t1), Some(polynomial.t2));
            // With a domain the register holds its least x, and what is stated is not its format.
            let whole = self.config.domain.is_empty();
            let cut = if whole { formats.cut } else { self.config.widths.cut };
            let hand_over = formats.hand_over;
            widths = StatedWidths { u, c3, c2, c1, c0, t1, t2, cut, hand_over, ..widths };
        }
        if let Some(tail) = &formats.tail {
            let [tail_a, tail_b, divisor] = [tail.a, tail.b, tail.divisor].map(Some);
            widths = StatedWidths { tail_a, tail_b, divisor, ..widths };
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
