//! The registers of a model by the RTL's names. Names and probes are made once for a model; a `Register` is made when
//! somebody looks it up, as who asks for all of a request looks at few.

use std::sync::Arc;

use model::Model;
use pyo3::exceptions::PyKeyError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator, PyString, PyTuple};

use crate::facts::{Probe, Register};

/// The registers of one model, whatever they hold, the first rank first.
pub(crate) struct Known {
    probes: Vec<Py<Probe>>,
    names: Vec<Py<PyString>>,
    /// The number of each in these lists, by its name.
    numbers: Py<PyDict>,
}

impl Known {
    pub(crate) fn of(py: Python<'_>, model: &Model) -> PyResult<Self> {
        let probes = model.probes().iter().map(|probe| Py::new(py, Probe::of(py, probe)?)).collect::<PyResult<_>>()?;
        let names: Vec<_> = model.probes().iter().map(|probe| PyString::intern(py, &probe.path).unbind()).collect();
        let numbers = PyDict::new(py);
        names.iter().enumerate().try_for_each(|(number, name)| numbers.set_item(name, number))?;
        Ok(Self { probes, names, numbers: numbers.unbind() })
    }

    pub(crate) fn probes(&self, py: Python<'_>) -> Vec<Py<Probe>> {
        self.probes.iter().map(|probe| probe.clone_ref(py)).collect()
    }
}

/// What registers hold, by their RTL names, in the order of the ranks: a mapping that stays as it is.
#[pyclass(frozen, mapping, module = "blysk")]
pub(crate) struct Registers {
    known: Arc<Known>,
    /// The number of the first of them.
    first: usize,
    bits: Vec<i64>,
}

impl Registers {
    /// The registers from the number `first` on, with the bits that they hold.
    pub(crate) fn new(known: &Arc<Known>, first: usize, bits: Vec<i64>) -> Self {
        Self { known: Arc::clone(known), first, bits }
    }

    fn find(&self, name: &Bound<'_, PyAny>) -> PyResult<Option<Register>> {
        let py = name.py();
        let Some(number) = self.known.numbers.bind(py).get_item(name)? else { return Ok(None) };
        let place = number.extract::<usize>()?.checked_sub(self.first);
        Ok(place.filter(|&place| place < self.bits.len()).map(|place| self.at(py, place)))
    }

    fn at(&self, py: Python<'_>, place: usize) -> Register {
        Register { probe: self.known.probes[self.first + place].clone_ref(py), bits: self.bits[place] }
    }

    fn names(&self) -> &[Py<PyString>] {
        &self.known.names[self.first..][..self.bits.len()]
    }

    /// All of them, for who looks at all.
    fn dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        self.names().iter().enumerate().try_for_each(|(place, name)| dict.set_item(name, self.at(py, place)))?;
        Ok(dict)
    }
}

#[pymethods]
impl Registers {
    fn __len__(&self) -> usize {
        self.bits.len()
    }

    fn __getitem__(&self, name: &Bound<'_, PyAny>) -> PyResult<Register> {
        self.find(name)?.ok_or_else(|| PyKeyError::new_err(name.clone().unbind()))
    }

    fn __contains__(&self, name: &Bound<'_, PyAny>) -> PyResult<bool> {
        Ok(self.find(name)?.is_some())
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        PyTuple::new(py, self.names())?.try_iter()
    }

    /// The register of a name, or `default` where there is none.
    #[pyo3(signature = (name, default=None, /))]
    fn get<'py>(&self, name: &Bound<'py, PyAny>, default: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        let py = name.py();
        match self.find(name)? {
            Some(register) => Ok(Bound::new(py, register)?.into_any()),
            None => Ok(default.unwrap_or_else(|| py.None().into_bound(py))),
        }
    }

    fn keys<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.dict(py)?.call_method0(intern!(py, "keys"))
    }

    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.dict(py)?.call_method0(intern!(py, "values"))
    }

    fn items<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.dict(py)?.call_method0(intern!(py, "items"))
    }

    /// What each register holds as bits, by its name: the quickest way to read all of them.
    fn bits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        self.names().iter().zip(&self.bits).try_for_each(|(name, bits)| dict.set_item(name, bits))?;
        Ok(dict)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("Registers({})", self.dict(py)?))
    }
}
