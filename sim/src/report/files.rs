//! `error_vs_n.csv`, the same as JSON, and the plots.

use hw_model::design::Design;
use thiserror::Error;
use vectors::whole_file::{OutputError, OutputSet};

use super::figures;
use crate::analysis::error_report::ErrorReport;
use crate::plot::{Chart, PlotError, svg_to_png};

/// The tables a report writes.
pub const TABLES: [&str; 2] = ["error_vs_n.csv", "error_vs_n.json"];

/// The plots a report writes, each as SVG and PNG.
pub const PLOTS: [&str; 3] = ["error_vs_n", "error_full_range", "curves"];

/// The names of a report's files.
pub fn names() -> impl Iterator<Item = String> {
    let plots = PLOTS.iter().flat_map(|name| ["png", "svg"].map(|end| format!("{name}.{end}")));
    TABLES.into_iter().map(str::to_owned).chain(plots)
}

/// The columns of `error_vs_n.csv`: the fields of a row, in their order.
pub const COLUMNS: [&str; 13] = [
    "n",
    "approximation_abs",
    "approximation_rel",
    "approximation_x",
    "coefficient_abs",
    "datapath_abs",
    "input_abs",
    "total_abs",
    "total_x",
    "full_range_abs",
    "full_range_x",
    "holds",
    "full_range_holds",
];

/// Pixels of a PNG for each unit of its SVG.
const PNG_SCALE: f32 = 2.0;

/// Why a report was not written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FilesError {
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A row that does not become CSV.
    #[error("error_vs_n.csv: {0}")]
    Csv(#[from] csv::Error),
    /// A report that does not become JSON.
    #[error("error_vs_n.json: {0}")]
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

/// Adds every file of a report to `set`. `curves` is an exponent of the ROM, for the plot of curves.
///
/// # Errors
/// When a file cannot be written, or there is nothing to plot.
pub fn write(
    set: &mut OutputSet,
    design: &Design,
    report: &ErrorReport,
    curves: f64,
) -> Result<(), FilesError> {
    let [csv, json] = TABLES;
    set.write(csv, rows_as_csv(report)?)?;
    let mut text = serde_json::to_string_pretty(report)?;
    text.push('\n');
    set.write(json, text)?;
    let charts =
        [figures::epicentre(report), figures::full_range(report), figures::curves(design, curves)];
    for (name, chart) in PLOTS.into_iter().zip(charts) {
        picture(set, name, &chart)?;
    }
    Ok(())
}

fn picture(set: &mut OutputSet, name: &'static str, chart: &Chart) -> Result<(), FilesError> {
    let plot = |source| FilesError::Plot { name, source };
    let svg = chart.to_svg().map_err(plot)?;
    set.write(&format!("{name}.png"), svg_to_png(&svg, PNG_SCALE).map_err(plot)?)?;
    set.write(&format!("{name}.svg"), svg)?;
    Ok(())
}

fn rows_as_csv(report: &ErrorReport) -> Result<Vec<u8>, csv::Error> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    for row in &report.rows {
        csv.serialize(row)?;
    }
    csv.into_inner().map_err(|error| csv::Error::from(error.into_error()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::error_report::ErrorRow;

    #[test]
    fn the_columns_are_the_fields_of_a_row() {
        let row = ErrorRow {
            n: 1.0,
            approximation_abs: 0.0,
            approximation_rel: 0.0,
            approximation_x: 0.0,
            coefficient_abs: 0.0,
            datapath_abs: 0.0,
            input_abs: 0.0,
            total_abs: 0.0,
            total_x: 0.0,
            full_range_abs: 0.0,
            full_range_x: 0.0,
            holds: true,
            full_range_holds: true,
        };
        let mut csv = csv::Writer::from_writer(Vec::new());
        csv.serialize(row).unwrap();
        let text = String::from_utf8(csv.into_inner().unwrap()).unwrap();
        assert_eq!(text.lines().next().unwrap(), COLUMNS.join(","));
    }
}
