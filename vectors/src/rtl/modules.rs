//! What the modules and files of a directory of hardware are called.
//!
//! All of them begin with one prefix, `blysk` unless another one was asked for, so that several configurations stand in
//! one design: each has its package and its modules, whose widths come from that package.

use hw_model::names::{self, NameError};
use hw_model::rtl::{PACKAGE, SOURCES, TESTBENCH, TOP, WRAPPER};

use super::files::DESCRIPTIONS;
use crate::manifest::ROM;

/// The prefix of all names, and the module under test.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Modules {
    prefix: String,
    dut: String,
}

impl Default for Modules {
    /// The project's own names.
    fn default() -> Self {
        Self { prefix: TOP.to_owned(), dut: TOP.to_owned() }
    }
}

impl Modules {
    /// Names with a prefix; the module under test is the pipeline of that name, or `dut`, a designer's own.
    ///
    /// # Errors
    /// When the prefix or `dut` is no name of a module, or `dut` one that is written beside it.
    pub fn new(prefix: &str, dut: Option<&str>) -> Result<Self, NameError> {
        names::module(prefix)?;
        let modules = Self { prefix: prefix.to_owned(), dut: dut.unwrap_or(prefix).to_owned() };
        names::module(&modules.dut)?;
        if !modules.is_own() && KNOWN.iter().any(|file| modules.file(file) == format!("{}.sv", modules.dut)) {
            return Err(NameError::Bundle(modules.dut));
        }
        Ok(modules)
    }

    /// The module under test.
    #[must_use]
    pub fn dut(&self) -> &str {
        &self.dut
    }

    /// True where the module under test is the project's own, whose registers are known.
    #[must_use]
    pub fn is_own(&self) -> bool {
        self.dut == self.prefix
    }

    /// True where names are as they stand in the project's sources.
    fn is_plain(&self) -> bool {
        self.prefix == TOP
    }

    /// What a file is called that is `name` in the project.
    #[must_use]
    pub fn file(&self, name: &str) -> String {
        match name.strip_prefix(TOP) {
            Some(rest) => format!("{}{rest}", self.prefix),
            None => name.to_owned(),
        }
    }

    /// The image of the ROM under a name of its own, which the pipeline reads unless its parameter says otherwise: two
    /// in one directory would be one. None where the prefix is the project's: there it is [`ROM`].
    #[must_use]
    pub fn rom_image(&self) -> Option<String> {
        (!self.is_plain()).then(|| format!("{}_{ROM}", self.prefix))
    }

    /// A text with these names in the place of the project's: modules, package, testbench and files, wherever they are
    /// named. The command `blysk` keeps its name.
    #[must_use]
    pub fn text(&self, text: &str) -> String {
        if self.is_plain() {
            return text.to_owned();
        }
        let mut renamed = String::with_capacity(text.len());
        let mut rest = text;
        while let Some(start) = rest.find(|c: char| in_a_name(c)) {
            let (before, from) = rest.split_at(start);
            renamed += before;
            let (name, after) = from.split_at(from.find(|c: char| !in_a_name(c)).unwrap_or(from.len()));
            let known = name != TOP && KNOWN.iter().any(|file| file.strip_suffix(".sv") == Some(name));
            let instance = after.starts_with(" #(") || after.starts_with(" pipeline (");
            let top = name == TOP && (renamed.ends_with("module ") || after.starts_with(".sv") || instance);
            renamed += &if known || top { self.file(name) } else { name.to_owned() };
            rest = after;
        }
        renamed += rest;
        match self.rom_image() {
            Some(image) => renamed.replace(&format!("ROM_FILE = \"{ROM}\""), &format!("ROM_FILE = \"{image}\"")),
            None => renamed,
        }
    }

    /// The files of the hardware, but those of the vectors and their testbench.
    pub(super) fn files(&self) -> impl Iterator<Item = String> {
        let renamed = KNOWN.iter().chain(&DESCRIPTIONS).map(|name| self.file(name));
        renamed.chain(self.rom_image())
    }
}

/// The files that begin with the prefix and hold a module or a package of the same name.
const KNOWN: [&str; SOURCES.len() + 3] = {
    let mut known = [PACKAGE; SOURCES.len() + 3];
    known[1] = TESTBENCH;
    known[2] = WRAPPER.0;
    let mut source = 0;
    while source < SOURCES.len() {
        known[3 + source] = SOURCES[source].0;
        source += 1;
    }
    known
};

fn in_a_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_the_prefix_and_the_command_keeps_its_own() {
        let modules = Modules::new("shiny", None).unwrap();
        assert_eq!(modules.file("blysk_pkg.sv"), "shiny_pkg.sv");
        assert_eq!(modules.file("Makefile"), "Makefile");
        let text = "// blysk rtl: blysk.sv\nmodule blysk #(parameter ROM_FILE = \"rom.mem\") blysk_pkg::X blysk_x";
        let renamed =
            "// blysk rtl: shiny.sv\nmodule shiny #(parameter ROM_FILE = \"shiny_rom.mem\") shiny_pkg::X blysk_x";
        assert_eq!(modules.text(text), renamed);
        assert_eq!(Modules::default().text(text), text);
    }

    #[test]
    fn no_source_keeps_a_name_of_the_project() {
        let modules = Modules::new("q", None).unwrap();
        for (name, text) in SOURCES.into_iter().chain([WRAPPER]) {
            let code: String = modules.text(text).lines().map(|line| line.split("//").next().unwrap_or("")).collect();
            assert!(!code.contains(TOP), "{name}");
        }
    }

    #[test]
    fn what_stands_beside_it_is_no_module_under_test() {
        let taken = Modules::new("shiny", Some("shiny_rom"));
        assert_eq!(taken, Err(NameError::Bundle("shiny_rom".to_owned())));
        assert!(Modules::new("shiny", Some("shiny")).unwrap().is_own());
        assert!(!Modules::new("shiny", Some("mine")).unwrap().is_own());
        assert!(Modules::new("blysk_rom", None).is_err() && Modules::new("a b", None).is_err());
    }
}
