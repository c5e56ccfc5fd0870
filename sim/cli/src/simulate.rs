//! `blysk simulate`: a stimulus through the clocked pipeline.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args as ClapArgs;
use hw_model::datapath::Datapath;
use vectors::read_stimulus;
use vectors::stimulus_file::parse_stimulus;

use super::answers::Answers;
use super::bar::{self, Bar};
use super::configuration::Configuration;
use super::out::{Out, Outcome};
use super::output::is_standard_output;
use super::recordings::{Recordings, Target};
use super::table::{Cell, Format, Rows};
use sim::pipeline::Pipeline;
use sim::run::{Counts, Cycle, StimulusCycle, run as run_stimulus, settle};
use sim::trace::TraceWriter;
use sim::waves::{WaveFormat, WaveWriter};
use vectors::progress::Progress;

/// Run a stimulus through the clocked pipeline; record every register, every cycle.
///
/// The stimulus is a CSV file with a line for each cycle: columns n, x (or x_bits), and optionally
/// valid, ready, reset (default 1, 1, 0). A request that is not taken stays presented, and those after
/// it wait; after the last line the pipeline runs with ready high until it is empty. Printed are the counts, and in a
/// table for people the first answers; with --out - every answer, as CSV.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk simulate --preset paper --stimulus in.csv --trace trace.csv --waves out.vcd")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: Configuration,
    /// The stimulus; - is standard input.
    #[arg(long, value_name = "FILE")]
    stimulus: PathBuf,
    /// Write every port and register of every cycle to this CSV file; - is standard output, which then has nothing
    /// else.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Write waves to this file, which ends in .vcd, or in .fst for a small part of the size; and beside it
    /// a save file for GTKWave, which ends in .gtkw.
    #[arg(long, value_name = "FILE")]
    waves: Option<PathBuf>,
    /// Write trace.csv, waves.vcd and waves.gtkw to this directory; with -, write every answer as CSV to standard
    /// output, which then has nothing else.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["trace", "waves"])]
    out: Option<PathBuf>,
    /// How to print the counts.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = args.configuration.design()?;
    let datapath = design.datapath();
    let from_standard_input = args.stimulus == Path::new("-");
    let stimulus_file = (!from_standard_input).then(|| args.stimulus.clone());
    let inputs = [stimulus_file.into_iter().collect(), args.configuration.files()].concat();
    let all_answers = args.out.as_deref().is_some_and(is_standard_output);
    let mut recordings = match args.out.as_ref().filter(|_| !all_answers) {
        None => Recordings::of_files(args.trace.as_deref(), args.waves.as_deref(), &inputs)?,
        Some(directory) => Recordings::in_directory(directory, &inputs)?,
    };
    let (rom, input) = (design.rom(), design.config().input);
    let stimulus = if from_standard_input {
        // Who types a stimulus at a terminal is not shown for how long the command has waited.
        bar::end();
        parse_stimulus(io::stdin(), Path::new("standard input"), rom, input)?
    } else {
        read_stimulus(&args.stimulus, rom, input)?
    };
    let name = &design.config().name;
    recordings.save(name, datapath)?;
    let (trace, waves) = recordings.targets();
    let mut recorders = Recorders::new(trace, waves, name, datapath)?;
    let mut pipeline = Pipeline::new(datapath);
    let bar = Bar::counting(Some(stimulus.len() as u64), "cycles");
    let mut answers = Answers::new(datapath, all_answers.then_some(&mut *out))?;
    let counts = run_stimulus(&mut pipeline, stimulus.iter().map(|line| Ok(StimulusCycle::from(line))), |cycle| {
        bar.advance(1);
        answers.cycle(cycle)?;
        recorders.cycle(cycle)
    })?;
    let first = answers.finish()?;
    bar.finish();
    settle(&mut pipeline, counts.cycles, |settled| recorders.finish(settled))?;
    let alone = recordings.commit()?;
    if !alone && !all_answers {
        print(&counts, datapath.latency(), args.format, out)?;
        if args.format == Format::Table {
            first.print(counts.results, out)?;
        }
    }
    Ok(Outcome::Good)
}

/// What records a run.
struct Recorders<'a> {
    trace: Option<TraceWriter<Target<'a>>>,
    waves: Option<WaveWriter<'a>>,
}

impl<'a> Recorders<'a> {
    fn new(
        trace: Option<Target<'a>>,
        waves: Option<(WaveFormat, Target<'a>)>,
        name: &str,
        datapath: &Datapath,
    ) -> anyhow::Result<Self> {
        let trace = trace.map(|file| TraceWriter::new(file, datapath)).transpose()?;
        let waves = waves.map(|(format, file)| WaveWriter::new(format, file, name, datapath)).transpose()?;
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
