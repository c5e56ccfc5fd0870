//! `blysk rtl`: the hardware, with its testbench and vectors.

use std::io::Write;
use std::path::PathBuf;

use clap::Args as ClapArgs;
use hw_model::rtl::TOP;
use vectors::{Bundle, OutputSet, Strategy, rtl};

use super::bar::Bar;
use super::configuration::Configuration;
use super::{Out, Outcome};
use crate::analysis::error_report::Progress;

/// Write the RTL with its testbench, vectors and a Makefile that runs them.
///
/// The directory stands alone: SystemVerilog sources and the package of widths, the ROM image, a
/// self-checking testbench with its vectors, a Makefile for Icarus Verilog and Verilator, and a
/// FuseSoC core file. Same command, same bytes.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk rtl --preset compact --out rtl")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: Configuration,
    /// The directory; it is made where it does not exist.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// The module under test: your own, with the ports of `blysk`. Its sources go into DUT of the
    /// Makefile; only its ports are checked.
    #[arg(long, value_name = "NAME", default_value = TOP, value_parser = module_name)]
    dut: String,
    /// How vectors are chosen: mixed, corners, even, random or exhaustive.
    #[arg(long, default_value_t)]
    strategy: Strategy,
    /// How many vectors.
    #[arg(long, default_value_t = 4096)]
    count: u64,
    /// Seed of the random ones.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// A simple Verilog identifier.
fn module_name(text: &str) -> Result<String, String> {
    let first = |c: char| c.is_ascii_alphabetic() || c == '_';
    let rest = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '$';
    if text.starts_with(first) && text.chars().all(rest) {
        Ok(text.to_owned())
    } else {
        Err("use the name of a module: letters, digits and _, not beginning with a digit".into())
    }
}

impl Args {
    fn command(&self) -> String {
        let Self { dut, strategy, count, seed, .. } = self;
        let configuration = self.configuration.option();
        let dut = if dut == TOP { String::new() } else { format!(" --dut {dut}") };
        format!(
            "blysk rtl {configuration}{dut} --strategy {strategy} --count {count} --seed {seed}"
        )
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = args.configuration.design()?;
    let command = args.command();
    let bundle = Bundle::new(&design, args.strategy, args.count, args.seed, &command)?;
    let mut set = OutputSet::create(&args.out)?;
    // Every vector goes to the testbench's files and to those of its registers.
    let bar = Bar::counting(Some(2 * bundle.vector_count()), "lines");
    let watcher = |vectors| bar.advance(vectors);
    let manifest = rtl::stage(&bundle.watched(&watcher), &args.dut, &command, &mut set)?;
    bar.finish();
    set.commit()?;
    let place = args.out.display();
    writeln!(
        out,
        "{place}: module {}, latency {} cycles, {} vectors; try: make -C {place} icarus",
        args.dut, manifest.hardware.latency, manifest.counts.vectors,
    )?;
    Ok(Outcome::Good)
}
