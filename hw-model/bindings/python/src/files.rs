//! Vectors, RTL and the judgement of a log: the files of the command's `vectors`, `rtl` and `check`.

use std::fmt::Display;
use std::path::PathBuf;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use vectors::rtl::Modules;
use vectors::{Bundle, OutputSet, Strategy};

use crate::errors;
use crate::model::Model;

/// Addresses and bits of x.
type Requests<'py> = (Bound<'py, PyArray1<u32>>, Bound<'py, PyArray1<i64>>);

/// Which vectors a bundle has.
struct Choice {
    strategy: Strategy,
    count: u64,
    seed: u64,
}

impl Choice {
    fn of(strategy: &str, count: u64, seed: u64) -> PyResult<Self> {
        Ok(Self { strategy: strategy.parse().map_err(errors::file)?, count, seed })
    }

    /// What the files say that they were made by.
    fn command(&self, function: &str, model: &Model, more: impl Display) -> String {
        let Self { strategy, count, seed } = self;
        let name = &model.golden().design().config().name;
        format!("blysk.{function}({name}{more}, strategy={strategy}, count={count}, seed={seed})")
    }

    fn bundle<'a>(&self, model: &'a Model, command: &str) -> PyResult<Bundle<'a>> {
        Bundle::new(model.golden().design(), self.strategy, self.count, self.seed, command).map_err(errors::file)
    }
}

/// Writes vectors to the directory `out` and returns the manifest as JSON.
#[pyfunction]
#[pyo3(name = "vectors", signature = (model, out, *, strategy="mixed", count=4096, seed=1))]
pub(crate) fn write_vectors(
    py: Python<'_>,
    model: &Model,
    out: PathBuf,
    strategy: &str,
    count: u64,
    seed: u64,
) -> PyResult<String> {
    let choice = Choice::of(strategy, count, seed)?;
    py.detach(|| {
        let bundle = choice.bundle(model, &choice.command("vectors", model, ""))?;
        let manifest = bundle.write_to(&out).map_err(errors::file)?;
        Ok(manifest.to_json())
    })
}

/// Writes RTL, testbench and vectors to the directory `out` and returns the manifest as JSON.
#[pyfunction]
#[pyo3(name = "rtl", signature = (model, out, *, prefix="blysk", dut=None, strategy="mixed", count=4096, seed=1))]
// Each is a keyword of the Python function.
#[allow(clippy::too_many_arguments)]
pub(crate) fn write_rtl(
    py: Python<'_>,
    model: &Model,
    out: PathBuf,
    prefix: &str,
    dut: Option<&str>,
    strategy: &str,
    count: u64,
    seed: u64,
) -> PyResult<String> {
    let modules = Modules::new(prefix, dut).map_err(errors::file)?;
    let choice = Choice::of(strategy, count, seed)?;
    py.detach(|| {
        let command = choice.command("rtl", model, format_args!(", prefix={prefix}, dut={}", modules.dut()));
        let emission = modules.into();
        let bundle = choice.bundle(model, &command)?;
        let mut set = OutputSet::create(&out)
            .and_then(|set| set.listed("rtl"))
            .and_then(|set| set.announce(vectors::rtl::names(&emission, choice.strategy)))
            .map_err(errors::file)?;
        let manifest = vectors::rtl::stage(&bundle, &emission, &command, &mut set).map_err(errors::file)?;
        set.commit().map_err(errors::file)?;
        Ok(manifest.to_json())
    })
}

/// The addresses and the bits of x of the vectors that `vectors` would write, in their order.
#[pyfunction]
#[pyo3(signature = (model, *, strategy="mixed", count=4096, seed=1))]
pub(crate) fn stimulus<'py>(
    py: Python<'py>,
    model: &Model,
    strategy: &str,
    count: u64,
    seed: u64,
) -> PyResult<Requests<'py>> {
    let choice = Choice::of(strategy, count, seed)?;
    let (addresses, xs): (Vec<u32>, Vec<i64>) = py.detach(|| {
        let bundle = choice.bundle(model, "")?;
        PyResult::Ok(bundle.samples().map(|sample| (sample.case.address, sample.case.x)).unzip())
    })?;
    Ok((addresses.into_pyarray(py), xs.into_pyarray(py)))
}

/// Judges a log of answers against a directory of vectors: whether all are right, and the verdict in words.
#[pyfunction]
pub(crate) fn check(py: Python<'_>, vectors: PathBuf, log: PathBuf) -> PyResult<(bool, u64, u64, String)> {
    let verdict = py.detach(|| vectors::check(&vectors, &log)).map_err(errors::file)?;
    Ok((verdict.holds(), verdict.vectors, verdict.failing(), verdict.to_string()))
}
