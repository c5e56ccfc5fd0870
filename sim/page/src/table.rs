//! A table whose rows can be sorted and searched in the page.

/// One cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cell {
    /// Text, or a number as it is to be read.
    Text(String),
    /// Markup of the program's own, such as `<code>t3</code>`: it is not escaped.
    Markup(String),
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self::Text(text.into())
    }
}

impl Cell {
    /// True for a number, or for nothing, which a column of numbers may have.
    fn is_numeric(&self) -> bool {
        match self {
            Self::Text(text) | Self::Markup(text) => text.is_empty() || text.replace('−', "-").parse::<f64>().is_ok(),
        }
    }

    fn is_empty(&self) -> bool {
        match self {
            Self::Text(text) | Self::Markup(text) => text.is_empty(),
        }
    }
}

/// Columns with their names, and rows.
#[derive(Debug, Clone, Default)]
pub struct Table {
    pub(super) caption: String,
    pub(super) columns: Vec<Cell>,
    pub(super) rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows. The caption says what it shows; an empty one leaves that to the text around it.
    #[must_use]
    pub fn new<C: Into<Cell> + Clone>(caption: impl Into<String>, columns: &[C]) -> Self {
        let columns = columns.iter().cloned().map(Into::into).collect();
        Self { caption: caption.into(), columns, rows: Vec::new() }
    }

    /// Adds a row of as many cells as there are columns.
    pub fn row(&mut self, cells: impl IntoIterator<Item = Cell>) {
        let row: Vec<Cell> = cells.into_iter().collect();
        debug_assert_eq!(row.len(), self.columns.len(), "a row of table \"{}\"", self.caption);
        self.rows.push(row);
    }

    /// For each column whether it has numbers alone, which stand at the right of their cells.
    pub(super) fn numeric(&self) -> Vec<bool> {
        let of = |column: usize| {
            let mut cells = self.rows.iter().filter_map(|row| row.get(column)).peekable();
            cells.peek().is_some() && cells.clone().any(|cell| !cell.is_empty()) && cells.all(Cell::is_numeric)
        };
        (0..self.columns.len()).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_of_numbers_is_known_as_one() {
        let mut table = Table::new("", &["n", "known", "least", "nothing"]);
        table.row(["1".into(), "exact".into(), "−3".into(), "".into()]);
        table.row(["2.5e9".into(), "4".into(), "".into(), "".into()]);
        assert_eq!(table.numeric(), [true, false, true, false]);
        assert_eq!(Table::new("", &["n"]).numeric(), [false]);
    }
}
