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

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use hw_model::format::{Overflow, QFormat};
use hw_model::quantise::{decimal, quantise};
use hw_model::rom::Rom;
use hw_model::rounding::Rounding;
use thiserror::Error;

use crate::case::Case;

/// What one clock cycle puts on the pipeline's input ports.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// Address and x; both 0 where the file left them empty.
    pub case: Case,
    /// `in_valid`.
    pub valid: bool,
    /// `out_ready`.
    pub ready: bool,
    /// `reset`.
    pub reset: bool,
}

/// Why a stimulus file is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StimulusError {
    /// The file cannot be read.
    #[error("cannot read {}: {cause}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// A line is not text.
    #[error("{}:{line}: the line is not UTF-8; write the file as plain text", path.display())]
    NotText {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
    },
    /// The line of column names.
    #[error("{}:{line}: {problem}", path.display())]
    Header {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// A line has too few or too many fields.
    #[error(
        "{}:{line}: there are {found} fields, the first line names {expected} columns", path.display()
    )]
    Fields {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// Fields found.
        found: usize,
        /// Columns named.
        expected: usize,
    },
    /// A field.
    #[error("{}:{line}: field `{field}`: {problem}", path.display())]
    Field {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// The column.
        field: &'static str,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// There is no cycle.
    #[error("{} has no cycles; write a line for each clock cycle below the column names", .0.display())]
    Empty(PathBuf),
}

/// Reads the stimulus file at `path`; `rom` gives the addresses, `input` is the format of x.
///
/// # Errors
/// Names the file, the line and the field, what is wrong and what would be right.
pub fn read_stimulus(path: &Path, rom: &Rom, input: QFormat) -> Result<Vec<Cycle>, StimulusError> {
    match File::open(path) {
        Ok(file) => parse_stimulus(file, path, rom, input),
        Err(cause) => Err(StimulusError::Io { path: path.to_owned(), cause }),
    }
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
) -> Result<Vec<Cycle>, StimulusError> {
    let mut columns: Option<Columns> = None;
    let mut cycles = Vec::new();
    for (line, text) in (1..).zip(BufReader::new(from).lines()) {
        let text = text.map_err(|cause| unreadable(path, line, cause))?;
        let text = text.trim_start_matches(BYTE_ORDER_MARK).trim();
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        let fields: Vec<&str> = text.split(',').map(unquoted).collect();
        let path = || path.to_owned();
        let Some(columns) = &columns else {
            let found = Columns::find(&fields);
            let header = |problem| StimulusError::Header { path: path(), line, problem };
            columns = Some(found.map_err(header)?);
            continue;
        };
        if fields.len() != columns.count {
            let (found, expected) = (fields.len(), columns.count);
            return Err(StimulusError::Fields { path: path(), line, found, expected });
        }
        let cycle = columns.cycle(&fields, rom, input);
        cycles.push(cycle.map_err(|Wrong { field, problem }| StimulusError::Field {
            path: path(),
            line,
            field,
            problem,
        })?);
    }
    if cycles.is_empty() { Err(StimulusError::Empty(path.to_owned())) } else { Ok(cycles) }
}

/// What some editors put in front of the first line.
const BYTE_ORDER_MARK: char = '\u{feff}';

fn unreadable(path: &Path, line: u64, cause: io::Error) -> StimulusError {
    let path = path.to_owned();
    match cause.kind() {
        io::ErrorKind::InvalidData => StimulusError::NotText { path, line },
        _ => StimulusError::Io { path, cause },
    }
}

/// A field without the space around it, or the quotes that some programs put around every field.
fn unquoted(field: &str) -> &str {
    let field = field.trim();
    let inner = field.strip_prefix('"').and_then(|field| field.strip_suffix('"'));
    inner.unwrap_or(field)
}

/// A field that cannot be used.
struct Wrong {
    field: &'static str,
    problem: String,
}

#[derive(Debug, Default)]
struct Columns {
    count: usize,
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
        let mut columns = Self { count: header.len(), ..Self::default() };
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

    fn cycle(&self, fields: &[&str], rom: &Rom, input: QFormat) -> Result<Cycle, Wrong> {
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
        Ok(Cycle {
            case,
            valid,
            ready: flag("ready", self.ready, true)?,
            reset: flag("reset", self.reset, false)?,
        })
    }
}

/// An exponent of 1 or more; whether the ROM has it is the hardware's business.
fn exponent(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(n) if n.is_finite() && n >= 1.0 => Ok(n),
        Ok(_) => Err(format!("{text} is not an exponent; exponents are finite numbers from 1 up")),
        Err(_) => Err(format!("{text:?} is not a number; write an exponent such as 64 or 2.5")),
    }
}

fn real(text: &str, input: QFormat) -> Result<i64, String> {
    let value: f64 = text.parse().map_err(|_| {
        format!("{text:?} is not a number; write x as a decimal such as 0.75, or use `x_bits`")
    })?;
    quantise(value, input, Rounding::NearestEven, Overflow::Refuse)
        .map_err(|error| error.to_string())
}

/// A signed integer, or a word of the format as `0x…`, two's complement where it is signed.
fn bits(text: &str, input: QFormat) -> Result<i64, String> {
    let not_bits =
        |_| format!("{text:?} is not an integer; write the bits of x such as 8388607 or 0x7fffff");
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
        decimal(low, input),
        decimal(high, input)
    ))
}
