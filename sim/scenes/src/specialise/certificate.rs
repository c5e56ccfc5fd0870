//! The certificate: over every (n, x) of the domain the smaller hardware answers as the source does, and refuses
//! every x outside.
//!
//! It holds both configurations and what was found. Of what it says nothing is believed: `check.rs`.

use std::fmt;

use hw_model::config::Config;
use hw_model::design::Design;
use serde::{Deserialize, Serialize};

use crate::scene::{DISPLAY_BITS, Transfer};
use bounds::seal::{self, BrokenSeal, Sealed, Unreadable};

/// How alike the answers are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Proved {
    /// Every intensity as a number, and every flag that both have.
    BitIdentical,
    /// At most the allowed display codes, of the highlight at full strength in the scene's transfer curve.
    Codes {
        /// The greatest difference that is allowed, in display codes.
        allowed: u16,
        /// The greatest difference that was found, in display codes.
        greatest: u16,
    },
}

/// The display whose codes are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Display {
    /// Bits of a code.
    pub bits: u32,
    /// The transfer curve: `srgb` or `linear`.
    pub transfer: Transfer,
}

impl Display {
    /// The greatest code; 0 where the bits are not those of a scene.
    #[must_use]
    pub(crate) fn greatest_code(&self) -> u32 {
        if DISPLAY_BITS.contains(&self.bits) { (1 << self.bits) - 1 } else { 0 }
    }
}

impl fmt::Display for Display {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "display codes of {} bits, {}", self.bits, self.transfer.name())
    }
}

/// One exponent of the domain, and what was found there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// The exponent of this part of the domain.
    pub n: f64,
    /// The least x of the scene, as it was bounded.
    pub least: f64,
    /// The first x, bits in the input format.
    pub first: i64,
    /// The last x: 1, or the greatest of the format.
    pub last: i64,
    /// x from the first to the last.
    pub points: u64,
    /// Of them, those whose intensities or flags differ.
    pub differing: u64,
    /// The greatest difference of intensities, as a fraction of full intensity.
    pub greatest: f64,
    /// x from 0 up to the first that the row answers, each of which is refused with the flag; none where every x is
    /// answered. The row answers from this part's first x, or from that of another part which it serves.
    pub refused: u64,
    /// Which row answers, in every part of a certificate in which a row serves an exponent that is not its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub served: Option<Served>,
}

/// Which row answers for an exponent, and what that costs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Served {
    /// The exponent of the row.
    pub row: f64,
    /// The greatest difference from the source's row of the part's own exponent, in display codes.
    pub codes: u16,
}

/// A certificate as it stands in its file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    format: String,
    version: u32,
    /// The name of the scene.
    pub scene: String,
    /// The command that made the file, for readers; no claim depends on it.
    pub command: String,
    /// The claim in words, made from the other fields.
    pub statement: String,
    /// How alike the answers were proved to be.
    pub proved: Proved,
    /// The display in whose codes a difference is counted.
    pub display: Display,
    /// The domain, one part for each exponent.
    pub parts: Vec<Part>,
    /// What is answered as.
    pub source: Config,
    /// The configuration of the specialised hardware.
    pub specialised: Config,
    /// SHA-256 of the file with this field empty.
    sha256: String,
}

impl Sealed for Certificate {
    const FORMAT: &'static str = "blysk specialisation";
    const VERSION: u32 = 2;
    const WRITER: &'static str = "blysk specialise --out";

    fn sha256(&self) -> &str {
        &self.sha256
    }
    fn sha256_mut(&mut self) -> &mut String {
        &mut self.sha256
    }
}

impl Certificate {
    /// The certificate of these findings, with its statement in words and its seal.
    #[must_use]
    pub fn new(
        scene: &str,
        command: &str,
        display: Display,
        (proved, parts): (Proved, Vec<Part>),
        (source, specialised): (&Design, &Design),
    ) -> Self {
        seal::seal(Self {
            format: Self::FORMAT.to_owned(),
            version: Self::VERSION,
            scene: scene.to_owned(),
            command: command.to_owned(),
            statement: statement(proved, display, &parts, source.config(), specialised.config()),
            proved,
            display,
            parts,
            source: source.config().clone(),
            specialised: specialised.config().clone(),
            sha256: String::new(),
        })
    }

    /// As JSON, in the one way to write it.
    #[must_use]
    pub fn to_json(&self) -> String {
        seal::to_json(self)
    }

    /// Points that were compared.
    #[must_use]
    pub fn points(&self) -> u64 {
        self.parts.iter().fold(0, |sum, part| sum.saturating_add(part.points))
    }

    /// Points that were compared and x that were refused, as the certificate says: for a bar.
    #[must_use]
    pub fn inputs(&self) -> u64 {
        let parts = self.parts.iter();
        parts.fold(0, |sum, part| sum.saturating_add(part.points).saturating_add(part.refused))
    }

    /// The greatest difference of intensities, as a fraction of full intensity.
    #[must_use]
    pub fn greatest(&self) -> f64 {
        greatest(&self.parts)
    }

    /// Reads a certificate. That it can be read says nothing of its truth.
    ///
    /// # Errors
    /// When it is none.
    pub fn parse(text: &str) -> Result<Self, Unreadable> {
        seal::parse(text)
    }

    /// The text it was read from is what was sealed.
    ///
    /// # Errors
    /// When it is not.
    pub fn check_seal(&self, text: &str) -> Result<(), BrokenSeal> {
        seal::check(self, text)
    }
}

fn greatest(parts: &[Part]) -> f64 {
    parts.iter().map(|part| part.greatest).fold(0.0, f64::max)
}

fn statement(proved: Proved, display: Display, parts: &[Part], source: &Config, specialised: &Config) -> String {
    let points: u64 = parts.iter().map(|part| part.points).sum();
    let refused: u64 = parts.iter().map(|part| part.refused).sum();
    let how = match proved {
        Proved::BitIdentical => "the same bits".to_owned(),
        Proved::Codes { allowed, greatest: codes } => format!(
            "display codes of the highlight at full strength that differ by at most {codes} of {} ({allowed} \
             allowed; {} bits, {}), and intensities by at most {} of full intensity,",
            display.greatest_code(),
            display.bits,
            display.transfer.name(),
            greatest(parts)
        ),
    };
    let shared = match parts.iter().filter(|part| part.served.is_some_and(|served| served.row != part.n)).count() {
        0 => String::new(),
        count => format!(" ({count} of {} exponents served by the row of another)", parts.len()),
    };
    let outside = if specialised.domain.is_empty() {
        "no x from 0 to 1 is outside the domain".to_owned()
    } else {
        format!("all {refused} others from 0 to 1 are refused with out_of_domain")
    };
    let (specialised, source) = (&specialised.name, &source.name);
    format!("{specialised} and {source} give {how} at every one of {points} points (n, x){shared}; {outside}")
}
