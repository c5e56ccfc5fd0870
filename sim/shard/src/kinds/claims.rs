//! Certificates of methods: at single exponents, and at every real exponent.

use std::ops::Range;

use bounds::certify::certificate::{Certificate, Claim};
use bounds::certify::claim::{Claims, EveryClaim, ExponentClaim, Stretch, subjects};
use bounds::certify::search::{claim_every_exponent, claim_exponent};
use hw_model::exponents::Exponents;
use hw_model::fit::{Levels, Method};

use super::rows::count;
use crate::error::ShardError;
use crate::job::JobError;
use crate::kind::Kind;
use crate::merged::Merged;
use crate::part::Part;

/// Claims of a thread between two checkpoints: about a second.
const STEP: u64 = 16;

/// Methods at single exponents.
pub(super) struct AtExponents {
    subjects: Vec<(Method, Stretch, f64)>,
    levels: Levels,
}

impl AtExponents {
    pub(super) fn new(methods: &[Method], exponents: &Exponents, levels: Levels) -> Self {
        Self { subjects: subjects(methods, exponents), levels }
    }
}

impl Kind for AtExponents {
    fn pieces(&self) -> u64 {
        self.subjects.len() as u64
    }

    fn step(&self) -> u64 {
        STEP
    }

    fn measure(&self, piece: u64) -> Result<Part, ShardError> {
        let (method, region, n) = self.subjects[piece as usize];
        let what = || format!("{method}, n = {n}, {}", region.name());
        let claim = claim_exponent(method, n, region, self.levels);
        Ok(Part::Claim(claim.map_err(|cause| ShardError::NotProved { what: what(), cause })?))
    }

    fn check(&self, pieces: &Range<u64>, parts: &[Part]) -> Result<(), String> {
        count(pieces, parts)?;
        let wanted = &self.subjects[pieces.start as usize..pieces.end as usize];
        for (part, &(method, region, n)) in parts.iter().zip(wanted) {
            match part {
                Part::Claim(claim) if (claim.method, claim.region, claim.n) == (method, region, n) => {}
                _ => return Err(format!("there is no claim of {method}, n = {n}, {}", region.name())),
            }
        }
        Ok(())
    }

    fn merged(&self, parts: Vec<Part>) -> Result<Merged, ShardError> {
        let claims: Vec<ExponentClaim> = parts
            .into_iter()
            .map(|part| match part {
                Part::Claim(claim) => Ok(claim),
                _ => Err(ShardError::Kind),
            })
            .collect::<Result<_, _>>()?;
        Ok(certificate(Claim::Exponents(Claims { levels: self.levels, claims })))
    }
}

/// Methods at every real exponent n ≥ 1.
pub(super) struct EveryExponent {
    methods: Vec<Method>,
    levels: Levels,
}

impl EveryExponent {
    pub(super) fn new(methods: &[Method], levels: Levels) -> Result<Self, ShardError> {
        let without = methods.iter().find(|&&method| !Stretch::has_formula_of_n(method));
        match without {
            None => Ok(Self { methods: methods.to_vec(), levels }),
            Some(method) => Err(ShardError::Job(JobError::Range {
                field: "certify.every_exponent.methods",
                value: method.to_string(),
                wanted: "use methods with a formula in n that are made for the epicentre, such as hermite",
            })),
        }
    }
}

impl Kind for EveryExponent {
    fn pieces(&self) -> u64 {
        self.methods.len() as u64
    }

    fn step(&self) -> u64 {
        1
    }

    fn measure(&self, piece: u64) -> Result<Part, ShardError> {
        let method = self.methods[piece as usize];
        let claim = claim_every_exponent(method, self.levels);
        Ok(Part::EveryClaim(claim.map_err(|cause| ShardError::NotProved { what: method.to_string(), cause })?))
    }

    fn check(&self, pieces: &Range<u64>, parts: &[Part]) -> Result<(), String> {
        count(pieces, parts)?;
        let wanted = &self.methods[pieces.start as usize..pieces.end as usize];
        for (part, &method) in parts.iter().zip(wanted) {
            match part {
                Part::EveryClaim(claim) if claim.method == method => {}
                _ => return Err(format!("there is no claim of {method}")),
            }
        }
        Ok(())
    }

    fn merged(&self, parts: Vec<Part>) -> Result<Merged, ShardError> {
        let claims: Vec<EveryClaim> = parts
            .into_iter()
            .map(|part| match part {
                Part::EveryClaim(claim) => Ok(claim),
                _ => Err(ShardError::Kind),
            })
            .collect::<Result<_, _>>()?;
        Ok(certificate(Claim::EveryExponent(Claims { levels: self.levels, claims })))
    }
}

fn certificate(claim: Claim) -> Merged {
    Merged::Certificate(Box::new(Certificate::new(claim)))
}
