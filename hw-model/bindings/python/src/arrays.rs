//! numpy arrays in and out: what a caller may give, and the one conversion that it costs.
//!
//! An array of the wanted type in one piece of memory is read where it lies. Other whole or real numbers (lists, other
//! types, slices with gaps) are converted once, by numpy. What is no such number is refused.

use model::{Addresses, Error, Model};
use numpy::{
    Element, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray, PyUntypedArrayMethods, get_array_module,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::errors;

/// Intensities and status of many requests.
type Answers<'py> = (Bound<'py, PyArrayDyn<i64>>, Bound<'py, PyArrayDyn<u8>>);

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
fn in_place<'py, T: Element>(given: &Bound<'py, PyAny>) -> PyResult<Option<PyReadonlyArrayDyn<'py, T>>> {
    match given.cast::<PyArrayDyn<T>>() {
        Ok(array) if array.is_c_contiguous() => Ok(Some(array.try_readonly()?)),
        _ => Ok(None),
    }
}

/// An array of type `to` from another, which may be of these `kinds`.
fn converted<'py, T: Element>(
    given: &Bound<'py, PyAny>,
    what: &str,
    wanted: &str,
    to: &str,
    kinds: &[&str],
) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
    let py = given.py();
    let refused = |has: &str| PyTypeError::new_err(format!("{what} are {wanted}, not {has}"));
    let numpy = get_array_module(py)?;
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
    let numpy = get_array_module(first.py())?;
    let both = numpy
        .call_method1("broadcast_arrays", (first, second))
        .map_err(|error| errors::input(said(first.py(), &error)))?;
    Ok(Some((both.get_item(0)?, both.get_item(1)?)))
}

fn said(py: Python<'_>, error: &PyErr) -> String {
    error.value(py).to_string()
}

/// `evaluate` over arrays. The shape of the answers is that of x.
pub(crate) fn evaluate<'py>(
    py: Python<'py>,
    model: &Model,
    addresses: &Whole<'py>,
    xs: &Whole<'py>,
) -> PyResult<Answers<'py>> {
    match xs {
        Whole::One(_) => Err(errors::input("x is one number and the address an array; give as many")),
        Whole::Wide(array) => at_addresses(py, model, addresses, (array.as_slice()?, array.shape())),
        Whole::Narrow(array) => at_addresses(py, model, addresses, (array.as_slice()?, array.shape())),
        Whole::Made(values, shape) => at_addresses(py, model, addresses, (values, shape)),
    }
}

fn at_addresses<'py, X: Copy + Sync + TryInto<i64>>(
    py: Python<'py>,
    model: &Model,
    addresses: &Whole<'py>,
    xs: (&[X], &[usize]),
) -> PyResult<Answers<'py>> {
    match addresses {
        Whole::One(address) => answer(py, model, Addresses::One(*address), xs),
        Whole::Wide(array) => answer(py, model, Addresses::Each(array.as_slice()?), xs),
        Whole::Narrow(array) => answer(py, model, Addresses::Each(array.as_slice()?), xs),
        Whole::Made(values, _) => answer(py, model, Addresses::Each(values), xs),
    }
}

fn answer<'py, A: Copy + Send + Sync + TryInto<u32>, X: Copy + Sync + TryInto<i64>>(
    py: Python<'py>,
    model: &Model,
    addresses: Addresses<'_, A>,
    (xs, shape): (&[X], &[usize]),
) -> PyResult<Answers<'py>> {
    let intensities = PyArrayDyn::<i64>::zeros(py, shape, false);
    let status = PyArrayDyn::<u8>::zeros(py, shape, false);
    {
        let (mut intensities, mut status) = (intensities.try_readwrite()?, status.try_readwrite()?);
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

/// Exponents and x of `highlight`, brought to one shape.
pub(crate) fn reals<'py>(n: &Bound<'py, PyAny>, x: &Bound<'py, PyAny>) -> PyResult<(Reals<'py>, Reals<'py>)> {
    let (exponents, xs) = (Reals::of(n, "exponents")?, Reals::of(x, "x")?);
    match broadcast(n, x, (exponents.shape(), xs.shape()))? {
        Some((n, x)) => Ok((Reals::of(&n, "exponents")?, Reals::of(&x, "x")?)),
        None => Ok((exponents, xs)),
    }
}

/// Whole numbers, one for each cycle, or one for all.
#[derive(Clone, Copy)]
pub(crate) enum List<'a> {
    One(i64),
    Wide(&'a [i64]),
    Narrow(&'a [u32]),
}

impl List<'_> {
    pub(crate) fn get(&self, cycle: usize) -> i64 {
        match self {
            Self::One(value) => *value,
            Self::Wide(values) => values[cycle],
            Self::Narrow(values) => values[cycle].into(),
        }
    }

    pub(crate) const fn length(&self) -> Option<usize> {
        match self {
            Self::One(_) => None,
            Self::Wide(values) => Some(values.len()),
            Self::Narrow(values) => Some(values.len()),
        }
    }
}

impl Whole<'_> {
    pub(crate) fn list(&self) -> PyResult<List<'_>> {
        Ok(match self {
            Self::One(value) => List::One(*value),
            Self::Wide(array) => List::Wide(array.as_slice()?),
            Self::Narrow(array) => List::Narrow(array.as_slice()?),
            Self::Made(values, _) => List::Wide(values),
        })
    }
}

/// Levels of a port, one for each cycle, or one for all.
pub(crate) enum Levels<'py> {
    One(bool),
    Each(PyReadonlyArrayDyn<'py, bool>),
}

impl<'py> Levels<'py> {
    /// Of what a caller gave as `what`; `otherwise` where nothing was given.
    pub(crate) fn of(given: Option<&Bound<'py, PyAny>>, what: &str, otherwise: bool) -> PyResult<Self> {
        let Some(given) = given else { return Ok(Self::One(otherwise)) };
        if let Ok(one) = given.extract::<bool>() {
            return Ok(Self::One(one));
        }
        if let Some(array) = in_place(given)? {
            return Ok(Self::Each(array));
        }
        converted(given, what, "levels: give bool", "bool", &["b1", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8"])
            .map(Self::Each)
    }

    pub(crate) fn list(&self) -> PyResult<Level<'_>> {
        Ok(match self {
            Self::One(level) => Level::One(*level),
            Self::Each(array) => Level::Each(array.as_slice()?),
        })
    }

    pub(crate) fn length(&self) -> Option<usize> {
        match self {
            Self::One(_) => None,
            Self::Each(array) => Some(array.len()),
        }
    }
}

/// The levels themselves, for work without the interpreter's lock.
#[derive(Clone, Copy)]
pub(crate) enum Level<'a> {
    One(bool),
    Each(&'a [bool]),
}

impl Level<'_> {
    pub(crate) fn get(&self, cycle: usize) -> bool {
        match self {
            Self::One(level) => *level,
            Self::Each(levels) => levels[cycle],
        }
    }
}

/// How many cycles there are, by what was given for each.
pub(crate) fn cycles<const N: usize>(names: [&str; N], lengths: [Option<usize>; N]) -> PyResult<usize> {
    let mut found: Option<(&str, usize)> = None;
    for (name, length) in names.into_iter().zip(lengths) {
        match (found, length) {
            (None, Some(length)) => found = Some((name, length)),
            (Some((first, wanted)), Some(length)) if length != wanted => {
                let said = format!("{name} has {length} cycles and {first} has {wanted}; give as many");
                return Err(errors::input(said));
            }
            _ => {}
        }
    }
    found.map(|(_, cycles)| cycles).ok_or_else(|| errors::input("give an array with a value for each cycle"))
}
