//! Wrong RTL, made on purpose: does a bundle of vectors catch it?
//!
//! Three kinds: other ROM contents ([`rom`]), lines of the RTL changed as the fault model says
//! ([`edits`]), and random mutations of the synthesised netlist ([`netlist`]). Each runs with a testbench
//! that sees the ports only, as a designer's own module would.

pub mod edits;
pub mod netlist;
pub mod proof;
pub mod rom;

use std::path::{Path, PathBuf};

use hw_model::design::Design;
use hw_model::rtl::TOP;
use vectors::faults::Fault;
use vectors::rtl::Modules;
use vectors::{Bundle, OutputSet, rtl};

use super::simulators::{Simulator, fresh};
use super::workspace::copy;
use super::{Failure, failed};

/// The class of exchanged rows that the fault model does not have.
pub const DISTANT_ROWS: &str = "distant rows";
/// The class of mutations of the netlist.
pub const NETLIST: &str = "netlist";
/// The class of what only a clock and a stalled consumer show.
pub const HANDSHAKE: &str = "handshake";

/// The class that a fault of the model is counted in.
#[must_use]
pub const fn class(fault: Fault) -> &'static str {
    match fault {
        Fault::Field(_) => "coefficient",
        Fault::Swap(_) => "neighbouring rows",
        Fault::Rounding(..) => "rounding",
        Fault::Register(..) => "register",
        Fault::Logic(_) => "choice",
    }
}

const WRAPPER: &str = include_str!("../blysk_mutated.sv");

/// What became of a mutant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outcome {
    /// The name of the mutant, for tables.
    pub name: String,
    /// What the testbench found: `vector 17`, `handshake`; none where it passed.
    pub killed_by: Option<String>,
}

/// A directory in which mutants are run: the RTL, a bundle, and the wrapper.
#[derive(Debug)]
pub struct Bench {
    /// The directory in which mutants are built and run.
    pub directory: PathBuf,
}

impl Bench {
    /// A fresh directory `target/rtl/<name>`.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn new(name: &str, bundle: &Bundle<'_>) -> Result<Self, Failure> {
        let directory = fresh(name)?;
        let dut = Modules::new(TOP, Some("blysk_mutated")).map_err(|error| Failure(error.to_string()))?;
        let written = || -> Result<(), vectors::BundleError> {
            let mut set = OutputSet::create(&directory)?;
            rtl::stage(bundle, &dut.clone().into(), "make mutants", &mut set)?;
            set.write("blysk_mutated.sv", WRAPPER)?;
            set.commit()?;
            Ok(())
        };
        written().map_err(|error| Failure(error.to_string()))?;
        Ok(Self { directory })
    }

    /// Builds the testbench with these sources as the module under test.
    ///
    /// # Errors
    /// With what the simulator says.
    pub fn build(&self, simulator: &Simulator, sources: &str) -> Result<(), Failure> {
        let target = if simulator.is_icarus() { "blysk.vvp" } else { "verilated/blysk_tb" };
        let target = format!("{}/{target}", simulator.build());
        let output = simulator
            .make(&self.directory, &target)
            .arg(format!("DUT={sources}"))
            .output()
            .map_err(|error| Failure(error.to_string()))?;
        if output.status.success() {
            return Ok(());
        }
        failed(String::from_utf8_lossy(&[output.stdout, output.stderr].concat()))
    }

    /// Runs the built testbench in a directory, which has the files it reads.
    ///
    /// # Errors
    /// When it says neither PASS nor FAIL.
    pub fn run(&self, simulator: &Simulator, place: &Path, plusargs: &[String]) -> Result<Option<String>, Failure> {
        let mut command = simulator.testbench(&self.directory);
        let output = command.current_dir(place).args(plusargs).output();
        let output = output.map_err(|error| Failure(error.to_string()))?;
        let text = String::from_utf8_lossy(&output.stdout);
        for line in text.lines() {
            if line.starts_with("PASS ") {
                return Ok(None);
            }
            if let Some(failure) = line.strip_prefix("FAIL ") {
                let end = failure.find([':', ',']).unwrap_or(failure.len());
                return Ok(Some(failure[..end].to_owned()));
            }
        }
        failed(format!("no verdict: {text}"))
    }

    /// Forgets what was built.
    ///
    /// # Errors
    /// When it cannot be removed.
    pub fn clear(&self, simulator: &Simulator) -> Result<(), Failure> {
        std::fs::remove_dir_all(self.directory.join(simulator.build())).map_err(|error| Failure(error.to_string()))
    }

    /// Compiles a copy with one line changed, and runs it.
    ///
    /// # Errors
    /// When the line is not there once, or the copy does not compile.
    pub fn run_edit(&self, simulator: &Simulator, edit: &edits::Edit) -> Result<Outcome, Failure> {
        let directory = self.directory.file_name().unwrap_or_default().to_string_lossy();
        let thread = rayon::current_thread_index().unwrap_or(0);
        let copy = Self { directory: copy(&self.directory, &format!("{directory}-edit-{thread}"))? };
        let path = copy.directory.join(edit.file);
        let text = std::fs::read_to_string(&path).map_err(|error| Failure(error.to_string()))?;
        std::fs::write(&path, edit.apply(&text)?).map_err(|error| Failure(error.to_string()))?;
        copy.build(simulator, &own_sources()).map_err(|error| Failure(format!("{}: {error}", edit.name)))?;
        let killed_by = copy.run(simulator, &copy.directory, &[])?;
        Ok(Outcome { name: edit.name.clone(), killed_by })
    }

    /// A directory beside it with links to the memory files, but for these.
    ///
    /// # Errors
    /// When it cannot be made.
    pub fn place(&self, name: &str, without: &[&str]) -> Result<PathBuf, Failure> {
        let place = self.directory.join(name);
        let made = || -> std::io::Result<()> {
            std::fs::create_dir_all(&place)?;
            for file in ["stimulus.mem", "expected.mem", "exponents.mem", "rom.mem"] {
                let link = place.join(file);
                if without.contains(&file) || link.exists() {
                    continue;
                }
                std::fs::hard_link(self.directory.join(file), link)?;
            }
            Ok(())
        };
        made().map_err(|error| Failure(format!("{}: {error}", place.display())))?;
        Ok(place)
    }
}

/// The sources of the pipeline with its wrapper.
#[must_use]
pub fn own_sources() -> String {
    let names = hw_model::rtl::SOURCES.map(|(name, _)| name);
    format!("{} blysk_mutated.sv", names.join(" "))
}

/// The design of a preset.
///
/// # Errors
/// When there is no such preset.
pub fn preset(name: &str) -> Result<Design, Failure> {
    let Some(preset) = hw_model::presets::find(name) else {
        return failed(format!("there is no preset {name}; blysk presets lists them"));
    };
    let config = preset.config().map_err(|error| Failure(error.to_string()))?;
    Design::new(config).map_err(|error| Failure(error.to_string()))
}
