//! The methods, and what each of them is: a row of one table, which lists, help texts, checks and searches read.
//!
//! A method in closed form is a file beside this one and a row here. What proves its error has a formula of its own, on
//! purpose, and does not compile without one (`sim/bounds/src/certify/curve.rs`).

mod hermite;
mod quadratic;
mod rational;
mod tangent;
mod three_point;

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::crossing::WideCrossing;
use super::curve::Curve;
use super::levels::Levels;
use super::minimax;
use crate::highlight;
use crate::registers::{CUBIC, MAX_DEGREE};

/// How x^n is approximated, for one exponent. q = Q^(1/n) is where the epicentre begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// The cubic with f(1) = 1, f(q) = Q, f′(q) = nQ/q, f(0) = 0: the main result of \[Rom\].
    Hermite,
    /// The cubic with f(1) = 1, f(r) = Q, f(l) = G, f(0) = 0, r = q, l = G^(1/n).
    ThreePoint,
    /// The cubic a·x·(x − m)² with f(1) = 1, f(q) = Q: its minimum touches zero.
    Tangent,
    /// The cubic with f(1) = 1 whose greatest error on the epicentre is least.
    Minimax,
    /// The parabola with f(1) = 1, f(q) = Q, f′(q) = nQ/q.
    Quadratic,
    /// The hyperbola x/(A − B·x) with g(q) = Q, g′(q) = nQ/q, meant for x < q.
    Rational,
    /// `Hermite` from q up, `Rational` below; value and slope continue across q.
    Composite,
    /// x/(n − n·x + x), the baseline.
    Schlick,
}

/// A name that is not a method's.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0:?} is not a method; choose one of {list}", list = Method::list())]
pub struct UnknownMethod(pub String);

/// What a method is.
#[derive(Debug, Clone, Copy)]
pub struct Capabilities {
    /// The name in configurations and on the command line.
    pub name: &'static str,
    /// What a processor evaluates for a sample.
    pub evaluation: &'static str,
    /// Made for x from q to 1, the epicentre.
    pub epicentre: bool,
    /// Made for x from 0 to q, the tail.
    pub tail: bool,
    /// Its coefficients have a formula in n, so that all n can be bounded at once; otherwise each n has a search.
    pub closed_form: bool,
    /// What it is in hardware.
    pub hardware: Hardware,
    /// The degree with which `design` tries it; none where it is no candidate as it is.
    pub candidate: Option<usize>,
    /// The curve for one exponent n and q = Q^(1/n).
    pub(super) fit: fn(f64, Levels, &WideCrossing) -> Curve,
}

/// What a method is in hardware.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hardware {
    /// A polynomial of a degree from the least to the greatest.
    Polynomial {
        /// The least degree.
        least: usize,
        /// The greatest.
        greatest: usize,
        /// What to say where another degree is stated.
        otherwise: &'static str,
    },
    /// A divider for all x, and no polynomial.
    Divider,
    /// None by itself.
    None {
        /// What to say in its place.
        instead: &'static str,
    },
}

const ZERO_BELOW: &str = "1 - s(k1 - s(k2 - s k3)), s = 1 - x, not less than 0; 0 below the cubic's minimum \
                          under the epicentre";
const CUBIC_ALONE: Hardware = Hardware::Polynomial {
    least: CUBIC,
    greatest: CUBIC,
    otherwise: "only minimax and quadratic have other degrees: leave it out, or say 3",
};

/// A cubic for the epicentre by a formula in n; the rows of the others say what they are instead.
const CUBIC_BY_FORMULA: Capabilities = Capabilities {
    name: "hermite",
    evaluation: ZERO_BELOW,
    epicentre: true,
    tail: false,
    closed_form: true,
    hardware: CUBIC_ALONE,
    candidate: Some(CUBIC),
    fit: |n, _, at_q| Curve::Cubic(hermite::hermite(n, at_q)),
};

impl Method {
    /// Every method, in the order in which they are explained.
    pub const ALL: [Self; 8] = [
        Self::Hermite,
        Self::ThreePoint,
        Self::Tangent,
        Self::Minimax,
        Self::Quadratic,
        Self::Rational,
        Self::Composite,
        Self::Schlick,
    ];

    /// What the method is: its row of the table.
    #[must_use]
    pub const fn capabilities(self) -> &'static Capabilities {
        match self {
            Self::Hermite => &CUBIC_BY_FORMULA,
            Self::ThreePoint => &Capabilities {
                name: "three_point",
                fit: |n, levels, at_q| {
                    Curve::Cubic(three_point::three_point(n, at_q, &WideCrossing::new(n, levels.g())))
                },
                ..CUBIC_BY_FORMULA
            },
            Self::Tangent => &Capabilities {
                name: "tangent",
                fit: |n, _, at_q| Curve::Cubic(tangent::tangent(n, at_q)),
                ..CUBIC_BY_FORMULA
            },
            Self::Minimax => &Capabilities {
                name: "minimax",
                closed_form: false,
                hardware: Hardware::Polynomial { least: 1, greatest: MAX_DEGREE, otherwise: "use 1 to 4" },
                fit: |n, _, at_q| Curve::Cubic(minimax::minimax(n, at_q).0),
                ..CUBIC_BY_FORMULA
            },
            Self::Quadratic => &Capabilities {
                name: "quadratic",
                hardware: Hardware::Polynomial {
                    least: 2,
                    greatest: CUBIC,
                    otherwise: "quadratic is a parabola: say 2, or 3 for a cubic without x³",
                },
                candidate: Some(2),
                fit: |n, _, at_q| Curve::Cubic(quadratic::quadratic(n, at_q)),
                ..CUBIC_BY_FORMULA
            },
            Self::Rational => &Capabilities {
                name: "rational",
                evaluation: "x/(a - b + b s) everywhere, and 1 where that is more",
                epicentre: false,
                tail: true,
                hardware: Hardware::None {
                    instead: "rational answers on the tail only: say hermite, three_point, tangent, minimax, \
                              quadratic or schlick, with \"tail\": \"rational\"",
                },
                candidate: None,
                fit: |n, levels, at_q| Curve::Rational(rational::rational(n, levels.q(), at_q)),
                ..CUBIC_BY_FORMULA
            },
            Self::Composite => &Capabilities {
                name: "composite",
                evaluation: "hermite's cubic in s = 1 - x on the epicentre, x/(a - b + b s) below",
                tail: true,
                hardware: Hardware::None {
                    instead: "composite is hermite with a rational tail: say \"method\": \"hermite\", \
                              \"tail\": \"rational\"",
                },
                candidate: None,
                fit: |n, levels, at_q| Curve::Composite {
                    epicentre: hermite::hermite(n, at_q),
                    tail: rational::rational(n, levels.q(), at_q),
                },
                ..CUBIC_BY_FORMULA
            },
            Self::Schlick => &Capabilities {
                name: "schlick",
                evaluation: "x/(n - n x + x)",
                tail: true,
                hardware: Hardware::Divider,
                candidate: None,
                fit: |n, _, _| Curve::Rational(highlight::Rational::schlick(n)),
                ..CUBIC_BY_FORMULA
            },
        }
    }

    /// The name used in configurations and on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.capabilities().name
    }

    /// The names of all methods, for help texts and messages.
    #[must_use]
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// The methods that hardware can be built for, in the same order.
    pub fn of_hardware() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|method| !matches!(method.capabilities().hardware, Hardware::None { .. }))
    }

    /// True where the hardware has a polynomial.
    #[must_use]
    pub const fn has_polynomial(self) -> bool {
        matches!(self.capabilities().hardware, Hardware::Polynomial { .. })
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(text: &str) -> Result<Self, UnknownMethod> {
        Self::ALL.into_iter().find(|method| method.name() == text).ok_or_else(|| UnknownMethod(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_agree_everywhere() {
        let message = UnknownMethod("cubic".into()).to_string();
        // What serde lists is every variant.
        let known = serde_json::from_str::<Method>("\"cubic\"").unwrap_err().to_string();
        assert_eq!(known.matches('`').count(), 2 * (1 + Method::ALL.len()), "{known}");
        for method in Method::ALL {
            assert_eq!(method.name().parse(), Ok(method));
            assert_eq!(serde_json::to_string(&method).unwrap(), format!("\"{method}\""));
            assert!(message.contains(method.name()), "{message}");
        }
        assert_eq!("Hermite".parse::<Method>(), Err(UnknownMethod("Hermite".into())));
    }
}
