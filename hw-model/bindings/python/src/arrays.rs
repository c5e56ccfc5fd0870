//! numpy arrays in and out: what a caller may give, and the one conversion that it costs.
//!
//! An array of the wanted type in one piece of memory is read where it lies. Other whole or real numbers (lists, other
//! types, slices with gaps) are converted once, by numpy. What is no such number is refused.

use model::Error;
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;

use crate::errors;

/// Whole numbers: one, or an array.
pub(crate) enum Whole<'py> {
    One(i64),
    Wide(PyReadonlyArrayDyn<'py, i64>),
    Narrow(PyReadonlyArrayDyn<'py, u32>),
    /// Converted here from real numbers; with the shape that they had.
    Made(Vec<i64>, Vec<usize>),
}

impl<'py> Whole<'py> {
    /// Of what a caller gave as `what`.
    pub(crate) fn of(given: &Bound<'py, PyAny>, what: &str) -> PyResult<Self> {
        if given.cast::<PyUntypedArray>().is_err()
            && let Ok(one) = given.extract::<i64>()
        {
            return Ok(Self::One(one));
        }
        if let Some(array) = in_place(given)? {
            return Ok(Self::Wide(array));
        }
        if let Some(array) = in_place(given)? {
            return Ok(Self::Narrow(array));
        }
        let wanted = "whole numbers: give int64 or uint32";
        Ok(Self::Wide(converted(given, what, wanted, "int64", &["i1", "i2", "i4", "i8", "u1", "u2", "u4"])?))
    }

    pub(crate) fn shape(&self) -> Option<&[usize]> {
        match self {
            Self::One(_) => None,
            Self::Wide(array) => Some(array.shape()),
            Self::Narrow(array) => Some(array.shape()),
            Self::Made(_, shape) => Some(shape),
        }
    }
}

/// Real numbers: one, or an array.
pub(crate) enum Reals<'py> {
    One(f64),
    Many(PyReadonlyArrayDyn<'py, f64>),
}

impl<'py> Reals<'py> {
    /// Of what a caller gave as `what`.
    pub(crate) fn of(given: &Bound<'py, PyAny>, what: &str) -> PyResult<Self> {
        if given.cast::<PyUntypedArray>().is_err()
            && let Ok(one) = given.extract::<f64>()
        {
            return Ok(Self::One(one));
        }
        if let Some(array) = in_place(given)? {
            return Ok(Self::Many(array));
        }
        let kinds = ["i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "f2", "f4", "f8"];
        converted(given, what, "real numbers: give float64", "float64", &kinds).map(Self::Many)
    }

    fn shape(&self) -> Option<&[usize]> {
        match self {
            Self::One(_) => None,
            Self::Many(array) => Some(array.shape()),
        }
    }

    /// Each of them as a whole number.
    pub(crate) fn each(&self, to: impl Fn(f64) -> Result<i64, Error>) -> PyResult<Whole<'py>> {
        match self {
            Self::One(real) => to(*real).map(Whole::One).map_err(errors::refused),
            Self::Many(array) => {
                let whole = array.as_slice()?.iter().map(|&real| to(real)).collect::<Result<_, _>>();
                Ok(Whole::Made(whole.map_err(errors::refused)?, array.shape().to_vec()))
            }
        }
    }
}

/// The array itself, where it has this type and lies in one piece.
pub(crate) fn in_place<'py, T: Element>(given: &Bound<'py, PyAny>) -> PyResult<Option<PyReadonlyArrayDyn<'py, T>>> {
    match given.cast::<PyArrayDyn<T>>() {
        Ok(array) if array.is_c_contiguous() => Ok(Some(array.try_readonly().map_err(errors::in_use)?)),
        _ => Ok(None),
    }
}

pub(crate) fn numpy(py: Python<'_>) -> PyResult<Bound<'_, PyModule>> {
    py.import(intern!(py, "numpy"))
}

/// An array of type `to` from another, which may be of these `kinds`.
pub(crate) fn converted<'py, T: Element>(
    given: &Bound<'py, PyAny>,
    what: &str,
    wanted: &str,
    to: &str,
    kinds: &[&str],
) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
    let py = given.py();
    let refused = |has: &str| PyTypeError::new_err(format!("{what} are {wanted}, not {has}"));
    let numpy = numpy(py)?;
    let array = numpy.call_method1("asarray", (given,)).map_err(|_| refused("a list of lists of other lengths"))?;
    let dtype = array.getattr("dtype")?;
    let kind: String = dtype.getattr("str")?.extract()?;
    if !kinds.contains(&kind.trim_start_matches(['<', '>', '|', '='])) {
        return Err(refused(&dtype.str()?.to_string_lossy()));
    }
    // A number has no dimension, and ascontiguousarray gives it one.
    let shape = array.getattr("shape")?;
    let array = numpy.call_method1("ascontiguousarray", (array, to))?.call_method1("reshape", (shape,))?;
    Ok(array.cast::<PyArrayDyn<T>>()?.try_readonly()?)
}

/// Both brought to one shape, where both are arrays of different shapes or only the second is a number.
pub(crate) fn broadcast<'py>(
    first: &Bound<'py, PyAny>,
    second: &Bound<'py, PyAny>,
    shapes: (Option<&[usize]>, Option<&[usize]>),
) -> PyResult<Option<(Bound<'py, PyAny>, Bound<'py, PyAny>)>> {
    match shapes {
        (None, _) => return Ok(None),
        (Some(first), Some(second)) if first == second => return Ok(None),
        _ => {}
    }
    let numpy = numpy(first.py())?;
    let both = numpy
        .call_method1("broadcast_arrays", (first, second))
        .map_err(|error| errors::input(said(first.py(), &error)))?;
    Ok(Some((both.get_item(0)?, both.get_item(1)?)))
}

fn said(py: Python<'_>, error: &PyErr) -> String {
    error.value(py).to_string()
}

/// Exponents and x of `highlight`, brought to one shape.
pub(crate) fn reals<'py>(n: &Bound<'py, PyAny>, x: &Bound<'py, PyAny>) -> PyResult<(Reals<'py>, Reals<'py>)> {
    let (exponents, xs) = (Reals::of(n, "exponents")?, Reals::of(x, "x")?);
    match broadcast(n, x, (exponents.shape(), xs.shape()))? {
        Some((n, x)) => Ok((Reals::of(&n, "exponents")?, Reals::of(&x, "x")?)),
        None => Ok((exponents, xs)),
    }
}
