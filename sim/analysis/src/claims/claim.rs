//! A claim of the paper: what it says, what was computed, and what became of it.

use std::fmt;

use bounds::certify::search::NotProved;
use hw_model::fit::{FitError, LevelsError};
use serde::{Serialize, Serializer};
use thiserror::Error;

/// What became of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judgement {
    /// True, for every exponent where it speaks of exponents.
    Holds,
    /// True up to this integer exponent, and false from the next one on.
    HoldsTo(u64),
    /// True for every integer exponent, and false for some between them.
    HoldsForIntegers,
    /// The claim does not hold.
    Fails,
    /// A formula is printed otherwise than the text around it means it.
    Misprint,
    /// Nothing in it can be true or false; a figure stands beside it.
    NoFigure,
}

impl fmt::Display for Judgement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Holds => f.write_str("holds"),
            Self::HoldsTo(n) => write!(f, "holds for n <= {n}"),
            Self::HoldsForIntegers => f.write_str("holds for integer n"),
            Self::Fails => f.write_str("does not hold"),
            Self::Misprint => f.write_str("misprint"),
            Self::NoFigure => f.write_str("no figure given"),
        }
    }
}

impl Serialize for Judgement {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// One number a verdict rests on.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Evidence {
    /// What the number is, in words.
    pub what: String,
    /// For which exponent; `None` where it concerns all, or none.
    pub n: Option<f64>,
    /// The number, in `unit`.
    pub value: f64,
    /// What the claim allows, in the same unit; `None` where it allows nothing in particular.
    pub limit: Option<f64>,
    /// %, times, or nothing for a plain number.
    pub unit: &'static str,
}

/// A claim with its verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// A short name, as in `blysk claims --claim NAME`.
    pub id: &'static str,
    /// What the paper says.
    pub claim: &'static str,
    /// Where it says so. Formulas set apart from the text are counted from the beginning.
    pub source: &'static str,
    /// What was computed, in words.
    pub computed: String,
    /// For which exponents it holds, in words.
    pub holds_for: String,
    /// The least integer exponent for which it fails; `None` where there is none, or the claim is not about
    /// exponents.
    pub fails_from: Option<u64>,
    /// What became of it.
    pub verdict: Judgement,
    /// The command that shows it.
    pub command: String,
    /// The numbers on which the verdict rests.
    pub evidence: Vec<Evidence>,
}

/// Why a claim could not be judged.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ClaimsError {
    /// Bisection needs a claim that, once it fails, fails for every greater n.
    #[error(
        "claim {claim}: by bisection it {} at n = {n}, by computing that n it does not; \
         a claim that holds, fails and holds again cannot be judged so",
        if *.expected { "holds" } else { "fails" }
    )]
    NotMonotone {
        /// The short name of the claim.
        claim: &'static str,
        /// The exponent at which the two ways disagree.
        n: u64,
        /// What the bisection says of it.
        expected: bool,
    },
    /// Interval arithmetic does not confirm what was computed.
    #[error(
        "claim {claim}: computed one way it {} at n = {n}, and the proved bounds of the same number do not say so",
        if *.holds { "holds" } else { "fails" }
    )]
    NotConfirmed {
        /// The short name of the claim.
        claim: &'static str,
        /// The exponent; infinite for all at once.
        n: f64,
        /// Whether the claim holds by the first computation.
        holds: bool,
    },
    /// A bound cannot be proved.
    #[error(transparent)]
    NotProved(#[from] NotProved),
    /// Levels that a claim is tried at are none.
    #[error(transparent)]
    Levels(#[from] LevelsError),
    /// A method refuses an exponent.
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// `id`, and the command that shows the numbers behind it.
pub(super) fn command(id: &str) -> String {
    format!("blysk claims --claim {id}")
}
