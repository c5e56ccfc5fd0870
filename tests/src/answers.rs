//! Logs of answers, as a user's simulation would write them: right answers, which tests then spoil.

use crate::cli::Bench;

/// A log: the names of its columns, and its lines.
#[derive(Debug, Clone)]
pub struct Log {
    /// The names of the columns, as in the log's header.
    pub columns: Vec<String>,
    /// Every field of every line.
    pub lines: Vec<Vec<String>>,
}

impl Log {
    /// What a right design answers to the vectors in a directory of the bench: the index, every register
    /// of the table, intensity and status, in hex with `0x`.
    ///
    /// # Panics
    /// When there are no vectors.
    #[must_use]
    pub fn right(bench: &Bench, directory: &str) -> Self {
        let table = bench.text(&format!("{directory}/vectors.csv"));
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let header = reader.headers().expect("a header").clone();
        let wanted = |name: &str| ["index", "status"].contains(&name) || (name.ends_with("_hex") && name != "x_hex");
        let places: Vec<usize> = (0..header.len()).filter(|&place| wanted(&header[place])).collect();
        let field = |line: &csv::StringRecord, place: usize| match &header[place] {
            // Its four bits are the only ones that the table has no column of hex for.
            "status" => format!("0x{:x}", line[place].parse::<u8>().expect("a status")),
            _ => line[place].to_owned(),
        };
        let lines: Vec<Vec<String>> = reader
            .records()
            .map(|line| line.expect("a line"))
            .map(|line| places.iter().map(|&place| field(&line, place)).collect())
            .collect();
        assert!(!lines.is_empty(), "no vectors");
        let name = |&place: &usize| header[place].trim_end_matches("_hex").to_owned();
        Self { columns: places.iter().map(name).collect(), lines }
    }

    /// The log as CSV.
    #[must_use]
    pub fn text(&self) -> String {
        let lines = std::iter::once(&self.columns).chain(&self.lines);
        lines.map(|line| format!("{}\n", line.join(","))).collect()
    }

    /// The place of a column.
    ///
    /// # Panics
    /// When there is none.
    #[must_use]
    pub fn place(&self, column: &str) -> usize {
        let found = self.columns.iter().position(|name| name == column);
        found.unwrap_or_else(|| panic!("there is no column {column}"))
    }

    /// A field.
    ///
    /// # Panics
    /// When there is none.
    pub fn field(&mut self, line: usize, column: &str) -> &mut String {
        let place = self.place(column);
        &mut self.lines[line][place]
    }

    /// Turns the lowest bit of a field over.
    ///
    /// # Panics
    /// When it is no hex number with `0x`.
    pub fn spoil(&mut self, line: usize, column: &str) {
        let field = self.field(line, column);
        let bits = u64::from_str_radix(&field[2..], 16).expect("hex");
        *field = format!("0x{:01$x}", bits ^ 1, field.len() - 2);
    }

    /// The log with these columns only.
    #[must_use]
    pub fn only(&self, columns: &[&str]) -> Self {
        let places: Vec<usize> = columns.iter().map(|column| self.place(column)).collect();
        let line = |line: &Vec<String>| places.iter().map(|&place| line[place].clone()).collect();
        Self { columns: line(&self.columns), lines: self.lines.iter().map(line).collect() }
    }

    /// The log with every field but the index changed by `change`.
    #[must_use]
    pub fn spelt(&self, change: impl Fn(&str) -> String) -> Self {
        let mut spelt = self.clone();
        for line in &mut spelt.lines {
            for (field, column) in line.iter_mut().zip(&self.columns) {
                if column != "index" {
                    *field = change(field);
                }
            }
        }
        spelt
    }
}
