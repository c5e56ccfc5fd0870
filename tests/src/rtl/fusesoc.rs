//! The core file that is written beside the RTL, in FuseSoC.

use std::path::Path;
use std::process::Command;

use hw_model::design::Design;
use hw_model::rtl::{SOURCES, TOP};
use vectors::rtl::{Modules, core_name};
use vectors::{Bundle, OutputSet, Strategy, rtl};

use super::simulators::{fresh, repository};
use super::workspace::Emitted;
use super::{Failure, failed};

/// A designer's own pipeline.
const OWN: &str = "my_highlight";

/// Runs the testbench in Icarus, with the right answers and with a wrong one, and the lint.
///
/// # Errors
/// When a verdict is not what it has to be.
pub fn check(emitted: &Emitted<'_>) -> Result<(), Failure> {
    let name = core_name(&Modules::default(), &emitted.design.config().name);
    let said = run(&emitted.directory, &["--target", "sim", &name])?;
    expect(&said, "PASS ")?;
    let control = ["--target", "sim", &name, "--expected", "negative_control.mem"];
    expect(&run(&emitted.directory, &control)?, "FAIL vector")?;
    let said = run(&emitted.directory, &["--target", "lint", &name])?;
    if said.contains("%Warning") { failed(format!("FuseSoC, lint: {said}")) } else { Ok(()) }
}

/// Runs the core file of a pipeline that is not the project's own: its source stands beside it.
///
/// # Errors
/// When it does not pass.
pub fn check_dut(design: &Design) -> Result<(), Failure> {
    let directory = fresh("fusesoc_dut")?;
    let dut = Modules::new(TOP, Some(OWN)).map_err(|error| Failure(error.to_string()))?;
    let written = || -> Result<(), vectors::BundleError> {
        let bundle = Bundle::new(design, Strategy::Mixed, 256, 1, "make rtl")?;
        let mut set = OutputSet::create(&directory)?;
        rtl::stage(&bundle, &dut.clone().into(), "make rtl", &mut set)?;
        let own = SOURCES.map(|(_, text)| text.replace(&format!("module {TOP} #("), &format!("module {OWN} #(")));
        set.write(&format!("{OWN}.sv"), own.concat())?;
        set.commit()?;
        Ok(())
    };
    written().map_err(|error| Failure(error.to_string()))?;
    let name = core_name(&dut, &design.config().name);
    expect(&run(&directory, &["--target", "sim", &name])?, "PASS ")
}

fn expect(said: &str, verdict: &str) -> Result<(), Failure> {
    if said.lines().any(|line| line.starts_with(verdict)) {
        return Ok(());
    }
    failed(format!("FuseSoC: no line begins with {verdict:?}\n{said}"))
}

fn run(directory: &Path, arguments: &[&str]) -> Result<String, Failure> {
    let build = directory.join("fusesoc");
    std::fs::create_dir_all(&build).map_err(|error| Failure(error.to_string()))?;
    let output = Command::new(repository().join("target/venv/bin/fusesoc"))
        .arg("--cores-root")
        .arg(directory)
        .args(["run", "--build-root", "build"])
        .args(arguments)
        .current_dir(&build)
        // What its user keeps elsewhere is not looked at.
        .envs(["XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"].map(|name| (name, &build)))
        .env_remove("MAKEFLAGS")
        .env_remove("MFLAGS")
        .env_remove("MAKELEVEL")
        .output();
    let output = output.map_err(|error| Failure(format!("cannot run fusesoc: {error}; run scripts/setup")))?;
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    if output.status.success() { Ok(text) } else { failed(format!("FuseSoC: {text}")) }
}
