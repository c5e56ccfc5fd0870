//! The arrays that take the answers: new ones, or those that a caller keeps and gives again.

use numpy::{Element, PyArrayDyn, PyUntypedArray, PyUntypedArrayMethods, dtype};
use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays::numpy;
use crate::errors;

/// Arrays for intensities and for status.
pub(crate) type Answers<'py> = (Bound<'py, PyArrayDyn<i64>>, Bound<'py, PyArrayDyn<u8>>);

/// An argument of the call by its name, where it was given.
pub(crate) type Argument<'a, 'py> = (&'static str, Option<&'a Bound<'py, PyAny>>);

/// Where the answers of a call go.
pub(crate) struct Out<'a, 'py> {
    /// The arrays of the argument `out`.
    pub(crate) given: Option<&'a Bound<'py, PyAny>>,
    /// What the call reads.
    pub(crate) inputs: [Argument<'a, 'py>; 4],
}

impl<'py> Out<'_, 'py> {
    /// The arrays for answers of this shape: new ones where none are given. Nothing is written where those that are
    /// given cannot take the answers.
    pub(crate) fn answers(&self, py: Python<'py>, shape: &[usize]) -> PyResult<Answers<'py>> {
        match self.given {
            Some(out) => self.usable(out, shape),
            None => Ok((PyArrayDyn::zeros(py, shape, false), PyArrayDyn::zeros(py, shape, false))),
        }
    }

    fn usable(&self, out: &Bound<'py, PyAny>, shape: &[usize]) -> PyResult<Answers<'py>> {
        let (intensity, status) = out.extract::<(Bound<'py, PyAny>, Bound<'py, PyAny>)>().map_err(|_| {
            PyTypeError::new_err("out is a tuple of two arrays: int64 for the intensity, uint8 for the status")
        })?;
        let answers = (usable(&intensity, "intensity", shape)?, usable(&status, "status", shape)?);
        apart(&intensity, "intensity", &[("status", Some(&status))])?;
        apart(&intensity, "intensity", &self.inputs)?;
        apart(&status, "status", &self.inputs)?;
        Ok(answers)
    }
}

/// An array whose elements have the type, the shape and the places in memory that answers have.
fn usable<'py, T: Element>(
    given: &Bound<'py, PyAny>,
    name: &str,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let py = given.py();
    let Ok(array) = given.cast::<PyArrayDyn<T>>() else {
        let has = match given.cast::<PyUntypedArray>() {
            Ok(array) => format!("one of {}", array.dtype()),
            Err(_) => given.get_type().name()?.to_string(),
        };
        return Err(PyTypeError::new_err(format!("out: {name} is an array of {}, not {has}", dtype::<T>(py))));
    };
    let refused = |why: &str| Err(errors::input(format!("out: {name} {why}")));
    if array.shape() != shape {
        let (has, wanted) = (PyTuple::new(py, array.shape())?, PyTuple::new(py, shape)?);
        return refused(&format!("has the shape {has}, and the answers have {wanted}"));
    }
    if !(array.is_c_contiguous() && array.is_aligned()) {
        return refused("has gaps or another order in memory; give a C-contiguous array, as numpy.empty makes it");
    }
    if !array.getattr(intern!(py, "flags"))?.getattr(intern!(py, "writeable"))?.is_truthy()? {
        return refused("is read-only; give an array that can be written");
    }
    Ok(array.clone())
}

/// Whether no other array lies where this one lies: it would be read and written at the same time.
fn apart(array: &Bound<'_, PyAny>, name: &str, others: &[Argument<'_, '_>]) -> PyResult<()> {
    let py = array.py();
    for (other, given) in others {
        if let Some(given) = given
            && numpy(py)?.call_method1(intern!(py, "may_share_memory"), (array, given))?.is_truthy()?
        {
            return Err(errors::input(format!("out: {name} overlaps {other}; give an array that lies apart")));
        }
    }
    Ok(())
}
