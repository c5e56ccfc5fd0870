//! Vector files and waves.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::Instant;

use hw_model::design::Design;
use sim::pipeline::{Inputs, Pipeline};
use sim::run::{Cycle, settle};
use sim::waves::{WaveFormat, WaveWriter};
use vectors::{Bundle, Strategy};

use super::Timed;
use super::engines::{Random, Stimulus, processor};
use crate::rtl::Failure;

fn failure(error: impl std::fmt::Display) -> Failure {
    Failure(error.to_string())
}

fn bytes(directory: &Path) -> Result<u64, Failure> {
    let mut bytes = 0;
    for entry in std::fs::read_dir(directory).map_err(failure)? {
        bytes += entry.and_then(|entry| entry.metadata()).map_err(failure)?.len();
    }
    Ok(bytes)
}

/// A bundle of uniform vectors, complete: ROM, stimulus, answers, table and manifest. Counts bytes.
///
/// # Errors
/// When it cannot be written.
pub fn bundle(design: &Design, vectors: u64, directory: &Path) -> Result<Timed, Failure> {
    let begin = Instant::now();
    let bundle = Bundle::new(design, Strategy::Random, vectors, 1, "make bench");
    bundle.and_then(|bundle| bundle.write_to(directory)).map_err(failure)?;
    let seconds = begin.elapsed().as_secs_f64();
    Ok(Timed { count: bytes(directory)?, seconds, checksum: 0 })
}

/// Stimulus and answers alone, as one writes them first: a `write!` for each word. Counts bytes.
///
/// # Errors
/// When they cannot be written.
pub fn naive_vectors(design: &Design, vectors: u64, path: &Path) -> Result<Timed, Failure> {
    let begin = Instant::now();
    let mut out = BufWriter::new(File::create(path).map_err(failure)?);
    let mut stimulus = Random::new();
    for _ in 0..vectors {
        let (address, x) = stimulus.next();
        let last = design.datapath().evaluate(address, x);
        let (intensity, status) = (last.intensity, last.status.bits());
        writeln!(out, "{address:03x}{x:06x}\n{status:x}{intensity:04x}").map_err(failure)?;
    }
    out.flush().map_err(failure)?;
    let seconds = begin.elapsed().as_secs_f64();
    let count = path.metadata().map_err(failure)?.len();
    Ok(Timed { count, seconds, checksum: 0 })
}

/// Waves of the clocked simulator, every register. Counts cycles.
///
/// # Errors
/// When they cannot be written.
pub fn waves(design: &Design, cycles: u64, path: &Path) -> Result<Timed, Failure> {
    let begin = processor();
    let datapath = design.datapath();
    let out = BufWriter::with_capacity(1 << 16, File::create(path).map_err(failure)?);
    let name = &design.config().name;
    let mut writer = WaveWriter::new(WaveFormat::Vcd, out, name, datapath).map_err(failure)?;
    let (mut pipeline, mut stimulus) = (Pipeline::new(datapath), Random::new());
    for index in 0..cycles {
        let (address, x) = stimulus.next();
        let inputs = Inputs { reset: false, in_valid: true, address, x, out_ready: true };
        let outputs = pipeline.combinational(&inputs);
        let cycle = Cycle { index, inputs: &inputs, outputs: &outputs, ranks: pipeline.ranks() };
        writer.cycle(&cycle).map_err(failure)?;
        pipeline.clock();
    }
    settle(&mut pipeline, cycles, |settled| writer.finish(settled)).map_err(failure)?;
    Ok(Timed { count: cycles, seconds: processor() - begin, checksum: 0 })
}
