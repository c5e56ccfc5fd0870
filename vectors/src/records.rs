//! Lines of fields between commas, as a log or a stimulus has them: numbers, of which none has a comma.
//!
//! Empty lines and lines that begin with `#` do not count. A field may have space around it, or the quotes that some
//! programs put around every field. Lines are read one by one: a quote that is not closed swallows none.

use std::io::{BufRead, Read};

use crate::text_file::{TextProblem, TextReader, foreign_separator, why_other_count};

/// What some programs write in front of the first line, also where it became a line in the middle.
const MARK: char = '\u{feff}';

/// Why a line is refused.
#[derive(Debug)]
pub(crate) enum RecordError {
    /// It cannot be read.
    Text(TextProblem),
    /// A line has another shape or other values than a record may have.
    Line {
        /// The number of the line, counted from 1.
        line: u64,
        /// What is wrong, and what would be right.
        problem: String,
    },
}

/// One line of a CSV file, split into its fields.
#[derive(Debug)]
pub(crate) struct Record<'a> {
    /// The number of the line, counted from 1.
    pub(crate) line: u64,
    /// As many as there are columns.
    pub(crate) fields: Vec<&'a str>,
}

/// A file of records.
#[derive(Debug)]
pub(crate) struct Records<R> {
    reader: TextReader<R>,
    text: String,
    line: u64,
    columns: Option<usize>,
}

impl<R: Read> Records<R> {
    pub(crate) fn new(reader: TextReader<R>) -> Self {
        Self { reader, text: String::new(), line: 0, columns: None }
    }

    /// The next line; none at the end. The first one names the columns.
    pub(crate) fn next_record(&mut self) -> Result<Option<Record<'_>>, RecordError> {
        loop {
            self.text.clear();
            let count = self.reader.read_line(&mut self.text);
            if count.map_err(|error| RecordError::Text(error.into()))? == 0 {
                return Ok(None);
            }
            self.line += 1;
            let text = self.text.trim_start_matches(MARK).trim_start();
            if !text.is_empty() && !text.starts_with('#') {
                break;
            }
        }
        let line = self.line;
        let text = self.text.trim_start_matches(MARK).trim();
        let fields: Vec<&str> = text.split(',').map(unquoted).collect();
        let found = fields.len();
        let wrong = |problem| Err(RecordError::Line { line, problem });
        match self.columns {
            None => match foreign_separator(text) {
                Some(problem) => return wrong(problem),
                None => self.columns = Some(found),
            },
            Some(columns) if columns != found => {
                let why = why_other_count(&fields, columns);
                return wrong(format!("there are {found} fields, the first line names {columns} columns{why}"));
            }
            Some(_) => {}
        }
        Ok(Some(Record { line, fields }))
    }
}

fn unquoted(field: &str) -> &str {
    let field = field.trim();
    let inner = field.strip_prefix('"').and_then(|field| field.strip_suffix('"'));
    inner.map_or(field, str::trim)
}
