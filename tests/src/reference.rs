//! The table of 32-digit coefficients and error maxima, `tests/data/reference.csv`.

use std::path::Path;

/// Rows the table holds: six methods, thirty exponents each.
pub const ROWS: usize = 180;

/// One method at one exponent.
pub struct Row {
    /// The name of the method.
    pub method: String,
    /// The exponent of the row.
    pub exponent: f64,
    cells: Vec<(String, String)>,
}

impl Row {
    /// The value in a column; `None` where the method has none.
    ///
    /// # Panics
    /// When the table has no such column, or the cell is not a number.
    #[must_use]
    pub fn value(&self, column: &str) -> Option<f64> {
        let cell = self.cells.iter().find(|(name, _)| name == column);
        let (_, text) = cell.unwrap_or_else(|| panic!("the table has no column {column:?}"));
        let parse = |text: &String| {
            let place = format!("{} n = {}, {column}", self.method, self.exponent);
            text.parse().unwrap_or_else(|_| panic!("{place}: {text:?} is not a number"))
        };
        (!text.is_empty()).then(|| parse(text))
    }
}

/// Every row of the table.
///
/// # Panics
/// When the file is missing or malformed, or does not have exactly [`ROWS`] rows: a test that
/// compared nothing must not pass.
#[must_use]
pub fn rows() -> Vec<Row> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/reference.csv");
    let mut reader = csv::Reader::from_path(&path).expect("tests/data/reference.csv is there");
    let header = reader.headers().expect("the table has a header").clone();
    let rows: Vec<Row> = reader
        .records()
        .map(|record| {
            let record = record.expect("every row has as many cells as the header");
            let cells: Vec<_> =
                header.iter().zip(&record).map(|(name, text)| (name.to_owned(), text.to_owned())).collect();
            Row { method: record[0].to_owned(), exponent: record[1].parse().expect("n is a number"), cells }
        })
        .collect();
    assert_eq!(rows.len(), ROWS, "rows in {}", path.display());
    rows
}
