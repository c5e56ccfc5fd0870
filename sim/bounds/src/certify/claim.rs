//! What is claimed, and what proves it.

use hw_model::exponents::Exponents;
use hw_model::fit::{Levels, Method};
use serde::{Deserialize, Serialize};

/// The x that a claim is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stretch {
    /// x from q to 1, where x^n ≥ Q.
    Epicentre,
    /// x from 0 to q.
    Tail,
}

impl Stretch {
    /// The regions that a method is made for.
    #[must_use]
    pub const fn of(method: Method) -> &'static [Self] {
        let capabilities = method.capabilities();
        match (capabilities.epicentre, capabilities.tail) {
            (true, false) => &[Self::Epicentre],
            (false, true) => &[Self::Tail],
            (true, true) => &[Self::Epicentre, Self::Tail],
            (false, false) => &[],
        }
    }

    /// Whether a method is made for the epicentre by a formula in n, so that every n can be bounded at once.
    /// `minimax` is found for each n by itself.
    #[must_use]
    pub const fn has_formula_of_n(method: Method) -> bool {
        let capabilities = method.capabilities();
        capabilities.closed_form && capabilities.epicentre
    }

    /// As in files and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Epicentre => "epicentre",
            Self::Tail => "tail",
        }
    }
}

/// What is claimed of some methods at some exponents: method by method, region by region, n rising.
#[must_use]
pub fn subjects(methods: &[Method], exponents: &Exponents) -> Vec<(Method, Stretch, f64)> {
    let of = |method: Method| Stretch::of(method).iter().map(move |&region| (method, region));
    let parts = methods.iter().flat_map(|&method| of(method));
    parts.flat_map(|(method, region)| exponents.iter().map(move |exponent| (method, region, exponent))).collect()
}

/// How an error of a method is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// The absolute error |f − x^n|.
    Absolute,
    /// The relative error |f/x^n − 1|.
    Relative,
}

/// A point at which the error is at least the lower bound.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Witness {
    /// h = 1/n where the claim is for every n; 0 is the limit n → ∞.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub h: Option<f64>,
    /// σ = −n·ln x.
    pub sigma: f64,
}

impl Witness {
    /// x^n = e^−σ there, to the nearest f64: to be shown, as no proof rests on it.
    #[must_use]
    pub fn level(&self) -> f64 {
        core_math::exp(-self.sigma)
    }
}

/// lower ≤ max |e| ≤ upper, with the proof of both.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Enclosure {
    /// Not more than the maximum.
    pub lower: f64,
    /// Not less than the maximum.
    pub upper: f64,
    /// Where the error is at least `lower`.
    pub witness: Witness,
    /// Tails: where the partition ends. Beyond, σ ≥ far, f and x^n are both below `upper`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub far: Option<f64>,
    /// The boxes over each of which the error is at most `upper`, as `partition.rs` writes them.
    pub partition: String,
}

impl Enclosure {
    /// Its width over its lower end.
    #[must_use]
    pub fn relative_width(&self) -> f64 {
        (self.upper - self.lower) / self.lower
    }
}

/// The maximum of an error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Finding {
    /// It is zero: the curve is x^n itself ([`super::curve::is_exact`]).
    Exact,
    /// It lies between two numbers.
    Enclosed(Enclosure),
}

impl Finding {
    /// Not more than the maximum.
    #[must_use]
    pub const fn lower(&self) -> f64 {
        match self {
            Self::Exact => 0.0,
            Self::Enclosed(enclosure) => enclosure.lower,
        }
    }

    /// Not less than the maximum.
    #[must_use]
    pub const fn upper(&self) -> f64 {
        match self {
            Self::Exact => 0.0,
            Self::Enclosed(enclosure) => enclosure.upper,
        }
    }
}

/// One method at one exponent.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExponentClaim {
    /// The method that the claim is about.
    pub method: Method,
    /// The exponent, 1 or more.
    pub n: f64,
    /// The x that the claim is about.
    pub region: Stretch,
    /// max |f − x^n|.
    pub absolute: Finding,
    /// max |f/x^n − 1|; none on a tail, where it has no bound.
    pub relative: Option<Finding>,
}

/// One method at every real exponent n ≥ 1, on the epicentre.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EveryClaim {
    /// The method that the claim is about.
    pub method: Method,
    /// sup |f − x^n|.
    pub absolute: Enclosure,
    /// sup |f/x^n − 1|.
    pub relative: Enclosure,
}

/// Claims about methods, all with the same levels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claims<T> {
    /// The levels Q and G of the methods.
    pub levels: Levels,
    /// One after the other.
    pub claims: Vec<T>,
}
