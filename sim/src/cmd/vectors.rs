//! `blysk vectors`: test vectors for an RTL simulation.

use std::io::Write;
use std::path::PathBuf;

use clap::Args as ClapArgs;
use vectors::{Bundle, Strategy};

use super::configuration::Configuration;
use super::table::write_folded;
use super::{Out, Outcome};

/// Write test vectors for an RTL simulation.
///
/// The directory gets stimulus.mem, expected.mem and rom.mem for $readmemh, vectors.csv (the same with
/// every stage's expected register), and manifest.json. Same command, same bytes.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk vectors --preset paper --count 4096 --seed 1 --out vectors")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: Configuration,
    /// The directory; it is made where it does not exist.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// mixed, corners, even, random or exhaustive (every address with every x).
    #[arg(long, default_value_t)]
    strategy: Strategy,
    /// How many vectors.
    #[arg(long, default_value_t = 4096)]
    count: u64,
    /// Seed of the random ones.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

impl Args {
    /// What made the files: everything that determines their bytes, and not where they went.
    fn command(&self) -> String {
        let Self { strategy, count, seed, .. } = self;
        let configuration = self.configuration.option();
        format!("blysk vectors {configuration} --strategy {strategy} --count {count} --seed {seed}")
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = args.configuration.design()?;
    let bundle = Bundle::new(&design, args.strategy, args.count, args.seed, &args.command())?;
    let manifest = bundle.write_to(&args.out)?;
    let counts = &manifest.counts;
    writeln!(
        out,
        "{}: {} vectors, {} ROM words, latency {} cycles",
        args.out.display(),
        counts.vectors,
        counts.rom_words,
        manifest.hardware.latency
    )?;
    let kinds: Vec<String> =
        counts.kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    write_folded(out, &kinds.join(", "))?;
    for note in &manifest.notes {
        write_folded(out, &format!("note: {note}"))?;
    }
    Ok(Outcome::Good)
}
