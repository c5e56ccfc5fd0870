//! The stimulus file of `blysk simulate --stimulus in.csv`: one line for each clock cycle.
//!
//! | column   | holds                                                              | default |
//! |----------|--------------------------------------------------------------------|---------|
//! | `n`      | the exponent, a number of 1 or more                                |         |
//! | `x`      | x as a real number; rounded to the input format, ties to even      |         |
//! | `x_bits` | instead of `x`: its bits, a signed integer, or a word as `0x…`     |         |
//! | `valid`  | 1 when the cycle offers an input                                   | 1       |
//! | `ready`  | 1 when the receiver takes an output                                | 1       |
//! | `reset`  | 1 to reset                                                         | 0       |
//!
//! The first line names the columns, in any order. Empty lines and lines that begin with `#` do not
//! count. Where
//! `valid` is 0, `n` and `x` may be empty. x need not lie in [0, 1], but the format must hold it. An
//! exponent without a ROM word is no mistake: the hardware answers it with 0 and a status flag.

use std::io::Read;
use std::path::{Path, PathBuf};

use hw_model::format::{Overflow, QFormat};
use hw_model::quantise::{self, x_bits};
use hw_model::rom::Rom;
use thiserror::Error;

use crate::case::Case;
use crate::decimal;
use crate::limits::MOST_CYCLES;
use crate::records::{Record, RecordError, Records};
use crate::text_file::{self, STIMULUS, TextError, TextReader};

/// What one clock cycle puts on the pipeline's input ports.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StimulusLine {
    /// Address and x; both 0 where the file left them empty.
    pub case: Case,
    /// The level of `in_valid`: a request is presented from this cycle on.
    pub valid: bool,
    /// The level of `out_ready`: a result can be taken in this cycle.
    pub ready: bool,
    /// The level of `reset`.
    pub reset: bool,
}

/// Why a stimulus file is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StimulusError {
    /// The file cannot be read, or is no text.
    #[error(transparent)]
    Text(#[from] TextError),
    /// A line, or the line of column names.
    #[error("{}:{line}: {problem}", path.display())]
    Line {
        /// The path of the stimulus.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// A field of a line cannot be used.
    #[error("{}:{line}: field `{field}`: {problem}", path.display())]
    Field {
        /// The path of the stimulus.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// The name of the field's column.
        field: &'static str,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// There is no cycle.
    #[error(
        "{} has no cycles{}; write a line for each clock cycle below the column names", path.display(),
        if *nothing { ": it is empty, or has comments only" } else { "" }
    )]
    Empty {
        /// The path of the stimulus.
        path: PathBuf,
        /// Not even the line of column names is there.
        nothing: bool,
    },
}

/// Reads the stimulus file at `path`; `rom` gives the addresses, `input` is the format of x.
///
/// # Errors
/// Names the file, the line and the field, what is wrong and what would be right.
pub fn read_stimulus(path: &Path, rom: &Rom, input: QFormat) -> Result<Vec<StimulusLine>, StimulusError> {
    parse(text_file::open(path, STIMULUS)?, path, rom, input)
}

/// Reads a stimulus file from anywhere; `path` is for messages.
///
/// # Errors
/// As [`read_stimulus`].
pub fn parse_stimulus(
    from: impl Read,
    path: &Path,
    rom: &Rom,
    input: QFormat,
) -> Result<Vec<StimulusLine>, StimulusError> {
    parse(TextReader::new(from, STIMULUS), path, rom, input)
}

fn parse(
    from: TextReader<impl Read>,
    path: &Path,
    rom: &Rom,
    input: QFormat,
) -> Result<Vec<StimulusLine>, StimulusError> {
    let in_line = |line, problem| StimulusError::Line { path: path.to_owned(), line, problem };
    let refused = |error| match error {
        RecordError::Text(problem) => TextError::new(path, &STIMULUS, problem).into(),
        RecordError::Line { line, problem } => in_line(line, problem),
    };
    let mut records = Records::new(from);
    let Some(Record { line, fields }) = records.next_record().map_err(refused)? else {
        return Err(StimulusError::Empty { path: path.to_owned(), nothing: true });
    };
    let columns = Columns::find(&fields).map_err(|problem| in_line(line, problem))?;
    let mut cycles = Vec::new();
    while let Some(Record { line, fields }) = records.next_record().map_err(refused)? {
        if cycles.len() == MOST_CYCLES {
            let problem = format!("there are more than {MOST_CYCLES} cycles; make several runs");
            return Err(in_line(line, problem));
        }
        let cycle = columns.cycle(&fields, rom, input);
        cycles.push(cycle.map_err(|Wrong { field, problem }| StimulusError::Field {
            path: path.to_owned(),
            line,
            field,
            problem,
        })?);
    }
    if cycles.is_empty() {
        return Err(StimulusError::Empty { path: path.to_owned(), nothing: false });
    }
    Ok(cycles)
}

/// A field that cannot be used.
struct Wrong {
    field: &'static str,
    problem: String,
}

#[derive(Debug, Default)]
struct Columns {
    n: usize,
    x: usize,
    /// True when the column of x holds bits.
    bits: bool,
    valid: Option<usize>,
    ready: Option<usize>,
    reset: Option<usize>,
}

const KNOWN: &str = "the columns are n, x (or x_bits), valid, ready, reset";

impl Columns {
    fn find(header: &[&str]) -> Result<Self, String> {
        let (mut n, mut x, mut x_bits) = (None, None, None);
        let mut columns = Self::default();
        for (place, &name) in header.iter().enumerate() {
            let column = match name {
                "n" => &mut n,
                "x" => &mut x,
                "x_bits" => &mut x_bits,
                "valid" => &mut columns.valid,
                "ready" => &mut columns.ready,
                "reset" => &mut columns.reset,
                _ => return Err(format!("there is no column {name:?}; {KNOWN}")),
            };
            if column.replace(place).is_some() {
                return Err(format!("the column `{name}` is named twice; name it once"));
            }
        }
        columns.n = n.ok_or_else(|| format!("the column `n` is missing; {KNOWN}"))?;
        columns.bits = x_bits.is_some();
        columns.x = match (x, x_bits) {
            (Some(_), Some(_)) => {
                return Err("x is given as `x` and as `x_bits`; give one of them".to_owned());
            }
            (None, None) => return Err(format!("the column `x` is missing; {KNOWN}")),
            (Some(place), None) | (None, Some(place)) => place,
        };
        Ok(columns)
    }

    fn cycle(&self, fields: &[&str], rom: &Rom, input: QFormat) -> Result<StimulusLine, Wrong> {
        let text = |place: usize| fields.get(place).copied().unwrap_or_default();
        let flag = |field, place: Option<usize>, default| match place.map(text) {
            None => Ok(default),
            Some("0") => Ok(false),
            Some("1") => Ok(true),
            Some(other) => Err(Wrong { field, problem: format!("{other:?} is neither 0 nor 1") }),
        };
        let valid = flag("valid", self.valid, true)?;
        let (n, x) = (text(self.n), text(self.x));
        let case = if !valid && n.is_empty() && x.is_empty() {
            Case { exponent: None, address: 0, x: 0 }
        } else {
            let exponent = exponent(n).map_err(|problem| Wrong { field: "n", problem })?;
            let field = if self.bits { "x_bits" } else { "x" };
            let x = if self.bits { bits(x, input) } else { real(x, input) };
            Case::of(rom, exponent, x.map_err(|problem| Wrong { field, problem })?)
        };
        Ok(StimulusLine {
            case,
            valid,
            ready: flag("ready", self.ready, true)?,
            reset: flag("reset", self.reset, false)?,
        })
    }
}

/// The field `n`: an exponent of 1 or more; whether the ROM has it is the hardware's business.
///
/// # Errors
/// What is wrong with the text, and what would be right.
pub fn exponent(text: &str) -> Result<f64, String> {
    match decimal::real(text) {
        Ok(n) if n.is_finite() && n >= 1.0 => Ok(n),
        Ok(_) => Err(format!("{text} is not an exponent; exponents are finite numbers from 1 up")),
        Err(_) => Err(format!("{text:?} is not a number; write an exponent such as 64 or 2.5")),
    }
}

/// The field `x`: the bits of a real number, rounded to the nearest x of the format, ties to even.
///
/// # Errors
/// What is wrong with the text, and what would be right.
pub fn real(text: &str, input: QFormat) -> Result<i64, String> {
    let value = decimal::real(text)
        .map_err(|_| format!("{text:?} is not a number; write x as a decimal such as 0.75, or use `x_bits`"))?;
    x_bits(value, input, Overflow::Refuse).map_err(|error| error.to_string())
}

/// The field `x_bits`: a signed integer, or a word of the format as `0x…`, two's complement where it is signed.
///
/// # Errors
/// What is wrong with the text, and what would be right.
pub fn bits(text: &str, input: QFormat) -> Result<i64, String> {
    let not_bits = |_| format!("{text:?} is not an integer; write the bits of x such as 8388607 or 0x7fffff");
    if let Some(digits) = text.strip_prefix("0x") {
        // A sign would be read as part of the number.
        let digits = digits.strip_prefix('+').map_or(digits, |_| "");
        let word = u64::from_str_radix(digits, 16).map_err(not_bits)?;
        if word >> input.width() != 0 {
            return Err(format!("{text} does not fit the {} bits of {input}", input.width()));
        }
        return Ok(input.from_word(word));
    }
    let bits: i64 = text.parse().map_err(not_bits)?;
    if input.holds(bits.into()) {
        return Ok(bits);
    }
    let (low, high) = (input.min_bits(), input.max_bits());
    Err(format!(
        "{text} does not fit {input}, whose bits are {low} to {high} (x from {} to {})",
        quantise::decimal(low, input),
        quantise::decimal(high, input)
    ))
}
