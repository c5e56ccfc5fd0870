//! Writes memory files: comments that say the layout, then one word a line in hex.

use std::fmt::LowerHex;
use std::io::{self, Write};

use crate::packing::WordLayout;

/// What the comments at the top of a memory file say.
#[derive(Debug, Clone, Copy)]
pub struct Header<'a> {
    /// What the file is: `stimulus`, `expected answers`.
    pub title: &'a str,
    /// What a word is made of.
    pub layout: &'a WordLayout,
    /// The number of words that follow.
    pub words: u64,
    /// The command that made the file.
    pub command: &'a str,
}

/// Writes the comments at the top.
///
/// # Errors
/// When the writer does.
pub fn write_header(out: &mut impl Write, header: &Header<'_>) -> io::Result<()> {
    let Header { title, layout, words, command } = header;
    let (digits, width) = (layout.digits(), layout.width);
    writeln!(out, "// Blysk {title}, for $readmemh: {words} words of {width} bits")?;
    writeln!(out, "// one word a line, {digits} hex digits, two's complement where signed")?;
    for field in &layout.fields {
        let (msb, lsb, format) = (field.msb, field.lsb, field.format);
        writeln!(out, "//   [{msb}:{lsb}] {} {format}", field.name)?;
    }
    writeln!(out, "// made by: {}", comment(command))
}

/// A text as it may stand in a comment of a line: a line break would end the comment, and what is behind it would be
/// read as numbers.
pub(crate) fn comment(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Writes one word.
///
/// # Errors
/// When the writer does.
pub fn write_word(out: &mut impl Write, layout: &WordLayout, word: &impl LowerHex) -> io::Result<()> {
    writeln!(out, "{word:00$x}", layout.digits())
}
