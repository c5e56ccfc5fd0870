//! `blysk rtl`: the hardware, with its testbench and vectors.

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use clap::Args as ClapArgs;
use hw_model::names::{self, NameError};
use hw_model::rtl::TOP;
use vectors::rtl::{Modules, REGISTER_CHECKER, register_checker};
use vectors::{Bundle, Strategy, rtl};

use super::bar::Bar;
use super::configuration::Configuration;
use super::out::{Out, Outcome};
use super::output;
use vectors::progress::Progress;

/// Write the RTL with its testbench, vectors and a Makefile that runs them.
///
/// The directory stands alone: SystemVerilog sources and the package of widths, the ROM image, a
/// self-checking testbench with its vectors, a Makefile for Icarus Verilog and Verilator, and a
/// FuseSoC core file. The same command writes the same bytes.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk rtl --preset compact --out rtl")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: Configuration,
    /// The directory; it is made where it does not exist.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// What the names of modules, package and files begin with, so that several configurations stand in one design.
    #[arg(long, value_name = "NAME", default_value = TOP, value_parser = module_name)]
    prefix: String,
    /// The module under test, where it is your own with the ports of `blysk`. Give its sources to make as DUT=FILE;
    /// only its ports are checked.
    #[arg(long, value_name = "NAME", value_parser = module_name)]
    dut: Option<String>,
    /// Write `blysk_register_checker.sv` too: judges every register beside the golden model by DPI-C, in a simulator
    /// that has it; needs the library libblysk.
    #[arg(long, conflicts_with = "dut")]
    checker: bool,
    /// How vectors are chosen: mixed, corners, even, random or exhaustive.
    #[arg(long, default_value_t)]
    strategy: Strategy,
    /// How many vectors the bundle has.
    #[arg(long, default_value_t = 4096)]
    count: u64,
    /// Seed of the random vectors.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

fn module_name(text: &str) -> Result<String, NameError> {
    names::module(text).map(|()| text.to_owned())
}

impl Args {
    fn command(&self) -> String {
        let Self { prefix, dut, checker, strategy, count, seed, .. } = self;
        let configuration = self.configuration.option();
        let dut = dut.as_ref().filter(|dut| *dut != prefix).map(|dut| format!(" --dut {dut}")).unwrap_or_default();
        let prefix = if prefix == TOP { String::new() } else { format!(" --prefix {prefix}") };
        let checker = if *checker { " --checker" } else { "" };
        format!("blysk rtl {configuration}{prefix}{dut}{checker} --strategy {strategy} --count {count} --seed {seed}")
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let modules = Modules::new(&args.prefix, args.dut.as_deref()).context("--dut")?;
    let design = args.configuration.design()?;
    let command = args.command();
    let inputs = args.configuration.files();
    let checker = args.checker.then(|| modules.file(REGISTER_CHECKER));
    let names = rtl::names(&modules, args.strategy).into_iter().chain(checker.clone());
    let mut set = output::set(&args.out, "rtl", &inputs, names)?;
    let bundle = Bundle::new(&design, args.strategy, args.count, args.seed, &command)?;
    // Every vector goes to the testbench's files and to those of its registers.
    let bar = Bar::counting(Some(2 * bundle.vector_count()), "lines");
    let watcher = |vectors| bar.advance(vectors);
    let manifest = rtl::stage(&bundle.watched(&watcher), &modules, &command, &mut set)?;
    if let Some(name) = checker {
        set.write(&name, register_checker(&design, &modules, &command))?;
    }
    bar.finish();
    set.commit()?;
    let place = names::shell(&args.out);
    let dut = if modules.is_own() { "" } else { " DUT=FILE" };
    writeln!(
        out,
        "{place}: module {}, latency {} cycles, {} vectors; try: make -C {place} icarus{dut}",
        modules.dut(),
        manifest.hardware.latency,
        manifest.counts.vectors,
    )?;
    Ok(Outcome::Good)
}
