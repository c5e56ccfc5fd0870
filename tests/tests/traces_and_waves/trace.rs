//! A trace read back.

use std::collections::HashMap;

/// A trace: a cell for each column in each cycle; `None` where it says `x`.
pub struct Trace {
    columns: HashMap<String, usize>,
    pub header: Vec<String>,
    cycles: Vec<Vec<Option<i64>>>,
}

impl Trace {
    pub fn read(text: &str) -> Self {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
        let columns: HashMap<String, usize> =
            header.iter().enumerate().map(|(place, name)| (name.clone(), place)).collect();
        assert_eq!(columns.len(), header.len(), "a column is named twice");
        let cell = |cell: &str| (cell != "x").then(|| cell.parse().expect("an integer or x"));
        let cycles: Vec<Vec<_>> = reader.records().map(|line| line.unwrap().iter().map(cell).collect()).collect();
        assert!(!cycles.is_empty(), "an empty trace shows nothing");
        Self { columns, header, cycles }
    }

    pub fn len(&self) -> usize {
        self.cycles.len()
    }

    /// What a column has in a cycle; `None` is unknown.
    pub fn get(&self, cycle: usize, column: &str) -> Option<i64> {
        let place = self.columns.get(column).unwrap_or_else(|| panic!("no column {column}"));
        self.cycles[cycle][*place]
    }

    /// A column that is never unknown.
    pub fn value(&self, cycle: usize, column: &str) -> i64 {
        self.get(cycle, column).unwrap_or_else(|| panic!("cycle {cycle}: {column} is unknown"))
    }

    /// A column of one bit that is never unknown.
    pub fn flag(&self, cycle: usize, column: &str) -> bool {
        let value = self.value(cycle, column);
        assert!(value == 0 || value == 1, "cycle {cycle}: {column} is {value}");
        value == 1
    }
}
