//! What drives the clocked pipeline over many cycles: a value for each cycle, or one for all.

use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{Whole, converted, in_place};
use crate::errors;

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
