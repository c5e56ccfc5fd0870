//! Two configurations in one top module, through AXI4-Stream, with the sources and sinks of `cocotbext-axi`.

use std::path::PathBuf;
use std::process::Command;

use hw_model::design::Design;
use hw_model::rtl::{PACKAGE, SOURCES, WRAPPER};
use vectors::Strategy;
use vectors::rtl::Modules;

use super::simulators::{fresh, repository};
use super::workspace::emit_as;
use super::{Failure, failed};

fn failure(error: impl std::fmt::Display) -> Failure {
    Failure(error.to_string())
}

/// Sends `count` random requests to each of two pipelines, named by their prefixes, and compares every result. Gives
/// how many results were compared.
///
/// # Errors
/// When a result is not the model's, one is missing or one too many; when a wrong expected answer is not found.
pub fn check(designs: [(&str, &Design); 2], count: u64) -> Result<u64, Failure> {
    let control = Stream::emit("axis_control", designs, CONTROL)?.run("negative_control.mem");
    match control {
        Err(Failure(said)) if said.lines().any(|line| line.starts_with("FAIL ") && line.contains(", expected ")) => {}
        Err(failure) => return Err(failure),
        Ok(_) => return failed("AXI4-Stream: a wrong expected answer was not found"),
    }
    let said = Stream::emit("axis", designs, count)?.run("expected.mem")?;
    let results = said.lines().find_map(|line| line.strip_prefix("PASS ")?.strip_suffix(" results")?.parse().ok());
    match results {
        Some(results) if results == 2 * count => Ok(results),
        _ => failed(format!("AXI4-Stream: not every result was compared\n{said}")),
    }
}

/// Requests of each pipeline in the run that must fail.
const CONTROL: u64 = 300;

/// A directory with a top module of two pipelines, and their bundles.
struct Stream {
    directory: PathBuf,
    sources: Vec<String>,
    bundles: String,
}

impl Stream {
    fn emit(name: &str, designs: [(&str, &Design); 2], count: u64) -> Result<Self, Failure> {
        let directory = fresh(name)?;
        std::fs::create_dir_all(&directory).map_err(failure)?;
        let (mut sources, mut ports, mut instances) = (Vec::new(), Vec::new(), String::new());
        let mut bundles = serde_json::Map::new();
        for (prefix, design) in designs {
            let modules = Modules::new(prefix, None).map_err(failure)?;
            let place = format!("{name}_{prefix}");
            let emitted = emit_as(design, &place, &modules.clone().into(), (Strategy::Random, count))?;
            let names = [PACKAGE].into_iter().chain(SOURCES.map(|(name, _)| name)).chain([WRAPPER.0]);
            sources.extend(names.map(|name| emitted.directory.join(modules.file(name)).display().to_string()));
            let image = format!("{prefix}_rom.mem");
            std::fs::copy(emitted.directory.join(&image), directory.join(&image)).map_err(failure)?;
            bundles.insert(prefix.to_owned(), emitted.directory.display().to_string().into());
            ports.extend(stream_ports(prefix, design));
            instances += &instance(prefix);
        }
        let ports = ports.join(",\n  ");
        let top = format!(
            "`timescale 1ns / 1ps\nmodule both_axis (\n  input logic aclk,\n  input logic aresetn,\n  {ports}\n);\n\
         {instances}endmodule\n"
        );
        std::fs::write(directory.join("both_axis.sv"), top).map_err(failure)?;
        sources.push(directory.join("both_axis.sv").display().to_string());
        Ok(Self { directory, sources, bundles: serde_json::Value::Object(bundles).to_string() })
    }

    /// What the run says, where every answer is that of this file of the bundles.
    fn run(&self, expected: &str) -> Result<String, Failure> {
        let here = repository().join("tests/src/rtl/axis");
        let output = Command::new(repository().join("target/venv/bin/python"))
            .arg(here.join("run_axis.py"))
            .arg("both_axis")
            .args(&self.sources)
            .env("BUNDLES", &self.bundles)
            .env("EXPECTED", expected)
            .env("PYTHONPATH", &here)
            // Deprecations of the libraries are theirs.
            .env("PYTHONWARNINGS", "ignore")
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .env("COCOTB_LOG_LEVEL", "ERROR")
            .env_remove("MAKEFLAGS")
            .env_remove("MAKELEVEL")
            .current_dir(&self.directory)
            .output()
            .map_err(|error| Failure(format!("cannot run cocotb: {error}; run scripts/setup")))?;
        let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        if output.status.success() { Ok(text) } else { failed(format!("AXI4-Stream: {text}")) }
    }
}

/// The ports of a stream of requests and one of results. Widths are the model's, not the package's.
fn stream_ports(prefix: &str, design: &Design) -> [String; 7] {
    let datapath = design.datapath();
    let bytes = |width: u32| width.div_ceil(8) * 8;
    let request = bytes(datapath.formats().input.width()) + bytes(datapath.rom().address_width());
    let result = bytes(datapath.formats().output.width());
    [
        format!("input logic {prefix}_s_axis_tvalid"),
        format!("output logic {prefix}_s_axis_tready"),
        format!("input logic [{}:0] {prefix}_s_axis_tdata", request - 1),
        format!("output logic {prefix}_m_axis_tvalid"),
        format!("input logic {prefix}_m_axis_tready"),
        format!("output logic [{}:0] {prefix}_m_axis_tdata", result - 1),
        format!("output logic [{}:0] {prefix}_m_axis_tuser", datapath.status_width() - 1),
    ]
}

fn instance(prefix: &str) -> String {
    let names = ["s_axis_tvalid", "s_axis_tready", "s_axis_tdata", "m_axis_tvalid", "m_axis_tready", "m_axis_tdata"];
    let ports = names.into_iter().chain(["m_axis_tuser"]).map(|name| format!(".{name}({prefix}_{name})"));
    format!("  {prefix}_axis {prefix}_stream (.aclk, .aresetn, {});\n", ports.collect::<Vec<_>>().join(", "))
}
