//! The bound of a configuration as bits, by exhaustion: every representable x in [0, 1] of every ROM row.
//!
//! What is claimed of a configuration. `hardware_check.rs` goes through every x again; who finds the claim is not known
//! here.

use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::fit::FitError;
use hw_model::highlight::{ExactPower, phong};
use serde::{Deserialize, Serialize};
use thiserror::Error;
use vectors::limits::{Sweep, TooManyInputs, inputs};

use crate::interval::Interval;

/// x and intensity of at most this many bits are f64, exactly.
const EXACT_BITS: u32 = 53;

/// The greatest error of a row over some x.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Worst {
    /// Not more than the greatest error: the error at `x`, rounded down.
    pub lower: f64,
    /// Not less than the greatest error.
    pub upper: f64,
    /// Where, as bits of the input.
    pub x: i64,
    /// What the hardware answers there, as bits of the output.
    pub output: i64,
}

/// The bounds of one ROM row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HardwareRow {
    /// The exponent of the row.
    pub n: f64,
    /// The least x of the epicentre, as bits of the input.
    pub epicentre_from: i64,
    /// The greatest error over the epicentre.
    pub epicentre: Worst,
    /// Over all of [0, 1].
    pub full_range: Worst,
}

/// The greatest error of all rows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Overall {
    /// The exponent of the row that has it (the first one).
    pub n: f64,
    /// The lower bound of its greatest error, as a fraction of full intensity.
    pub lower: f64,
    /// The upper bound of its greatest error, as a fraction of full intensity.
    pub upper: f64,
}

/// The bound of a configuration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HardwareClaim {
    /// The whole configuration: hardware follows from it, bit for bit.
    pub configuration: Config,
    /// Points, all rows together.
    pub points: u64,
    /// The greatest error over the epicentres of all rows.
    pub epicentre: Overall,
    /// Over all of [0, 1].
    pub full_range: Overall,
    /// In the order of the addresses.
    pub rows: Vec<HardwareRow>,
}

/// Why a configuration has no certificate.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum HardwareError {
    /// Its numbers are no f64.
    #[error("a certificate takes formats of at most {EXACT_BITS} fraction bits; {what} has {bits}")]
    TooFine {
        /// The port that is too fine: `input` or `output`.
        what: &'static str,
        /// The fraction bits of its format.
        bits: u32,
    },
    /// Exhaustion would take too long.
    #[error(transparent)]
    TooMany(#[from] TooManyInputs),
    /// A method has no epicentre for one of the exponents.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// There is no row.
    #[error("there is no exponent to certify")]
    NoRow,
}

/// The number of points that certifying the configuration takes, and checking it again.
///
/// # Errors
/// When there can be no certificate.
pub fn points(design: &Design) -> Result<u64, HardwareError> {
    let config = design.config();
    for (what, format) in [("input", config.input), ("output", config.output)] {
        let bits = format.fraction_bits();
        if bits > EXACT_BITS {
            return Err(HardwareError::TooFine { what, bits });
        }
    }
    Ok(Sweep::Certify.within(inputs(design), config.input)?)
}

/// The row with the greatest upper bound, the first one where several have it.
#[must_use]
pub fn overall(rows: &[HardwareRow], of: fn(&HardwareRow) -> Worst) -> Option<Overall> {
    let worst = rows.iter().reduce(|most, row| if of(row).upper > of(most).upper { row } else { most });
    worst.map(|row| Overall { n: row.n, lower: of(row).lower, upper: of(row).upper })
}

/// x^n for x in bits of the input: the neighbours of the correctly rounded power.
pub(super) fn power(design: &Design, n: f64, x: i64) -> Interval {
    let power = phong(n, x as f64 * design.config().input.ulp());
    Interval::new(power.next_down().max(0.0), power.next_up())
}

/// x^n as a ratio of integers, where that is possible.
pub(super) fn exact_power(design: &Design, n: f64, x: i64) -> Option<ExactPower> {
    let integer = n.fract() == 0.0 && n <= f64::from(u32::MAX);
    let exponent = integer.then_some(n as u32)?;
    ExactPower::new(u64::try_from(x).ok()?, design.config().input.fraction_bits(), exponent).ok()
}

/// |output − x^n| rounded down: exactly for an integer n of moderate size, else in intervals. x and output are bits of
/// the formats that the design has.
#[must_use]
pub fn least_error(design: &Design, n: f64, x: i64, output: i64) -> f64 {
    let format = design.config().output;
    if let Some(exact) = exact_power(design, n, x) {
        return exact.error_of_bits(output, format.fraction_bits()).abs().next_down().max(0.0);
    }
    (Interval::exactly(output as f64 * format.ulp()) - power(design, n, x)).least_magnitude()
}

impl HardwareClaim {
    pub(super) fn statement(&self) -> String {
        let Self { configuration, points, epicentre, full_range, rows } = self;
        format!(
            "Over all {points} points (every x in [0, 1] of the input format {}, every one of {} \
             exponents), the output bits of the configuration differ from the real x^n by at most {} \
             where x^n >= {}, and by at most {} on all of [0, 1]. By exhaustion, against correctly \
             rounded x^n, whose own error of at most 2^-54 is within the bound.",
            configuration.input,
            rows.len(),
            epicentre.upper,
            configuration.q,
            full_range.upper
        )
    }
}
