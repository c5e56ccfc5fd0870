//! The hardware as files: RTL, package, testbench, and what runs them.

mod dut_ports;
mod dut_testbench;
mod emission;
pub(crate) mod files;
mod modules;
mod package;
pub mod probes;
mod project;
mod register_checker;
pub mod register_log;
pub mod reset_port;
mod rom_source;
pub mod save_file;
mod sources;
mod testbench;
mod testbench_rules;
pub mod wrappers;

use std::io::Write;

use dashu_int::UBig;
use hw_model::datapath::Signals;
use hw_model::design::Design;
pub use hw_model::rtl::{PACKAGE, TESTBENCH};
use hw_model::rtl::{SOURCES, WRAPPER};

use crate::bundle::{self, Bundle, BundleError};
use crate::case::Strategy;
use crate::manifest::Manifest;
use crate::whole_file::{OutputError, OutputFile, OutputSet};

pub use dut_ports::{DutPorts, PortMapError};
pub use dut_testbench::dut_testbench;
pub use emission::{CLOCK_MHZ, Dut, Emission};
pub use files::{CORE, EXPONENTS, MAKEFILE, SAVE_FILE, STAGES};
use files::{SCOPE, WAVES};
pub use modules::Modules;
pub use package::{package, rounding_name, rounding_number};
pub use project::core_name;
pub use register_checker::{REGISTER_CHECKER, register_checker};
pub use save_file::{Names, save_file};
pub use sources::Sources;
pub use testbench::testbench;

use probes::StageWord;
use rom_source::in_source;

/// The names of the files of a directory of hardware.
#[must_use]
pub fn names(emission: &Emission, strategy: Strategy) -> Vec<String> {
    let plain = [MAKEFILE, SAVE_FILE, STAGES, EXPONENTS].into_iter().chain(bundle::names(strategy));
    emission.modules.files().chain(plain.map(str::to_owned)).collect()
}

/// Writes a directory that stands alone into `set`: RTL, package, testbench, ROM image, vectors,
/// Makefile, FuseSoC core file, and what GTKWave shows.
///
/// # Errors
/// When a file cannot be written.
pub fn stage(
    bundle: &Bundle<'_>,
    emission: &Emission,
    command: &str,
    set: &mut OutputSet,
) -> Result<Manifest, BundleError> {
    let (design, modules) = (bundle.design(), &emission.modules);
    let sources = Sources { design, modules, vectors: bundle.vector_count(), control: bundle.flip().vector, command };
    for (name, text) in SOURCES.into_iter().chain([WRAPPER]) {
        let text = if emission.rom_in_source { &in_source(text, design) } else { text };
        let text = reset_port::named(name, text, &design.config().reset);
        set.write(&modules.file(name), modules.text(&text))?;
    }
    set.write(&modules.file(PACKAGE), modules.text(&package(design, command)))?;
    let bench = emission.dut.as_ref().map_or_else(|| testbench(&sources), |dut| dut_testbench(&sources, dut));
    set.write(&modules.file(TESTBENCH), modules.text(&bench))?;
    for (name, text) in wrappers::wrappers(&sources, emission) {
        set.write(&modules.file(name), text)?;
    }
    set.write(MAKEFILE, modules.text(&project::makefile(&sources)))?;
    set.write(&modules.file(CORE), modules.text(&project::core_file(&sources)))?;
    let (names, scope) = match &emission.dut {
        Some(_) => (Names::Testbench, TESTBENCH.trim_end_matches(".sv")),
        None if modules.is_own() => (Names::Rtl, SCOPE),
        None => (Names::Ports, SCOPE),
    };
    set.write(SAVE_FILE, save_file(design.datapath(), names, &modules.text(scope), Some(WAVES)))?;
    stage_words(bundle, command, set)?;
    set.write(EXPONENTS, exponents(design, command))?;
    if let Some(image) = modules.rom_image() {
        bundle.stage_rom(set, &image)?;
    }
    bundle.stage(set)
}

fn stage_words(bundle: &Bundle<'_>, command: &str, set: &mut OutputSet) -> Result<(), OutputError> {
    let datapath = bundle.design().datapath();
    let word = StageWord::of(datapath);
    let mut file = set.file(STAGES)?;
    write_stage_words(&mut file, bundle, command, &word).map_err(|cause| file.error(cause))?;
    set.keep(file).map(drop)
}

fn write_stage_words(
    file: &mut OutputFile,
    bundle: &Bundle<'_>,
    command: &str,
    word: &StageWord,
) -> std::io::Result<()> {
    writeln!(file, "// Blysk registers in the rank that computes them, for $readmemh")?;
    for (probe, lsb) in word.fields.iter().rev() {
        let format = probe.register.format;
        writeln!(file, "//   [{}:{lsb}] {} {format}", lsb + format.width() - 1, probe.name)?;
    }
    writeln!(file, "// made by: {command}")?;
    let digits = word.width.div_ceil(4) as usize;
    for sample in bundle.samples() {
        let passage = bundle.design().datapath().passage(sample.case.address, sample.case.x);
        writeln!(file, "{:0digits$x}", pack(word, &passage))?;
        bundle.written(1);
    }
    Ok(())
}

fn pack(word: &StageWord, passage: &[Signals]) -> UBig {
    word.fields.iter().fold(UBig::ZERO, |packed, (probe, lsb)| {
        let bits = probe.register.bits(&passage[probe.rank]);
        packed | (UBig::from(probe.register.format.to_word(bits)) << *lsb as usize)
    })
}

fn exponents(design: &Design, command: &str) -> String {
    let head = "// Blysk exponents of the ROM words as IEEE doubles, for $readmemh and $bitstoreal\n";
    let mut text = format!("{head}// made by: {command}\n");
    for exponent in design.rom().exponents().iter() {
        text += &format!("{:016x}\n", exponent.to_bits());
    }
    text
}
