//! One configuration of the pipeline, as JSON.
//!
//! Every field but the first five has a default; unknown fields are refused. The presets
//! ([`crate::presets`]) are such files. A configuration that parses is complete and consistent in
//! itself ([`Config::from_json`] checks it); whether its widths can carry its values is found when
//! the [`Design`](crate::design::Design) is made.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::domain::{self, Presented};
use crate::exponents::Exponents;
use crate::fit::{Levels, Method};
use crate::format::{MAX_WIDTH, QFormat};
use crate::names;
use crate::rounding::Rounding;
use crate::steps::{self, CoefficientSteps};

/// The variable the polynomial is evaluated in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// a·x³ + b·x² + c·x + d, as printed in \[Rom\].
    Power,
    /// 1 − u(k1 − u(k2 − u·k3)), u = (1 − x)·2^e, e = ⌊log2 n⌋.
    Centred,
}

/// What answers below the cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tail {
    /// The intensity is 0.
    Zero,
    /// x / (A − B·x), by a divider.
    Rational,
}

/// Where the polynomial stops answering.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cut {
    /// At q, where the highlight has fallen to Q.
    Epicentre,
    /// At the polynomial's minimum below q, so that a zero tail makes the least jump and the
    /// polynomial never rises again (at 0 where it has none); or above it, where the polynomial has
    /// fallen to half an output ulp, which a zero shows as well; or, with
    /// `multiplier_operand_bits`, where u would reach 2.
    Minimum,
    /// Where x^n has fallen to the greatest error of the polynomial above, so that a zero below errs no more.
    /// Only for `minimax`, whose range it is.
    Balanced,
}

/// Formats stated by hand instead of derived. They are checked: a register that could overflow is
/// refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StatedWidths {
    /// u, in the centred form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub u: Option<QFormat>,
    /// Coefficient of v³.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c3: Option<QFormat>,
    /// Coefficient of v².
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c2: Option<QFormat>,
    /// Coefficient of v.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c1: Option<QFormat>,
    /// Constant coefficient.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c0: Option<QFormat>,
    /// Result of stage 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t1: Option<QFormat>,
    /// Result of stage 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t2: Option<QFormat>,
    /// The least x at which the polynomial answers, rounded down: unsigned, at most one integer bit, and no more
    /// fraction bits than x. With a domain, whose least x takes its place with all bits of x, it still says below
    /// what the domain may not begin, and which lengths the shifts are fitted to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut: Option<QFormat>,
    /// The least x at which the first of two segments answers, rounded to the nearest; a format as that of the cut.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hand_over: Option<QFormat>,
    /// A of the tail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tail_a: Option<QFormat>,
    /// B of the tail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tail_b: Option<QFormat>,
    /// Divisor of the tail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub divisor: Option<QFormat>,
}

impl StatedWidths {
    fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// One configuration: everything from which a pipeline follows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// A name for files and reports.
    pub name: String,
    /// hermite, three_point, tangent, minimax, quadratic, or schlick.
    pub method: Method,
    /// The exponents of the ROM, in the order of their addresses: `1..=256`, `1,2,8,64`.
    pub exponents: Exponents,
    /// Format of x. Signed where x may be negative; at least one integer bit where it may reach 1.
    pub input: QFormat,
    /// Format of the intensity, unsigned.
    pub output: QFormat,
    /// One sentence for people.
    #[serde(default)]
    pub description: String,
    /// Q, the level of x^n where the epicentre ends.
    #[serde(default = "default_q")]
    pub q: f64,
    /// G, the lower level of three_point.
    #[serde(default = "default_g")]
    pub g: f64,
    /// Power or centred form. (schlick has no polynomial and ignores it.)
    #[serde(default = "default_form")]
    pub form: Form,
    /// What answers below the cut.
    #[serde(default = "default_tail")]
    pub tail: Tail,
    /// Where the polynomial stops.
    #[serde(default = "default_cut")]
    pub cut: Cut,
    /// Cubics for one exponent, 1 or 2. The second counts from where the first hands over to it.
    #[serde(default = "default_segments", skip_serializing_if = "is_one")]
    pub segments: u32,
    /// The rounding of every line.
    #[serde(default)]
    pub rounding: Rounding,
    /// Quotient bits the divider finds in one clock cycle, 1 to 8.
    #[serde(default = "default_quotient_bits")]
    pub quotient_bits_per_stage: u32,
    /// The widest operand a multiplier of the polynomial may have, 8 to 63 bits: 18 for a block that
    /// multiplies 18 by 18. Without it the error budget alone decides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub multiplier_operand_bits: Option<u32>,
    /// What coefficients and data path together may add to the error, in output ulp.
    #[serde(default = "default_budget")]
    pub error_budget_ulp: f64,
    /// Formats stated by hand; those not stated are derived from the budget.
    #[serde(default, skip_serializing_if = "StatedWidths::is_empty")]
    pub widths: StatedWidths,
    /// Coefficients moved away from the nearest integers, by exponent; they mean something only with the
    /// formats of the coefficients stated.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub coefficient_steps: Vec<CoefficientSteps>,
    /// The x that are presented, one entry for each exponent; every x where it is empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub domain: Vec<Presented>,
}

fn default_q() -> f64 {
    Levels::default().q()
}
fn default_g() -> f64 {
    Levels::default().g()
}
const fn default_form() -> Form {
    Form::Centred
}
const fn default_tail() -> Tail {
    Tail::Zero
}
const fn default_segments() -> u32 {
    1
}
// serde hands over a reference.
#[allow(clippy::trivially_copy_pass_by_ref)]
const fn is_one(segments: &u32) -> bool {
    *segments == 1
}
const fn default_cut() -> Cut {
    Cut::Epicentre
}
const fn default_quotient_bits() -> u32 {
    2
}
const fn default_budget() -> f64 {
    1.0
}

/// Why a configuration is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// Not JSON, an unknown or missing field, or a value of the wrong kind; with line and column.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    /// A field whose value cannot be used.
    #[error("field `{field}`: {problem}")]
    Field {
        /// The field's name in the JSON.
        field: &'static str,
        /// What is wrong, and what would be right.
        problem: String,
    },
}

fn wrong<T>(field: &'static str, problem: impl Into<String>) -> Result<T, ConfigError> {
    Err(ConfigError::Field { field, problem: problem.into() })
}

impl Config {
    /// Parses and checks a configuration.
    ///
    /// # Errors
    /// When the text is not a configuration, or a field cannot be used.
    pub fn from_json(text: &str) -> Result<Self, ConfigError> {
        let config: Self = serde_json::from_str(text)?;
        config.check()?;
        Ok(config)
    }

    /// The configuration as JSON, ready to be parsed again.
    #[must_use]
    pub fn to_json(&self) -> String {
        // A struct of plain fields with string keys: serialising it cannot fail.
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }

    /// Q and G.
    ///
    /// # Errors
    /// When not 0 < G < Q < 1.
    pub fn levels(&self) -> Result<Levels, ConfigError> {
        Levels::new(self.q, self.g)
            .map_err(|error| ConfigError::Field { field: "q, g", problem: error.to_string() })
    }

    /// Checks what can be checked without deriving widths.
    ///
    /// # Errors
    /// Names the field and what would be right.
    pub fn check(&self) -> Result<(), ConfigError> {
        self.levels()?;
        if let Err(error) = names::label(&self.name) {
            return wrong("name", error.to_string());
        }
        self.check_method()?;
        self.check_segments()?;
        self.check_formats()?;
        steps::check(self)?;
        domain::check(self)?;
        if !(1..=8).contains(&self.quotient_bits_per_stage) {
            return wrong("quotient_bits_per_stage", "use 1 to 8");
        }
        if self.multiplier_operand_bits.is_some_and(|bits| !(8..=MAX_WIDTH).contains(&bits)) {
            return wrong("multiplier_operand_bits", "use 8 to 63, or leave it out");
        }
        if !(self.error_budget_ulp > 0.0 && self.error_budget_ulp <= 1e6) {
            return wrong("error_budget_ulp", "use a number above 0 (1.0 is usual), at most 1e6");
        }
        Ok(())
    }

    fn check_method(&self) -> Result<(), ConfigError> {
        match self.method {
            Method::Composite => wrong(
                "method",
                "composite is hermite with a rational tail: say \"method\": \"hermite\", \
                 \"tail\": \"rational\"",
            ),
            Method::Rational => wrong(
                "method",
                "rational answers on the tail only: say hermite, three_point, tangent, minimax, \
                 quadratic or schlick, with \"tail\": \"rational\"",
            ),
            Method::Schlick if self.tail != Tail::Rational => {
                wrong("tail", "schlick is a ratio: say \"tail\": \"rational\"")
            }
            Method::Schlick => Ok(()),
            _ if self.tail == Tail::Rational && self.cut != Cut::Epicentre => wrong(
                "cut",
                "a rational tail meets the polynomial at q: say \"cut\": \"epicentre\"",
            ),
            _ => Ok(()),
        }
    }

    fn check_segments(&self) -> Result<(), ConfigError> {
        if !(1..=2).contains(&self.segments) {
            return wrong("segments", "use 1 or 2");
        }
        if self.cut == Cut::Balanced && self.method != Method::Minimax {
            return wrong(
                "cut",
                "only minimax is fitted to a range whose end is chosen for it: say \"method\": \
                 \"minimax\", or \"cut\": \"minimum\"",
            );
        }
        if self.segments == 1 {
            return Ok(());
        }
        if self.method != Method::Minimax || self.form != Form::Centred || self.tail != Tail::Zero {
            return wrong(
                "segments",
                "two segments are for \"method\": \"minimax\", \"form\": \"centred\", \"tail\": \"zero\"",
            );
        }
        if self.cut == Cut::Minimum {
            return wrong(
                "cut",
                "two segments end at q or where they are balanced: say \"balanced\"",
            );
        }
        Ok(())
    }

    fn check_formats(&self) -> Result<(), ConfigError> {
        if self.output.is_signed() {
            return wrong(
                "output",
                "an intensity is not negative: use an unsigned format (UQ1.15)",
            );
        }
        // 63 fraction bits would leave no room for 1 in that unit.
        let fraction = 1..=MAX_WIDTH - 1;
        if !fraction.contains(&self.output.fraction_bits()) || self.output.integer_bits() < 0 {
            return wrong("output", "use UQ0.n or UQ1.n with n of 1 to 62");
        }
        let value_bits = self.input.integer_bits() - i32::from(self.input.is_signed());
        if value_bits < 0 || !fraction.contains(&self.input.fraction_bits()) {
            return wrong("input", "x lies in [0, 1]: use UQ0.n, UQ1.n or Q2.n with n of 1 to 62");
        }
        self.check_stated()
    }

    /// A format stated for a register that the configuration does not have is a mistake.
    fn check_stated(&self) -> Result<(), ConfigError> {
        let StatedWidths { u, c3, c2, c1, c0, t1, t2, cut, hand_over, tail_a, tail_b, divisor } =
            &self.widths;
        let polynomial = self.method != Method::Schlick;
        let stated = |formats: &[&Option<QFormat>]| formats.iter().any(|format| format.is_some());
        if stated(&[u]) && (self.form == Form::Power || !polynomial) {
            return wrong("widths.u", "only the centred form has a u; leave it out");
        }
        if stated(&[c3, c2, c1, c0, t1, t2, cut]) && !polynomial {
            return wrong(
                "widths",
                "schlick has no polynomial; leave out c3 to c0, t1, t2 and cut",
            );
        }
        if hand_over.is_some() && self.segments < 2 {
            return wrong("widths.hand_over", "only two segments hand over; leave it out");
        }
        let within_x = |format: &QFormat| {
            !format.is_signed()
                && format.integer_bits() <= 1
                && format.fraction_bits() <= self.input.fraction_bits()
        };
        for (name, format) in [("widths.cut", cut), ("widths.hand_over", hand_over)] {
            if !format.as_ref().is_none_or(within_x) {
                return wrong(
                    name,
                    "it is compared with x and at most 1: give an unsigned format with at most one \
                     integer bit and no more fraction bits than the input's",
                );
            }
        }
        if stated(&[tail_a, tail_b, divisor]) && self.tail == Tail::Zero {
            return wrong(
                "widths",
                "a zero tail has no divider; leave out tail_a, tail_b and divisor, or say \
                 \"tail\": \"rational\"",
            );
        }
        Ok(())
    }
}
