//! `pareto.csv`, `pareto_timing.csv`, both as JSON, and the plots. What depends on the machine stands in
//! files and fields of its own.

use vectors::whole_file::OutputSet;

use super::pareto_figures::figures;
use super::written::{self, FilesError};
use crate::pareto::{ContenderRow, ParetoReport};

/// The table that is the same run after run.
pub const TABLE: &str = "pareto.csv";
/// The table that is of one machine.
pub(crate) const TIMING_TABLE: &str = "pareto_timing.csv";
/// Everything.
pub const JSON: &str = "pareto.json";

/// The tables, and the same as JSON.
pub const TABLES: [&str; 3] = [TABLE, TIMING_TABLE, JSON];

/// Adds every file to `set`, and returns their names, a picture's without its end.
///
/// # Errors
/// When a file cannot be written or a picture not be drawn.
pub fn write(set: &mut OutputSet, report: &ParetoReport) -> Result<Vec<String>, FilesError> {
    let mut names = vec![TABLE.to_owned()];
    set.write(TABLE, table(report)?)?;
    match timing_table(report)? {
        Some(table) => {
            set.write(TIMING_TABLE, table)?;
            names.push(TIMING_TABLE.to_owned());
        }
        // Times of an earlier run do not belong to these errors.
        None => set.obsolete(TIMING_TABLE),
    }
    set.write(JSON, json(report)?)?;
    names.push(JSON.to_owned());
    for (name, chart) in figures(report) {
        written::picture(set, name, &chart)?;
        names.push(name.to_owned());
    }
    Ok(names)
}

/// `pareto.csv`.
///
/// # Errors
/// When a row does not become CSV.
pub fn table(report: &ParetoReport) -> Result<Vec<u8>, FilesError> {
    written::table(TABLE, &report.contenders)
}

/// `pareto_timing.csv`, where times were measured.
///
/// # Errors
/// When a row does not become CSV.
pub(crate) fn timing_table(report: &ParetoReport) -> Result<Option<Vec<u8>>, FilesError> {
    report.timing.as_ref().map(|timing| written::table(TIMING_TABLE, &timing.rows)).transpose()
}

/// Everything as JSON.
///
/// # Errors
/// When it does not become JSON.
pub fn json(report: &ParetoReport) -> Result<String, FilesError> {
    written::json(JSON, report)
}

/// Reads a `pareto.csv` back.
///
/// # Errors
/// When it is none.
pub fn read(text: &str) -> Result<Vec<ContenderRow>, FilesError> {
    let named = |cause| FilesError::Csv { name: TABLE.to_owned(), cause };
    csv::Reader::from_reader(text.as_bytes()).deserialize().collect::<Result<_, _>>().map_err(named)
}
