//! Errors against x^n, exponent by exponent.

use std::sync::atomic::AtomicU64;

use analysis::error_report::{ErrorRow, Options, error_report};
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors;
use crate::model::Model;

type Column = (&'static str, fn(&ErrorRow) -> f64);

/// The columns of real numbers, named as in the report's files.
const COLUMNS: [Column; 11] = [
    ("n", |row| row.n),
    ("approximation_abs", |row| row.approximation_abs),
    ("approximation_rel", |row| row.approximation_rel),
    ("approximation_x", |row| row.approximation_x),
    ("coefficient_abs", |row| row.coefficient_abs),
    ("datapath_abs", |row| row.datapath_abs),
    ("input_abs", |row| row.input_abs),
    ("total_abs", |row| row.total_abs),
    ("total_x", |row| row.total_x),
    ("full_range_abs", |row| row.full_range_abs),
    ("full_range_x", |row| row.full_range_x),
];

/// The errors of every exponent as columns, a row for each: what `error_vs_n.csv` of `blysk report` holds.
///
/// Errors are fractions of full intensity. `holds` and `full_range_holds` compare the greatest error on the epicentre
/// and on [0, 1] with `bound`. By default corners and an even spread of x are seen; with `exhaustive` every
/// representable x, on all cores. `pandas.DataFrame(blysk.report(model))` is a
/// table.
#[pyfunction]
#[pyo3(signature = (model, *, bound=0.0067, exhaustive=false))]
pub(crate) fn report<'py>(
    py: Python<'py>,
    model: &Model,
    bound: f64,
    exhaustive: bool,
) -> PyResult<Bound<'py, PyDict>> {
    if !(bound > 0.0 && bound <= 1.0) {
        return Err(errors::input("bound: use a number above 0 and at most 1, such as 0.0067 for 0.67 %"));
    }
    let design = model.golden().design();
    let options = Options { bound, exhaustive };
    let report = py.detach(|| error_report(design, options, &AtomicU64::new(0))).map_err(errors::input)?;
    let table = PyDict::new(py);
    for (name, of) in COLUMNS {
        table.set_item(name, report.rows.iter().map(of).collect::<Vec<f64>>().into_pyarray(py))?;
    }
    table.set_item("holds", report.rows.iter().map(|row| row.holds).collect::<Vec<bool>>().into_pyarray(py))?;
    let full_range = report.rows.iter().map(|row| row.full_range_holds);
    table.set_item("full_range_holds", full_range.collect::<Vec<bool>>().into_pyarray(py))?;
    Ok(table)
}
