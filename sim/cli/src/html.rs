//! What commands print, as parts of a page: rows as tables, and what a terminal shows.

use std::io::Write;

use page::{Section, Table};

use super::table::Rows;

/// Significant digits of a real in a table of a page; CSV has all of them.
const DIGITS: usize = 7;

/// Rows under their columns.
pub(super) fn table(caption: &str, rows: &Rows) -> Table {
    let mut table = Table::new(caption, &rows.columns);
    for row in &rows.rows {
        table.row(row.iter().map(|cell| cell.shown(DIGITS).into()));
    }
    table
}

/// What a command prints, word for word.
pub(super) fn printed(
    title: &str,
    print: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
) -> anyhow::Result<Section> {
    let mut bytes = Vec::new();
    print(&mut bytes)?;
    Ok(Section::new(title).lines(String::from_utf8_lossy(&bytes).trim_end()))
}
