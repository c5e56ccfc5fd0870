//! What the generated files are about.

use hw_model::design::Design;
use hw_model::handshake::ReadySlice;

use super::modules::Modules;

/// What the generated files are about.
#[derive(Debug, Clone, Copy)]
pub struct Sources<'a> {
    /// The design that the RTL, the package and the testbench are written for.
    pub design: &'a Design,
    /// What modules are called, and which one is under test.
    pub modules: &'a Modules,
    /// Vectors in the bundle.
    pub vectors: u64,
    /// The vector whose answer is wrong in the negative control.
    pub control: u64,
    /// The command that made the files.
    pub command: &'a str,
}

impl Sources<'_> {
    /// Where the wrong answer of the negative control is seen first, as a regular expression for grep: in the answer's
    /// register, or in an entry of the register slice behind it.
    #[must_use]
    pub fn control_shows(&self) -> &'static str {
        match self.design.datapath().control().slice {
            Some(ReadySlice::Output) => r"\(\.intensity\|output_slice\.[a-z]*\)",
            Some(ReadySlice::Input) | None => r"\.intensity",
        }
    }
}
