//! What stands in the ROM, and the real numbers that it stands for: columns of arrays, a row for each address.

use hw_model::design::{Design, RealRow};
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Exponent and every field of each ROM word, as bits in the field's format.
pub(crate) fn rom<'py>(py: Python<'py>, design: &Design) -> PyResult<Bound<'py, PyDict>> {
    let table = PyDict::new(py);
    table.set_item("n", design.rom().exponents().as_slice().to_vec().into_pyarray(py))?;
    for field in design.rom().layout().fields() {
        let bits: Vec<i64> = design.rom().rows().iter().map(|row| row.get(field.name)).collect();
        table.set_item(field.name.name(), bits.into_pyarray(py))?;
    }
    Ok(table)
}

/// The real functions behind each ROM word. Where a row has no such part, its numbers are NaN.
pub(crate) fn coefficients<'py>(py: Python<'py>, design: &Design) -> PyResult<Bound<'py, PyDict>> {
    let rows = design.rows();
    let table = PyDict::new(py);
    let column = |name: String, of: &dyn Fn(&RealRow) -> f64| {
        let values: Vec<f64> = rows.iter().map(of).collect();
        table.set_item(name, values.into_pyarray(py))
    };
    column("n".to_owned(), &|row| row.exponent)?;
    column("q".to_owned(), &|row| 1.0 - row.epicentre)?;
    column("cut".to_owned(), &|row| hw_model::quantise::real(row.cut, design.config().input))?;
    let degree = design.datapath().degree();
    if degree > 0 && !design.is_centred() {
        for power in 0..=degree {
            column(format!("c{power}"), &|row| row.power[power])?;
        }
    } else if degree > 0 {
        for segment in 0..design.config().segments {
            let of = |row: &RealRow, number: &dyn Fn(&hw_model::highlight::Segment) -> f64| {
                row.segments.get(segment).map_or(f64::NAN, |segment| number(&segment.polynomial))
            };
            let suffix = if segment == 0 { String::new() } else { format!("_{segment}") };
            column(format!("start{suffix}"), &|row| of(row, &|polynomial| polynomial.start))?;
            for power in 0..=degree {
                column(format!("c{power}{suffix}"), &|row| of(row, &|polynomial| polynomial.c[power]))?;
            }
        }
    }
    if design.datapath().divider().is_some() {
        column("tail_a".to_owned(), &|row| row.tail.map_or(f64::NAN, |tail| tail.a))?;
        column("tail_b".to_owned(), &|row| row.tail.map_or(f64::NAN, |tail| tail.b))?;
    }
    Ok(table)
}
