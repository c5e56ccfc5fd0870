//! Reads a log of answers, CSV with a line for each vector, into bits by column.

use std::fs::File;
use std::path::{Path, PathBuf};

use hw_model::format::QFormat;

use super::column::{Column, Got, INTENSITY};
use super::error::AnswersError;
use crate::memory_file::{Value, value};
use crate::records::{Record, RecordError, Records};
use crate::text_file::{self, ANSWER_LOG, TextError};

const INDEX: &str = "index";

/// A log under way.
pub(super) struct Log {
    path: PathBuf,
    records: Records<File>,
    index: Option<usize>,
    columns: Vec<Placed>,
    /// The line that answers each vector; 0 where none has so far.
    lines: Vec<u64>,
    /// Answers read so far.
    answered: usize,
}

/// A column of the log that is compared.
struct Placed {
    column: Column,
    place: usize,
    /// Whether its numbers begin with `0x`: `0x12` may as well be four digits with an unknown one. The
    /// first number decides.
    prefixed: Option<bool>,
}

/// A line of the log.
pub(super) struct Answer {
    /// The vector it answers.
    pub(super) index: usize,
    /// The line, counted from 1.
    pub(super) line: u64,
    /// What it says, in the order of [`Log::columns`].
    pub(super) values: Vec<Got>,
}

impl Log {
    /// Opens a log of `count` answers; `known` is what it may have, in the order of comparison.
    pub(super) fn open(path: &Path, known: Vec<Column>, count: usize) -> Result<Self, AnswersError> {
        let mut records = Records::new(text_file::open(path, ANSWER_LOG)?);
        let header = records.next_record().map_err(|error| refused(path, error))?;
        let line = header.as_ref().map_or(1, |header| header.line);
        let names = header.map_or_else(Vec::new, |header| header.fields);
        let (index, columns) = places(&names, known).map_err(|problem| {
            let empty = if names.is_empty() { "the file is empty, or has comments only: " } else { "" };
            AnswersError::Line { path: path.to_owned(), line, problem: format!("{empty}{problem}") }
        })?;
        let (path, lines) = (path.to_owned(), vec![0; count]);
        Ok(Self { path, records, index, columns, lines, answered: 0 })
    }

    /// What is compared, in order: registers first, then ports.
    pub(super) fn columns(&self) -> impl Iterator<Item = &Column> {
        self.columns.iter().map(|placed| &placed.column)
    }

    /// The vectors that no line answered, once all are read.
    pub(super) fn unanswered(&self) -> impl Iterator<Item = usize> {
        (0..).zip(&self.lines).filter(|(_, line)| **line == 0).map(|(index, _)| index)
    }

    /// The next line; none at the end.
    pub(super) fn next_answer(&mut self) -> Result<Option<Answer>, AnswersError> {
        let Self { path, records, index, columns, lines, answered } = self;
        let record = records.next_record().map_err(|error| refused(path, error))?;
        let Some(Record { line, fields }) = record else {
            return if *answered == 0 { Err(AnswersError::Empty(path.clone())) } else { Ok(None) };
        };
        let in_line = |problem| AnswersError::Line { path: path.clone(), line, problem };
        let in_field = |column: &str, problem| {
            let (path, column) = (path.clone(), column.to_owned());
            AnswersError::Field { path, line, column, problem }
        };
        let field = |place: usize| fields.get(place).copied().unwrap_or_default();
        let index = match *index {
            None => next_index(*answered, lines.len()).map_err(in_line)?,
            Some(place) => named_index(field(place), lines).map_err(|problem| in_field(INDEX, problem))?,
        };
        let mut values = Vec::with_capacity(columns.len());
        for placed in columns {
            let value = placed.value(field(placed.place));
            values.push(value.map_err(|problem| in_field(&placed.column.name, problem))?);
        }
        if let Some(answering) = lines.get_mut(index) {
            *answering = line;
        }
        *answered += 1;
        Ok(Some(Answer { index, line, values }))
    }
}

fn refused(path: &Path, error: RecordError) -> AnswersError {
    match error {
        RecordError::Text(problem) => TextError::new(path, &ANSWER_LOG, problem).into(),
        RecordError::Line { line, problem } => AnswersError::Line { path: path.to_owned(), line, problem },
    }
}

/// Without an index the lines are in the order of the vectors.
fn next_index(next: usize, count: usize) -> Result<usize, String> {
    let many = || format!("this answer is one too many; the bundle has {count} vectors");
    (next < count).then_some(next).ok_or_else(many)
}

/// `lines` has the line that answers each vector.
fn named_index(text: &str, lines: &[u64]) -> Result<usize, String> {
    let last = lines.len().saturating_sub(1);
    let index: usize = text
        .parse()
        .map_err(|_| format!("{text:?} is no index; write the vector's number in decimal, from 0 to {last}"))?;
    match lines.get(index) {
        None => Err(format!("{index} is out of range; the vectors are 0 to {last}")),
        Some(0) => Ok(index),
        Some(line) => Err(format!("vector {index} is answered twice, first in line {line}")),
    }
}

/// Where the index is, if anywhere, and the known columns that the header names.
fn places(header: &[&str], known: Vec<Column>) -> Result<(Option<usize>, Vec<Placed>), String> {
    const COLUMNS: &str = "the columns are index, intensity, status, and the registers that \
                           vectors.csv names, such as front_end.region";
    let mut index = None;
    let mut found: Vec<Option<usize>> = vec![None; known.len()];
    for (place, &full_name) in header.iter().enumerate() {
        let name = full_name.strip_suffix("_hex").unwrap_or(full_name);
        let taken = match known.iter().position(|column| column.name == name) {
            Some(column) => &mut found[column],
            None if name == INDEX => &mut index,
            None => return Err(format!("there is no column {full_name:?}; {COLUMNS}")),
        };
        if taken.replace(place).is_some() {
            return Err(format!("the column `{name}` is named twice; name it once"));
        }
    }
    let placed = known
        .into_iter()
        .zip(found)
        .filter_map(|(column, place)| place.map(|place| Placed { column, place, prefixed: None }));
    let placed: Vec<Placed> = placed.collect();
    if placed.iter().any(|placed| placed.column.name == INTENSITY) {
        Ok((index, placed))
    } else {
        Err(format!("the column `{INTENSITY}` is missing; {COLUMNS}"))
    }
}

impl Placed {
    fn value(&mut self, text: &str) -> Result<Got, String> {
        let format = self.column.format;
        let after = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
        let alike = "write the numbers of a column alike";
        let digits = match (after, self.prefixed) {
            (Some(digits), None | Some(true)) => {
                self.prefixed = Some(true);
                digits
            }
            (None, Some(true)) => {
                return Err(format!("{text:?} has no 0x, which the numbers above it have; {alike}"));
            }
            // Too long for a word with an unknown digit.
            (Some(_), Some(false)) if text.len() > digits(format) => {
                return Err(format!("{text:?} has 0x, which the numbers above it have not; {alike}"));
            }
            _ => text,
        };
        match value(digits) {
            None => Err(format!("{text:?} is not a hex number; write digits such as 7fff or 0x7fff")),
            Some(Value::Unknown(_)) => Ok(Got::Unknown(text.to_owned())),
            Some(Value::Known(word)) => {
                self.prefixed.get_or_insert(false);
                let word = u64::try_from(word).ok().filter(|word| word >> format.width() == 0);
                let wide = || format!("{text} does not fit the {} bits of {format}", format.width());
                word.map(|word| Got::Known(format.from_word(word))).ok_or_else(wide)
            }
        }
    }
}

/// Hex digits of a word.
fn digits(format: QFormat) -> usize {
    format.width().div_ceil(4) as usize
}
