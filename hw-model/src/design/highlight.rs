//! The front door: highlights of a design, as real numbers and as bits.

use thiserror::Error;

use super::error::DesignError;
use super::whole::Design;
use crate::format::{DoesNotFit, Overflow};
use crate::presets;
use crate::quantise::{QuantiseError, real, x_bits};

/// Why a design has no highlight for an n and an x.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum HighlightError {
    /// The ROM has no word for the exponent.
    #[error("the ROM has no word for n = {exponent}; it has {available}")]
    Exponent {
        /// n.
        exponent: f64,
        /// The exponents of the ROM, as they are written.
        available: String,
    },
    /// x is NaN or infinite.
    #[error("x: {0}")]
    X(QuantiseError),
}

impl Design {
    /// The design of a preset.
    ///
    /// # Errors
    /// When there is no preset of this name.
    pub fn preset(name: &str) -> Result<Self, DesignError> {
        let preset = presets::find(name).ok_or_else(|| DesignError::NoPreset { name: name.to_owned() })?;
        Self::new(preset.config()?)
    }

    /// The intensity, in [0, 1], that the hardware answers to the exponent n and x = cos γ.
    ///
    /// x is rounded to the input format, and brought to its ends where it lies outside; above 1 the hardware takes it
    /// as 1, and below 0 it answers 0.
    ///
    /// # Errors
    /// When the ROM has no word for n, or x is not finite.
    pub fn highlight(&self, n: f64, x: f64) -> Result<f64, HighlightError> {
        let exponents = self.rom().exponents();
        let address = exponents
            .position(n)
            .ok_or_else(|| HighlightError::Exponent { exponent: n, available: exponents.to_string() })?;
        let x = x_bits(x, self.config.input, Overflow::Saturate).map_err(HighlightError::X)?;
        Ok(real(self.datapath.evaluate(address as u32, x).intensity, self.config.output))
    }

    /// The same bit for bit: the word on the port `intensity` for those on the ports `address` and `x`. An address
    /// without a ROM word gives 0; [`Datapath::evaluate`](crate::datapath::Datapath::evaluate) tells that and all else
    /// that the hardware knows.
    ///
    /// # Errors
    /// When the input format does not hold the bits of x.
    pub fn intensity_bits(&self, address: u32, x_bits: i64) -> Result<i64, DoesNotFit> {
        let x = self.config.input.fit(x_bits.into(), Overflow::Refuse)?;
        Ok(self.datapath.evaluate(address, x).intensity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn real_numbers_and_bits_are_the_same_highlight() {
        for preset in presets::ALL {
            let design = Design::preset(preset.name).unwrap();
            let (input, output) = (design.config().input, design.config().output);
            for (address, n) in design.rom().exponents().iter().enumerate().step_by(15) {
                for x in [-0.5, 0.0, 0.7, 0.99, 1.0 - input.ulp(), 1.0, 1.5, 1e9] {
                    let bits = x_bits(x, input, Overflow::Saturate).unwrap();
                    let word = design.intensity_bits(address as u32, bits).unwrap();
                    assert_eq!(design.highlight(n, x), Ok(real(word, output)), "{n} {x}");
                }
            }
        }
    }

    #[test]
    fn what_has_no_highlight_is_refused() {
        let design = Design::preset("compact").unwrap();
        let error = design.highlight(2.5, 0.5).unwrap_err();
        assert_eq!(error.to_string(), "the ROM has no word for n = 2.5; it has 1..=256");
        assert!(matches!(design.highlight(64.0, f64::NAN), Err(HighlightError::X(_))));
        assert!(design.intensity_bits(63, 1 << 24).is_err());
        assert!(design.intensity_bits(63, -1).is_err());
        assert_eq!(design.intensity_bits(u32::MAX, 1 << 23), Ok(0));
        let error = Design::preset("shiny").unwrap_err();
        assert!(error.to_string().contains("\"shiny\"") && error.to_string().contains("compact"));
    }
}
