//! `blysk simulate`: a stimulus through the clocked pipeline.

use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args as ClapArgs;
use hw_model::datapath::Datapath;
use vectors::rtl::save_file;
use vectors::{Cycle as StimulusLine, WholeFile, read_stimulus};

use super::configuration::Configuration;
use super::table::{Cell, Format, Rows};
use super::{Out, Outcome};
use crate::pipeline::Pipeline;
use crate::run::{Counts, Cycle, StimulusCycle, run as run_stimulus, settle};
use crate::trace::TraceWriter;
use crate::waves::{self, WaveFormat, WaveWriter};

/// Run a stimulus through the clocked pipeline; record every register, every cycle.
///
/// The stimulus is a CSV file with a line for each cycle: columns n, x (or x_bits), and optionally
/// valid, ready, reset (default 1, 1, 0). A request that is not taken stays presented, and those after
/// it wait; after the last line the pipeline runs with ready high until it is empty.
#[derive(ClapArgs)]
#[command(
    after_help = "Example: blysk simulate --preset paper --stimulus in.csv --trace trace.csv --waves out.vcd"
)]
pub(super) struct Args {
    #[command(flatten)]
    configuration: Configuration,
    /// The stimulus.
    #[arg(long, value_name = "FILE")]
    stimulus: PathBuf,
    /// Write every port and register of every cycle to this CSV file.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Write waves to this file, which ends in .vcd, or in .fst for a small part of the size; and beside it
    /// a save file for GTKWave, which ends in .gtkw.
    #[arg(long, value_name = "FILE")]
    waves: Option<PathBuf>,
    /// Write trace.csv, waves.vcd and waves.gtkw to this directory.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["trace", "waves"])]
    out: Option<PathBuf>,
    /// How to print the counts.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = args.configuration.design()?;
    let datapath = design.datapath();
    let stimulus = read_stimulus(&args.stimulus, design.rom(), design.config().input)?;
    let (trace, waves) = match &args.out {
        None => (args.trace.clone(), args.waves.clone()),
        Some(directory) => (Some(directory.join("trace.csv")), Some(directory.join("waves.vcd"))),
    };
    let save = waves.as_ref().map(|waves| waves.with_extension(save_file::EXTENSION));
    let same = |other: &Option<PathBuf>| {
        trace.is_some() && trace.as_deref().map(place) == other.as_deref().map(place)
    };
    if same(&waves) {
        bail!("--trace and --waves name the same file; give each its own");
    }
    if same(&save) {
        bail!("--trace names the save file that comes with --waves; give it another name");
    }
    let format = waves.as_deref().map(wave_format).transpose()?;
    // Nothing gets its name before the run is over.
    let mut trace = trace.map(WholeFile::create).transpose()?;
    let name = &design.config().name;
    let shown = waves.as_deref().map(|dump| waves::save_file(name, datapath, dump));
    let mut waves = waves.map(WholeFile::create).transpose()?;
    let mut save = save.map(WholeFile::create).transpose()?;
    if let Some((file, text)) = save.as_mut().zip(shown) {
        file.write_all(text.as_bytes()).map_err(|error| file.error(error))?;
    }
    let mut recorders = Recorders::new(trace.as_mut(), format.zip(waves.as_mut()), name, datapath)?;
    let mut pipeline = Pipeline::new(datapath);
    let counts =
        run_stimulus(&mut pipeline, stimulus.iter().map(|line| Ok(cycle(line))), |cycle| {
            recorders.cycle(cycle)
        })?;
    settle(&mut pipeline, counts.cycles, |settled| recorders.finish(settled))?;
    for file in [trace, waves, save].into_iter().flatten() {
        file.commit()?;
    }
    print(&counts, datapath.rank_count(), args.format, out)?;
    Ok(Outcome::Good)
}

/// The format that the end of a file's name asks for.
fn wave_format(path: &Path) -> anyhow::Result<WaveFormat> {
    let asked = path.extension().unwrap_or_default();
    let found = WaveFormat::ALL.into_iter().find(|format| asked == format.extension());
    found.with_context(|| {
        format!("--waves {}: give the file a name that ends in .vcd or .fst", path.display())
    })
}

/// Where a path leads, however it is written: the file need not be there yet.
fn place(path: &Path) -> PathBuf {
    let parent = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let parent = parent.canonicalize().or_else(|_| std::path::absolute(parent));
    let name = path.file_name().unwrap_or_default();
    parent.map_or_else(|_| path.to_owned(), |parent| parent.join(name))
}

fn cycle(line: &StimulusLine) -> StimulusCycle {
    let request = line.valid.then_some((line.case.address, line.case.x));
    StimulusCycle { request, ready: line.ready, reset: line.reset }
}

/// What records a run.
struct Recorders<'a> {
    trace: Option<TraceWriter<Target<'a>>>,
    waves: Option<WaveWriter<'a>>,
}

/// A file whose errors say which file it is.
struct Target<'a>(&'a mut WholeFile);

impl Target<'_> {
    fn named(&self, error: io::Error) -> io::Error {
        io::Error::new(error.kind(), self.0.error(error))
    }
}

impl Write for Target<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes).map_err(|error| self.named(error))
    }
    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(|error| self.named(error))
    }
}

impl Seek for Target<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to).map_err(|error| self.named(error))
    }
}

impl<'a> Recorders<'a> {
    fn new(
        trace: Option<&'a mut WholeFile>,
        waves: Option<(WaveFormat, &'a mut WholeFile)>,
        name: &str,
        datapath: &Datapath,
    ) -> anyhow::Result<Self> {
        let trace = trace.map(|file| TraceWriter::new(Target(file), datapath)).transpose()?;
        let waves = waves
            .map(|(format, file)| WaveWriter::new(format, Target(file), name, datapath))
            .transpose()?;
        Ok(Self { trace, waves })
    }

    fn cycle(&mut self, cycle: &Cycle<'_>) -> anyhow::Result<()> {
        if let Some(trace) = &mut self.trace {
            trace.cycle(cycle)?;
        }
        if let Some(waves) = &mut self.waves {
            waves.cycle(cycle)?;
        }
        Ok(())
    }

    fn finish(self, settled: &Cycle<'_>) -> anyhow::Result<()> {
        if let Some(trace) = self.trace {
            trace.finish()?;
        }
        if let Some(waves) = self.waves {
            waves.finish(settled)?;
        }
        Ok(())
    }
}

fn print(counts: &Counts, latency: usize, format: Format, out: &mut Out) -> anyhow::Result<()> {
    let integer = |count: u64| Cell::Integer(count as i64);
    let values = [
        ("cycles", integer(counts.cycles)),
        ("requests", integer(counts.requests)),
        ("results", integer(counts.results)),
        ("lost_to_reset", integer(counts.lost_to_reset)),
        ("stalls", integer(counts.stalls)),
        ("bubbles", integer(counts.bubbles)),
        ("latency", Cell::Integer(latency as i64)),
        ("initiation_interval", counts.initiation_interval().into()),
        ("cycles_per_million_results", counts.cycles_per_million().into()),
    ];
    if format == Format::Table {
        let mut rows = Rows::new(&["count", "value"]);
        for (name, value) in values {
            rows.push(vec![Cell::from(name.replace('_', " ")), value]);
        }
        return rows.print(out, format, 9);
    }
    let (columns, cells): (Vec<&str>, Vec<Cell>) = values.into_iter().unzip();
    let mut rows = Rows::new(&columns);
    rows.push(cells);
    rows.print(out, format, 17)?;
    Ok(out.flush()?)
}
