//! Vector files, waves and answers to files of questions.

use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::Path;
use std::time::Instant;

use hw_model::design::Design;
use hw_model::format::Overflow;
use hw_model::quantise::x_bits;
use sim::pipeline::{Inputs, Pipeline};
use sim::run::{Cycle, settle};
use sim::waves::{WaveFormat, WaveWriter};
use vectors::evaluate::{Answer, Csv, Question, stream};
use vectors::text_file::{self, QUESTIONS};
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

/// How the columns of questions are named.
pub const COLUMNS: [&str; 2] = ["n,x", "address,x_bits"];

/// Questions at random in a file: with the columns n,x an n of 1 to 256 and an x of six to nine decimals, with
/// address,x_bits the same n and an x of the input format.
///
/// # Errors
/// When it cannot be written.
pub fn questions(columns: &str, count: u64, path: &Path) -> Result<(), Failure> {
    let mut out = BufWriter::new(File::create(path).map_err(failure)?);
    let mut stimulus = Random::new();
    writeln!(out, "{columns}").map_err(failure)?;
    for _ in 0..count {
        let (address, x_bits) = stimulus.next();
        let random = (x_bits as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let decimals = 6 + (random >> 62) as usize;
        let x = random % 10_u64.pow(decimals as u32);
        match columns {
            "n,x" => writeln!(out, "{},0.{x:0decimals$}", address + 1),
            _ => writeln!(out, "{address},{x_bits}"),
        }
        .map_err(failure)?;
    }
    out.flush().map_err(failure)
}

/// The answers to a file of questions, as `blysk evaluate` gives them, in one thread; they go nowhere. Counts answers.
///
/// # Errors
/// When the file cannot be read.
pub fn answered(design: &Design, path: &Path) -> Result<Timed, Failure> {
    let begin = processor();
    let questions = text_file::open(path, QUESTIONS).map_err(failure)?;
    let mut csv = Csv::new(design.datapath());
    let count = stream(design.datapath(), &mut csv, (path, questions), &mut std::io::sink());
    Ok(Timed { count: count.map_err(failure)?, seconds: processor() - begin, checksum: 0 })
}

/// The same as one writes it first: a line, `split`, `parse`, an answer and a `writeln!` at a time.
///
/// # Errors
/// When the file cannot be read.
pub fn naively_answered(design: &Design, path: &Path) -> Result<Timed, Failure> {
    let begin = processor();
    let (datapath, mut out, mut count) = (design.datapath(), BufWriter::new(std::io::sink()), 0);
    for line in BufReader::new(File::open(path).map_err(failure)?).lines().skip(1) {
        let line = line.map_err(failure)?;
        let (n, x) = line.split_once(',').ok_or_else(|| Failure(line.clone()))?;
        let n: f64 = n.parse().map_err(failure)?;
        let x: f64 = x.parse().map_err(failure)?;
        let x = x_bits(x, design.config().input, Overflow::Refuse).map_err(failure)?;
        let answer = Answer::of(datapath, Question::of(datapath.rom(), n, x));
        let reference = answer.reference(datapath).unwrap_or_default();
        let (x, value) = (answer.x(datapath), answer.value(datapath));
        let error = answer.error_ulp(datapath, reference);
        let (region, bits) = (answer.region.name(), answer.intensity);
        let status = answer.status.bits();
        writeln!(out, "{n},{x},{value},{reference},{error},{region},{bits},{status}").map_err(failure)?;
        count += 1;
    }
    Ok(Timed { count, seconds: processor() - begin, checksum: 0 })
}
