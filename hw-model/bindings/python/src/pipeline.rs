//! The class `Pipeline`: the clocked pipeline, a cycle or an array of cycles at a time.

use model::{Clocked, Inputs, Outputs as Shown};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::Whole;
use crate::cycles::{Levels, cycles};
use crate::errors;
use crate::model::Model;
use crate::registers::Registers;

/// What the output ports show in a cycle.
#[pyclass(frozen, get_all, eq, module = "blysk")]
#[derive(Clone, PartialEq)]
pub(crate) struct Outputs {
    in_ready: bool,
    out_valid: bool,
    /// Bits in the output format.
    intensity: i64,
    status: u8,
}

impl From<Shown> for Outputs {
    fn from(shown: Shown) -> Self {
        let Shown { in_ready, out_valid, intensity, status } = shown;
        Self { in_ready, out_valid, intensity, status: status.bits() }
    }
}

#[pymethods]
impl Outputs {
    fn __repr__(&self) -> String {
        let Self { in_ready, out_valid, intensity, status } = self;
        format!("Outputs(in_ready={in_ready}, out_valid={out_valid}, intensity={intensity}, status={status})")
    }
}

/// One rank of registers before the next clock edge.
#[pyclass(frozen, get_all, module = "blysk")]
pub(crate) struct Rank {
    name: String,
    /// True where the rank holds a request.
    valid: bool,
    /// False until data is loaded for the first time: hardware shows unknown values there.
    loaded: bool,
    /// Its registers by their RTL names.
    registers: Py<Registers>,
}

#[pymethods]
impl Rank {
    fn __repr__(&self) -> String {
        format!("Rank({}, valid={}, loaded={})", self.name, self.valid, self.loaded)
    }
}

/// The clocked pipeline of a model, empty as after reset. One thread at a time may clock it.
#[pyclass(module = "blysk")]
pub(crate) struct Pipeline {
    model: Py<Model>,
    clocked: Clocked,
}

#[pymethods]
impl Pipeline {
    #[new]
    fn new(model: Py<Model>) -> Self {
        Self { clocked: Clocked::new(model.get().golden()), model }
    }

    #[getter]
    fn model(&self, py: Python<'_>) -> Py<Model> {
        self.model.clone_ref(py)
    }

    /// True where no rank holds a request.
    #[getter]
    fn is_empty(&self) -> bool {
        self.clocked.is_empty()
    }

    /// One clock cycle: what the ports show at the rising edge that ends it, and then the edge.
    ///
    /// x is bits in the input format. Raises `InputError` where the format does not hold them; then no cycle has
    /// passed.
    #[pyo3(signature = (in_valid=false, address=0, x=0, out_ready=true, reset=false))]
    fn tick(&mut self, in_valid: bool, address: u32, x: i64, out_ready: bool, reset: bool) -> PyResult<Outputs> {
        let inputs = Inputs { reset, in_valid, address, x, out_ready };
        self.clocked.tick(&inputs).map(Outputs::from).map_err(errors::refused)
    }

    /// What the ports show with these inputs, without an edge.
    #[pyo3(signature = (in_valid=false, address=0, x=0, out_ready=true, reset=false))]
    fn outputs(&mut self, in_valid: bool, address: u32, x: i64, out_ready: bool, reset: bool) -> PyResult<Outputs> {
        let inputs = Inputs { reset, in_valid, address, x, out_ready };
        self.clocked.combinational(&inputs).map(Outputs::from).map_err(errors::refused)
    }

    /// The registers before the next edge, the first rank first.
    fn ranks(&mut self, py: Python<'_>) -> PyResult<Vec<Rank>> {
        let model = self.model.get();
        let (golden, ranks) = (model.golden(), self.clocked.ranks());
        let probes = golden.probes();
        let first = |index| probes.partition_point(|probe| probe.rank < index);
        let rank = |(index, rank): (usize, &model::Rank)| {
            let of_rank = &probes[first(index)..first(index + 1)];
            let held = of_rank.iter().map(|probe| probe.register.bits(&rank.signals)).collect();
            let registers = Py::new(py, Registers::new(model.known(), first(index), held))?;
            let name = golden.datapath().rank_name(index);
            Ok(Rank { name, valid: rank.valid, loaded: rank.loaded, registers })
        };
        ranks.iter().enumerate().map(rank).collect()
    }

    /// The same in short: each rank's valid flag, and each register's word in the order of the model's probes.
    ///
    /// None stands for a register that was never loaded.
    fn words(&mut self) -> (Vec<bool>, Vec<Option<u64>>) {
        let ranks = self.clocked.ranks();
        let word = |probe: &model::Probe| {
            let rank = &ranks[probe.rank];
            rank.loaded.then(|| probe.register.format.to_word(probe.register.bits(&rank.signals)))
        };
        let words = self.model.get().golden().probes().iter().map(word).collect();
        (ranks.iter().map(|rank| rank.valid).collect(), words)
    }

    /// Many cycles: arrays of the levels at the inputs, one element a cycle, or one level for all.
    ///
    /// Returns the output ports of each cycle: `in_ready`, `out_valid`, `intensity`, `status`. Raises `InputError` at
    /// the first cycle whose input is refused; the cycles before it have passed.
    #[pyo3(signature = (in_valid, address, x, out_ready=None, reset=None))]
    fn run<'py>(
        &mut self,
        py: Python<'py>,
        in_valid: &Bound<'py, PyAny>,
        address: &Bound<'py, PyAny>,
        x: &Bound<'py, PyAny>,
        out_ready: Option<&Bound<'py, PyAny>>,
        reset: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let valid = Levels::of(Some(in_valid), "in_valid", true)?;
        let ready = Levels::of(out_ready, "out_ready", true)?;
        let reset = Levels::of(reset, "reset", false)?;
        let (address, x) = (Whole::of(address, "addresses")?, Whole::of(x, "x")?);
        let (address, x) = (address.list()?, x.list()?);
        let lengths = [valid.length(), address.length(), x.length(), ready.length(), reset.length()];
        let count = cycles(["in_valid", "address", "x", "out_ready", "reset"], lengths)?;
        let clocked = &mut self.clocked;
        let (valid, ready, reset) = (valid.list()?, ready.list()?, reset.list()?);
        let ports = py.detach(|| {
            let mut ports = Ports::with_capacity(count);
            for cycle in 0..count {
                let address = address.get(cycle).try_into().map_err(|_| model::Error::Address);
                let inputs = address.map(|address| Inputs {
                    reset: reset.get(cycle),
                    in_valid: valid.get(cycle),
                    address,
                    x: x.get(cycle),
                    out_ready: ready.get(cycle),
                });
                let shown = inputs.and_then(|inputs| clocked.tick(&inputs));
                ports.push(&shown.map_err(|error| error.at(cycle))?);
            }
            Ok(ports)
        });
        ports.map_err(errors::refused)?.table(py)
    }

    fn __repr__(&self) -> String {
        format!("<blysk.Pipeline {}>", self.model.get().golden().design().config().name)
    }
}

/// The output ports of many cycles.
struct Ports {
    in_ready: Vec<bool>,
    out_valid: Vec<bool>,
    intensity: Vec<i64>,
    status: Vec<u8>,
}

impl Ports {
    fn with_capacity(cycles: usize) -> Self {
        Self {
            in_ready: Vec::with_capacity(cycles),
            out_valid: Vec::with_capacity(cycles),
            intensity: Vec::with_capacity(cycles),
            status: Vec::with_capacity(cycles),
        }
    }

    fn push(&mut self, shown: &Shown) {
        self.in_ready.push(shown.in_ready);
        self.out_valid.push(shown.out_valid);
        self.intensity.push(shown.intensity);
        self.status.push(shown.status.bits());
    }

    fn table(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let table = PyDict::new(py);
        table.set_item("in_ready", self.in_ready.into_pyarray(py))?;
        table.set_item("out_valid", self.out_valid.into_pyarray(py))?;
        table.set_item("intensity", self.intensity.into_pyarray(py))?;
        let status: Bound<'_, PyArray1<u8>> = self.status.into_pyarray(py);
        table.set_item("status", status)?;
        Ok(table)
    }
}
