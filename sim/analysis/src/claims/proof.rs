//! Verdicts that rest on more than f64: the enclosures of [`bounds::certify`] at the exponents that decide.
//!
//! The last operation on a proved end, a product or a quotient, is rounded to nearest and not outwards. It
//! moves the end by less than 2⁻⁵² of itself; the enclosures are 10⁻⁷ wide, and what they must decide is
//! further from the limit than that, or nothing is confirmed.

use hw_model::fit::{Levels, Method};

use super::claim::{Claim, ClaimsError, Evidence, Judgement};
use super::comparison::Comparison;
use bounds::certify::claim::{ExponentClaim, Stretch};
use bounds::certify::search::{claim_every_exponent, claim_exponent};

/// A number between two others.
#[derive(Debug, Clone, Copy)]
pub(super) struct Enclosed {
    pub(super) lower: f64,
    pub(super) upper: f64,
}

/// The proved errors of a method on its epicentre.
pub(super) fn epicentre(method: Method, n: f64) -> Result<ExponentClaim, ClaimsError> {
    Ok(claim_exponent(method, n, Stretch::Epicentre, Levels::default())?)
}

/// Confirms that a claim holds at the last n and fails at the next.
pub(super) fn at_the_boundary(
    mut claim: Claim,
    comparison: &Comparison<'_>,
    enclosure: impl Fn(f64) -> Result<Enclosed, ClaimsError>,
) -> Result<Claim, ClaimsError> {
    let Judgement::HoldsTo(last) = claim.verdict else { return Ok(claim) };
    for (n, holds) in [(last as f64, true), (last as f64 + 1.0, false)] {
        let Enclosed { lower, upper } = enclosure(n)?;
        if [lower, upper].iter().any(|&end| comparison.holds(end) != holds) {
            return Err(ClaimsError::NotConfirmed { claim: claim.id, n, holds });
        }
        for (end, value) in [("least", lower), ("most", upper)] {
            claim.evidence.push(Evidence {
                what: format!("the same, proved to be at {end}"),
                n: Some(n),
                value,
                limit: Some(comparison.limit),
                unit: comparison.unit,
            });
        }
    }
    Ok(claim)
}

/// Confirms, for every real n ≥ 1 at once, that the cubic's absolute error stays within `limit` per cent.
pub(super) fn for_every_exponent(mut claim: Claim, limit: f64) -> Result<Claim, ClaimsError> {
    let Judgement::Holds = claim.verdict else { return Ok(claim) };
    let upper = 100.0 * claim_every_exponent(Method::Hermite, Levels::default())?.absolute.upper;
    if upper > limit {
        return Err(ClaimsError::NotConfirmed { claim: claim.id, n: f64::INFINITY, holds: true });
    }
    claim.holds_for = "every real n >= 1, proved (blysk certify --all-real-n)".to_owned();
    claim.evidence.push(Evidence {
        what: "the same for every real n >= 1, proved to be at most".to_owned(),
        n: None,
        value: upper,
        limit: Some(limit),
        unit: "%",
    });
    Ok(claim)
}
