//! What commands print, as parts of a page: rows as tables, and what a terminal shows.

use std::io::Write;

use page::{Section, Table};

use super::table::Rows;

/// Significant digits of a real in a table of a page, where they need not be all.
pub(super) const DIGITS: usize = 7;
/// All digits of a real, as CSV has them: a proved bound that is shortened is none.
pub(super) const ALL_DIGITS: usize = 17;

/// Rows under their columns, with so many significant digits of a real.
pub(super) fn table(caption: &str, rows: &Rows, significant: usize) -> Table {
    let mut table = Table::new(caption, &rows.columns);
    for row in &rows.rows {
        table.row(row.iter().map(|cell| cell.shown(significant).into()));
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
