//! One configuration of the pipeline, as JSON.
//!
//! Every field but the first five has a default; unknown fields are refused. The presets
//! ([`crate::presets`]) are such files. A configuration that parses is complete and consistent in
//! itself ([`Config::from_json`] checks it); whether its widths can carry its values is found when
//! the [`Design`](crate::design::Design) is made.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use thiserror::Error;

use crate::clock::Clock;
use crate::domain::{self, Presented};
use crate::exponents::Exponents;
use crate::fit::{Hardware, Levels, Method};
use crate::format::{MAX_WIDTH, QFormat};
use crate::handshake::{Control, Handshake, Reset};
use crate::names;
use crate::pipelining::Pipelining;
use crate::registers::{CUBIC, MAX_SEGMENTS, Register};
use crate::rounding::Rounding;
use crate::steps::{self, CoefficientSteps};
use crate::widths::StatedWidths;

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

/// One configuration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// A name for files and reports.
    pub name: String,
    /// hermite, three_point, tangent, minimax, quadratic, or schlick.
    #[serde(deserialize_with = "method")]
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
    /// The degree of the polynomials, 1 to 4, and the number of multiply-add stages: 3 for the cubics of \[Rom\], 2 or
    /// 3 for a parabola, any for minimax.
    #[serde(default = "default_degree", skip_serializing_if = "is_cubic")]
    pub degree: usize,
    /// Polynomials for one exponent, 1 to 8. A further one counts from where the one before hands over to it.
    #[serde(default = "default_segments", skip_serializing_if = "is_one")]
    pub segments: usize,
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
    /// Ranks of registers beyond the least.
    #[serde(default, skip_serializing_if = "Pipelining::is_least")]
    pub pipelining: Pipelining,
    /// A clock from which the ranks follow, in the place of `pipelining`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clock: Option<Clock>,
    /// The rule by which ranks advance.
    #[serde(default, skip_serializing_if = "Handshake::is_usual")]
    pub handshake: Handshake,
    /// How a reset comes.
    #[serde(default, skip_serializing_if = "Reset::is_usual")]
    pub reset: Reset,
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
const fn default_degree() -> usize {
    CUBIC
}
// serde hands over references.
#[allow(clippy::trivially_copy_pass_by_ref)]
const fn is_cubic(degree: &usize) -> bool {
    *degree == CUBIC
}
const fn default_segments() -> usize {
    1
}
#[allow(clippy::trivially_copy_pass_by_ref)]
const fn is_one(segments: &usize) -> bool {
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

/// A method by its name. A misspelt one is answered with those that a configuration takes; one without hardware is
/// refused later, by what to say instead.
fn method<'de, D: Deserializer<'de>>(from: D) -> Result<Method, D::Error> {
    let text = String::deserialize(from)?;
    text.parse().map_err(|_| {
        let names: Vec<String> = Method::of_hardware().map(|method| format!("`{method}`")).collect();
        D::Error::custom(format!("unknown method `{text}`, expected one of {}", names.join(", ")))
    })
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

    /// The same for other x and exponents. Stated formats of cut and hand-over are for those that it had: where these
    /// are others, the ends are as fine as x.
    #[must_use]
    pub fn with_inputs(mut self, input: QFormat, exponents: Exponents) -> Self {
        if input != self.input || exponents != self.exponents {
            self.widths.set(Register::Cut, None);
            self.widths.set(Register::HandOver(1), None);
        }
        Self { input, exponents, ..self }
    }

    /// What stands around the data path.
    #[must_use]
    pub const fn control(&self) -> Control {
        Control { handshake: self.handshake, reset: self.reset, slice: self.pipelining.ready_slice }
    }

    /// Q and G.
    ///
    /// # Errors
    /// When not 0 < G < Q < 1.
    pub fn levels(&self) -> Result<Levels, ConfigError> {
        Levels::new(self.q, self.g).map_err(|error| ConfigError::Field { field: "q, g", problem: error.to_string() })
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
        self.check_degree()?;
        self.check_segments()?;
        self.check_formats()?;
        let degree = self.method.has_polynomial().then_some(self.degree);
        steps::check(&self.coefficient_steps, &self.exponents, self.segments, degree)
            .or_else(|problem| wrong("coefficient_steps", problem))?;
        domain::check(&self.domain, &self.exponents, self.tail != Tail::Zero)
            .or_else(|problem| wrong("domain", problem))?;
        self.pipelining.check().or_else(|problem| wrong("pipelining", problem))?;
        self.control().check().or_else(|problem| wrong("handshake", problem))?;
        self.check_clock()?;
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

    fn check_clock(&self) -> Result<(), ConfigError> {
        let Some(clock) = &self.clock else { return Ok(()) };
        if !self.pipelining.is_least() {
            return wrong("clock", "the ranks follow from a clock: leave \"pipelining\" out, or the clock");
        }
        clock.check().or_else(|problem| wrong("clock", problem))
    }

    fn check_method(&self) -> Result<(), ConfigError> {
        match self.method.capabilities().hardware {
            Hardware::None { instead } => wrong("method", instead),
            Hardware::Divider if self.tail != Tail::Rational => {
                wrong("tail", "schlick is a ratio: say \"tail\": \"rational\"")
            }
            Hardware::Polynomial { .. } if self.tail == Tail::Rational && self.cut != Cut::Epicentre => {
                wrong("cut", "a rational tail meets the polynomial at q: say \"cut\": \"epicentre\"")
            }
            Hardware::Divider | Hardware::Polynomial { .. } => Ok(()),
        }
    }

    fn check_degree(&self) -> Result<(), ConfigError> {
        let (allowed, would_be_right) = match self.method.capabilities().hardware {
            Hardware::Polynomial { least, greatest, otherwise } => (least..=greatest, otherwise),
            Hardware::Divider | Hardware::None { .. } => (CUBIC..=CUBIC, "it has no polynomial: leave the degree out"),
        };
        if !allowed.contains(&self.degree) {
            return wrong("degree", would_be_right);
        }
        if self.method == Method::Minimax && self.degree != CUBIC && self.cut == Cut::Minimum {
            return wrong(
                "cut",
                "the minimum is looked for in cubics: say \"epicentre\" or \"balanced\", or leave the degree out",
            );
        }
        Ok(())
    }

    fn check_segments(&self) -> Result<(), ConfigError> {
        if !(1..=MAX_SEGMENTS).contains(&self.segments) {
            return wrong("segments", "use 1 to 8");
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
                "two segments or more are for \"method\": \"minimax\", \"form\": \"centred\", \"tail\": \"zero\"",
            );
        }
        if self.cut == Cut::Minimum {
            return wrong("cut", "two segments or more end at q or where they are balanced: say \"balanced\"");
        }
        Ok(())
    }

    fn check_formats(&self) -> Result<(), ConfigError> {
        if self.output.is_signed() {
            return wrong("output", "an intensity is not negative: use an unsigned format (UQ1.15)");
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
        let polynomial = self.method.has_polynomial();
        let widths = &self.widths;
        let stated = |registers: &[Register]| registers.iter().any(|&r| widths[r].is_some());
        if stated(&[Register::V]) && (self.form == Form::Power || !polynomial) {
            return wrong("widths.u", "only the centred form has a u; leave it out");
        }
        let of_polynomial = |register: Register| matches!(register, Register::C(..) | Register::T(_) | Register::Cut);
        if widths.iter().any(|(register, _)| of_polynomial(register)) && !polynomial {
            return wrong("widths", "schlick has no polynomial; leave out c3 to c0, t1, t2 and cut");
        }
        // The last stage gives the output's fraction bits, and its range decides the rest.
        let degree = self.degree;
        let beyond = |register: Register| match register {
            Register::C(_, power) => power > degree,
            Register::T(stage) => stage >= degree,
            _ => false,
        };
        if let Some((register, _)) = widths.iter().find(|&(register, _)| beyond(register)) {
            return wrong(
                "widths",
                format!("there is no format of {register} to state where the degree is {degree}; leave it out"),
            );
        }
        if stated(&[Register::HandOver(1)]) && self.segments < 2 {
            return wrong("widths.hand_over", "only two segments or more hand over; leave it out");
        }
        let within_x = |format: &QFormat| {
            !format.is_signed() && format.integer_bits() <= 1 && format.fraction_bits() <= self.input.fraction_bits()
        };
        let ends = [("widths.cut", Register::Cut), ("widths.hand_over", Register::HandOver(1))];
        for (name, end) in ends {
            if !widths[end].as_ref().is_none_or(within_x) {
                return wrong(
                    name,
                    "it is compared with x and at most 1: give an unsigned format with at most one \
                     integer bit and no more fraction bits than the input's, or leave it out",
                );
            }
        }
        if stated(&[Register::TailA, Register::TailB, Register::Divisor]) && self.tail == Tail::Zero {
            return wrong(
                "widths",
                "a zero tail has no divider; leave out tail_a, tail_b and divisor, or say \
                 \"tail\": \"rational\"",
            );
        }
        Ok(())
    }
}
