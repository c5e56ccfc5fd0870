//! Waves replayed in the RTL by Yosys: at every clock edge it takes the inputs from the file, and compares every wire
//! that has a name there.

use std::path::Path;
use std::process::Command;

use hw_model::datapath::Datapath;
use hw_model::rtl::{PACKAGE, SOURCES, TOP};
use vectors::rtl::probes::ports;

use super::{Failure, failed};

/// Replays waves, in which the pipeline stands in `scope`, in a directory of RTL.
///
/// # Errors
/// The first difference; when a port or register was not found in the waves, and so not compared.
pub fn replay(directory: &Path, datapath: &Datapath, waves: &Path, scope: &str) -> Result<(), Failure> {
    let files = SOURCES.map(|(name, _)| name).join(" ");
    let script = format!(
        "read_verilog -sv {PACKAGE} {files}; prep -top {TOP}; flatten; \
         sim -r {} -scope {scope} -clock clk_i -sim-cmp",
        waves.display()
    );
    let output = Command::new("yosys").args(["-q", "-p", &script]).current_dir(directory).output();
    let output = output.map_err(|error| Failure(format!("cannot run yosys: {error}")))?;
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    let missing = |line: &str| {
        let (_, name) = line.split_once("Unable to find wire ")?;
        Some(name.split_once(" in input")?.0.to_owned())
    };
    if !output.status.success() {
        let said: Vec<&str> = text.lines().filter(|line| missing(line).is_none()).collect();
        return failed(format!("Yosys, {}: {}", waves.display(), said.join("\n")));
    }
    let missing: Vec<String> = text.lines().filter_map(missing).collect();
    if missing.is_empty() {
        return failed("Yosys names no wire that the waves lack, though there are many");
    }
    // Every register ends in _q; the ROM's own word is there in its fields.
    let rom = format!("{scope}.rom.");
    let register = |name: &&String| name.ends_with("_q") && !name.starts_with(&rom);
    let ports = ports(datapath).map(|port| format!("{scope}.{}", port.name));
    let port = |name: &&String| ports.contains(name);
    match missing.iter().find(|name| register(name) || port(name)) {
        Some(name) => failed(format!("{} lack {name}", waves.display())),
        None => Ok(()),
    }
}
