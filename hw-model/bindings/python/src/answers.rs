//! Answers to arrays of requests. The work runs without the interpreter's lock.

use model::{Addresses, Model};
use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{Reals, Whole};
use crate::errors;
use crate::out::{Answers, Out};

/// `evaluate` over arrays. The shape of the answers is that of x.
pub(crate) fn evaluate<'py>(
    py: Python<'py>,
    model: &Model,
    addresses: &Whole<'py>,
    xs: &Whole<'py>,
    out: &Out<'_, 'py>,
) -> PyResult<Answers<'py>> {
    match xs {
        Whole::One(_) => Err(errors::input("x is one number and the address an array; give as many")),
        Whole::Wide(array) => at_addresses(py, model, addresses, (array.as_slice()?, array.shape()), out),
        Whole::Narrow(array) => at_addresses(py, model, addresses, (array.as_slice()?, array.shape()), out),
        Whole::Made(values, shape) => at_addresses(py, model, addresses, (values, shape), out),
    }
}

fn at_addresses<'py, X: model::XBits + Sync>(
    py: Python<'py>,
    model: &Model,
    addresses: &Whole<'py>,
    xs: (&[X], &[usize]),
    out: &Out<'_, 'py>,
) -> PyResult<Answers<'py>> {
    match addresses {
        Whole::One(address) => answer(py, model, Addresses::One(*address), xs, out),
        Whole::Wide(array) => answer(py, model, Addresses::Each(array.as_slice()?), xs, out),
        Whole::Narrow(array) => answer(py, model, Addresses::Each(array.as_slice()?), xs, out),
        Whole::Made(values, _) => answer(py, model, Addresses::Each(values), xs, out),
    }
}

fn answer<'py, A: Copy + Send + Sync + TryInto<u32>, X: model::XBits + Sync>(
    py: Python<'py>,
    model: &Model,
    addresses: Addresses<'_, A>,
    (xs, shape): (&[X], &[usize]),
    out: &Out<'_, 'py>,
) -> PyResult<Answers<'py>> {
    let (intensities, status) = out.answers(py, shape)?;
    {
        let mut intensities = intensities.try_readwrite().map_err(errors::in_use)?;
        let mut status = status.try_readwrite().map_err(errors::in_use)?;
        let (intensities, status) = (intensities.as_slice_mut()?, status.as_slice_mut()?);
        py.detach(|| model.evaluate_all(addresses, xs, intensities, status)).map_err(errors::refused)?;
    }
    Ok((intensities, status))
}

/// `highlight` over arrays. The shape of the answers is that of x.
pub(crate) fn highlight<'py>(
    py: Python<'py>,
    model: &Model,
    exponents: &Reals<'py>,
    xs: &PyReadonlyArrayDyn<'py, f64>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let values = PyArrayDyn::<f64>::zeros(py, xs.shape(), false);
    {
        let mut values = values.try_readwrite()?;
        let (xs, values) = (xs.as_slice()?, values.as_slice_mut()?);
        let exponents = match exponents {
            Reals::One(n) => Addresses::One(*n),
            Reals::Many(array) => Addresses::Each(array.as_slice()?),
        };
        py.detach(|| model.highlight_all(exponents, xs, values)).map_err(errors::refused)?;
    }
    Ok(values)
}
