//! The two intensities at which the methods meet x^n.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The levels Q and G of x^n, 0 < G < Q < 1. The epicentre is where x^n ≥ Q; only the `three_point`
/// method looks at G.
///
/// The default is Q = 1/2, as \[Rom\] takes it, and G = 1/18, the greatest 1/k with which the
/// `three_point` cubic has no negative zone for any n ≥ 3.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Raw", into = "Raw")]
pub struct Levels {
    q: f64,
    g: f64,
}

/// Levels that are not in order.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("the levels q = {q}, g = {g} are refused; they must satisfy 0 < g < q < 1, for example q = 0.5, g = 0.0556")]
pub struct LevelsError {
    /// The level Q as given.
    pub q: f64,
    /// The level G as given.
    pub g: f64,
}

impl Levels {
    /// Checks the order of the two.
    ///
    /// # Errors
    /// Unless 0 < g < q < 1, or when g is subnormal.
    pub fn new(q: f64, g: f64) -> Result<Self, LevelsError> {
        if f64::MIN_POSITIVE <= g && g < q && q < 1.0 { Ok(Self { q, g }) } else { Err(LevelsError { q, g }) }
    }

    /// Q, the intensity at the edge of the epicentre.
    #[must_use]
    pub const fn q(self) -> f64 {
        self.q
    }

    /// G, the intensity at the third point of the `three_point` method.
    #[must_use]
    pub const fn g(self) -> f64 {
        self.g
    }
}

impl Default for Levels {
    fn default() -> Self {
        Self { q: 0.5, g: 1.0 / 18.0 }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Raw {
    q: f64,
    g: f64,
}

impl Default for Raw {
    fn default() -> Self {
        Levels::default().into()
    }
}

impl From<Levels> for Raw {
    fn from(Levels { q, g }: Levels) -> Self {
        Self { q, g }
    }
}

impl TryFrom<Raw> for Levels {
    type Error = LevelsError;
    fn try_from(Raw { q, g }: Raw) -> Result<Self, LevelsError> {
        Self::new(q, g)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_ordered_levels_pass() {
        assert_eq!(Levels::new(0.5, 1.0 / 18.0), Ok(Levels::default()));
        for (q, g) in [
            (0.5, 0.5),
            (0.5, 0.6),
            (1.0, 0.5),
            (0.5, 0.0),
            (0.5, -0.1),
            (0.5, 1e-310),
            (f64::NAN, 0.1),
            (0.5, f64::NAN),
        ] {
            let refusal = Levels::new(q, g).unwrap_err().to_string();
            assert!(refusal.contains("0 < g < q < 1"), "{refusal}");
        }
    }

    #[test]
    fn json_is_checked_and_defaults() {
        let parse = |text| serde_json::from_str::<Levels>(text);
        assert_eq!(parse(r#"{"q":0.6,"g":0.1}"#).unwrap(), Levels::new(0.6, 0.1).unwrap());
        assert_eq!(parse("{}").unwrap(), Levels::default());
        assert!(parse(r#"{"q":0.1,"g":0.6}"#).is_err());
        assert!(parse(r#"{"Q":0.5}"#).is_err());
        let text = serde_json::to_string(&Levels::default()).unwrap();
        assert_eq!(parse(&text).unwrap(), Levels::default());
    }
}
