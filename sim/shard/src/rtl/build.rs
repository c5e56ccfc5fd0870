//! The harness, built by Verilator in a directory of RTL.

use std::path::{Path, PathBuf};
use std::process::Command;

use hw_model::design::Design;
use hw_model::rtl::SOURCES;
use vectors::rtl::{self, Emission, PACKAGE};
use vectors::{Bundle, OutputSet, Strategy, WholeFile};

use super::error::RtlError;

const HARNESS: &str = include_str!("harness.cpp");
const SOURCE: &str = "exhaustive.cpp";

/// Where the harness stands in a directory of RTL in which it was built.
pub const PROGRAM: &str = "exhaustive/exhaustive";

/// Writes the RTL of a design, with the ROM image that it reads. `command` is what generated files name.
///
/// # Errors
/// When it cannot be written.
pub fn emit(design: &Design, directory: &Path, command: &str) -> Result<(), RtlError> {
    // Its vectors are for whoever wants to look into a difference.
    let bundle = Bundle::new(design, Strategy::Corners, 16, 1, command)?;
    let mut set = OutputSet::create(directory)?;
    rtl::stage(&bundle, &Emission::default(), command, &mut set)?;
    set.commit()?;
    Ok(())
}

/// Builds the harness in a directory of RTL, and returns its path.
///
/// # Errors
/// With what the compiler says.
pub fn build(directory: &Path) -> Result<PathBuf, RtlError> {
    WholeFile::create(directory.join(SOURCE))?.fill(HARNESS)?;
    let (place, name) = PROGRAM.split_once('/').unwrap_or(("exhaustive", PROGRAM));
    let output = Command::new("verilator")
        .args(["--cc", "--exe", "--build", "-j", "2", "-O3", "--x-assign", "fast"])
        .args(["--x-initial", "fast", "-CFLAGS", "-O3", "--top-module", hw_model::rtl::TOP])
        .args(["-MAKEFLAGS", "OPT_FAST=-O3", "--Mdir", place, "-o", name])
        .arg(PACKAGE)
        .args(SOURCES.map(|(name, _)| name))
        .arg(SOURCE)
        .current_dir(directory)
        .output()
        .map_err(|cause| RtlError::NoProgram { program: "verilator".into(), cause })?;
    if !output.status.success() {
        return Err(RtlError::Build(String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned()));
    }
    Ok(directory.join(PROGRAM))
}
