//! What is written beside the RTL for other languages and tools, each in a real reader.

use std::path::Path;
use std::process::Command;

use hw_model::datapath::Datapath;
use hw_model::rtl::{PACKAGE, SOURCES, WRAPPER};
use vectors::rtl::Modules;
use vectors::rtl::wrappers::{BENDER, IP_XACT, VHDL};

use super::simulators::repository;
use super::{Failure, failed};

/// Reads the wrappers of a directory of emitted RTL with these names: the AXI4-Stream module in Icarus, Verilator and
/// Yosys, the VHDL in GHDL, the IP-XACT component by its schema, Bender's manifest as YAML, the recipes in a Tcl
/// interpreter.
///
/// # Errors
/// With what one of the tools says.
pub fn check(directory: &Path, modules: &Modules) -> Result<(), Failure> {
    let names = [PACKAGE].into_iter().chain(SOURCES.map(|(name, _)| name)).chain([WRAPPER.0]);
    let sources: Vec<String> = names.map(|name| modules.file(name)).collect();
    let axis = modules.file(WRAPPER.0).replace(".sv", "");
    let read = |program: &str, options: &[&str]| run(directory, Command::new(program).args(options).args(&sources));
    quiet("Icarus", &read("iverilog", &["-g2012", "-Wall", "-o", "/dev/null", "-s", &axis])?)?;
    quiet("Verilator", &read("verilator", &["--lint-only", "-Wall", "--top-module", &axis])?)?;
    let netlist = format!("{axis}.json");
    let script = format!(
        "read_verilog -sv {}; hierarchy -check -top {axis}; proc; check -assert; write_json {netlist}",
        sources.join(" ")
    );
    quiet("Yosys", &run(directory, Command::new("yosys").args(["-q", "-p", &script]))?)?;
    vhdl(directory, &modules.file(VHDL))?;
    let mut descriptions = Command::new(repository().join("target/venv/bin/python"));
    descriptions.arg(repository().join("tests/src/rtl/descriptions.py"));
    run(directory, descriptions.args([&modules.file(IP_XACT), &netlist, &axis, BENDER]))?;
    let recipes = repository().join("tests/src/rtl/recipes.tcl");
    let said = run(directory, Command::new("yosys").args(["-q", "-c"]).arg(recipes))?;
    for wanted in ["create_clock -name clk -period ", "synth_design -top ", "execute_flow -compile", "RECIPES END"] {
        if !said.contains(wanted) {
            return failed(format!("the recipes never say {wanted}\n{said}"));
        }
    }
    Ok(())
}

/// GHDL analyses the component and its instantiation, and elaborates it; what is bound to it is not VHDL.
fn vhdl(directory: &Path, file: &str) -> Result<(), Failure> {
    quiet("GHDL", &run(directory, Command::new("ghdl").args(["-a", "--std=08", "--workdir=.", file]))?)?;
    let text = std::fs::read_to_string(directory.join(file)).map_err(|error| Failure(error.to_string()))?;
    let entity = text.lines().find_map(|line| line.strip_prefix("entity ")?.strip_suffix(" is"));
    let Some(entity) = entity else { return failed(format!("{file} has no entity")) };
    let elaborate = ["--elab-run", "--std=08", "--workdir=.", entity, "--no-run"];
    let said = run(directory, Command::new("ghdl").args(elaborate))?;
    // An instance of SystemVerilog has no entity here; nothing else may be said.
    match said
        .lines()
        .find(|line| line.contains("warning") && !line.contains("is not bound") && !line.contains("in default"))
    {
        None => Ok(()),
        Some(line) => failed(format!("GHDL: {line}")),
    }
}

/// The whole in Verilog-2005, as the emitted Makefile has Yosys write it, answers every vector in Icarus `-g2005`.
///
/// # Errors
/// With what a tool says, or a verdict that is none.
pub fn verilog_2005(directory: &Path, datapath: &Datapath, vectors: u64) -> Result<(), Failure> {
    let mut make = Command::new("make");
    make.args(["--silent", "verilog2005"]).env_remove("MAKEFLAGS").env_remove("MFLAGS").env_remove("MAKELEVEL");
    run(directory, &mut make)?;
    let text = std::fs::read_to_string(directory.join("blysk_2005.v")).map_err(|error| Failure(error.to_string()))?;
    if text.contains("always_ff") || text.contains("logic ") {
        return failed("the Verilog-2005 has words of SystemVerilog in it");
    }
    let formats = datapath.formats();
    let macros = [
        ("VECTORS", vectors),
        ("ADDRESS", datapath.rom().address_width().into()),
        ("INPUT", formats.input.width().into()),
        ("OUTPUT", formats.output.width().into()),
        ("STATUS", datapath.status_width().into()),
    ];
    let mut compile = Command::new("iverilog");
    compile.args(["-g2005", "-s", "verilog_2005", "-o", "verilog_2005.vvp", "blysk_2005.v"]);
    compile.args(macros.map(|(name, value)| format!("-D{name}={value}")));
    run(directory, compile.arg(repository().join("tests/src/rtl/verilog_2005.v")))?;
    let said = run(directory, Command::new("vvp").args(["-n", "verilog_2005.vvp"]))?;
    if said.lines().any(|line| line == format!("PASS {vectors} vectors")) {
        return Ok(());
    }
    failed(format!("Verilog-2005: {said}"))
}

fn quiet(name: &str, said: &str) -> Result<(), Failure> {
    if said.trim().is_empty() { Ok(()) } else { failed(format!("{name}: {said}")) }
}

/// What a program says, where it ends well.
fn run(directory: &Path, command: &mut Command) -> Result<String, Failure> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command.current_dir(directory).output();
    let output = output.map_err(|error| Failure(format!("cannot run {program}: {error}; run scripts/setup")))?;
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    if output.status.success() { Ok(text) } else { failed(format!("{program}: {text}")) }
}
