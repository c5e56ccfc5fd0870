//! Checking a certificate: no search, no halving, nothing believed of how it was found.
//!
//! | what                    | is checked by                                                              |
//! |-------------------------|----------------------------------------------------------------------------|
//! | the file is whole       | SHA-256, and its one way to be written                                     |
//! | upper                   | the partition covers the region; the error over each box, in intervals    |
//! | lower                   | the error at the witness, in intervals                                     |
//! | a hyperbola's far end   | its value at `far`, as it falls from there on                              |
//! | hardware                | `hardware_check.rs`                                                  |

use hw_model::exponents::MAX_EXPONENT;
use hw_model::fit::Levels;
use rayon::prelude::*;
use thiserror::Error;

use super::certificate::{Certificate, Claim};
use super::claim::{Claims, Enclosure, EveryClaim, ExponentClaim, Finding, Measure, Stretch};
use super::curve::is_exact;
use super::error::{ErrorFunction, EveryExponent, OneExponent};
use super::fault::Fault;
use super::hardware_check::check_hardware;
use super::partition::boxes;
use crate::seal::BrokenSeal;
use vectors::progress::Progress;

/// Why a certificate is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}", self.shown())]
pub struct Refused {
    /// It is not the one that was sealed.
    pub seal: Option<BrokenSeal>,
    /// Where the claim is false or not proved, and why.
    pub content: Option<Fault>,
}

impl Refused {
    fn shown(&self) -> String {
        let parts = [self.content.as_ref().map(ToString::to_string), self.seal.as_ref().map(ToString::to_string)];
        parts.into_iter().flatten().collect::<Vec<_>>().join("; ")
    }
}

/// What was looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Checked {
    /// The number of enclosures checked.
    pub enclosures: u64,
    /// Boxes, each with its own interval evaluation.
    pub boxes: u64,
    /// Points of a configuration, each through the data path.
    pub points: u64,
}

impl Checked {
    fn and(self, other: Self) -> Self {
        Self {
            enclosures: self.enclosures + other.enclosures,
            boxes: self.boxes + other.boxes,
            points: self.points + other.points,
        }
    }
}

/// Checks a certificate that was read from `text`.
///
/// # Errors
/// When it is not accepted. A broken seal alone is enough; the content is looked at even so, to say which
/// field is at fault, except where that takes a sweep over hardware.
pub fn check(certificate: &Certificate, text: &str, progress: &dyn Progress) -> Result<Checked, Refused> {
    let seal = certificate.check_seal(text).err();
    let content = match certificate.claim() {
        Claim::Exponents(claims) => check_exponents(claims),
        Claim::EveryExponent(claims) => check_every_exponent(claims),
        Claim::Hardware(_) if seal.is_some() => Ok(Checked::default()),
        Claim::Hardware(claim) => {
            check_hardware(claim, progress).map(|points| Checked { points, ..Checked::default() })
        }
    };
    match (seal, content) {
        (None, Ok(checked)) => Ok(checked),
        (seal, content) => Err(Refused { seal, content: content.err() }),
    }
}

fn check_exponents(claims: &Claims<ExponentClaim>) -> Result<Checked, Fault> {
    not_empty(&claims.claims)?;
    claims
        .claims
        .par_iter()
        .enumerate()
        .map(|(index, claim)| {
            let ExponentClaim { method, n, region, .. } = claim;
            let place = format!("claims[{index}] ({method}, n = {n}, {}), ", region.name());
            check_exponent(claim, claims.levels).map_err(|fault| fault.within(&place))
        })
        .collect::<Vec<_>>()
        .into_iter()
        .try_fold(Checked::default(), |sum, checked| Ok(sum.and(checked?)))
}

fn check_exponent(claim: &ExponentClaim, levels: Levels) -> Result<Checked, Fault> {
    let ExponentClaim { method, n, region, absolute, relative } = claim;
    if !(1.0..=MAX_EXPONENT).contains(n) {
        return Err(Fault::new("n", "exponents are numbers from 1 to 1e15"));
    }
    if !Stretch::of(*method).contains(region) {
        return Err(Fault::new("region", "the method is not made for it"));
    }
    if relative.is_some() != (*region == Stretch::Epicentre) {
        return Err(Fault::new("relative", "it belongs to an epicentre, and to no tail"));
    }
    let finding = |finding: &Finding, measure, name: &str| match finding {
        Finding::Exact if is_exact(*method, *region, *n) => Ok(Checked { enclosures: 1, ..Checked::default() }),
        Finding::Exact => Err(Fault::new(name, "the method is not exact for this exponent")),
        Finding::Enclosed(enclosure) => {
            let error = OneExponent::new(*method, *n, *region, measure, levels)
                .map_err(|error| Fault::new("n", error.to_string()))?;
            check_enclosure(enclosure, &error, false).map_err(|fault| fault.within(&format!("{name}.")))
        }
    };
    let absolute = finding(absolute, Measure::Absolute, "absolute")?;
    let relative = relative.as_ref().map(|found| finding(found, Measure::Relative, "relative"));
    Ok(absolute.and(relative.transpose()?.unwrap_or_default()))
}

fn check_every_exponent(claims: &Claims<EveryClaim>) -> Result<Checked, Fault> {
    not_empty(&claims.claims)?;
    claims.claims.iter().enumerate().try_fold(Checked::default(), |sum, (index, claim)| {
        let EveryClaim { method, absolute, relative } = claim;
        let place = format!("claims[{index}] ({method}, every n), ");
        if !Stretch::has_formula_of_n(*method) {
            let fault = Fault::new("method", "it has no formula on the epicentre, in n");
            return Err(fault.within(&place));
        }
        let enclosure = |enclosure, measure, name: &str| {
            let error = EveryExponent::new(*method, measure, claims.levels);
            check_enclosure(enclosure, &error, true).map_err(|fault| fault.within(&format!("{place}{name}.")))
        };
        let absolute = enclosure(absolute, Measure::Absolute, "absolute")?;
        let relative = enclosure(relative, Measure::Relative, "relative")?;
        Ok(sum.and(absolute).and(relative))
    })
}

fn not_empty<T>(claims: &[T]) -> Result<(), Fault> {
    if claims.is_empty() { Err(Fault::new("claims", "there is none")) } else { Ok(()) }
}

/// Both ends of one enclosure.
fn check_enclosure(enclosure: &Enclosure, error: &impl ErrorFunction, every: bool) -> Result<Checked, Fault> {
    let Enclosure { lower, upper, .. } = *enclosure;
    if !(0.0 <= lower && lower <= upper) {
        return Err(Fault::new("lower", format!("{lower} to {upper} is no interval of magnitudes")));
    }
    check_witness(enclosure, error, every)?;
    check_far(enclosure, error)?;
    let root = error.span().root(error.h(), enclosure.far);
    let boxes =
        boxes(&enclosure.partition, root, every).map_err(|problem| Fault::new("partition", problem.to_string()))?;
    for (index, &cell) in boxes.iter().enumerate() {
        let (greatest, _) = error.greatest(cell);
        // Not `greatest > upper`, which NaN would pass.
        let within = greatest <= upper;
        if !within {
            let problem = format!(
                "it is not proved: in box {index} of the partition (h {} to {}, sigma {} to {}) the \
                 error is bounded by {greatest} only",
                cell.h.low(),
                cell.h.high(),
                cell.sigma.low(),
                cell.sigma.high()
            );
            return Err(Fault::new("upper", problem));
        }
    }
    Ok(Checked { enclosures: 1, boxes: boxes.len() as u64, points: 0 })
}

fn check_witness(enclosure: &Enclosure, error: &impl ErrorFunction, every: bool) -> Result<(), Fault> {
    let witness = enclosure.witness;
    if witness.h.is_some() != every {
        return Err(Fault::new("witness.h", "it belongs to a claim for every n, and to no other"));
    }
    let h = witness.h.unwrap_or(error.h().low());
    if !error.h().holds(h) {
        return Err(Fault::new("witness.h", format!("{h} is not within 0 to 1")));
    }
    if !error.span().inner.holds(witness.sigma) {
        return Err(Fault::new("witness.sigma", format!("{} is not in the region", witness.sigma)));
    }
    let least = error.least_at(h, witness.sigma);
    if least >= enclosure.lower {
        Ok(())
    } else {
        let problem = format!("it is not proved: the error at the witness is at least {least} only");
        Err(Fault::new("lower", problem))
    }
}

fn check_far(enclosure: &Enclosure, error: &impl ErrorFunction) -> Result<(), Fault> {
    let outer = error.span().outer;
    match enclosure.far {
        None if outer.high().is_finite() => Ok(()),
        Some(far) if outer.high().is_infinite() => {
            if !(far.is_finite() && outer.low() < far) {
                return Err(Fault::new("far", format!("{far} is not in the region")));
            }
            let beyond = error.beyond(far);
            if beyond <= enclosure.upper {
                Ok(())
            } else {
                let problem = format!("beyond, the error is bounded by {beyond} only, not by upper");
                Err(Fault::new("far", problem))
            }
        }
        _ => Err(Fault::new("far", "it belongs to a tail, and to no epicentre")),
    }
}
