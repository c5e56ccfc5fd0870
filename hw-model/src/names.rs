//! Names that a user chooses, and what each must be for the places it goes to.
//!
//! | what                               | goes to                                                      | must be   |
//! |------------------------------------|--------------------------------------------------------------|-----------|
//! | name of a configuration or a scene | names of files, comments, FuseSoC's core file, scopes of waves | [`label`]  |
//! | module under test (`--dut`)        | SystemVerilog, Makefile, core file, command lines            | [`module`] |
//! | path of a file                     | the command at the top of generated files, printed hints     | [`shell`]  |
//!
//! A label and a module are harmless in all of those as they are, so nothing is quoted for Verilog, make or
//! YAML. A path in a shell's quotes is one line of printable characters, so it cannot end a comment.

use std::ffi::OsStr;

use thiserror::Error;

use crate::rtl::{PACKAGE, SOURCES, TESTBENCH, TOP, WRAPPER};

/// Characters of a name: files get longer names from it, and file systems end at 255.
const LONGEST: usize = 100;

/// Why a name is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NameError {
    /// A configuration or a scene.
    #[error("use letters, digits, - and _, a letter, digit or _ first; it becomes part of file names")]
    Label,
    /// Not a plain identifier.
    #[error("use the name of a module: letters, digits and _, not beginning with a digit")]
    Module,
    /// A word of the language.
    #[error("{0} is a reserved word of SystemVerilog (IEEE 1800-2017); give your module another name")]
    Reserved(String),
    /// Not reserved by the standard, but refused by a simulator.
    #[error("{0} is a word that {1} keeps for itself; give your module another name")]
    Tool(String, &'static str),
    /// A name of the bundle itself.
    #[error("{0} is a name of the bundle itself, which is written beside your module; give it another name")]
    Bundle(String),
    /// The name has more characters than a file system takes well.
    #[error("it has {0} characters; use at most {LONGEST}")]
    Long(usize),
}

/// Checks the name of a configuration or a scene.
///
/// # Errors
/// Says what would be right.
pub fn label(name: &str) -> Result<(), NameError> {
    let first = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !name.starts_with(first) || !name.chars().all(|c| first(c) || c == '-') {
        return Err(NameError::Label);
    }
    short(name)
}

/// Checks the name of a module under test: [`TOP`], or a designer's own.
///
/// `$` and escaped identifiers are Verilog, but not for make and the shells in between.
///
/// # Errors
/// Says what would be right.
pub fn module(name: &str) -> Result<(), NameError> {
    let first = |c: char| c.is_ascii_alphabetic() || c == '_';
    if !name.starts_with(first) || !name.chars().all(|c| first(c) || c.is_ascii_digit()) {
        return Err(NameError::Module);
    }
    short(name)?;
    if RESERVED.contains(&name) {
        return Err(NameError::Reserved(name.to_owned()));
    }
    if let Some((_, tool)) = KEPT_BY_TOOLS.iter().find(|(word, _)| *word == name) {
        return Err(NameError::Tool(name.to_owned(), tool));
    }
    let files = SOURCES.iter().map(|&(file, _)| file).chain([PACKAGE, TESTBENCH, WRAPPER.0]);
    let taken = files.filter_map(|file| file.strip_suffix(".sv")).any(|taken| taken == name);
    if taken && name != TOP { Err(NameError::Bundle(name.to_owned())) } else { Ok(()) }
}

fn short(name: &str) -> Result<(), NameError> {
    match name.chars().count() {
        count if count > LONGEST => Err(NameError::Long(count)),
        _ => Ok(()),
    }
}

/// An argument as a POSIX shell takes it; where it has characters that do not print, as bash, ksh and zsh do
/// (`$'…'`). One line, whatever is in it.
#[must_use]
pub fn shell(argument: impl AsRef<OsStr>) -> String {
    let argument = argument.as_ref();
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-+=/,:@%".contains(c);
    let prints = |c: char| c.is_ascii_graphic() || c == ' ' || c.is_alphanumeric();
    match argument.to_str() {
        Some(text) if !text.is_empty() && text.chars().all(plain) => text.to_owned(),
        Some(text) if text.chars().all(prints) => format!("'{}'", text.replace('\'', r"'\''")),
        _ => escaped(argument.as_encoded_bytes()),
    }
}

/// Bytes that are not printable ASCII as three octal digits, after which any other digit may follow.
fn escaped(bytes: &[u8]) -> String {
    let mut text = "$'".to_owned();
    for &byte in bytes {
        match byte {
            b'\'' | b'\\' => text.extend(['\\', char::from(byte)]),
            b' '..=b'~' => text.push(char::from(byte)),
            _ => text += &format!("\\{byte:03o}"),
        }
    }
    text + "'"
}

/// Words that are free in IEEE 1800-2017 and that a simulator refuses as the name of a module.
const KEPT_BY_TOOLS: [(&str, &str); 5] = [
    ("TOP", "Verilator"),
    ("bool", "Icarus Verilog"),
    ("std", "Verilator"),
    ("wone", "Icarus Verilog"),
    ("wreal", "Icarus Verilog"),
];

/// The reserved words of IEEE 1800-2017, table B.1. Case counts.
#[rustfmt::skip]
pub const RESERVED: [&str; 248] = [
    "accept_on", "alias", "always", "always_comb", "always_ff", "always_latch", "and", "assert",
    "assign", "assume", "automatic", "before", "begin", "bind", "bins", "binsof", "bit", "break",
    "buf", "bufif0", "bufif1", "byte", "case", "casex", "casez", "cell", "chandle", "checker",
    "class", "clocking", "cmos", "config", "const", "constraint", "context", "continue", "cover",
    "covergroup", "coverpoint", "cross", "deassign", "default", "defparam", "design", "disable",
    "dist", "do", "edge", "else", "end", "endcase", "endchecker", "endclass", "endclocking",
    "endconfig", "endfunction", "endgenerate", "endgroup", "endinterface", "endmodule",
    "endpackage", "endprimitive", "endprogram", "endproperty", "endsequence", "endspecify",
    "endtable", "endtask", "enum", "event", "eventually", "expect", "export", "extends", "extern",
    "final", "first_match", "for", "force", "foreach", "forever", "fork", "forkjoin", "function",
    "generate", "genvar", "global", "highz0", "highz1", "if", "iff", "ifnone", "ignore_bins",
    "illegal_bins", "implements", "implies", "import", "incdir", "include", "initial", "inout",
    "input", "inside", "instance", "int", "integer", "interconnect", "interface", "intersect",
    "join", "join_any", "join_none", "large", "let", "liblist", "library", "local", "localparam",
    "logic", "longint", "macromodule", "matches", "medium", "modport", "module", "nand", "negedge",
    "nettype", "new", "nexttime", "nmos", "nor", "noshowcancelled", "not", "notif0", "notif1",
    "null", "or", "output", "package", "packed", "parameter", "pmos", "posedge", "primitive",
    "priority", "program", "property", "protected", "pull0", "pull1", "pulldown", "pullup",
    "pulsestyle_ondetect", "pulsestyle_onevent", "pure", "rand", "randc", "randcase",
    "randsequence", "rcmos", "real", "realtime", "ref", "reg", "reject_on", "release", "repeat",
    "restrict", "return", "rnmos", "rpmos", "rtran", "rtranif0", "rtranif1", "s_always",
    "s_eventually", "s_nexttime", "s_until", "s_until_with", "scalared", "sequence", "shortint",
    "shortreal", "showcancelled", "signed", "small", "soft", "solve", "specify", "specparam",
    "static", "string", "strong", "strong0", "strong1", "struct", "super", "supply0", "supply1",
    "sync_accept_on", "sync_reject_on", "table", "tagged", "task", "this", "throughout", "time",
    "timeprecision", "timeunit", "tran", "tranif0", "tranif1", "tri", "tri0", "tri1", "triand",
    "trior", "trireg", "type", "typedef", "union", "unique", "unique0", "unsigned", "until",
    "until_with", "untyped", "use", "uwire", "var", "vectored", "virtual", "void", "wait",
    "wait_order", "wand", "weak", "weak0", "weak1", "while", "wildcard", "wire", "with", "within",
    "wor", "xnor", "xor",
];

#[cfg(test)]
mod tests {
    use std::os::unix::ffi::OsStrExt;
    use std::process::Command;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn reserved_words_are_in_order_and_refused() {
        assert!(RESERVED.is_sorted());
        for word in RESERVED {
            assert_eq!(module(word), Err(NameError::Reserved(word.to_owned())));
        }
    }

    #[test]
    fn the_bundles_own_names_are_refused_but_the_top() {
        assert_eq!(module(TOP), Ok(()));
        for name in ["blysk_pkg", "blysk_tb", "blysk_rom", "blysk_tail_digits"] {
            assert_eq!(module(name), Err(NameError::Bundle(name.to_owned())));
        }
    }

    #[test]
    fn only_plain_identifiers_are_modules() {
        for good in ["a", "_", "Always", "my_highlight2", "blysk2", "dut", "clk", &"a".repeat(100)] {
            assert_eq!(module(good), Ok(()), "{good}");
        }
        for bad in ["", "1a", "a b", "a$b", "$a", "\\a ", "a\n", "a#", "a-b", "é", "a\"", "`a"] {
            assert_eq!(module(bad), Err(NameError::Module), "{bad:?}");
        }
        assert_eq!(module(&"a".repeat(101)), Err(NameError::Long(101)));
        assert_eq!(module("bool"), Err(NameError::Tool("bool".to_owned(), "Icarus Verilog")));
    }

    #[test]
    fn labels_are_names_of_files_everywhere() {
        for good in ["a", "1", "_", "a-b", "compact_12_bit", "always"] {
            assert_eq!(label(good), Ok(()), "{good}");
        }
        for bad in ["", "-", "-x", "a b", "a/b", ".", "a\n", "a$", "a#", "a\"", "a:b", "é", "a\\"] {
            assert_eq!(label(bad), Err(NameError::Label), "{bad:?}");
        }
        assert_eq!(label(&"a".repeat(101)), Err(NameError::Long(101)));
    }

    #[test]
    fn arguments_are_quoted_where_they_must_be() {
        for (argument, wanted) in [
            ("a/b-c.json", "a/b-c.json"),
            ("", "''"),
            ("a b", "'a b'"),
            ("$x#`y`", "'$x#`y`'"),
            ("it's", r"'it'\''s'"),
            ("grün", "'grün'"),
            ("a\nb'1", r"$'a\012b\'1'"),
            ("\u{202e}x", r"$'\342\200\256x'"),
        ] {
            assert_eq!(shell(argument), wanted);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// Bash reads back what was quoted, from one line without control characters.
        #[test]
        fn a_shell_reads_back_what_was_quoted(bytes in proptest::collection::vec(1_u8.., 0..12), text in "\\PC*") {
            for argument in [OsStr::from_bytes(&bytes), OsStr::new(&text)] {
                if argument.as_encoded_bytes().contains(&0) {
                    continue;
                }
                let quoted = shell(argument);
                prop_assert!(quoted.chars().all(|c| !c.is_control()), "{quoted:?}");
                let script = format!("printf %s {quoted}");
                let output = Command::new("bash").args(["-c", &script]).output().unwrap();
                prop_assert_eq!(&output.stdout, argument.as_encoded_bytes(), "{}", quoted);
            }
        }
    }
}
