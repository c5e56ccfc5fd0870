//! Tools that read SystemVerilog and do not run it: RTL and testbench must be clean in each.

use std::path::Path;
use std::process::Command;

use hw_model::rtl::{PACKAGE, SOURCES, TESTBENCH};

use super::simulators::{python_package, repository};
use super::{Failure, failed};

/// The one warning of slang's that is not wanted: a cast to a width of the package changes nothing in those
/// configurations in which both widths are equal.
const SLANG: [&str; 6] = ["-Wextra", "-Wpedantic", "-Wno-useless-cast", "-Werror", "--top", "blysk_tb"];

/// What Surelog ends with, for each kind of message that must not be there.
const SURELOG: [&str; 4] = ["[  FATAL] : 0", "[ SYNTAX] : 0", "[  ERROR] : 0", "[WARNING] : 0"];

/// Slang, Verible and Surelog read a directory of emitted RTL.
///
/// # Errors
/// With what one of them says.
pub fn check(directory: &Path) -> Result<(), Failure> {
    slang(directory)?;
    verible(directory)?;
    surelog(directory)
}

fn slang(directory: &Path) -> Result<(), Failure> {
    let mut command = Command::new(repository().join("target/venv/bin/python"));
    command.arg(repository().join("tests/src/rtl/slang.py")).args(SLANG);
    let (good, text) = run("slang", command, directory)?;
    if good && text.contains("0 errors, 0 warnings") {
        return Ok(());
    }
    failed(format!("slang: {text}"))
}

fn verible(directory: &Path) -> Result<(), Failure> {
    let mut command = Command::new(repository().join("target/venv/bin/verible-verilog-lint"));
    let rules = repository().join("tests/src/rtl/verible.rules");
    command.arg(format!("--rules_config={}", rules.display()));
    let (good, text) = run("verible-verilog-lint", command, directory)?;
    if good && text.is_empty() { Ok(()) } else { failed(format!("Verible: {text}")) }
}

fn surelog(directory: &Path) -> Result<(), Failure> {
    let Some(home) = python_package(&repository(), "surelog", "bin/surelog") else {
        return failed("Surelog is not in target/venv; run scripts/setup");
    };
    let mut command = Command::new(home.join("bin/surelog"));
    command.args(["-sverilog", "-parse", "-nobuiltin", "-nocache", "-top", "blysk_tb", "-odir"]);
    command.arg(directory.join("surelog"));
    let (good, text) = run("surelog", command, directory)?;
    if good && SURELOG.iter().all(|none| text.contains(none)) {
        return Ok(());
    }
    let said = text.lines().filter(|line| !line.starts_with("[INF") && !line.starts_with("[NTE"));
    failed(format!("Surelog: {}", said.collect::<Vec<_>>().join("\n")))
}

/// Runs a tool on the package, the RTL and the testbench: whether it ended well, and all that it said.
fn run(name: &str, mut command: Command, directory: &Path) -> Result<(bool, String), Failure> {
    let output = command
        .arg(PACKAGE)
        .args(SOURCES.map(|(file, _)| file))
        .arg(TESTBENCH)
        .current_dir(directory)
        .output()
        .map_err(|error| Failure(format!("cannot run {name}: {error}; run scripts/setup")))?;
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    Ok((output.status.success(), text))
}
