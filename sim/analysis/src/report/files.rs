//! `error_vs_n.csv`, the same as JSON, and the plots.

use hw_model::design::Design;
use vectors::whole_file::OutputSet;

use super::figures;
use super::written::{self, FilesError};
use crate::error_report::ErrorReport;
use plot::Chart;

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

/// The exponent of the plot of curves where none was asked for: 64, or the middle one of the configuration.
#[must_use]
pub fn exponent_of_curves(design: &Design) -> f64 {
    let exponents = design.rom().exponents();
    if exponents.position(64.0).is_some() { 64.0 } else { exponents.as_slice()[exponents.len() / 2] }
}

/// The charts of [`PLOTS`], in their order. `curves` is an exponent of the ROM, for the plot of curves.
#[must_use]
pub fn charts(design: &Design, report: &ErrorReport, curves: f64) -> [Chart; 3] {
    [figures::epicentre(report), figures::full_range(report), figures::curves(design, curves)]
}

/// Adds every file of a report to `set`. `curves` is an exponent of the ROM, for the plot of curves.
///
/// # Errors
/// When a file cannot be written, or there is nothing to plot.
pub fn write(set: &mut OutputSet, design: &Design, report: &ErrorReport, curves: f64) -> Result<(), FilesError> {
    let [csv, json] = TABLES;
    set.write(csv, written::table(csv, &report.rows)?)?;
    set.write(json, written::json(json, report)?)?;
    for (name, chart) in PLOTS.into_iter().zip(charts(design, report, curves)) {
        written::picture(set, name, &chart)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error_report::ErrorRow;

    #[test]
    fn the_columns_are_the_fields_of_a_row() {
        let row = ErrorRow {
            n: 1.0,
            approximation_abs: 0.0,
            approximation_rel: 0.0,
            approximation_x: 0.0,
            coefficient_abs: 0.0,
            coefficient_x: 0.0,
            datapath_abs: 0.0,
            datapath_x: 0.0,
            input_abs: 0.0,
            total_abs: 0.0,
            total_x: 0.0,
            full_range_abs: 0.0,
            full_range_x: 0.0,
            holds: true,
            full_range_holds: true,
        };
        let text = String::from_utf8(written::table("error_vs_n.csv", &[row]).unwrap()).unwrap();
        assert_eq!(text.lines().next().unwrap(), COLUMNS.join(","));
    }
}
