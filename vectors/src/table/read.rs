//! Reads `vectors.csv` back, line by line.

use std::fs::File;
use std::io;
use std::path::Path;
use std::str::FromStr;

use super::error::TableError;
use crate::case::Case;
use crate::limits::MAX_VECTORS;
use crate::reference::Expected;
use crate::text_file::{self, TextError, TextReader, VECTOR_TABLE};

/// One line of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct TableRow {
    /// The line of the memory files, counted from 0.
    pub index: u64,
    /// Why the case was chosen, as a [`Kind`](crate::Kind) prints itself.
    pub kind: String,
    /// The input: an address and an x.
    pub case: Case,
    /// The expected output, and every register on the way.
    pub expected: Expected,
}

/// The cases of the table at `path`, with what is expected of them.
///
/// # Errors
/// Names the line and the column.
pub fn read_table(path: &Path) -> Result<Vec<TableRow>, TableError> {
    let (mut reader, header) = open(path)?;
    let columns = Columns::find(&header, path)?;
    let row = |record: csv::Result<csv::StringRecord>| {
        columns.row(&Line { path, record: record.map_err(|cause| in_file(path, cause))? })
    };
    let mut rows = Vec::new();
    for record in reader.records() {
        if rows.len() as u64 == MAX_VECTORS {
            return Err(TableError::Long { path: path.to_owned(), most: MAX_VECTORS });
        }
        rows.push(row(record)?);
    }
    Ok(rows)
}

/// The integers in some columns of the table at `path`, line by line.
///
/// # Errors
/// Names the line and the column.
pub fn read_columns(path: &Path, names: &[&str]) -> Result<Vec<Vec<i64>>, TableError> {
    let (mut reader, header) = open(path)?;
    let columns: Vec<Column<'_>> =
        names.iter().map(|name| Column::find(&header, name, path)).collect::<Result<_, TableError>>()?;
    let line = |record: csv::Result<csv::StringRecord>| {
        let line = Line { path, record: record.map_err(|cause| in_file(path, cause))? };
        columns.iter().map(|&column| line.parsed(column, BITS)).collect()
    };
    reader.records().map(line).collect()
}

/// What the columns of registers hold.
const BITS: &str = "an integer of at most 63 bits";

type Reader = csv::Reader<TextReader<File>>;

fn open(path: &Path) -> Result<(Reader, csv::StringRecord), TableError> {
    let mut reader = csv::Reader::from_reader(text_file::open(path, VECTOR_TABLE)?);
    let header = reader.headers().map_err(|cause| in_file(path, cause))?.clone();
    Ok((reader, header))
}

fn in_file(path: &Path, cause: csv::Error) -> TableError {
    if !cause.is_io_error() {
        return TableError::Csv { path: path.to_owned(), cause };
    }
    let error = match cause.into_kind() {
        csv::ErrorKind::Io(error) => error,
        _ => io::ErrorKind::Other.into(),
    };
    TextError::new(path, &VECTOR_TABLE, error).into()
}

struct Columns {
    index: Column<'static>,
    kind: Column<'static>,
    n: Column<'static>,
    address: Column<'static>,
    x: Column<'static>,
    intensity: Column<'static>,
    status: Column<'static>,
}

#[derive(Clone, Copy)]
struct Column<'a> {
    name: &'a str,
    place: usize,
}

impl<'a> Column<'a> {
    fn find(header: &csv::StringRecord, name: &'a str, path: &Path) -> Result<Self, TableError> {
        let missing = || TableError::Column { path: path.to_owned(), column: name.to_owned() };
        let place = header.iter().position(|field| field == name).ok_or_else(missing)?;
        Ok(Self { name, place })
    }
}

impl Columns {
    fn find(header: &csv::StringRecord, path: &Path) -> Result<Self, TableError> {
        let column = |name| Column::find(header, name, path);
        Ok(Self {
            index: column("index")?,
            kind: column("kind")?,
            n: column("n")?,
            address: column("address")?,
            x: column("x_bits")?,
            intensity: column("intensity_bits")?,
            status: column("status")?,
        })
    }

    fn row(&self, line: &Line<'_>) -> Result<TableRow, TableError> {
        let exponent = match line.text(self.n) {
            "" => None,
            _ => Some(line.parsed(self.n, "an exponent, or empty")?),
        };
        Ok(TableRow {
            index: line.parsed(self.index, "a line number")?,
            kind: line.text(self.kind).to_owned(),
            case: Case { exponent, address: line.parsed(self.address, "an address")?, x: line.parsed(self.x, BITS)? },
            expected: Expected {
                intensity: line.parsed(self.intensity, BITS)?,
                status: line.parsed(self.status, "an integer of 4 bits")?,
            },
        })
    }
}

struct Line<'a> {
    path: &'a Path,
    record: csv::StringRecord,
}

impl Line<'_> {
    fn text(&self, column: Column<'_>) -> &str {
        self.record.get(column.place).unwrap_or_default()
    }

    fn parsed<T: FromStr>(&self, column: Column<'_>, wanted: &'static str) -> Result<T, TableError> {
        let text = self.text(column);
        text.parse().map_err(|_| TableError::Field {
            path: self.path.to_owned(),
            line: self.record.position().map_or(0, csv::Position::line),
            column: column.name.to_owned(),
            text: text.to_owned(),
            wanted,
        })
    }
}
