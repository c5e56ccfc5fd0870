//! The bound of a configuration: its greatest errors against x^n, every representable x counted.

use std::sync::atomic::AtomicU64;

use analysis::hardware_claim::certify_hardware;
use bounds::certify::hardware::Overall;
use hw_model::design::Design;
use pyo3::prelude::*;

use crate::errors;

/// The greatest error over a range of x, as a fraction of full intensity.
#[pyclass(frozen, get_all, module = "blysk")]
#[derive(Clone, Copy)]
pub(crate) struct Worst {
    /// Not less than the greatest error.
    error: f64,
    /// Not more than the greatest error.
    at_least: f64,
    /// The exponent that has it.
    n: f64,
}

#[pymethods]
impl Worst {
    fn __repr__(&self) -> String {
        format!("Worst(error={:?}, n={})", self.error, self.n)
    }
}

/// The greatest errors of a configuration, with every exponent and every representable x counted.
#[pyclass(frozen, get_all, module = "blysk", name = "Bound")]
#[derive(Clone)]
pub(crate) struct Claim {
    /// Over the x with x^n ≥ Q, 1/2 unless the configuration says otherwise.
    epicentre: Worst,
    /// Over all x from 0 to 1.
    full_range: Worst,
    /// How many (n, x) were counted.
    points: u64,
}

#[pymethods]
impl Claim {
    fn __repr__(&self) -> String {
        format!("Bound(epicentre={:?}, full_range={:?})", self.epicentre.error, self.full_range.error)
    }
}

/// The bound of a design, by a sweep over every x.
pub(crate) fn bound(py: Python<'_>, design: &Design) -> PyResult<Claim> {
    let claim = py.detach(|| certify_hardware(design, &AtomicU64::new(0))).map_err(errors::input)?;
    let worst = |of: &Overall| Worst { error: of.upper, at_least: of.lower, n: of.n };
    Ok(Claim { epicentre: worst(&claim.epicentre), full_range: worst(&claim.full_range), points: claim.points })
}
