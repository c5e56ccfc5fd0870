//! The ROM as an image that simulators and vendors' tools read.
//!
//! | format | read by | a word is |
//! |---|---|---|
//! | `mem` | `$readmemh`, in simulators and synthesisers | hex digits on a line |
//! | `hex` | Quartus | a record of Intel HEX: whole bytes, the highest first, at an address that counts words |
//! | `mif` | Quartus | `address : digits;` |
//! | `coe` | Vivado's Block Memory Generator | hex digits before a comma |
//!
//! Quartus counts the addresses of Intel HEX in words of the memory, and readers that count bytes find words on top of
//! each other, so that they refuse the file.

use std::fmt;
use std::io::{self, Write};

use dashu_int::UBig;
use hw_model::design::Design;
use thiserror::Error;

use crate::memory_file::{Header, comment, write_header, write_word};
use crate::packing::WordLayout;

/// How an image is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageFormat {
    /// For `$readmemh`.
    Mem,
    /// Intel HEX, its addresses in words.
    Hex,
    /// Altera's Memory Initialization File.
    Mif,
    /// Xilinx's coefficient file.
    Coe,
}

impl ImageFormat {
    /// The end of a file's name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mem => "mem",
            Self::Hex => "hex",
            Self::Mif => "mif",
            Self::Coe => "coe",
        }
    }
}

impl fmt::Display for ImageFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The most data bytes of a record of Intel HEX: their number has two hex digits.
const MOST_BYTES: usize = 255;

/// A word has more bytes than a record of Intel HEX holds.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "a ROM word of {width} bits takes {} bytes, and a record of Intel HEX has at most {MOST_BYTES}; \
     write mem, mif or coe", width.div_ceil(8)
)]
pub struct WideWord {
    /// Bits of a ROM word.
    pub width: u32,
}

/// The image of a design's ROM; `command` is what the file says it was made by (Intel HEX has no place for it).
///
/// # Errors
/// When a word is too wide for the format.
pub fn rom_image(design: &Design, format: ImageFormat, command: &str) -> Result<Vec<u8>, WideWord> {
    let width = design.rom().layout().word_width();
    if format == ImageFormat::Hex && width.div_ceil(8) as usize > MOST_BYTES {
        return Err(WideWord { width });
    }
    let mut text = Vec::new();
    let written = match format {
        ImageFormat::Mem => mem(design, command, &mut text),
        ImageFormat::Hex => hex(design, &mut text),
        ImageFormat::Mif => mif(design, command, &mut text),
        ImageFormat::Coe => coe(design, command, &mut text),
    };
    // Writing to memory cannot fail.
    debug_assert!(written.is_ok());
    Ok(text)
}

/// The words by address, packed.
pub(crate) fn words(design: &Design) -> impl Iterator<Item = UBig> + '_ {
    let rom = design.rom();
    rom.rows().iter().map(|row| rom.layout().pack(row))
}

/// The image for `$readmemh`.
///
/// # Errors
/// When the writer does.
pub(crate) fn mem(design: &Design, command: &str, to: &mut impl Write) -> io::Result<()> {
    let layout = &WordLayout::rom(design.rom().layout());
    let words_of = design.rom().depth() as u64;
    write_header(to, &Header { title: "ROM image", layout, words: words_of, command })?;
    words(design).try_for_each(|word| write_word(to, layout, &word))
}

fn digits(design: &Design) -> usize {
    design.rom().layout().word_width().div_ceil(4) as usize
}

fn hex(design: &Design, to: &mut impl Write) -> io::Result<()> {
    const DATA: u8 = 0;
    let bytes = design.rom().layout().word_width().div_ceil(8) as usize;
    for (address, word) in words(design).enumerate() {
        let mut data = word.to_be_bytes().to_vec();
        data.splice(..0, vec![0; bytes - data.len()]);
        // A list of exponents has at most 2^16.
        let [high, low] = (address as u16).to_be_bytes();
        let record = [&[bytes as u8, high, low, DATA], &data[..]].concat();
        // The bytes and the last one together are 0.
        let sum = record.iter().fold(0_u8, |sum, byte| sum.wrapping_sub(*byte));
        let text: String = record.iter().chain([&sum]).map(|byte| format!("{byte:02X}")).collect();
        writeln!(to, ":{text}")?;
    }
    writeln!(to, ":00000001FF")
}

fn mif(design: &Design, command: &str, to: &mut impl Write) -> io::Result<()> {
    let (depth, width, digits) = (design.rom().depth(), design.rom().layout().word_width(), digits(design));
    writeln!(to, "-- Blysk ROM image, configuration {}", comment(&design.config().name))?;
    writeln!(to, "-- made by: {}", comment(command))?;
    writeln!(to, "WIDTH={width};\nDEPTH={depth};\nADDRESS_RADIX=UNS;\nDATA_RADIX=HEX;\nCONTENT BEGIN")?;
    for (address, word) in words(design).enumerate() {
        writeln!(to, "  {address} : {word:0digits$x};")?;
    }
    writeln!(to, "END;")
}

fn coe(design: &Design, command: &str, to: &mut impl Write) -> io::Result<()> {
    let (depth, digits) = (design.rom().depth(), digits(design));
    writeln!(to, "; Blysk ROM image, configuration {}", comment(&design.config().name))?;
    writeln!(to, "; made by: {}", comment(command))?;
    writeln!(to, "memory_initialization_radix=16;\nmemory_initialization_vector=")?;
    for (address, word) in words(design).enumerate() {
        let end = if address + 1 == depth { ';' } else { ',' };
        writeln!(to, "{word:0digits$x}{end}")?;
    }
    Ok(())
}
