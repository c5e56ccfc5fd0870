//! Corrections of single ROM integers.
//!
//! The real coefficients are rounded to their formats one by one, and a row's integers are then not the best
//! ones together, least of all through lines that round as well. A search over the neighbouring integers
//! says by how many units of its format a coefficient is moved; the configuration carries it.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fmt;

use serde::de::{MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use crate::exponents::Exponents;
use crate::registers::{MAX_DEGREE, MAX_SEGMENTS, Register};

/// The farthest a coefficient is moved either way. Beyond it is no correction.
pub const MOST_STEPS: i32 = 1 << 16;

/// The steps of one exponent, in units of the last place of each coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoefficientSteps {
    /// The exponent of the row, one of the configuration's.
    pub n: f64,
    /// Of c0, c1, … of each segment.
    steps: [Steps; MAX_SEGMENTS],
}

/// The steps of c0, c1, … of one segment.
pub type Steps = [i32; MAX_DEGREE + 1];

impl CoefficientSteps {
    /// No steps for this exponent.
    #[must_use]
    pub const fn none(n: f64) -> Self {
        Self { n, steps: [[0; MAX_DEGREE + 1]; MAX_SEGMENTS] }
    }

    /// Of c0, c1, … of a segment; zeros of one that there is not.
    #[must_use]
    pub fn of(&self, segment: usize) -> Steps {
        self.steps.get(segment).copied().unwrap_or_default()
    }

    /// With these steps of c0, c1, … of a segment.
    #[must_use]
    pub fn with(mut self, segment: usize, steps: Steps) -> Self {
        if let Some(of_segment) = self.steps.get_mut(segment) {
            *of_segment = steps;
        }
        self
    }

    /// True where nothing is moved.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::none(self.n)
    }

    /// Every coefficient that is moved, with its steps, in the order of files: segment by segment, the highest power
    /// first.
    pub fn moved(&self) -> impl Iterator<Item = (Register, i32)> {
        let all = (0..MAX_SEGMENTS).flat_map(|segment| (0..=MAX_DEGREE).rev().map(move |power| (segment, power)));
        all.map(|(segment, power)| (Register::C(segment, power), self.steps[segment][power]))
            .filter(|&(_, steps)| steps != 0)
    }
}

impl Serialize for CoefficientSteps {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("n", &self.n)?;
        for (register, steps) in self.moved() {
            map.serialize_entry(register.name(), &steps)?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for CoefficientSteps {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ByName)
    }
}

struct ByName;

impl<'de> Visitor<'de> for ByName {
    type Value = CoefficientSteps;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("n, and steps by the names of coefficients")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<CoefficientSteps, A::Error> {
        let mut n = None;
        let mut steps = CoefficientSteps::none(0.0);
        let mut seen = BTreeSet::new();
        while let Some(name) = map.next_key::<Cow<'de, str>>()? {
            if name == "n" {
                if n.replace(map.next_value()?).is_some() {
                    return Err(de::Error::duplicate_field("n"));
                }
                continue;
            }
            let Some(Register::C(segment, power)) = Register::named(&name) else {
                return Err(de::Error::unknown_field(&name, &["n", "c3", "c2", "c1", "c0", "c3_outer", "…"]));
            };
            if !seen.insert((segment, power)) {
                return Err(de::Error::duplicate_field(Register::C(segment, power).name()));
            }
            steps.steps[segment][power] = map.next_value()?;
        }
        steps.n = n.ok_or_else(|| de::Error::missing_field("n"))?;
        Ok(steps)
    }
}

/// Checks the steps of a configuration against its exponents, its segments and the degree of its polynomial, if it has
/// one.
///
/// # Errors
/// Names the exponent and what would be right.
pub(crate) fn check(
    steps: &[CoefficientSteps],
    exponents: &Exponents,
    segments: usize,
    degree: Option<usize>,
) -> Result<(), String> {
    if steps.is_empty() {
        return Ok(());
    }
    let Some(degree) = degree else {
        return Err("schlick has no polynomial; leave them out".to_owned());
    };
    let mut seen = vec![false; exponents.len()];
    for of_row in steps {
        let n = of_row.n;
        let Some(seen) = exponents.position(n).and_then(|at| seen.get_mut(at)) else {
            return Err(format!("the ROM has no row for n = {n}; it has {exponents}"));
        };
        if std::mem::replace(seen, true) {
            return Err(format!("n = {n} comes twice; say all of its steps at once"));
        }
        if let Some((field, steps)) = of_row.moved().find(|(_, steps)| steps.unsigned_abs() > MOST_STEPS.unsigned_abs())
        {
            return Err(format!("n = {n}: {steps} steps of {field} are too many; use -{MOST_STEPS} to {MOST_STEPS}"));
        }
        let beyond = |register: &Register| match *register {
            Register::C(segment, power) => segment >= segments || power > degree,
            _ => false,
        };
        if let Some((field, _)) = of_row.moved().find(|(field, _)| beyond(field)) {
            return Err(format!(
                "n = {n}: there is no {field} where \"segments\" is {segments} and \"degree\" {degree}; leave its \
                 steps out"
            ));
        }
    }
    Ok(())
}
