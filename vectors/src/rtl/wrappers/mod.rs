//! What lets the pipeline into designs that are not plain SystemVerilog, or into the tools of a vendor.

mod ip_xact;
mod recipes;
mod vhdl;

use askama::Template;
use hw_model::rtl::{PACKAGE, SOURCES, TESTBENCH, TOP, WRAPPER};

use super::emission::Emission;
use super::sources::Sources;
use crate::manifest::ROM;

pub use ip_xact::ip_xact;
pub use recipes::{quartus, sdc, vivado};
pub use vhdl::vhdl;

/// The IP-XACT component of the AXI4-Stream module.
pub const IP_XACT: &str = "blysk_axis.xml";
/// The VHDL component and an entity that instantiates it.
pub const VHDL: &str = "blysk.vhd";
/// The manifest of Bender, the package manager for hardware.
pub const BENDER: &str = "Bender.yml";
/// The clock, for tools that read SDC.
pub const SDC: &str = "blysk.sdc";
/// The recipe for Vivado.
pub const VIVADO: &str = "vivado.tcl";
/// The recipe for Quartus.
pub const QUARTUS: &str = "quartus.tcl";

/// Each file of this kind under its name in the project, with its text.
#[must_use]
pub fn wrappers(sources: &Sources<'_>, emission: &Emission) -> Vec<(&'static str, String)> {
    vec![
        (IP_XACT, ip_xact(sources, emission)),
        (VHDL, vhdl(sources, emission)),
        (BENDER, bender(sources)),
        (SDC, sdc(sources, emission)),
        (VIVADO, vivado(sources)),
        (QUARTUS, quartus(sources)),
    ]
}

/// The files of the names above.
pub(super) const NAMES: [&str; 6] = [IP_XACT, VHDL, BENDER, SDC, VIVADO, QUARTUS];

/// Package and pipeline under their own names, in an order in which each names only what stands before it.
fn pipeline(sources: &Sources<'_>) -> Vec<String> {
    let names = SOURCES.iter().map(|(name, _)| *name);
    std::iter::once(PACKAGE).chain(names).map(|name| sources.modules.file(name)).collect()
}

/// The pipeline, and the module with AXI4-Stream ports.
fn with_axis(sources: &Sources<'_>) -> Vec<String> {
    pipeline(sources).into_iter().chain([sources.modules.file(WRAPPER.0)]).collect()
}

/// The image that the parameter `ROM_FILE` names where nothing else is said; none where the words stand in the source.
fn image(sources: &Sources<'_>, emission: &Emission) -> Option<String> {
    (!emission.rom_in_source).then(|| sources.modules.rom_image().unwrap_or_else(|| ROM.to_owned()))
}

/// The name of a module: that of its file without the end.
fn module(sources: &Sources<'_>, file: &str) -> String {
    sources.modules.file(file).trim_end_matches(".sv").to_owned()
}

/// The manifest of Bender.
fn bender(sources: &Sources<'_>) -> String {
    let bender = Bender {
        command: sources.command,
        configuration: &sources.design.config().name,
        prefix: sources.modules.file(TOP),
        files: with_axis(sources),
        testbench: sources.modules.file(TESTBENCH),
    };
    // The template writes to a String, which cannot fail.
    bender.render().unwrap_or_default() + "\n"
}

#[derive(Template)]
#[template(path = "Bender.yml", escape = "none")]
struct Bender<'a> {
    command: &'a str,
    configuration: &'a str,
    prefix: String,
    files: Vec<String>,
    testbench: String,
}
