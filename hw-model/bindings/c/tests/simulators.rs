//! The emitted RTL beside the golden model in simulators: by DPI-C in both Verilators, by VPI in Icarus. Right RTL
//! passes, and a bug that is planted is named by its register.

mod support;

use std::fs;
use std::path::Path;
use std::process::Command;

use support::rtl::{emit, newer_verilator, sources, verilate};
use support::{fails, libraries, package, passes, shared_directory};
use vectors::rtl::REGISTER_CHECKER;

/// Where the second stage rounds, and where it must not.
const ROUNDING: &str = ".ROUNDING(T_ROUNDING[32*j+:32])";
const WRONG_ROUNDING: &str = ".ROUNDING(j == 2 ? blysk_pkg::ROUND_FLOOR : T_ROUNDING[32*j+:32])";
const CYCLES: &str = "+cycles=20000";

/// Plants a bug in one stage.
fn plant(directory: &Path) {
    let path = directory.join("blysk.sv");
    let text = fs::read_to_string(&path).expect("the top module");
    assert_eq!(text.matches(ROUNDING).count(), 1);
    fs::write(path, text.replace(ROUNDING, WRONG_ROUNDING)).expect("the top module is written");
}

fn simulation(program: &Path, directory: &Path) -> Command {
    let mut command = Command::new(program);
    command.current_dir(directory).arg(CYCLES);
    command
}

/// The counts and the verdict of a run that passes.
fn judged(said: &str) {
    let verdict = said.lines().find(|line| line.starts_with("PASS ")).unwrap_or_else(|| panic!("no PASS\n{said}"));
    let results: u64 = verdict.split(' ').nth(1).and_then(|count| count.parse().ok()).expect("a count");
    assert!(results > 8000, "{verdict}");
    let counts = said.lines().find(|line| line.ends_with(" values compared")).expect("a line of counts");
    assert!(counts.starts_with("20000 cycles, ") || counts.starts_with("19999 cycles, "), "{counts}");
    for nothing in [" 0 stalls", " 0 bubbles", " 0 resets", " 0 values"] {
        assert!(!counts.contains(nothing), "{counts}");
    }
}

fn check_verilator(home: Option<&Path>, name: &str) {
    let directory = emit("compact", name);
    judged(&passes(&mut simulation(&verilate(home, &directory, &[], &[]), &directory)));
    // Ports alone: the result is wrong, and the registers are told as they should be.
    plant(&directory);
    let said = fails(&mut simulation(&verilate(home, &directory, &[], &[]), &directory));
    assert!(said.contains(": clamp.intensity is 16'h"), "{said}");
    assert!(said.contains("its registers should be:\n    fetch.x "), "{said}");
    // Registers too: the first one that departs is named.
    let watched = verilate(home, &directory, &["-DUNCHECKED"], &[REGISTER_CHECKER]);
    let said = fails(&mut simulation(&watched, &directory));
    assert!(said.contains(": stage2.t2 is "), "{said}");
}

#[test]
fn debians_verilator_judges_by_dpi() {
    check_verilator(None, "dpi_debian");
}

#[test]
fn the_newer_verilator_judges_by_dpi() {
    check_verilator(Some(&newer_verilator()), "dpi_newer");
}

/// The checker's configuration is a file, and not that of the DUT.
#[test]
fn another_configuration_is_noticed() {
    let directory = emit("compact", "dpi_other");
    let file = package().join("../../../docs/examples/compact_12_bit.json");
    let configuration = format!("-DCONFIGURATION=\"{}\"", file.display());
    let program = verilate(Some(&newer_verilator()), &directory, &[&configuration], &[]);
    let said = fails(&mut simulation(&program, &directory));
    assert!(said.contains("FAIL intensity_o of the DUT has a width of 16, and 12 in "), "{said}");
}

/// Every kind of register: the power form, and the divider's ranks.
#[test]
fn every_register_of_the_tail_is_seen() {
    let directory = emit("paper", "dpi_paper");
    let program = verilate(Some(&newer_verilator()), &directory, &["-DUNCHECKED"], &[REGISTER_CHECKER]);
    judged(&passes(&mut simulation(&program, &directory)));
}

/// Slang takes the language as the standard has it: no simulator with DPI-C but Verilator runs in these tests.
#[test]
fn slang_reads_the_checkers() {
    let directory = emit("compact", "dpi_slang");
    let (root, dpi) = (package().join("../../.."), package().join("dpi"));
    let mut slang = Command::new(root.join("target/venv/bin/python"));
    slang.arg(root.join("tests/src/rtl/slang.py"));
    slang.args(["-Wextra", "-Wpedantic", "-Werror", "-Wno-useless-cast", "--top", "blysk_golden_tb"]);
    slang.args(sources(&directory)).arg(dpi.join("blysk_dpi_pkg.sv")).arg(dpi.join("blysk_checker.sv"));
    slang.arg(dpi.join("blysk_golden_tb.sv")).arg(directory.join(REGISTER_CHECKER));
    let said = passes(&mut slang);
    assert!(said.contains("0 errors, 0 warnings"), "{said}");
}

/// Compiles testbench and checker for Icarus, and runs them with the library as a VPI module.
fn icarus(directory: &Path, watch: &str) -> Command {
    let vpi = package().join("vpi");
    let mut module = Command::new("iverilog-vpi");
    module
        .arg("--name=blysk_vpi")
        .arg(vpi.join("blysk_vpi.c"))
        .arg(format!("-I{}", package().join("include").display()));
    module.arg(format!("-L{}", libraries().display())).arg("-lblysk").current_dir(directory);
    passes(&mut module);
    let mut compiler = Command::new("iverilog");
    compiler.args(["-g2012", "-Wall", "-Wno-timescale", "-DVPI", "-s", "blysk_golden_tb", "-o", "tb.vvp"]);
    compiler.arg(format!("-DWATCH=\"{watch}\"")).args(sources(directory));
    compiler.arg(vpi.join("blysk_vpi_checker.sv")).arg(package().join("dpi/blysk_golden_tb.sv"));
    passes(compiler.current_dir(directory));
    let mut command = Command::new("vvp");
    command.args(["-n", "-M.", "-mblysk_vpi", "tb.vvp", CYCLES]).current_dir(directory);
    command.env("LD_LIBRARY_PATH", shared_directory());
    command
}

#[test]
fn icarus_judges_by_vpi() {
    let directory = emit("compact", "vpi");
    judged(&passes(&mut icarus(&directory, "")));
    judged(&passes(&mut icarus(&directory, "blysk_golden_tb.dut")));
    let said = fails(&mut icarus(&directory, "blysk_golden_tb.none"));
    assert!(said.contains("FAIL there is no register blysk_golden_tb.none."), "{said}");
    plant(&directory);
    let said = fails(&mut icarus(&directory, ""));
    assert!(said.contains(": clamp.intensity is 16'h"), "{said}");
    let said = fails(&mut icarus(&directory, "blysk_golden_tb.dut"));
    assert!(said.contains(": stage2.t2 is "), "{said}");
}
