//! The VHDL component of the pipeline, and an entity that instantiates it.

use askama::Template;
use hw_model::rtl::TOP;

use super::parts::image;
use crate::rtl::emission::Emission;
use crate::rtl::reset_port;
use crate::rtl::sources::Sources;

/// The text of the VHDL file.
#[must_use]
pub fn vhdl(sources: &Sources<'_>, emission: &Emission) -> String {
    let datapath = sources.design.datapath();
    let formats = datapath.formats();
    let top = sources.modules.file(TOP);
    let file = Vhdl {
        command: sources.command,
        package: identifier(&format!("{top}_component")),
        component: identifier(&top),
        entity: identifier(&format!("{top}_vhdl")),
        latency: datapath.latency(),
        reset: if datapath.control().reset.is_asynchronous() { "asynchronous" } else { "synchronous" },
        image: image(sources, emission),
        address: datapath.rom().address_width() - 1,
        x: formats.input.width() - 1,
        x_type: if formats.input.is_signed() { "signed" } else { "unsigned" },
        x_format: formats.input.to_string(),
        intensity: formats.output.width() - 1,
        intensity_format: formats.output.to_string(),
        status: datapath.status_width() - 1,
    };
    // The template writes to a String, which cannot fail.
    reset_port::everywhere(&(file.render().unwrap_or_default() + "\n"), &sources.design.config().reset)
}

#[derive(Template)]
#[template(path = "blysk.vhd", escape = "none")]
struct Vhdl<'a> {
    command: &'a str,
    package: String,
    component: String,
    entity: String,
    latency: usize,
    reset: &'static str,
    image: Option<String>,
    address: u32,
    x: u32,
    x_type: &'static str,
    x_format: String,
    intensity: u32,
    intensity_format: String,
    status: u32,
}

/// A name of a module in VHDL: as it is where it is a basic identifier in small letters, else as an extended one, which
/// keeps the letters as they are.
fn identifier(name: &str) -> String {
    let letters = name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    let basic = letters && name.starts_with(|c: char| c.is_ascii_lowercase());
    let underscores = name.contains("__") || name.ends_with('_');
    if basic && !underscores && !RESERVED.contains(&name) { name.to_owned() } else { format!("\\{name}\\") }
}

/// The reserved words of IEEE 1076-2008 that a module of SystemVerilog may be called.
#[rustfmt::skip]
const RESERVED: [&str; 100] = [
    "abs", "access", "after", "all", "architecture", "array", "assert", "assume_guarantee", "attribute", "block",
    "body", "buffer", "bus", "component", "configuration", "constant", "context", "disconnect", "downto", "elsif",
    "entity", "exit", "fairness", "file", "generic", "group", "guarded", "impure", "in", "inertial",
    "is", "label", "library", "linkage", "literal", "loop", "map", "mod", "new", "next",
    "null", "of", "on", "open", "others", "out", "port", "postponed", "procedure", "process",
    "protected", "range", "record", "register", "reject", "rem", "report", "restrict_guarantee", "rol", "ror",
    "select", "severity", "shared", "signal", "sla", "sll", "sra", "srl", "subtype", "then",
    "to", "transport", "type", "unaffected", "units", "until", "variable", "vmode", "vprop", "vunit",
    "wait", "when", "with", "xnor", "xor", "nand", "nor", "not", "or", "and",
    "begin", "case", "end", "for", "function", "if", "package", "parameter", "property", "return",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_verilog_are_names_of_vhdl() {
        for (name, wanted) in [
            ("blysk", "blysk"),
            ("a_1", "a_1"),
            ("Shiny", "\\Shiny\\"),
            ("_a", "\\_a\\"),
            ("a__b", "\\a__b\\"),
            ("entity", "\\entity\\"),
            ("a_", "\\a_\\"),
        ] {
            assert_eq!(identifier(name), wanted);
        }
    }
}
