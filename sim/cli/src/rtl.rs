//! `blysk rtl`: the hardware, with its testbench and vectors.

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use clap::Args as ClapArgs;
use hw_model::names::{self, NameError};
use hw_model::rtl::TOP;
use vectors::rtl::{self, CLOCK_MHZ, Dut, DutPorts, Emission, Modules, REGISTER_CHECKER, register_checker};

use super::bar::Bar;
use super::choice::Choice;
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
    /// Cycles from a request to its answer in your own module, where they are not the pipeline's.
    #[arg(long, value_name = "CYCLES", requires = "dut")]
    #[arg(value_parser = clap::value_parser!(u32).range(0..=MOST_LATENCY))]
    dut_latency: Option<u32>,
    /// What the ports of your own module are called, and which it has: {"ports": {"clk_i": "clk", "rst_i": "!rst_n",
    /// "in_ready_o": null}, "tied": {"scan": 0}}; ! is active low, null not there.
    #[arg(long, value_name = "FILE", requires = "dut")]
    ports: Option<PathBuf>,
    /// The clock in the constraints (SDC) that are written for synthesis, in MHz.
    #[arg(long, value_name = "MHZ", default_value_t = CLOCK_MHZ, value_parser = clock)]
    clock_mhz: f64,
    /// Put the ROM's words into the source, for tools that read no memory files.
    #[arg(long, conflicts_with = "dut")]
    rom_in_source: bool,
    #[command(flatten)]
    choice: Choice,
}

/// The longest latency of a module under test: its testbench keeps what is under way.
const MOST_LATENCY: i64 = 1 << 16;

fn clock(text: &str) -> Result<f64, String> {
    let right = |mhz: &f64| (0.001..=100_000.0).contains(mhz);
    text.parse().ok().filter(right).ok_or_else(|| "write a clock in MHz from 0.001 to 100000, such as 125".to_owned())
}

fn module_name(text: &str) -> Result<String, NameError> {
    names::module(text).map(|()| text.to_owned())
}

impl Args {
    /// How the module under test differs from the pipeline, where something is said of that.
    fn dut(&self) -> anyhow::Result<Option<Dut>> {
        if self.dut_latency.is_none() && self.ports.is_none() {
            return Ok(None);
        }
        let ports = self.ports.as_ref().map(|path| DutPorts::read(path)).transpose()?.unwrap_or_default();
        Ok(Some(Dut { latency: self.dut_latency, ports }))
    }

    fn command(&self) -> String {
        let Self { prefix, dut, choice, .. } = self;
        let configuration = self.configuration.option();
        let dut = dut.as_ref().filter(|dut| *dut != prefix).map(|dut| format!(" --dut {dut}")).unwrap_or_default();
        let prefix = if prefix == TOP { String::new() } else { format!(" --prefix {prefix}") };
        let latency = self.dut_latency.map(|cycles| format!(" --dut-latency {cycles}")).unwrap_or_default();
        let ports = self.ports.as_ref().map(|path| format!(" --ports {}", names::shell(path))).unwrap_or_default();
        let clock =
            if self.clock_mhz == CLOCK_MHZ { String::new() } else { format!(" --clock-mhz {}", self.clock_mhz) };
        let checker = if self.checker { " --checker" } else { "" };
        let rom = if self.rom_in_source { " --rom-in-source" } else { "" };
        format!("blysk rtl {configuration}{prefix}{dut}{latency}{ports}{checker}{rom}{clock} {}", choice.options())
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let modules = Modules::new(&args.prefix, args.dut.as_deref()).context("--dut")?;
    let emission = Emission { modules, rom_in_source: args.rom_in_source, dut: args.dut()?, clock_mhz: args.clock_mhz };
    let modules = &emission.modules;
    let design = args.configuration.design()?;
    let command = args.command();
    let maps = args.ports.iter().cloned().collect();
    let inputs = [args.configuration.files(), args.choice.files(), maps].concat();
    let checker = args.checker.then(|| modules.file(REGISTER_CHECKER));
    let names = rtl::names(&emission, args.choice.strategy()).into_iter().chain(checker.clone());
    let mut set = output::set(&args.out, "rtl", &inputs, names)?;
    let bundle = args.choice.bundle(&design, &command)?;
    // Every vector goes to the testbench's files and to those of its registers.
    let bar = Bar::counting(Some(2 * bundle.vector_count()), "lines");
    let watcher = |vectors| bar.advance(vectors);
    let manifest = rtl::stage(&bundle.watched(&watcher), &emission, &command, &mut set)?;
    if let Some(name) = checker {
        set.write(&name, register_checker(&design, modules, &command))?;
    }
    bar.finish();
    set.commit()?;
    let place = names::shell(&args.out);
    let latency = emission.dut.as_ref().and_then(|dut| dut.latency).unwrap_or(manifest.hardware.latency);
    let dut = if modules.is_own() { "" } else { " DUT=FILE" };
    writeln!(
        out,
        "{place}: module {}, latency {latency} cycles, {} vectors; try: make -C {place} icarus{dut}",
        modules.dut(),
        manifest.counts.vectors,
    )?;
    Ok(Outcome::Good)
}
