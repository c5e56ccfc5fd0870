//! The registers of a model as a Python dict, by the RTL's names. Names and probes are made once for a model.

use hw_model::quantise::real;
use model::Model;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::facts::{Probe, Register};

/// The registers of one model: the RTL's name of each, and its probe.
pub(crate) struct Registers {
    known: Vec<(Py<PyString>, Py<Probe>)>,
}

impl Registers {
    pub(crate) fn of(py: Python<'_>, model: &Model) -> PyResult<Self> {
        let known = |probe: &model::Probe| {
            let name = PyString::intern(py, &probe.path).unbind();
            Ok((name, Py::new(py, Probe::of(py, probe)?)?))
        };
        Ok(Self { known: model.probes().iter().map(known).collect::<PyResult<_>>()? })
    }

    pub(crate) fn probes(&self, py: Python<'_>) -> Vec<Py<Probe>> {
        self.known.iter().map(|(_, probe)| probe.clone_ref(py)).collect()
    }

    /// A dict of the registers of these numbers, with the bits that they hold.
    pub(crate) fn dict<'py>(
        &self,
        py: Python<'py>,
        model: &Model,
        held: impl Iterator<Item = (usize, i64)>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let registers = PyDict::new(py);
        for (number, bits) in held {
            let (name, probe) = &self.known[number];
            let value = real(bits, model.probes()[number].register.format);
            registers.set_item(name, Py::new(py, Register { probe: probe.clone_ref(py), bits, value })?)?;
        }
        Ok(registers)
    }
}
