//! Reading the table.

use std::path::Path;
use std::str::FromStr;

use super::TableError;
use crate::case::Case;
use crate::reference::Expected;

/// One line of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct TableRow {
    /// The line of the memory files, counted from 0.
    pub index: u64,
    /// Why the case was chosen, as a [`Kind`](crate::Kind) prints itself.
    pub kind: String,
    /// The input.
    pub case: Case,
    /// The output.
    pub expected: Expected,
}

/// The cases of the table at `path`, with what is expected of them.
///
/// # Errors
/// Names the line and the column.
pub fn read_table(path: &Path) -> Result<Vec<TableRow>, TableError> {
    let in_file = |cause| TableError::Csv { path: path.to_owned(), cause };
    let mut reader = csv::Reader::from_path(path).map_err(in_file)?;
    let columns = Columns::find(reader.headers().map_err(in_file)?, path)?;
    let row = |record: csv::Result<csv::StringRecord>| {
        columns.row(&Line { path, record: record.map_err(in_file)? })
    };
    reader.records().map(row).collect()
}

struct Columns {
    index: Column,
    kind: Column,
    n: Column,
    address: Column,
    x: Column,
    intensity: Column,
    status: Column,
}

#[derive(Clone, Copy)]
struct Column {
    name: &'static str,
    place: usize,
}

impl Columns {
    fn find(header: &csv::StringRecord, path: &Path) -> Result<Self, TableError> {
        let column = |name| {
            header
                .iter()
                .position(|field| field == name)
                .map(|place| Column { name, place })
                .ok_or_else(|| TableError::Column { path: path.to_owned(), column: name })
        };
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
            case: Case {
                exponent,
                address: line.parsed(self.address, "an address")?,
                x: line.parsed(self.x, "an integer of at most 63 bits")?,
            },
            expected: Expected {
                intensity: line.parsed(self.intensity, "an integer of at most 63 bits")?,
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
    fn text(&self, column: Column) -> &str {
        self.record.get(column.place).unwrap_or_default()
    }

    fn parsed<T: FromStr>(&self, column: Column, wanted: &'static str) -> Result<T, TableError> {
        let text = self.text(column);
        text.parse().map_err(|_| TableError::Field {
            path: self.path.to_owned(),
            line: self.record.position().map_or(0, csv::Position::line),
            column: column.name,
            text: text.to_owned(),
            wanted,
        })
    }
}
