//! Writes the module that judges the registers of the RTL beside the golden model in a simulator with DPI-C.

use askama::Template;
use hw_model::design::Design;

use super::modules::Modules;
use super::probes::probes;
use super::reset_port;

/// The file of the register checker.
pub const REGISTER_CHECKER: &str = "blysk_register_checker.sv";

/// The text of the register checker of a design, bound to the pipeline of these modules. It carries the configuration
/// along, so that a simulation needs no file of it.
#[must_use]
pub fn register_checker(design: &Design, modules: &Modules, command: &str) -> String {
    let file = modules.file(REGISTER_CHECKER);
    let reset = &design.config().reset;
    let checker = RegisterChecker {
        configuration: &design.config().name,
        command,
        name: file.trim_end_matches(".sv"),
        dut: modules.dut(),
        reset_port: reset_port::name(reset),
        reset: if reset.is_active_low() { "(!rst_ni)" } else { "" },
        paths: probes(design.datapath()).into_iter().map(|probe| probe.path).collect(),
        json: literal(&design.config().to_json()),
    };
    // The template writes to a String, which cannot fail.
    modules.text(&(checker.render().unwrap_or_default() + "\n"))
}

#[derive(Template)]
#[template(path = "blysk_register_checker.sv", escape = "none")]
struct RegisterChecker<'a> {
    configuration: &'a str,
    command: &'a str,
    name: &'a str,
    dut: &'a str,
    reset_port: &'a str,
    reset: &'a str,
    paths: Vec<String>,
    json: String,
}

/// A text as the inside of a string literal of SystemVerilog, on one line.
fn literal(text: &str) -> String {
    let joined: Vec<&str> = text.lines().map(str::trim_start).collect();
    joined.join(" ").replace('\\', "\\\\").replace('"', "\\\"")
}
