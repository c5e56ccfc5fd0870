//! One highlight, with every register on the way.

use hw_model::datapath::Datapath;
use hw_model::format::QFormat;
use hw_model::quantise::{decimal, real};
use serde::{Deserialize, Serialize};
use vectors::digits::digits;
use vectors::evaluate::{Answer, Held, Question};
use vectors::stimulus_file::{self, bits, exponent};

use crate::configuration::Configuration;
use crate::known::Known;
use crate::refusal::Refusal;
use crate::words::{Format, Range, Real, Word};

/// Which highlight.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HighlightAsk {
    /// Of which hardware.
    pub(crate) configuration: Configuration,
    n: String,
    x: X,
}

/// x as somebody wrote it.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum X {
    /// A real number, rounded to the input format.
    Real(String),
    /// Bits in the input format, an integer or `0x…`.
    Bits(String),
}

/// The answer, as `blysk evaluate --ranks` prints it.
#[derive(Debug, Serialize)]
pub(crate) struct Highlight {
    n: Real,
    x: Port,
    intensity: Port,
    reference: Real,
    error_ulp: Real,
    error_per_cent: Real,
    region: &'static str,
    status: String,
    ranks: Vec<Rank>,
}

/// A word on a port.
#[derive(Debug, Serialize)]
struct Port {
    format: Format,
    bits: String,
    hex: String,
    value: f64,
    /// As people read it.
    text: String,
    /// With all its decimals.
    decimal: String,
}

#[derive(Debug, Serialize)]
struct Rank {
    name: String,
    registers: Vec<Register>,
}

#[derive(Debug, Serialize)]
struct Register {
    #[serde(flatten)]
    word: Word,
    range: Range,
}

/// The question (n, x), read as the `blysk` command reads it.
///
/// # Errors
/// When the texts are no numbers that could be asked about.
pub(crate) fn question(datapath: &Datapath, n: &str, x: &X) -> Result<Question, Refusal> {
    let input = datapath.formats().input;
    let n = exponent(n.trim()).map_err(|problem| Refusal::unusable(format!("n: {problem}")))?;
    let x = match x {
        X::Real(text) => stimulus_file::real(text.trim(), input),
        X::Bits(text) => bits(text.trim(), input),
    };
    Ok(Question::of(datapath.rom(), n, x.map_err(|problem| Refusal::unusable(format!("x: {problem}")))?))
}

impl Highlight {
    /// Asks the data path.
    ///
    /// # Errors
    /// When the question is none.
    pub(crate) fn of(known: &Known, ask: &HighlightAsk) -> Result<Self, Refusal> {
        let datapath = known.datapath();
        let answer = Answer::of(datapath, question(datapath, &ask.n, &ask.x)?);
        let reference = answer.reference(datapath).unwrap_or(0.0);
        let error = answer.value(datapath) - reference;
        let (input, output) = (datapath.formats().input, datapath.formats().output);
        Ok(Self {
            n: Real::new(answer.question.exponent.unwrap_or(0.0), 17),
            x: Port::new(input, answer.question.x),
            intensity: Port::new(output, answer.intensity),
            reference: Real::new(reference, 17),
            error_ulp: Real::new(answer.error_ulp(datapath, reference), 6),
            error_per_cent: Real::new(error * 100.0, 4),
            region: answer.region.name(),
            status: answer.status.to_string(),
            ranks: ranks(known, &answer.question),
        })
    }
}

impl Port {
    fn new(format: QFormat, bits: i64) -> Self {
        let value = real(bits, format);
        Self {
            format: format.into(),
            bits: bits.to_string(),
            hex: format!("0x{:x}", format.to_word(bits)),
            value,
            text: digits(value, 17),
            decimal: decimal(bits, format),
        }
    }
}

fn ranks(known: &Known, question: &Question) -> Vec<Rank> {
    let held = Held::of_question(known.datapath(), question);
    let ranks = held.iter().zip(known.ranges()).enumerate();
    ranks
        .map(|(rank, (held, ranges))| Rank {
            name: known.datapath().rank_name(rank),
            registers: held
                .iter()
                .zip(ranges)
                .map(|(held, range)| Register { word: held.into(), range: range.clone() })
                .collect(),
        })
        .collect()
}
