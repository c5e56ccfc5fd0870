//! The manifest of Bender, the package manager for hardware.

use askama::Template;
use hw_model::rtl::{TESTBENCH, TOP};

use super::parts::with_axis;
use crate::rtl::sources::Sources;

/// The text of the manifest.
#[must_use]
pub fn bender(sources: &Sources<'_>) -> String {
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
