//! What is known of a configuration's ports and registers, as Python objects.

use hw_model::format::QFormat;
use hw_model::quantise::real;
use hw_model::rtl::{PACKAGE, SOURCES};
use model::Status;
use pyo3::prelude::*;

use crate::errors;

/// A Q format, such as UQ1.23: bits stand for bits · 2^−fraction_bits.
#[pyclass(frozen, eq, module = "blysk")]
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Format(pub(crate) QFormat);

#[pymethods]
impl Format {
    #[new]
    fn new(text: &str) -> PyResult<Self> {
        text.parse().map(Self).map_err(errors::input)
    }

    #[getter]
    fn signed(&self) -> bool {
        self.0.is_signed()
    }

    /// All bits, 1 to 63.
    #[getter]
    fn width(&self) -> u32 {
        self.0.width()
    }

    /// Integer bits, the sign included.
    #[getter]
    fn integer_bits(&self) -> i32 {
        self.0.integer_bits()
    }

    #[getter]
    fn fraction_bits(&self) -> u32 {
        self.0.fraction_bits()
    }

    #[getter]
    fn min_bits(&self) -> i64 {
        self.0.min_bits()
    }

    #[getter]
    fn max_bits(&self) -> i64 {
        self.0.max_bits()
    }

    /// The value of one last place.
    #[getter]
    fn ulp(&self) -> f64 {
        self.0.ulp()
    }

    /// The real value of bits.
    fn value(&self, bits: i64) -> f64 {
        real(bits, self.0)
    }

    /// The bits as a memory or a port holds them: two's complement, `width` bits.
    fn word(&self, bits: i64) -> u64 {
        self.0.to_word(bits)
    }

    /// The bits of such a word.
    fn bits(&self, word: u64) -> i64 {
        self.0.from_word(word)
    }

    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        format!("Format('{}')", self.0)
    }

    fn __hash__(&self) -> u64 {
        let (sign, fraction) = (u64::from(self.0.is_signed()), u64::from(self.0.fraction_bits()));
        u64::from(self.0.width()) << 32 | fraction << 1 | sign
    }
}

/// A port of the pipeline, as the RTL names it.
#[pyclass(frozen, get_all, module = "blysk")]
pub(crate) struct Port {
    name: &'static str,
    is_input: bool,
    format: Py<Format>,
}

impl Port {
    pub(crate) fn of(py: Python<'_>, port: &model::Port) -> PyResult<Self> {
        let format = Py::new(py, Format(port.format))?;
        Ok(Self { name: port.name, is_input: port.name.ends_with("_i"), format })
    }
}

#[pymethods]
impl Port {
    fn __repr__(&self) -> String {
        format!("Port({}: {})", self.name, self.format.get().0)
    }
}

/// A register of a rank.
#[pyclass(frozen, get_all, module = "blysk")]
pub(crate) struct Probe {
    /// The rank it stands in, counted from 0.
    rank: usize,
    /// Its name in traces and vectors: `stage1.t1`.
    name: String,
    /// Where the RTL has it, below the top module: `polynomial.stage[1].multiply_add.t_q`.
    path: String,
    format: Py<Format>,
    /// True in the rank that computes the value, false where it is only carried along.
    computed: bool,
}

impl Probe {
    pub(crate) fn of(py: Python<'_>, probe: &model::Probe) -> PyResult<Self> {
        Ok(Self {
            rank: probe.rank,
            name: probe.name.clone(),
            path: probe.path.clone(),
            format: Py::new(py, Format(probe.register.format))?,
            computed: probe.register.computed,
        })
    }
}

#[pymethods]
impl Probe {
    fn __repr__(&self) -> String {
        format!("Probe({}: {}, {})", self.name, self.format.get().0, self.path)
    }
}

/// What a register holds of a request.
#[pyclass(frozen, get_all, eq, module = "blysk")]
pub(crate) struct Register {
    pub(crate) probe: Py<Probe>,
    pub(crate) bits: i64,
}

/// The same register of one model, and the same bits.
impl PartialEq for Register {
    fn eq(&self, other: &Self) -> bool {
        self.probe.is(&other.probe) && self.bits == other.bits
    }
}

#[pymethods]
impl Register {
    /// The bits as a real number.
    #[getter]
    fn value(&self) -> f64 {
        self.probe.get().format.get().value(self.bits)
    }

    #[getter]
    fn rank(&self) -> usize {
        self.probe.get().rank
    }

    #[getter]
    fn name(&self) -> &str {
        &self.probe.get().name
    }

    #[getter]
    fn path(&self) -> &str {
        &self.probe.get().path
    }

    #[getter]
    fn format(&self, py: Python<'_>) -> Py<Format> {
        self.probe.get().format.clone_ref(py)
    }

    /// The bits in two's complement, as a simulator shows them.
    #[getter]
    fn word(&self) -> u64 {
        self.probe.get().format.get().0.to_word(self.bits)
    }

    fn __repr__(&self) -> String {
        format!("Register({} = {} ({}))", self.probe.get().name, self.bits, self.value())
    }
}

/// The flags of the status port with their bits.
pub(crate) fn status_flags() -> Vec<(&'static str, u8)> {
    Status::NAMES.iter().map(|(flag, name)| (*name, flag.bits())).collect()
}

/// The files of the RTL, the package first, each behind what it names.
pub(crate) fn rtl_sources() -> Vec<&'static str> {
    std::iter::once(PACKAGE).chain(SOURCES.iter().map(|(name, _)| *name)).collect()
}
