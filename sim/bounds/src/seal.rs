//! Sealed files: certificates that have one way to be written, and say which command wrote them.
//!
//! A sealed file is JSON with `format` and `version` first and `sha256` last: the digest of the same file with that
//! field empty. Reading compares the text with the one way to write it, byte for byte, so that no digit can be another
//! one, not even one that an f64 does not show. A seal is no signature: an attacker who alters a file can seal it
//! again. It tells damage, and nothing of truth; that is what each certificate's own checker is for.

use hw_model::config::Config;
use hw_model::presets;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use thiserror::Error;
use vectors::checksum::checksum;
use vectors::output_text::json;

/// A file that is sealed.
pub trait Sealed: Clone + Serialize + DeserializeOwned {
    /// What the field `format` of such a file says.
    const FORMAT: &'static str;
    /// What `version` says; it changes when an older program could not check what is written.
    const VERSION: u32;
    /// The command that writes such files, for messages.
    const WRITER: &'static str;
    /// What messages call such a file.
    const NOUN: &'static str = "certificate";

    /// The seal, as the field `sha256` has it.
    fn sha256(&self) -> &str;
    /// The field `sha256`, to be filled in.
    fn sha256_mut(&mut self) -> &mut String;
}

/// Why a text is no sealed file of the wanted kind.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Unreadable {
    /// No JSON, or other fields.
    #[error("it is not a {noun} as {writer} writes it: {cause}")]
    Json {
        /// What such a file is called.
        noun: &'static str,
        /// The command that writes such files.
        writer: &'static str,
        /// What is wrong with the JSON.
        cause: serde_json::Error,
    },
    /// Something else, or of another version.
    #[error("it says format {format:?}, version {version}; this program checks {wanted:?}, version {checked}")]
    Version {
        /// What it says it is.
        format: String,
        /// The version that it says.
        version: u32,
        /// What it should be.
        wanted: &'static str,
        /// The version that can be checked.
        checked: u32,
    },
}

/// A file that is not as it was written.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum BrokenSeal {
    /// Not the one way to write it.
    #[error("line {line} is not as this program writes it")]
    Text {
        /// The first such line, counted from 1.
        line: usize,
    },
    /// The statement in words is not the one that the fields give.
    #[error("sha256: the content is not the one that was sealed")]
    Sha256,
    /// Words that do not fit.
    #[error("statement: the claim says otherwise: {0:?}")]
    Statement(String),
}

/// What every sealed file begins with.
#[derive(Deserialize)]
struct Header {
    format: String,
    version: u32,
}

/// Fills in the digest.
#[must_use]
pub fn seal<T: Sealed>(mut file: T) -> T {
    *file.sha256_mut() = digest(&file);
    file
}

/// As JSON, in the one way to write it.
#[must_use]
pub fn to_json<T: Sealed>(file: &T) -> String {
    // A struct of plain fields with string keys: serialising it cannot fail.
    json(file).unwrap_or_default()
}

/// Reads a file. That it can be read says nothing of its truth, nor of its seal.
///
/// # Errors
/// When it is none of the wanted kind and version.
pub fn parse<T: Sealed>(text: &str) -> Result<T, Unreadable> {
    let json = |cause| Unreadable::Json { noun: T::NOUN, writer: T::WRITER, cause };
    let Header { format, version } = serde_json::from_str(text).map_err(json)?;
    if format != T::FORMAT || version != T::VERSION {
        let (wanted, checked) = (T::FORMAT, T::VERSION);
        return Err(Unreadable::Version { format, version, wanted, checked });
    }
    serde_json::from_str(text).map_err(json)
}

/// The text that a file was read from is what was sealed.
///
/// # Errors
/// When it is not.
pub fn check<T: Sealed>(file: &T, text: &str) -> Result<(), BrokenSeal> {
    if file.sha256() != digest(file) {
        return Err(BrokenSeal::Sha256);
    }
    let written = to_json(file);
    if text == written {
        return Ok(());
    }
    let same = text.lines().zip(written.lines()).take_while(|(read, own)| read == own);
    Err(BrokenSeal::Text { line: same.count() + 1 })
}

/// Which configuration a certificate is about, where the user did not say which it must be: a name is no identity.
#[must_use]
pub fn identity(config: &Config) -> String {
    let name = &config.name;
    match presets::find(name).map(|preset| preset.config()) {
        Some(Ok(preset)) if preset == *config => format!("The configuration is preset {name}."),
        Some(_) => format!(
            "The configuration is NOT preset {name}, but one of its own that has the name; say --preset or --config to \
             check which."
        ),
        None => format!("Not checked, as neither --preset nor --config was given: which configuration {name} is."),
    }
}

fn digest<T: Sealed>(file: &T) -> String {
    let mut open = file.clone();
    open.sha256_mut().clear();
    // Reading from memory cannot fail; an empty digest would fit no file that was sealed.
    checksum(to_json(&open).as_bytes()).map_or_else(|_| String::new(), |sum| sum.sha256)
}
