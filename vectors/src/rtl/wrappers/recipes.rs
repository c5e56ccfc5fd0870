//! Synthesis recipes for tools of vendors, and the clock that they aim at.

use askama::Template;
use hw_model::rtl::TOP;

use super::parts::pipeline;
use crate::rtl::emission::Emission;
use crate::rtl::files;
use crate::rtl::reset_port;
use crate::rtl::sources::Sources;

/// The constraints: the clock, and half of its period for what is outside.
#[must_use]
pub fn sdc(sources: &Sources<'_>, emission: &Emission) -> String {
    let period = 1000.0 / emission.clock_mhz;
    let ns = |time: f64| format!("{time:.3}");
    let sdc = Sdc { command: sources.command, mhz: emission.clock_mhz, period: ns(period), half: ns(period / 2.0) };
    // The templates write to a String, which cannot fail.
    reset_port::everywhere(&(sdc.render().unwrap_or_default() + "\n"), &sources.design.config().reset)
}

/// The recipe for Vivado.
#[must_use]
pub fn vivado(sources: &Sources<'_>) -> String {
    let Recipe { command, top, files, constraints } = Recipe::of(sources);
    Vivado { command, top, files, constraints }.render().unwrap_or_default() + "\n"
}

/// The recipe for Quartus.
#[must_use]
pub fn quartus(sources: &Sources<'_>) -> String {
    let Recipe { command, top, files, constraints } = Recipe::of(sources);
    Quartus { command, top, files, constraints }.render().unwrap_or_default() + "\n"
}

/// What every recipe says.
struct Recipe<'a> {
    command: &'a str,
    top: String,
    files: Vec<String>,
    constraints: String,
}

impl<'a> Recipe<'a> {
    fn of(sources: &Sources<'a>) -> Self {
        let (top, constraints) = (sources.modules.file(TOP), sources.modules.file(files::SDC));
        Self { command: sources.command, top, files: pipeline(sources), constraints }
    }
}

#[derive(Template)]
#[template(path = "blysk.sdc", escape = "none")]
struct Sdc<'a> {
    command: &'a str,
    mhz: f64,
    period: String,
    half: String,
}

#[derive(Template)]
#[template(path = "vivado.tcl", escape = "none")]
struct Vivado<'a> {
    command: &'a str,
    top: String,
    files: Vec<String>,
    constraints: String,
}

#[derive(Template)]
#[template(path = "quartus.tcl", escape = "none")]
struct Quartus<'a> {
    command: &'a str,
    top: String,
    files: Vec<String>,
    constraints: String,
}
