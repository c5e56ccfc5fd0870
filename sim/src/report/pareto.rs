//! `pareto.csv`, `pareto_timing.csv`, both as JSON, and the plots. What depends on the machine stands in
//! files and fields of its own.

use serde::Serialize;
use thiserror::Error;
use vectors::whole_file::{OutputError, OutputSet};

use super::pareto_figures::figures;
use crate::analysis::pareto::{ParetoReport, Row};
use crate::plot::{PlotError, svg_to_png};

/// The table that is the same run after run.
pub const TABLE: &str = "pareto.csv";
/// The table that is of one machine.
pub const TIMING_TABLE: &str = "pareto_timing.csv";
/// The file that has everything: errors, costs, times and synthesis.
pub const JSON: &str = "pareto.json";

/// The tables, and the same as JSON.
pub const TABLES: [&str; 3] = [TABLE, TIMING_TABLE, JSON];

/// Pixels of a PNG for each unit of its SVG.
const PNG_SCALE: f32 = 2.0;

/// Why a comparison was not written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ParetoFilesError {
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A table that does not become CSV, or is none.
    #[error("{name}: {source}")]
    Csv {
        /// The name of the table's file.
        name: &'static str,
        /// Why the row does not become CSV.
        source: csv::Error,
    },
    /// A comparison that does not become JSON.
    #[error("{JSON}: {0}")]
    Json(#[from] serde_json::Error),
    /// A plot cannot be drawn.
    #[error("{name}: {source}")]
    Plot {
        /// The name of the plot's file, without its end.
        name: &'static str,
        /// Why it cannot be drawn.
        source: PlotError,
    },
}

/// Adds every file to `set`, and returns their names, a picture's without its end.
///
/// # Errors
/// When a file cannot be written or a picture not be drawn.
pub fn write(set: &mut OutputSet, report: &ParetoReport) -> Result<Vec<String>, ParetoFilesError> {
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
        let plot = |source| ParetoFilesError::Plot { name, source };
        let svg = chart.to_svg().map_err(plot)?;
        set.write(&format!("{name}.png"), svg_to_png(&svg, PNG_SCALE).map_err(plot)?)?;
        set.write(&format!("{name}.svg"), svg)?;
        names.push(name.to_owned());
    }
    Ok(names)
}

/// `pareto.csv`.
///
/// # Errors
/// When a row does not become CSV.
pub fn table(report: &ParetoReport) -> Result<Vec<u8>, ParetoFilesError> {
    csv(TABLE, &report.contenders)
}

/// `pareto_timing.csv`, where times were measured.
///
/// # Errors
/// When a row does not become CSV.
pub fn timing_table(report: &ParetoReport) -> Result<Option<Vec<u8>>, ParetoFilesError> {
    report.timing.as_ref().map(|timing| csv(TIMING_TABLE, &timing.rows)).transpose()
}

/// Everything as JSON.
///
/// # Errors
/// When it does not become JSON.
pub fn json(report: &ParetoReport) -> Result<String, ParetoFilesError> {
    let mut text = serde_json::to_string_pretty(report)?;
    text.push('\n');
    Ok(text)
}

/// Reads a `pareto.csv` back.
///
/// # Errors
/// When it is none.
pub fn read(text: &str) -> Result<Vec<Row>, ParetoFilesError> {
    let named = |source| ParetoFilesError::Csv { name: TABLE, source };
    csv::Reader::from_reader(text.as_bytes()).deserialize().collect::<Result<_, _>>().map_err(named)
}

fn csv(name: &'static str, rows: &[impl Serialize]) -> Result<Vec<u8>, ParetoFilesError> {
    let named = |source| ParetoFilesError::Csv { name, source };
    let mut csv = csv::Writer::from_writer(Vec::new());
    for row in rows {
        csv.serialize(row).map_err(named)?;
    }
    csv.into_inner().map_err(|error| named(csv::Error::from(error.into_error())))
}
