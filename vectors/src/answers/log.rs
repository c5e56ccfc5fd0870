//! Reading the log.

use std::fs::File;
use std::path::{Path, PathBuf};

use hw_model::format::QFormat;

use super::{AnswersError, Column, Got, INTENSITY};
use crate::memory_file::{Value, value};

const INDEX: &str = "index";

/// A log under way.
pub(super) struct Log {
    path: PathBuf,
    reader: csv::Reader<File>,
    record: csv::StringRecord,
    /// Columns that the first line names.
    width: usize,
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
    pub(super) fn open(
        path: &Path,
        known: Vec<Column>,
        count: usize,
    ) -> Result<Self, AnswersError> {
        let in_file = |cause| AnswersError::Csv { path: path.to_owned(), cause };
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .comment(Some(b'#'))
            .flexible(true)
            .from_path(path)
            .map_err(in_file)?;
        let header = reader.headers().map_err(in_file)?.clone();
        let (index, columns) = places(&header, known).map_err(|problem| {
            let line = header.position().map_or(1, csv::Position::line);
            AnswersError::Line { path: path.to_owned(), line, problem }
        })?;
        let record = csv::StringRecord::new();
        let (path, width, lines) = (path.to_owned(), header.len(), vec![0; count]);
        Ok(Self { path, reader, record, width, index, columns, lines, answered: 0 })
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
        match self.reader.read_record(&mut self.record) {
            Err(cause) => return Err(AnswersError::Csv { path: self.path.clone(), cause }),
            Ok(false) if self.answered == 0 => return Err(AnswersError::Empty(self.path.clone())),
            Ok(false) => return Ok(None),
            Ok(true) => {}
        }
        let line = self.record.position().map_or(0, csv::Position::line);
        let in_line = |problem| AnswersError::Line { path: self.path.clone(), line, problem };
        let in_field = |column: &str, problem| {
            let (path, column) = (self.path.clone(), column.to_owned());
            AnswersError::Field { path, line, column, problem }
        };
        if self.record.len() != self.width {
            let (found, width) = (self.record.len(), self.width);
            let problem = format!("there are {found} fields, the first line names {width} columns");
            return Err(in_line(problem));
        }
        let index = match self.index {
            None => self.next_index().map_err(in_line)?,
            Some(place) => self.named_index(place).map_err(|problem| in_field(INDEX, problem))?,
        };
        let mut values = Vec::with_capacity(self.columns.len());
        for placed in &mut self.columns {
            let value = placed.value(self.record.get(placed.place).unwrap_or_default());
            values.push(value.map_err(|problem| in_field(&placed.column.name, problem))?);
        }
        self.lines[index] = line;
        self.answered += 1;
        Ok(Some(Answer { index, line, values }))
    }

    /// Without an index the lines are in the order of the vectors.
    fn next_index(&self) -> Result<usize, String> {
        let (next, count) = (self.answered, self.lines.len());
        let many = || format!("this answer is one too many; the bundle has {count} vectors");
        (next < count).then_some(next).ok_or_else(many)
    }

    fn named_index(&self, place: usize) -> Result<usize, String> {
        let text = self.record.get(place).unwrap_or_default();
        let last = self.lines.len().saturating_sub(1);
        let index: usize = text.parse().map_err(|_| {
            format!("{text:?} is no index; write the vector's number in decimal, from 0 to {last}")
        })?;
        match self.lines.get(index) {
            None => Err(format!("{index} is out of range; the vectors are 0 to {last}")),
            Some(0) => Ok(index),
            Some(line) => Err(format!("vector {index} is answered twice, first in line {line}")),
        }
    }
}

/// Where the index is, if anywhere, and the known columns that the header names.
fn places(
    header: &csv::StringRecord,
    known: Vec<Column>,
) -> Result<(Option<usize>, Vec<Placed>), String> {
    const COLUMNS: &str = "the columns are index, intensity, status, and the registers that \
                           vectors.csv names, such as front_end.region";
    let mut index = None;
    let mut found: Vec<Option<usize>> = vec![None; known.len()];
    for (place, full_name) in header.iter().enumerate() {
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
                return Err(format!(
                    "{text:?} has no 0x, which the numbers above it have; {alike}"
                ));
            }
            // Too long for a word with an unknown digit.
            (Some(_), Some(false)) if text.len() > digits(format) => {
                return Err(format!(
                    "{text:?} has 0x, which the numbers above it have not; {alike}"
                ));
            }
            _ => text,
        };
        match value(digits) {
            None => {
                Err(format!("{text:?} is not a hex number; write digits such as 7fff or 0x7fff"))
            }
            Some(Value::Unknown(_)) => Ok(Got::Unknown(text.to_owned())),
            Some(Value::Known(word)) => {
                self.prefixed.get_or_insert(false);
                let word = u64::try_from(word).ok().filter(|word| word >> format.width() == 0);
                let wide =
                    || format!("{text} does not fit the {} bits of {format}", format.width());
                word.map(|word| Got::Known(format.from_word(word))).ok_or_else(wide)
            }
        }
    }
}

/// Hex digits of a word.
fn digits(format: QFormat) -> usize {
    format.width().div_ceil(4) as usize
}
