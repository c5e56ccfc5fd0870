//! What runs the testbench: a Makefile for Icarus and Verilator, and a FuseSoC core file.

use askama::Template;
use hw_model::rtl::SOURCES;

use crate::manifest::ROM;

use hw_model::rtl::PACKAGE;

use super::modules::Modules;
use super::sources::Sources;

/// The text of the Makefile.
#[must_use]
pub fn makefile(sources: &Sources<'_>) -> String {
    // The template writes to a String, which cannot fail.
    Makefile { sources, rtl: rtl(sources) }.render().unwrap_or_default() + "\n"
}

/// What FuseSoC calls the pipeline of a configuration.
#[must_use]
pub fn core_name(modules: &Modules, configuration: &str) -> String {
    let pipeline = if *modules == Modules::default() || !modules.is_own() { "pipeline" } else { modules.dut() };
    format!("blysk:{pipeline}:{configuration}:{}", env!("CARGO_PKG_VERSION"))
}

/// The text of the FuseSoC core file.
#[must_use]
pub fn core_file(sources: &Sources<'_>) -> String {
    let vlnv = core_name(sources.modules, &sources.design.config().name);
    let image = sources.modules.rom_image().unwrap_or_else(|| ROM.to_owned());
    CoreFile { sources, vlnv, image, rtl: rtl(sources) }.render().unwrap_or_default() + "\n"
}

#[derive(Template)]
#[template(path = "Makefile.mk", escape = "none")]
struct Makefile<'a> {
    sources: &'a Sources<'a>,
    rtl: Vec<&'static str>,
}

#[derive(Template)]
#[template(path = "blysk.core", escape = "none")]
struct CoreFile<'a> {
    sources: &'a Sources<'a>,
    vlnv: String,
    image: String,
    rtl: Vec<&'static str>,
}

/// The package, and the pipeline where it is what is tested.
fn rtl(sources: &Sources<'_>) -> Vec<&'static str> {
    let own = SOURCES.iter().filter(|_| sources.modules.is_own()).map(|&(name, _)| name);
    std::iter::once(PACKAGE).chain(own).collect()
}
