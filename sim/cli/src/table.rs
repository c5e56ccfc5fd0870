//! Tables on standard output, for people (`table`) or for programs (`csv`, `json`).

use std::io::Write;

use clap::ValueEnum;
use comfy_table::{CellAlignment, ContentArrangement, Table};
use serde::Serialize;
use serde::ser::SerializeMap;

pub(super) use vectors::digits::digits;
use vectors::output_text::io_error;

/// The widest line of a table for people; longer cells are folded.
const TERMINAL_WIDTH: u16 = 100;

/// How a table is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(super) enum Format {
    /// For people, at most 100 columns wide.
    #[default]
    Table,
    /// Comma-separated values with a header.
    Csv,
    /// An array of objects.
    Json,
}

/// A cell: text, or a number that JSON shows as a number.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub(super) enum Cell {
    Text(String),
    Integer(i64),
    /// Printed with 17 significant digits in CSV.
    Real(f64),
    /// n: it names a row, so that people see all of its digits too.
    Exponent(f64),
    Flag(bool),
    /// No value: an empty field, JSON null.
    None,
}

impl Cell {
    /// The cell as people see it: a real with `significant` digits.
    pub(super) fn shown(&self, significant: usize) -> String {
        match self {
            Self::Real(real) => digits(*real, significant),
            Self::Exponent(exponent) => shortest(*exponent),
            cell => cell.text(),
        }
    }

    /// The cell as CSV has it.
    fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Integer(integer) => integer.to_string(),
            Self::Real(real) | Self::Exponent(real) => digits(*real, 17),
            Self::Flag(flag) => flag.to_string(),
            Self::None => String::new(),
        }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}
impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}
impl From<f64> for Cell {
    fn from(real: f64) -> Self {
        Self::Real(real)
    }
}
impl From<i64> for Cell {
    fn from(integer: i64) -> Self {
        Self::Integer(integer)
    }
}
impl From<bool> for Cell {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}
impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::None, Into::into)
    }
}

/// The shortest text that no other number has: 64, 2.5, 1000001, 1e9.
fn shortest(value: f64) -> String {
    let (plain, scientific) = (value.to_string(), format!("{value:e}"));
    if scientific.len() < plain.len() { scientific } else { plain }
}

/// `1 light`, `2 lights`.
pub(super) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Text whose lines are at most [`TERMINAL_WIDTH`] columns wide: a wider one goes on in further lines, each with an
/// indent. A longer word has a line of its own.
pub(super) fn folded(text: &str, indent: &str) -> String {
    text.split('\n').map(|line| folded_line(line, indent)).collect::<Vec<_>>().join("\n")
}

fn folded_line(text: &str, indent: &str) -> String {
    let width = |text: &str| text.chars().count();
    let (mut lines, mut begun) = (Vec::new(), false);
    let words = text.trim_start();
    let mut line = text[..text.len() - words.len()].to_owned();
    for word in words.split(' ') {
        if begun && width(&line) + 1 + width(word) > usize::from(TERMINAL_WIDTH) {
            lines.push(std::mem::replace(&mut line, indent.to_owned()));
            begun = false;
        }
        line.push_str(if begun { " " } else { "" });
        line.push_str(word);
        begun = true;
    }
    lines.push(line);
    lines.join("\n")
}

/// Writes text on lines of at most [`TERMINAL_WIDTH`] columns; a longer word has a line of its own.
pub(super) fn write_folded(out: &mut dyn Write, text: &str) -> std::io::Result<()> {
    writeln!(out, "{}", folded(text, ""))
}

/// Rows under named columns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rows {
    pub columns: Vec<String>,
    pub rows: Vec<Vec<Cell>>,
}

impl Rows {
    pub(super) fn new(columns: &[&str]) -> Self {
        Self { columns: columns.iter().map(|&name| name.to_owned()).collect(), rows: Vec::new() }
    }

    pub(super) fn push(&mut self, row: Vec<Cell>) {
        debug_assert_eq!(row.len(), self.columns.len());
        self.rows.push(row);
    }

    /// Writes the rows; in a table for people, reals have `significant` digits.
    pub(super) fn print(&self, out: &mut dyn Write, format: Format, significant: usize) -> anyhow::Result<()> {
        match format {
            Format::Table => Ok(writeln!(out, "{}", self.table(significant).trim_fmt())?),
            Format::Csv => self.csv(out),
            Format::Json => self.json(out),
        }
    }

    pub(super) fn csv(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        // As the I/O errors they are: a closed pipe must not hide in another type.
        csv.write_record(&self.columns).map_err(io_error)?;
        for row in &self.rows {
            csv.write_record(row.iter().map(Cell::text)).map_err(io_error)?;
        }
        Ok(csv.flush()?)
    }

    pub(super) fn json(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let objects: Vec<Object<'_>> = self.rows.iter().map(|row| Object { columns: &self.columns, row }).collect();
        serde_json::to_writer_pretty(&mut *out, &objects).map_err(std::io::Error::from)?;
        Ok(writeln!(out)?)
    }

    fn table(&self, significant: usize) -> Table {
        let mut table = Table::new();
        table
            .load_style(comfy_table::presets::NOTHING)
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(TERMINAL_WIDTH)
            .set_header(&self.columns);
        for row in &self.rows {
            table.add_row(row.iter().map(|cell| cell.shown(significant)));
        }
        for (index, column) in table.column_iter_mut().enumerate() {
            let numbers = self.rows.iter().any(|row| !matches!(row[index], Cell::Text(_)));
            column.set_padding((0, 2));
            if numbers {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        table
    }
}

/// A row with its column names, in their order.
struct Object<'a> {
    columns: &'a [String],
    row: &'a [Cell],
}

impl Serialize for Object<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.row.len()))?;
        for (column, cell) in self.columns.iter().zip(self.row) {
            map.serialize_entry(column, cell)?;
        }
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wide_line_goes_on_below() {
        let words = vec!["twelve chars"; 20].join(" ");
        let folded = folded(&format!("  a name  {words}\nshort"), "    ");
        let lines: Vec<&str> = folded.lines().collect();
        assert!(lines.len() == 4 && lines.iter().all(|line| line.len() <= 100), "{folded}");
        assert!(lines[0].starts_with("  a name  twelve") && lines[1].starts_with("    ") && lines[3] == "short");
        let long = "x".repeat(120);
        assert_eq!(super::folded(&format!("error: {long} end"), "    "), format!("error:\n    {long}\n    end"));
    }
}
