//! The class `Model`.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use hw_model::handshake::ReadySlice;
use model::Model as Golden;
use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::answers;
use crate::arrays::{self, Reals, Whole, broadcast};
use crate::bound::{self, Claim};
use crate::errors;
use crate::facts::{Format, Port, Probe};
use crate::out::Out;
use crate::registers::{Known, Registers};
use crate::tables;

type Given<'a, 'py> = Option<&'a Bound<'py, PyAny>>;

/// The golden model of one configuration. It does not change, and threads may share it.
///
/// Arrays may have any shape. int64 and uint32 for whole numbers and float64 for real ones are read where they lie;
/// other such numbers, lists and slices are converted once. Where both arguments are arrays of different shapes, they
/// are broadcast as numpy does.
#[pyclass(frozen, module = "blysk")]
pub(crate) struct Model {
    golden: Golden,
    registers: Arc<Known>,
    bound: OnceLock<Claim>,
}

impl Model {
    fn new(py: Python<'_>, golden: Golden) -> PyResult<Self> {
        Ok(Self { registers: Arc::new(Known::of(py, &golden)?), golden, bound: OnceLock::new() })
    }

    pub(crate) const fn golden(&self) -> &Golden {
        &self.golden
    }

    pub(crate) const fn known(&self) -> &Arc<Known> {
        &self.registers
    }

    /// The address that was given, or those of the exponents.
    fn addresses<'py>(&self, address: Given<'_, 'py>, n: Given<'_, 'py>) -> PyResult<Whole<'py>> {
        match (address, n) {
            (Some(address), None) => Whole::of(address, "addresses"),
            (None, Some(n)) => Reals::of(n, "exponents")?.each(|n| self.golden.address(n).map(i64::from)),
            _ => Err(PyTypeError::new_err("give an address or an exponent n, and not both")),
        }
    }

    /// The bits that were given, or those of real numbers.
    fn x_of<'py>(&self, x_bits: Given<'_, 'py>, x: Given<'_, 'py>) -> PyResult<Whole<'py>> {
        match (x_bits, x) {
            (Some(bits), None) => Whole::of(bits, "x_bits"),
            (None, Some(x)) => Reals::of(x, "x")?.each(|x| self.golden.x_bits(x)),
            _ => Err(PyTypeError::new_err("give x_bits or a real x, and not both")),
        }
    }

    /// One request: its address and the bits of its x.
    fn request(
        &self,
        n: Given<'_, '_>,
        x: Given<'_, '_>,
        address: Given<'_, '_>,
        x_bits: Given<'_, '_>,
    ) -> PyResult<(u32, i64)> {
        match (self.addresses(address, n)?, self.x_of(x_bits, x)?) {
            (Whole::One(address), Whole::One(x)) => Ok((one(address)?, x)),
            _ => Err(PyTypeError::new_err("registers are those of one request: give one address or n, and one x")),
        }
    }
}

fn one(address: i64) -> PyResult<u32> {
    address.try_into().map_err(|_| errors::refused(model::Error::Address))
}

#[pymethods]
impl Model {
    /// The model of a preset: paper, blooming, tangent, compact, precise or schlick. Raises `ConfigurationError`.
    #[staticmethod]
    fn preset(py: Python<'_>, name: &str) -> PyResult<Self> {
        Self::new(py, py.detach(|| Golden::preset(name)).map_err(errors::refused)?)
    }

    /// The model of a configuration as JSON. Raises `ConfigurationError`.
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<Self> {
        Self::new(py, py.detach(|| Golden::from_json(text)).map_err(errors::refused)?)
    }

    /// The model of a configuration in a file. Raises `ConfigurationError`.
    #[staticmethod]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::new(py, py.detach(|| Golden::from_file(&path)).map_err(errors::refused)?)
    }

    /// The intensity, 0 to 1, for the exponent n and x = cos γ, in real numbers.
    ///
    /// x is rounded to the input format, and brought to its ends where it lies outside. Raises `ExponentError` where
    /// the ROM has no word for n, and `InputError` where x is not finite.
    fn highlight<'py>(
        &self,
        py: Python<'py>,
        n: &Bound<'py, PyAny>,
        x: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        match arrays::reals(n, x)? {
            (Reals::One(n), Reals::One(x)) => {
                let value = self.golden.highlight(n, x).map_err(errors::refused)?;
                Ok(value.into_pyobject(py)?.into_any())
            }
            (n, Reals::Many(xs)) => Ok(answers::highlight(py, &self.golden, &n, &xs)?.into_any()),
            (Reals::Many(_), Reals::One(_)) => Err(errors::input("n is an array and x is not; give as many")),
        }
    }

    /// What the ports `intensity` and `status` answer to `address` and `x`, as bits.
    ///
    /// The address, or the exponent n, is one for all or one for each x; x is given as bits or as a real number. An
    /// address without a ROM word gives 0 and a flag. Raises `InputError` where the input format does not hold an x,
    /// and `ExponentError` where the ROM has no word for n.
    ///
    /// `out` is a tuple of two arrays that take the answers and are returned, int64 for the intensity and uint8 for the
    /// status: calls that share them need no new memory, which can take as long as the answers. They are C-contiguous,
    /// have the shape of the answers, and overlap neither each other nor what is read. Arrays that cannot be used raise
    /// `TypeError` or `InputError` before anything is written; after an x or an address that is refused, what they hold
    /// means nothing.
    #[pyo3(signature = (address=None, x_bits=None, *, n=None, x=None, out=None))]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        address: Given<'_, 'py>,
        x_bits: Given<'_, 'py>,
        n: Given<'_, 'py>,
        x: Given<'_, 'py>,
        out: Given<'_, 'py>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let (mut addresses, mut xs) = (self.addresses(address, n)?, self.x_of(x_bits, x)?);
        if let (Whole::One(address), Whole::One(x)) = (&addresses, &xs) {
            if out.is_some() {
                return Err(PyTypeError::new_err(
                    "out takes the answers to arrays; one request is answered by numbers",
                ));
            }
            let answer = self.golden.evaluate(one(*address)?, *x).map_err(errors::refused)?;
            return (answer.intensity, answer.status.bits()).into_pyobject(py);
        }
        let given = address.or(n).zip(x_bits.or(x));
        let shapes = (addresses.shape(), xs.shape());
        if let Some((first, second)) = given
            && let Some((first, second)) = broadcast(first, second, shapes)?
        {
            let pick = |given: Given<'_, 'py>, one| given.map(|_| one);
            addresses = self.addresses(pick(address, &first), pick(n, &first))?;
            xs = self.x_of(pick(x_bits, &second), pick(x, &second))?;
        }
        let out = Out { given: out, inputs: [("address", address), ("x_bits", x_bits), ("n", n), ("x", x)] };
        answers::evaluate(py, &self.golden, &addresses, &xs, &out)?.into_pyobject(py)
    }

    /// What every register of every rank holds of one request: a mapping by RTL names, in the order of the ranks.
    #[pyo3(signature = (n=None, x=None, *, address=None, x_bits=None))]
    fn registers(
        &self,
        n: Given<'_, '_>,
        x: Given<'_, '_>,
        address: Given<'_, '_>,
        x_bits: Given<'_, '_>,
    ) -> PyResult<Registers> {
        let (address, x) = self.request(n, x, address, x_bits)?;
        let held = self.golden.registers(address, x).map_err(errors::refused)?;
        Ok(Registers::new(&self.registers, 0, held))
    }

    /// The ROM address of the exponent n. Raises `ExponentError`.
    fn address(&self, n: f64) -> PyResult<u32> {
        self.golden.address(n).map_err(errors::refused)
    }

    /// The bits of a real x: the nearest in the input format, a tie to even. Raises `InputError`.
    fn x_bits(&self, x: f64) -> PyResult<i64> {
        self.golden.x_bits(x).map_err(errors::refused)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.golden.design().config().name
    }

    /// The configuration as JSON, ready for `from_json`.
    #[getter]
    fn configuration(&self) -> String {
        self.golden.design().config().to_json()
    }

    /// Clock cycles from a request to its result, which is the number of ranks.
    #[getter]
    fn latency(&self) -> usize {
        self.golden.latency()
    }

    /// The rule by which ranks advance: `valid_ready`, `enable` or `none`.
    #[getter]
    fn handshake(&self) -> &'static str {
        self.golden.datapath().control().handshake.name()
    }

    /// The end at which a register slice stands, `input` or `output`; None where there is none.
    #[getter]
    fn ready_slice(&self) -> Option<&'static str> {
        self.golden.datapath().control().slice.map(ReadySlice::name)
    }

    /// Whether the port of the reset, which is then `rst_ni`, resets at 0.
    #[getter]
    fn reset_active_low(&self) -> bool {
        self.golden.datapath().control().reset.is_active_low()
    }

    /// The exponents, in the order of their addresses.
    #[getter]
    fn exponents<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.golden.design().rom().exponents().as_slice().to_vec().into_pyarray(py)
    }

    /// The names of the status flags of this configuration, from bit 0 up.
    #[getter]
    fn status_flags(&self) -> Vec<&'static str> {
        self.golden.datapath().status_flags().iter().map(|(_, name)| *name).collect()
    }

    /// The names of the ranks of registers, the first one first.
    #[getter]
    fn ranks(&self) -> Vec<String> {
        (0..self.golden.latency()).map(|rank| self.golden.datapath().rank_name(rank)).collect()
    }

    /// The ports, the clock first.
    #[getter]
    fn ports(&self, py: Python<'_>) -> PyResult<Vec<Port>> {
        self.golden.ports().iter().map(|port| Port::of(py, port)).collect()
    }

    /// Every register of every rank, the first rank first.
    #[getter]
    fn probes(&self, py: Python<'_>) -> Vec<Py<Probe>> {
        self.registers.probes(py)
    }

    /// The format of every port, by its name in traces, and of every register, such as `stage1.t1`.
    #[getter]
    fn formats<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let formats = PyDict::new(py);
        for port in self.golden.ports() {
            if let Some(column) = port.column {
                formats.set_item(column, Format(port.format))?;
            }
        }
        for probe in self.golden.probes() {
            formats.set_item(&probe.name, Format(probe.register.format))?;
        }
        Ok(formats)
    }

    /// The ROM as columns, a row for each address: `n`, and every field's bits by its name.
    fn rom<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        tables::rom(py, self.golden.design())
    }

    /// The real functions behind the ROM, as columns with a row for each address.
    ///
    /// `n`, `q` and `cut`; in power form `c0` to `c3` of x^0 to x^3, of the first segment; in centred form `start` and
    /// `c0` to `c3` of c0 − v·(c1 − v·(c2 − v·c3)) in v = 1 − x − start, and for a further segment `start_1`, `c0_1`
    /// and so on; with a rational tail x / (tail_a − tail_b·x). NaN where a row has no such part.
    #[getter]
    fn coefficients<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        tables::coefficients(py, self.golden.design())
    }

    /// The greatest errors against x^n, with every exponent and every representable x counted.
    ///
    /// The first call goes through all of them (2^31 points for a preset) on all cores, which cannot be interrupted;
    /// the model keeps what it found. It is what `blysk certify --preset` claims before its certificate is checked.
    /// Raises `InputError` where there are too many points, or a format has more
    /// than 53 fraction bits.
    fn bound(&self, py: Python<'_>) -> PyResult<Claim> {
        if let Some(found) = self.bound.get() {
            return Ok(found.clone());
        }
        let found = bound::bound(py, self.golden.design())?;
        Ok(self.bound.get_or_init(|| found).clone())
    }

    fn __repr__(&self) -> String {
        format!("<blysk.Model {}>", self.name())
    }
}
