//! The names of the methods.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

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
#[error(
    "{0:?} is not a method; choose one of hermite, three_point, tangent, minimax, quadratic, rational, composite, \
     schlick"
)]
pub struct UnknownMethod(pub String);

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

    /// The name used in configurations and on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hermite => "hermite",
            Self::ThreePoint => "three_point",
            Self::Tangent => "tangent",
            Self::Minimax => "minimax",
            Self::Quadratic => "quadratic",
            Self::Rational => "rational",
            Self::Composite => "composite",
            Self::Schlick => "schlick",
        }
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
        for method in Method::ALL {
            assert_eq!(method.name().parse(), Ok(method));
            assert_eq!(serde_json::to_string(&method).unwrap(), format!("\"{method}\""));
            assert!(message.contains(method.name()), "{message}");
        }
        assert_eq!("Hermite".parse::<Method>(), Err(UnknownMethod("Hermite".into())));
    }
}
