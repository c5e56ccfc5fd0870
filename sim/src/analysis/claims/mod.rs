//! The claims of \[Rom\], each computed and judged.
//!
//! A claim about exponents is judged for all of them: from which n it fails is found by bisection over
//! the integers up to [`GREATEST`], and the answer is then held against every n up to [`EXAMINED`] and
//! every power of two above. Where the answer rests on the error of a method on its epicentre, the
//! enclosures of [`crate::certify`] must say the same at the last n and at the next. A claim about a printed formula is
//! judged by what the formula gives.

mod accuracy;
mod boundary;
mod comparison;
mod operations;
mod printed;
mod proof;
mod shape;
mod tail;

use std::fmt;

use hw_model::fit::{FitError, LevelsError};
use serde::{Serialize, Serializer};
use thiserror::Error;

use crate::certify::search::NotProved;

pub use boundary::{EXAMINED, GREATEST};

/// What became of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
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

impl fmt::Display for Verdict {
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

impl Serialize for Verdict {
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
    pub verdict: Verdict,
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

/// Computes every claim, in the order of the paper.
///
/// # Errors
/// When a claim is not of a kind that can be judged; with the claims of the paper none is.
pub fn claims() -> Result<Vec<Claim>, ClaimsError> {
    let mut claims = printed::hermite()?;
    claims.extend(accuracy::claims()?);
    claims.extend(printed::three_point()?);
    claims.extend(shape::claims()?);
    claims.extend(operations::claims());
    claims.extend(printed::rational()?);
    claims.extend(tail::claims()?);
    Ok(claims)
}

/// `id`, and the command that shows the numbers behind it.
fn command(id: &str) -> String {
    format!("blysk claims --claim {id}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_paper_claims_is_judged_as_the_numbers_say() {
        let claims = claims().unwrap();
        let verdict = |id: &str| claims.iter().find(|claim| claim.id == id).unwrap().verdict;
        assert_eq!(verdict("absolute-error"), Verdict::Holds);
        assert_eq!(verdict("relative-error"), Verdict::HoldsTo(114));
        let Verdict::HoldsTo(n) = verdict("schlick-epicentre") else { panic!() };
        assert!((120..128).contains(&n), "{n}");
        let ranges = ["tail-1-percent", "tail-3-percent", "tail-10-percent", "tail-ranges"];
        assert_eq!(ranges.map(verdict), [3, 4, 3, 3].map(Verdict::HoldsTo));
        let mut ids: Vec<&str> = claims.iter().map(|claim| claim.id).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), claims.len());
    }

    #[test]
    fn every_verdict_has_its_numbers() {
        for claim in claims().unwrap() {
            assert!(!claim.evidence.is_empty(), "{}", claim.id);
            let next = matches!(claim.verdict, Verdict::HoldsTo(_));
            assert_eq!(claim.fails_from.is_some(), next, "{}", claim.id);
            for evidence in &claim.evidence {
                assert!(evidence.value.is_finite(), "{}: {evidence:?}", claim.id);
            }
        }
    }
}
