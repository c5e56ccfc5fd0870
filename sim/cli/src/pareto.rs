//! `blysk pareto`: work against precision.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::{Args as ClapArgs, ValueEnum};
use hw_model::config::Config;
use hw_model::exponents::Exponents;
use hw_model::format::QFormat;
use hw_model::names;
use vectors::configuration_file;
use vectors::text_file::{self, PARETO_TABLE, SYNTHESIS_TABLE, foreign_separator};

use super::bar::Bar;
use super::out::{Out, Outcome};
use super::output;
use super::pareto_page::{FILE, page};
use super::pareto_tables as tables;
use super::table::write_folded;
use analysis::pareto::check::{differences, not_checked};
use analysis::pareto::contender::Contenders;
use analysis::pareto::inputs::Inputs;
use analysis::pareto::synthesis::{self, Synthesis};
use analysis::pareto::timing::FEWEST_ROUNDS;
use analysis::pareto::{ParetoReport, TimingOptions, compare};
use analysis::report::pareto as files;

/// Compare every method and preset by error and cost, and tell which are dominated.
///
/// Methods in f32 and f64, powf, repeated squaring, tables of straight lines, every preset and your own configurations
/// (--config) bit for bit: the greatest and the RMS error over every representable x of every exponent (minutes of
/// work; less with --every, --input or --exponents), run time side by side in this process, and the hardware's
/// latency, multipliers and ROM. A contender is dominated when another is nowhere worse and somewhere better. With
/// --out, the directory gets pareto.csv, pareto_timing.csv, pareto.json, and plots as SVG and PNG. Exit status: 0; 1
/// when --check finds a difference; 2 for an error.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk pareto --every 1009 --rounds 15 --out pareto\n          \
                        blysk pareto --input UQ1.10 --exponents 1..=8 --no-timing --format csv")]
pub(super) struct Args {
    /// The exponents of all contenders.
    #[arg(long, allow_hyphen_values = true, value_name = "LIST", default_value = "1..=256")]
    exponents: Exponents,
    /// The format of x, for presets and processors alike.
    #[arg(long, value_name = "FORMAT", default_value = "UQ1.23")]
    input: QFormat,
    /// A configuration of your own beside the presets, with the exponents and the input of all; may be repeated.
    #[arg(long, value_name = "FILE")]
    config: Vec<PathBuf>,
    /// Look at every K-th x only; every output then says so.
    #[arg(long, value_name = "K", default_value_t = 1,
          value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,
    /// Leave out run times, which differ from run to run: the other outputs are the same bytes every time.
    #[arg(long)]
    no_timing: bool,
    /// Rounds of timing, in each of which every contender has a turn; 15 at least.
    #[arg(long, value_name = "COUNT", default_value_t = 101, conflicts_with = "no_timing",
          value_parser = clap::value_parser!(u64).range(FEWEST_ROUNDS..=100_000))]
    rounds: u64,
    /// Seed of the x and n that are timed.
    #[arg(long, default_value_t = 1, conflicts_with = "no_timing")]
    seed: u64,
    /// The table that `make synth` wrote (default: results/synth/synth.csv, where there is one).
    #[arg(long, value_name = "FILE")]
    synth: Option<PathBuf>,
    /// Write the files to this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write pareto.html there too: tables that sort and plots that tell values, in one file.
    #[arg(long, requires = "out")]
    html: bool,
    /// Check whether a pareto.csv of the same exponents and input still holds: costs, the greatest errors at their x,
    /// and no greater error among every K-th x.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["out", "html", "synth", "format"])]
    check: Option<PathBuf>,
    /// What to print of the comparison.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Format {
    /// For people, at most 100 columns wide.
    #[default]
    Table,
    /// pareto.csv: nothing that depends on the machine.
    Csv,
    /// Everything that pareto.json has.
    Json,
    /// Everything as a page.
    Markdown,
}

impl Args {
    /// The command, without the place of its files, which are the same wherever they stand.
    fn command(&self) -> String {
        let mut command = format!("blysk pareto --exponents {} --input {}", self.exponents, self.input);
        self.config.iter().for_each(|path| command.push_str(&format!(" --config {}", names::shell(path))));
        if self.every > 1 {
            command.push_str(&format!(" --every {}", self.every));
        }
        if self.no_timing {
            command.push_str(" --no-timing");
        } else {
            command.push_str(&format!(" --rounds {} --seed {}", self.rounds, self.seed));
        }
        if let Some(path) = &self.synth {
            command.push_str(&format!(" --synth {}", names::shell(path)));
        }
        command + " --html"
    }
}

/// Where `make synth` writes.
const SYNTH: &str = "results/synth/synth.csv";

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let inputs = Inputs::new(args.input, args.exponents.clone(), args.every)?;
    let own = args.config.iter().map(|path| configuration_file::read(path)).collect::<Result<Vec<_>, _>>()?;
    if let Some(kept) = &args.check {
        return check(kept, &inputs, &own, out);
    }
    let (synthesis, origin) = synthesised(args)?;
    // Made before the work, so that an unwritable place is found at once.
    let synth = args.synth.clone().unwrap_or_else(|| PathBuf::from(SYNTH));
    let read = [args.config.as_slice(), &[synth]].concat();
    let names = files::TABLES.into_iter().chain(args.html.then_some(FILE));
    let set = args.out.as_deref().map(|out| output::set(out, "pareto", &read, names)).transpose()?;
    let timing = (!args.no_timing).then_some(TimingOptions { rounds: args.rounds, seed: args.seed });
    let bar = Bar::new(Some(inputs.count()));
    let report = compare(&inputs, &own, timing, &synthesis, &bar)?;
    bar.finish();
    let mut names = Vec::new();
    if let Some(mut set) = set {
        names = files::write(&mut set, &report)?;
        if args.html {
            set.write(FILE, page(&report, &origin, args.command())?)?;
            names.push(FILE.to_owned());
        } else {
            set.obsolete(FILE);
        }
        set.commit()?;
    }
    match args.format {
        Format::Table => tables::print(&report, &origin, out)?,
        Format::Csv => out.write_all(&files::table(&report)?)?,
        Format::Json => out.write_all(files::json(&report)?.as_bytes())?,
        Format::Markdown => tables::page(&report, out)?,
    }
    if let (Some(directory), Format::Table) = (&args.out, args.format) {
        written(directory, names, out)?;
    }
    Ok(Outcome::Good)
}

fn written(directory: &Path, names: Vec<String>, out: &mut Out) -> anyhow::Result<()> {
    let (tables, plots): (Vec<_>, Vec<_>) = names.into_iter().partition(|name| name.contains('.'));
    writeln!(out, "\nwritten to {}:", directory.display())?;
    write_folded(out, &tables.join(", "))?;
    write_folded(out, &format!("plots as .svg and .png: {}", plots.join(", ")))?;
    Ok(())
}

/// What was synthesised, and a line that says where it is from.
fn synthesised(args: &Args) -> anyhow::Result<(Vec<Synthesis>, String)> {
    let path = args.synth.clone().unwrap_or_else(|| PathBuf::from(SYNTH));
    let shown = path.display();
    let text = match text_file::read(&path, SYNTHESIS_TABLE) {
        Ok(text) => text,
        Err(error) if args.synth.is_none() && error.is_missing() => {
            let said = format!("no synthesis results: there is no {SYNTH} (`make synth` makes it)");
            return Ok((Vec::new(), said));
        }
        Err(error) => return Err(error.into()),
    };
    refuse_foreign(&text, &path)?;
    let rows = synthesis::read(&text).with_context(|| shown.to_string())?;
    Ok((rows, format!("synthesis results: {shown}")))
}

/// A table that a spreadsheet of another country has written.
fn refuse_foreign(text: &str, path: &Path) -> anyhow::Result<()> {
    match text.lines().next().and_then(foreign_separator) {
        Some(problem) => bail!("{}:1: {problem}", path.display()),
        None => Ok(()),
    }
}

fn check(path: &Path, inputs: &Inputs, own: &[Config], out: &mut Out) -> anyhow::Result<Outcome> {
    let shown = path.display();
    let text = text_file::read(path, PARETO_TABLE)?;
    refuse_foreign(&text, path)?;
    let kept = files::read(&text).with_context(|| shown.to_string())?;
    if kept.is_empty() {
        bail!("{shown} has no contender");
    }
    let bar = Bar::new(Some(inputs.count()));
    let made: ParetoReport = compare(inputs, own, None, &[], &bar)?;
    bar.finish();
    let contenders = Contenders::new(inputs, own)?.list;
    let found = differences(&kept, &made, &contenders, inputs);
    for line in &found {
        write_folded(out, line)?;
    }
    if found.is_empty() {
        let (count, samples) = (kept.len(), made.samples);
        writeln!(out, "{shown} holds: {count} contenders, {samples} samples each")?;
        if let Some(said) = not_checked(&kept, inputs) {
            write_folded(out, &said)?;
        }
        return Ok(Outcome::Good);
    }
    writeln!(out, "{shown} does not hold any more: {} differences", found.len())?;
    Ok(Outcome::Fails)
}
