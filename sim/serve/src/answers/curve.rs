//! The highlight of one exponent over x: hardware, x^n, and what lies between.

use hw_model::datapath::Datapath;
use hw_model::design::HighlightError;
use hw_model::fit::crossing;
use hw_model::format::Overflow;
use hw_model::quantise::x_bits;
use serde::{Deserialize, Serialize};
use vectors::evaluate::{Answer, Question};
use vectors::limits::MOST_SERVED_POINTS;
use vectors::stimulus_file::exponent;

use crate::configuration::Configuration;
use crate::known::Known;
use crate::refusal::Refusal;

/// Which curve.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CurveAsk {
    /// Of which hardware.
    pub(crate) configuration: Configuration,
    n: String,
    span: Span,
}

/// Which x.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Span {
    /// From 0 to 1.
    All,
    /// Where x^n is at least [`FAINT`].
    Highlight,
}

/// The level of x^n at which a highlight can hardly be seen any more.
const FAINT: f64 = 1.0 / 256.0;

/// The curve, point by point in rising x.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Curve {
    x: Vec<f64>,
    intensity: Vec<f64>,
    reference: Vec<f64>,
    error_ulp: Vec<f64>,
    /// Which part of the pipeline answers.
    region: Vec<&'static str>,
}

impl Curve {
    /// Asks the data path at evenly spaced x.
    ///
    /// # Errors
    /// When the ROM has no word for n.
    pub(crate) fn of(known: &Known, ask: &CurveAsk) -> Result<Self, Refusal> {
        let datapath = known.datapath();
        let n = exponent(ask.n.trim()).map_err(|problem| Refusal::unusable(format!("n: {problem}")))?;
        let exponents = datapath.rom().exponents();
        let none = || Refusal::unusable(HighlightError::Exponent { exponent: n, available: exponents.to_string() });
        let address = exponents.position(n).ok_or_else(none)? as u32;
        let greatest = datapath.front_end().greatest;
        let from = match ask.span {
            Span::All => 0,
            Span::Highlight => {
                let faint = crossing(n, FAINT).map_err(Refusal::unusable)?;
                x_bits(faint.x, datapath.formats().input, Overflow::Saturate).map_err(Refusal::own)?.min(greatest)
            }
        };
        let mut curve = Self::default();
        for x in spread(from, greatest) {
            curve.push(datapath, &Answer::of(datapath, Question::at(datapath.rom(), address, x)));
        }
        Ok(curve)
    }

    fn push(&mut self, datapath: &Datapath, answer: &Answer) {
        let reference = answer.reference(datapath).unwrap_or(f64::NAN);
        self.x.push(answer.x(datapath));
        self.intensity.push(answer.value(datapath));
        self.reference.push(reference);
        self.error_ulp.push(answer.error_ulp(datapath, reference));
        self.region.push(answer.region.name());
    }
}

/// Evenly spaced integers, both ends among them, and none twice.
fn spread(from: i64, to: i64) -> impl Iterator<Item = i64> {
    let steps = (to - from).clamp(1, MOST_SERVED_POINTS as i64 - 1);
    (0..=steps).map(move |step| from + (i128::from(to - from) * i128::from(step) / i128::from(steps)) as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_rise_from_end_to_end() {
        for (from, to, count) in [(0, 8_388_608, MOST_SERVED_POINTS), (10, 14, 5), (i64::MAX - 2, i64::MAX, 3)] {
            let points: Vec<i64> = spread(from, to).collect();
            assert_eq!((points[0], points[points.len() - 1], points.len()), (from, to, count));
            assert!(points.is_sorted_by(|a, b| a < b));
        }
    }
}
