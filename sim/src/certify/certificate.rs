//! The certificate: a claim with everything that is needed to check it, sealed, as JSON.
//!
//! A certificate has one way to be written. Reading compares the text with that, byte for byte (a mark and
//! CRLF are gone by then), so that
//! no digit can be another one, not even one that an f64 does not show.

use hw_model::fit::Method;
use serde::{Deserialize, Serialize};
use thiserror::Error;
use vectors::checksum::checksum;

use super::claim::{Claims, EveryClaim, ExponentClaim};
use super::hardware::HardwareClaim;

/// What the first line says.
const FORMAT: &str = "blysk certificate";

/// What changes when an older program could not check what is written.
const VERSION: u32 = 1;

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

/// Why a text is no certificate.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Unreadable {
    /// No JSON, or other fields.
    #[error("it is not a certificate as blysk certify --out writes it: {0}")]
    Json(#[from] serde_json::Error),
    /// Something else, or of another version.
    #[error(
        "it says format {format:?}, version {version}; this program checks {FORMAT:?}, version {VERSION}"
    )]
    Version {
        /// What it says it is.
        format: String,
        /// Its version.
        version: u32,
    },
}

/// A certificate that is not as it was written.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum BrokenSeal {
    /// Not the one way to write it.
    #[error("line {line} is not as this program writes it")]
    Text {
        /// The first such line, counted from 1.
        line: usize,
    },
    /// Another content.
    #[error("sha256: the content is not the one that was sealed")]
    Sha256,
    /// Words that do not fit.
    #[error("statement: the claim says otherwise: {0:?}")]
    Statement(String),
}

impl Certificate {
    /// Seals a claim.
    #[must_use]
    pub fn new(claim: Claim) -> Self {
        let statement = claim.statement();
        let mut certificate = Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            statement,
            claim,
            sha256: String::new(),
        };
        certificate.sha256 = certificate.digest();
        certificate
    }

    /// Reads a certificate. That it can be read says nothing of its truth.
    ///
    /// # Errors
    /// When it is none.
    pub fn parse(text: &str) -> Result<Self, Unreadable> {
        let certificate: Self = serde_json::from_str(text)?;
        if certificate.format != FORMAT || certificate.version != VERSION {
            let Self { format, version, .. } = certificate;
            return Err(Unreadable::Version { format, version });
        }
        Ok(certificate)
    }

    /// The text it was read from is what was written, and says what the claim says.
    ///
    /// # Errors
    /// When it is not.
    pub fn check_seal(&self, text: &str) -> Result<(), BrokenSeal> {
        if self.sha256 != self.digest() {
            return Err(BrokenSeal::Sha256);
        }
        let written = self.to_json();
        if text != written {
            let same = text.lines().zip(written.lines()).take_while(|(read, own)| read == own);
            return Err(BrokenSeal::Text { line: same.count() + 1 });
        }
        let statement = self.claim.statement();
        if self.statement != statement {
            return Err(BrokenSeal::Statement(statement));
        }
        Ok(())
    }

    /// The claim.
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
        // A struct of plain fields with string keys: serialising it cannot fail.
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }

    fn digest(&self) -> String {
        let open = Self { sha256: String::new(), ..self.clone() };
        // Reading from memory cannot fail; an empty digest would fit no certificate that was sealed.
        checksum(open.to_json().as_bytes()).map_or_else(|_| String::new(), |sum| sum.sha256)
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
}

/// The methods, each once.
fn listed(methods: impl Iterator<Item = Method>) -> String {
    let mut names: Vec<&str> = methods.map(Method::name).collect();
    names.dedup();
    names.join(", ")
}
