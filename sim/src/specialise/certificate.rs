//! The certificate: over every (n, x) of the domain the smaller hardware answers as the source does, and refuses
//! every x outside.
//!
//! It holds both configurations and what was found. Checking it builds both again and goes through every x again;
//! of what was found it believes nothing.

use hw_model::config::{Config, ConfigError};
use hw_model::design::{Design, DesignError};
use serde::{Deserialize, Serialize};
use thiserror::Error;
use vectors::checksum::checksum;
use vectors::limits::TooManyInputs;

use super::compare::certify;
use super::derive::Row;
use crate::analysis::error_report::Progress;
use crate::scene::Transfer;

/// What the first line says.
const FORMAT: &str = "blysk specialisation";
/// What changes when an older program could not check what is written.
const VERSION: u32 = 1;

/// How alike the answers are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Proved {
    /// Every intensity as a number, and every flag that both have.
    BitIdentical,
    /// At most the allowed display codes, of the highlight at full strength in the scene's transfer curve.
    Codes {
        /// What is allowed.
        allowed: u16,
        /// What was found.
        greatest: u16,
    },
}

/// The display whose codes are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Display {
    /// Bits of a code.
    pub bits: u32,
    /// `srgb` or `linear`.
    pub transfer: Transfer,
}

/// One exponent of the domain, and what was found there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// n.
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
    /// x from 0 up to the first, each of which is refused with the flag; none where every x is answered.
    pub refused: u64,
}

/// A certificate as it stands in its file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    format: String,
    version: u32,
    /// The scene's name.
    pub scene: String,
    /// What made it.
    pub command: String,
    /// In words.
    pub statement: String,
    /// What was proved.
    pub proved: Proved,
    /// The display.
    pub display: Display,
    /// The domain.
    pub parts: Vec<Part>,
    /// What is answered as.
    pub source: Config,
    /// What answers.
    pub specialised: Config,
    /// SHA-256 of the file with this field empty.
    sha256: String,
}

/// Why a certificate does not hold.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Refused {
    /// No JSON, or other fields.
    #[error("it is not a certificate as blysk specialise writes it: {0}")]
    Json(#[from] serde_json::Error),
    /// Something else, or of another version.
    #[error("it says format {0:?}, version {1}; this program checks {FORMAT:?}, version {VERSION}")]
    Version(String, u32),
    /// Another content than was sealed.
    #[error("sha256: the content is not the one that was sealed")]
    Seal,
    /// One of the configurations.
    #[error("configuration: {0}")]
    Config(#[from] ConfigError),
    /// One of the configurations has no hardware.
    #[error("configuration: {0}")]
    Design(#[from] DesignError),
    /// More x than are gone through.
    #[error(transparent)]
    TooMany(#[from] TooManyInputs),
    /// An exponent that one of the two has not, or another domain than the configuration's.
    #[error("parts[{index}], n = {n}: {problem}")]
    Part {
        /// Its place.
        index: usize,
        /// n.
        n: f64,
        /// What is wrong.
        problem: String,
    },
    /// Going through every x again finds something else.
    #[error("{field}: the certificate says {said}, and every x says {found}")]
    Found {
        /// Which field.
        field: String,
        /// What stands there.
        said: String,
        /// What is so.
        found: String,
    },
}

impl Certificate {
    /// Sealed.
    #[must_use]
    pub fn new(
        scene: &str,
        command: &str,
        display: Display,
        (proved, parts): (Proved, Vec<Part>),
        (source, specialised): (&Design, &Design),
    ) -> Self {
        let mut certificate = Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            scene: scene.to_owned(),
            command: command.to_owned(),
            statement: statement(proved, &parts, source.config(), specialised.config()),
            proved,
            display,
            parts,
            source: source.config().clone(),
            specialised: specialised.config().clone(),
            sha256: String::new(),
        };
        certificate.sha256 = certificate.digest();
        certificate
    }

    fn digest(&self) -> String {
        let open = Self { sha256: String::new(), ..self.clone() };
        // Reading from memory cannot fail; an empty digest would fit no certificate that was sealed.
        checksum(open.to_json().as_bytes()).map_or_else(|_| String::new(), |sum| sum.sha256)
    }

    /// As JSON, in the one way to write it.
    #[must_use]
    pub fn to_json(&self) -> String {
        // Plain fields and string keys: serialising cannot fail.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
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

    /// Reads a certificate, and checks that it is as it was sealed.
    ///
    /// # Errors
    /// When it is none, or not as it was written.
    pub fn from_json(text: &str) -> Result<Self, Refused> {
        let certificate: Self = serde_json::from_str(text)?;
        if certificate.format != FORMAT || certificate.version != VERSION {
            return Err(Refused::Version(certificate.format, certificate.version));
        }
        if certificate.to_json() != text || certificate.digest() != certificate.sha256 {
            return Err(Refused::Seal);
        }
        Ok(certificate)
    }

    /// Builds both hardwares again and goes through every x again.
    ///
    /// # Errors
    /// When anything is not as the certificate says.
    pub fn check(&self, progress: &dyn Progress) -> Result<(), Refused> {
        let designs = [&self.source, &self.specialised].map(|config| {
            config.check()?;
            Ok::<_, Refused>(Design::new(config.clone())?)
        });
        let [source, specialised] = designs;
        let (source, specialised) = (source?, specialised?);
        let rows = self.rows(&source, &specialised)?;
        let allowed = match self.proved {
            Proved::BitIdentical => None,
            Proved::Codes { allowed, .. } => Some(allowed),
        };
        let found = certify(&source, &specialised, &rows, self.display, allowed, progress)?;
        let again =
            Self::new(&self.scene, &self.command, self.display, found, (&source, &specialised));
        let differs = |field: &str, said: &dyn std::fmt::Debug, found: &dyn std::fmt::Debug| {
            let (said, found) = (format!("{said:?}"), format!("{found:?}"));
            Err(Refused::Found { field: field.to_owned(), said, found })
        };
        if again.proved != self.proved {
            return differs("proved", &self.proved, &again.proved);
        }
        if let Some((said, found)) = self.parts.iter().zip(&again.parts).find(|(a, b)| a != b) {
            return differs("parts", said, found);
        }
        if again.statement != self.statement {
            return differs("statement", &self.statement, &again.statement);
        }
        if again == *self { Ok(()) } else { Err(Refused::Seal) }
    }

    /// Holds the domain against what a scene asks.
    ///
    /// # Errors
    /// When the scene is another one, or asks for more.
    pub fn holds_for(&self, scene: &str, demands: &[super::Demand]) -> Result<(), Refused> {
        if self.scene != scene {
            let (said, found) = (self.scene.clone(), scene.to_owned());
            return Err(Refused::Found { field: "scene".to_owned(), said, found });
        }
        for demand in demands {
            let n = demand.exponent;
            let place = self.parts.iter().position(|part| part.n == n);
            let covered = place.is_some_and(|index| self.parts[index].least <= demand.least);
            if !covered {
                let problem = format!("the scene asks x from {}", demand.least);
                return Err(Refused::Part { index: place.unwrap_or(self.parts.len()), n, problem });
            }
        }
        Ok(())
    }

    /// The rows of the parts; a part must be what the specialised configuration answers.
    fn rows(&self, source: &Design, specialised: &Design) -> Result<Vec<Row>, Refused> {
        let demands: Vec<super::Demand> = self
            .parts
            .iter()
            .map(|part| super::Demand {
                exponent: part.n,
                least: part.least,
                greatest: 1.0,
                mesh: false,
            })
            .collect();
        let whole = |problem: String| Refused::Part { index: 0, n: f64::NAN, problem };
        let rows =
            super::derive::rows(source, &demands).map_err(|error| whole(error.to_string()))?;
        let exponents = specialised.rom().exponents();
        if !exponents.iter().eq(rows.iter().map(|row| row.demand.exponent)) {
            return Err(whole(format!("the specialised ROM has n = {exponents}, and other parts")));
        }
        let domain = &specialised.config().domain;
        let wrong =
            domain.iter().zip(&rows).position(|(stated, row)| stated.least != row.demand.least);
        match wrong {
            Some(index) => Err(Refused::Part {
                index,
                n: domain[index].n,
                problem: format!("the configuration's domain begins at {}", domain[index].least),
            }),
            None => Ok(rows),
        }
    }
}

fn statement(proved: Proved, parts: &[Part], source: &Config, specialised: &Config) -> String {
    let points: u64 = parts.iter().map(|part| part.points).sum();
    let refused: u64 = parts.iter().map(|part| part.refused).sum();
    let how = match proved {
        Proved::BitIdentical => "the same bits".to_owned(),
        Proved::Codes { allowed, greatest } => format!(
            "display codes of the highlight at full strength that differ by at most {greatest} ({allowed} allowed)"
        ),
    };
    let outside = if specialised.domain.is_empty() {
        "no x from 0 to 1 is outside the domain".to_owned()
    } else {
        format!("all {refused} others from 0 to 1 are refused with out_of_domain")
    };
    format!(
        "{} and {} give {how} at every one of {points} points (n, x); {outside}",
        specialised.name, source.name
    )
}
