//! Checking a certificate of specialised hardware.
//!
//! What it is about comes from the user where the user says it ([`Asked`]), and everything it says of that is found
//! again. The certificate proposes two configurations and an x to begin at for each exponent; nothing else of it is
//! taken. `docs/CERTIFICATES.md` goes through every field.
//!
//! | field | is |
//! |---|---|
//! | `format`, `version`, `sha256` | the file is whole: [`bounds::seal`] |
//! | `source` | the configuration asked for, where one is; else a proposal, named in the sentence |
//! | `specialised` | the source with rows, parts and bits left out, and nothing else changed |
//! | `display`, `scene`, `parts[].n`, `.least` | those of the scene, where one is given; else proposals, named |
//! | `proved`, the rest of `parts`, `statement` | found again: every x of every part through both data paths |
//! | `command` | a label |

use std::sync::atomic::AtomicU64;

use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::format::QFormat;

use super::certificate::{Certificate, Display, Part, Proved};
use super::codes::pixels_outside;
use super::compare::certify;
use super::demand::{Demand, demands};
use super::derive::{AskedRow, kept, served_rows, serving};
use super::refused::Refused;
use super::serve::{with_words, words_beside};
use crate::render::samples;
use crate::scene::{DISPLAY_BITS, Scene};
use bounds::seal::{BrokenSeal, identity};
use vectors::progress::Progress;

/// What the user says the certificate must be about.
#[derive(Debug, Clone, Copy, Default)]
pub struct Asked<'a> {
    /// The scene whose picture the hardware is for.
    pub scene: Option<&'a Scene>,
    /// The configuration that is answered as.
    pub source: Option<&'a Config>,
    /// The most display codes that answers may differ by.
    pub codes: Option<u16>,
}

/// What holds, and what was not looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct Held {
    /// What was proved, and of what.
    pub statement: String,
    /// What the checker knows from the certificate alone, a sentence each.
    pub not_checked: Vec<String>,
    /// The configuration that answers: what a file beside the certificate must say.
    pub specialised: Config,
}

/// How many x a certificate says it is about, for a bar; none where it cannot be read.
#[must_use]
pub fn inputs(text: &str) -> Option<u64> {
    Certificate::parse(text).ok().map(|certificate| certificate.inputs())
}

/// Checks a certificate's text: seal, subject, both hardwares, and every x again.
///
/// # Errors
/// When anything is not as the certificate says, or it is not about what was asked.
pub fn check(text: &str, asked: Asked<'_>, progress: &dyn Progress) -> Result<Held, Refused> {
    let certificate = Certificate::parse(text)?;
    certificate.check_seal(text)?;
    check_display(&certificate)?;
    check_asked(&certificate, asked)?;
    let source = design(&certificate.source)?;
    let specialised = design(&certificate.specialised)?;
    let rows = own_rows(&certificate, &source, &specialised)?;
    check_left_out(&certificate, &source, &rows)?;
    find_again(&certificate, (&source, &specialised), &rows, progress)?;
    Ok(Held {
        statement: certificate.statement.clone(),
        not_checked: not_checked(&certificate, asked),
        specialised: certificate.specialised,
    })
}

fn design(config: &Config) -> Result<Design, Refused> {
    config.check()?;
    Ok(Design::new(config.clone())?)
}

/// The display is one that a scene can have: its codes are counted in lists of 2^bits.
fn check_display(certificate: &Certificate) -> Result<(), Refused> {
    let Display { bits, .. } = certificate.display;
    let field = |field: &str, problem| Err(Refused::Field { field: field.to_owned(), problem });
    if !DISPLAY_BITS.contains(&bits) {
        return field("display.bits", format!("{bits} bits; a scene has 8, 10 or 12"));
    }
    if let Proved::Codes { allowed, greatest } = certificate.proved
        && greatest > allowed
    {
        return field("proved", format!("{greatest} codes are more than the {allowed} allowed"));
    }
    Ok(())
}

/// The certificate is about what the user gave.
fn check_asked(certificate: &Certificate, asked: Asked<'_>) -> Result<(), Refused> {
    let other = |field, said: String, asked: String| Err(Refused::Asked { field, said, asked });
    if let Some(source) = asked.source
        && wanted_source(certificate, source)? != certificate.source
    {
        let said = match certificate.source.name == source.name {
            true => format!("another configuration of the name {}", source.name),
            false => certificate.source.name.clone(),
        };
        return other("source", said, source.name.clone());
    }
    if let Some(most) = asked.codes
        && let Proved::Codes { greatest, .. } = certificate.proved
        && greatest > most
    {
        return other("proved", format!("answers that differ by {greatest} codes"), format!("at most {most}"));
    }
    let Some(scene) = asked.scene else { return Ok(()) };
    if certificate.scene != scene.name {
        return other("scene", certificate.scene.clone(), scene.name.clone());
    }
    let shown = Display { bits: scene.image.display_bits, transfer: scene.image.transfer };
    if certificate.display != shown {
        return other("display", certificate.display.to_string(), shown.to_string());
    }
    let demands = demands(scene);
    // Bounds are those of real places; a picture that f64 cannot compute within them is not bounded at all.
    let pixels = samples(scene, &AtomicU64::new(0));
    if let Some((n, x)) = pixels_outside(scene, &pixels, &demands) {
        let problem = format!("a pixel presents x = {x} with n = {n}, outside what was bounded");
        return Err(Refused::Field { field: "scene".to_owned(), problem });
    }
    check_demands(certificate, &demands)
}

/// The configuration asked for, with a word for each exponent that the certificate is about.
fn wanted_source(certificate: &Certificate, source: &Config) -> Result<Config, Refused> {
    let exponents = certificate.parts.iter().map(|part| part.n);
    let problem =
        |error: &dyn std::fmt::Display| Refused::Field { field: "parts".to_owned(), problem: error.to_string() };
    with_words(source, exponents).map_err(|error| problem(&error))
}

/// The domain holds all that the scene asks, and no other exponent.
fn check_demands(certificate: &Certificate, demands: &[Demand]) -> Result<(), Refused> {
    let refused = |index, n, problem| Err(Refused::Part { index, n, problem });
    for demand in demands {
        let n = demand.exponent;
        let place = certificate.parts.iter().position(|part| part.n == n);
        let covered = place.is_some_and(|index| certificate.parts[index].least <= demand.least);
        if !covered {
            let problem = format!("the scene asks x from {}", demand.least);
            return refused(place.unwrap_or(certificate.parts.len()), n, problem);
        }
    }
    let asked = |n: f64| demands.iter().any(|demand| demand.exponent == n);
    match certificate.parts.iter().position(|part| !asked(part.n)) {
        Some(index) => refused(index, certificate.parts[index].n, "the scene does not ask for it".to_owned()),
        None => Ok(()),
    }
}

/// The rows of the parts; a part must be what the specialised configuration answers.
fn own_rows(certificate: &Certificate, source: &Design, specialised: &Design) -> Result<Vec<AskedRow>, Refused> {
    let demand = |(index, part): (usize, &Part)| match part.least {
        least if (0.0..=1.0).contains(&least) => Ok(Demand { exponent: part.n, least, greatest: 1.0 }),
        least => {
            let problem = format!("least is {least}; it is an x from 0 to 1");
            Err(Refused::Part { index, n: part.n, problem })
        }
    };
    let demands = certificate.parts.iter().enumerate().map(demand).collect::<Result<Vec<_>, _>>()?;
    let whole = |problem: String| Refused::Field { field: "parts".to_owned(), problem };
    if !certificate.parts.is_sorted_by(|one, next| one.n < next.n) {
        return Err(whole("n does not rise from part to part; each exponent has one".to_owned()));
    }
    let own_or_other = |part: &Part| part.served.map_or(part.n, |served| served.row);
    let rows_of: Vec<f64> = certificate.parts.iter().map(own_or_other).collect();
    let rows = served_rows(source, &demands, &rows_of).map_err(|error| whole(error.to_string()))?;
    let exponents = specialised.rom().exponents();
    if !exponents.iter().eq(serving(&rows)) {
        return Err(whole(format!("the specialised ROM has n = {exponents}, and other parts")));
    }
    Ok(rows)
}

/// The specialised configuration is the source with rows, parts and bits left out: what specialisation does not
/// change is as it is in the source.
fn check_left_out(certificate: &Certificate, source: &Design, rows: &[AskedRow]) -> Result<(), Refused> {
    let specialised = &certificate.specialised;
    let wrong = |problem: String| Refused::Field { field: "specialised".to_owned(), problem };
    let mut wanted = kept(source, rows, &certificate.scene).map_err(|error| wrong(error.to_string()))?;
    // Widths are what is specialised; that answers stay the same is found by going through every x.
    wanted.widths = specialised.widths;
    if let Proved::Codes { .. } = certificate.proved
        && is_shorter(specialised.output, wanted.output)
    {
        wanted.output = specialised.output;
        // Steps are in last places, and there are others.
        wanted.coefficient_steps = Vec::new();
        let ends = source.config().widths.of_ends();
        wanted.widths = ends;
    }
    if wanted == *specialised {
        return Ok(());
    }
    Err(wrong(format!(
        "it is not {} with rows, parts and bits left out: {}",
        source.config().name,
        difference(&wanted, specialised)
    )))
}

/// The same integer bits, and fewer fraction bits.
fn is_shorter(output: QFormat, than: QFormat) -> bool {
    output.is_signed() == than.is_signed()
        && output.integer_bits() == than.integer_bits()
        && output.fraction_bits() < than.fraction_bits()
}

/// The first field of two configurations that differs.
fn difference(wanted: &Config, found: &Config) -> String {
    let [wanted, found] = [wanted, found].map(|config| {
        let lines: Vec<String> = config.to_json().lines().map(|line| line.trim().to_owned()).collect();
        lines
    });
    let pair = wanted.iter().zip(&found).find(|(wanted, found)| wanted != found);
    pair.map_or_else(
        || "one of the two has a field more".to_owned(),
        |(wanted, found)| format!("`{wanted}` became `{found}`"),
    )
}

/// Everything that was found, found again.
fn find_again(
    certificate: &Certificate,
    (source, specialised): (&Design, &Design),
    rows: &[AskedRow],
    progress: &dyn Progress,
) -> Result<(), Refused> {
    let Certificate { scene, command, display, proved, parts, statement, .. } = certificate;
    let allowed = match *proved {
        Proved::BitIdentical => None,
        Proved::Codes { allowed, .. } => Some(allowed),
    };
    let found = certify(source, specialised, rows, *display, allowed, progress)?;
    let again = Certificate::new(scene, command, *display, found, (source, specialised));
    let differs = |field: &str, said: &dyn std::fmt::Debug, found: &dyn std::fmt::Debug| {
        let (said, found) = (format!("{said:?}"), format!("{found:?}"));
        Err(Refused::Found { field: field.to_owned(), said, found })
    };
    if again.proved != *proved {
        return differs("proved", proved, &again.proved);
    }
    if let Some((said, found)) = parts.iter().zip(&again.parts).find(|(a, b)| a != b) {
        return differs("parts", said, found);
    }
    if again.statement != *statement {
        return differs("statement", statement, &again.statement);
    }
    // What is left are fields that were looked at before, and the seal that follows from all.
    if again == *certificate { Ok(()) } else { Err(BrokenSeal::Sha256.into()) }
}

/// What the certificate alone says.
fn not_checked(certificate: &Certificate, asked: Asked<'_>) -> Vec<String> {
    let Certificate { scene, source, display, parts, .. } = certificate;
    let mut sentences = Vec::new();
    if asked.scene.is_none() {
        let asked = parts.iter().map(|part| format!("n = {} from x = {}", part.n, part.least));
        sentences.push(format!(
            "Not checked, as no scene was given: that the scene {scene} asks for no more than {}, and that it is shown \
             with {display}.",
            asked.collect::<Vec<_>>().join(", ")
        ));
    }
    match asked.source {
        None => sentences.push(identity(source)),
        Some(asked) => sentences.extend(words_beside(asked, source)),
    }
    if asked.codes.is_none()
        && let Proved::Codes { allowed, .. } = certificate.proved
    {
        sentences.push(format!(
            "That codes may differ by up to {allowed} is what the certificate says; say --allow-codes N to demand it."
        ));
    }
    sentences
}
