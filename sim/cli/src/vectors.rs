//! `blysk vectors`: test vectors for an RTL simulation.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::{Args as ClapArgs, ValueEnum};
use sim::coverage::Coverage;
use vectors::output_text::json;
use vectors::{Bundle, Manifest, WholeFile, bundle};

use super::bar::Bar;
use super::choice::Choice;
use super::configuration::Configuration;
use super::coverage;
use super::out::{Out, Outcome};
use super::output;
use super::table::write_folded;
use vectors::progress::Progress;

/// Write test vectors for an RTL simulation.
///
/// The directory gets stimulus.mem, expected.mem and rom.mem for $readmemh, vectors.csv (the same vectors with
/// every expected register), and manifest.json; and negative_control.mem, which is expected.mem with
/// one wrong word: a testbench that is given it must fail. The same command writes the same bytes.
///
/// Strategy compact looks at every input for the fewest vectors that show every fault of the fault model, and
/// writes faults.csv; that takes minutes. --cases takes your own list of (n, x).
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk vectors --preset paper --count 4096 --seed 1 --out vectors\n          \
                        blysk vectors --config small.json --strategy compact --out fewest\n          \
                        blysk vectors --preset paper --cases mine.csv --out mine\n          \
                        blysk vectors --preset paper --count 64 --format csv --out -")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: Configuration,
    /// The directory; it is made where it does not exist. With --format csv the file, or - for standard output.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Which files to write.
    #[arg(long, value_enum, default_value_t)]
    format: Shape,
    #[command(flatten)]
    choice: Choice,
    /// Also write coverage.json, and print it: the bits of every register that changed, and those that cannot; the
    /// classes of corners; regions under stalls and bubbles.
    #[arg(long)]
    coverage: bool,
}

/// The files that the command writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Shape {
    /// Every file of the bundle.
    #[default]
    Files,
    /// What vectors.csv holds, alone.
    Csv,
}

impl Args {
    /// What made the files: everything that determines their bytes, and not where they went.
    fn command(&self) -> String {
        format!("blysk vectors {} {}", self.configuration.option(), self.choice.options())
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = args.configuration.design()?;
    let command = args.command();
    let inputs = [args.configuration.files(), args.choice.files()].concat();
    let bundle = || args.choice.bundle(&design, &command);
    if args.format == Shape::Csv {
        let file = WholeFile::apart_from(&inputs, &args.out)?;
        if args.coverage {
            bail!("--coverage is for --format files; coverage.json stands beside them");
        }
        return table(&bundle()?, file, out);
    }
    let mut set = output::set(&args.out, bundle::COMMAND, &inputs, names(args))?;
    let bundle = bundle()?;
    let bar = Bar::counting(Some(bundle.vector_count()), "vectors");
    let watcher = |vectors| bar.advance(vectors);
    let bundle = bundle.watched(&watcher);
    let manifest = bundle.stage(&mut set)?;
    bar.finish();
    let coverage = args.coverage.then(|| Coverage::of(&design, &bundle.samples().collect::<Vec<_>>(), manifest.seed));
    match &coverage {
        Some(coverage) => set.write(coverage::FILE, json(coverage)?)?,
        // Of other vectors in the same directory.
        None => set.obsolete(coverage::FILE),
    }
    set.commit()?;
    print(args, &manifest, out)?;
    if let Some(coverage) = &coverage {
        coverage::print(coverage, out)?;
    }
    Ok(Outcome::Good)
}

/// The files of the command.
fn names(args: &Args) -> impl Iterator<Item = &'static str> {
    bundle::names(args.choice.strategy()).chain(args.coverage.then_some(coverage::FILE))
}

/// Writes what `vectors.csv` of the bundle would hold, and nothing else.
fn table(bundle: &Bundle<'_>, file: WholeFile, out: &mut Out) -> anyhow::Result<Outcome> {
    let count = bundle.vector_count();
    let alone = file.is_standard_output();
    let place = bundle.write_table(file)?.commit()?;
    if !alone {
        writeln!(out, "{}: {count} vectors", place.display())?;
    }
    Ok(Outcome::Good)
}

fn print(args: &Args, manifest: &Manifest, out: &mut Out) -> anyhow::Result<()> {
    let counts = &manifest.counts;
    writeln!(
        out,
        "{}: {} vectors, {} ROM words, latency {} cycles",
        args.out.display(),
        counts.vectors,
        counts.rom_words,
        manifest.hardware.latency
    )?;
    let kinds: Vec<String> = counts.kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    write_folded(out, &kinds.join(", "))?;
    for note in &manifest.notes {
        write_folded(out, &format!("note: {note}"))?;
    }
    Ok(())
}
