//! The certificate: a claim with everything that is needed to check it, sealed, as JSON.
//!
//! How it is sealed and read: [`crate::seal`].

use hw_model::config::Config;
use hw_model::exponents::Exponents;
use hw_model::fit::{Levels, Method};
use serde::{Deserialize, Serialize};

use super::claim::{Claims, EveryClaim, ExponentClaim, Stretch};
use super::hardware::HardwareClaim;
use crate::seal::{self, BrokenSeal, Sealed, Unreadable};

/// A claim with its proof.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Claim {
    /// Methods at single exponents.
    Exponents(Claims<ExponentClaim>),
    /// Methods at every real exponent n ≥ 1.
    EveryExponent(Claims<EveryClaim>),
    /// A configuration, down to its bits.
    Hardware(Box<HardwareClaim>),
}

/// A certificate as it stands in its file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    format: String,
    version: u32,
    /// The claim in words; it follows from `claim`.
    statement: String,
    claim: Claim,
    /// SHA-256 of the file with this field empty.
    sha256: String,
}

impl Sealed for Certificate {
    const FORMAT: &'static str = "blysk certificate";
    const VERSION: u32 = 1;
    const WRITER: &'static str = "blysk certify --out";

    fn sha256(&self) -> &str {
        &self.sha256
    }
    fn sha256_mut(&mut self) -> &mut String {
        &mut self.sha256
    }
}

impl Certificate {
    /// The certificate of a claim: with its statement in words and the seal over both.
    #[must_use]
    pub fn new(claim: Claim) -> Self {
        seal::seal(Self {
            format: Self::FORMAT.to_owned(),
            version: Self::VERSION,
            statement: claim.statement(),
            claim,
            sha256: String::new(),
        })
    }

    /// Reads a certificate. That it can be read says nothing of its truth.
    ///
    /// # Errors
    /// When it is none.
    pub fn parse(text: &str) -> Result<Self, Unreadable> {
        seal::parse(text)
    }

    /// The text it was read from is what was written, and says what the claim says.
    ///
    /// # Errors
    /// When it is not.
    pub fn check_seal(&self, text: &str) -> Result<(), BrokenSeal> {
        seal::check(self, text)?;
        let statement = self.claim.statement();
        if self.statement != statement {
            return Err(BrokenSeal::Statement(statement));
        }
        Ok(())
    }

    /// The claim that the certificate proves.
    #[must_use]
    pub const fn claim(&self) -> &Claim {
        &self.claim
    }

    /// The claim in words.
    #[must_use]
    pub fn statement(&self) -> &str {
        &self.statement
    }

    /// As it stands in a file.
    #[must_use]
    pub fn to_json(&self) -> String {
        seal::to_json(self)
    }
}

impl Claim {
    /// The claim in words.
    #[must_use]
    pub fn statement(&self) -> String {
        match self {
            Self::Exponents(Claims { levels, claims }) => format!(
                "{}, at each of {} pairs of an exponent and a region: max |f(x) - x^n| over real x on \
                 the region lies within [lower, upper], and max |f(x)/x^n - 1| does where it is \
                 given. f has real coefficients, Q = {}, G = {}; epicentre: x^n >= Q, tail: x^n <= Q.",
                listed(claims.iter().map(|claim| claim.method)),
                claims.len(),
                levels.q(),
                levels.g()
            ),
            Self::EveryExponent(Claims { levels, claims }) => format!(
                "{}: the supremum of |f(x) - x^n| over every real n >= 1 and every real x with \
                 x^n >= Q lies within [lower, upper], and so does that of |f(x)/x^n - 1|. f has real \
                 coefficients, Q = {}, G = {}.",
                listed(claims.iter().map(|claim| claim.method)),
                levels.q(),
                levels.g()
            ),
            Self::Hardware(claim) => claim.statement(),
        }
    }

    /// What a bound on the epicentre is about: methods with their exponents and level, or a configuration.
    #[must_use]
    pub fn epicentres(&self) -> String {
        let of_level = |levels: &Levels| format!("Q = {}, G = {}", levels.q(), levels.g());
        match self {
            Self::Exponents(Claims { levels, claims }) => {
                let claims = || claims.iter().filter(|claim| claim.region == Stretch::Epicentre);
                let mut exponents: Vec<f64> = claims().map(|claim| claim.n).collect();
                exponents.sort_by(f64::total_cmp);
                exponents.dedup();
                // A certificate may have more exponents, and in any order, than a list of them may.
                let exponents = match exponents.as_slice() {
                    [least, .., greatest] => Exponents::new(exponents.clone()).map_or_else(
                        |_| format!("{} exponents from {least} to {greatest}", exponents.len()),
                        |list| format!("n = {list}"),
                    ),
                    [only] => format!("n = {only}"),
                    [] => "no exponent".to_owned(),
                };
                let methods = listed(claims().map(|claim| claim.method));
                format!("{methods}; {exponents}; {}", of_level(levels))
            }
            Self::EveryExponent(Claims { levels, claims }) => {
                let methods = listed(claims.iter().map(|claim| claim.method));
                format!("{methods}; every real n >= 1; {}", of_level(levels))
            }
            Self::Hardware(claim) => {
                let Config { name, exponents, q, .. } = &claim.configuration;
                format!("{name}; n = {exponents}; Q = {q}")
            }
        }
    }
}

/// The methods, each once.
fn listed(methods: impl Iterator<Item = Method>) -> String {
    let mut names: Vec<&str> = methods.map(Method::name).collect();
    names.dedup();
    names.join(", ")
}
