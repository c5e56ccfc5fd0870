//! What the testbench prints with `+registers=N`: every register of every cycle.
//!
//! A line begins with `R`; other lines (a simulator's own) are passed over. Its words are hex: the
//! ports rst, in_valid, in_ready, address, x, out_valid, out_ready, then for each rank its valid flag
//! and its registers, in the order of [`probes`]. A word with x or z in it is unknown. The last line is
//! `R-END` and the number of cycles: without it a log that was cut off would agree.

use std::io::BufRead;

use hw_model::datapath::Datapath;
use thiserror::Error;

use super::probes::{Probe, probes};
use crate::text_file::TextProblem;

/// What the last line begins with; the number of cycles follows.
pub const END: &str = "R-END ";

/// Ports at the start of a line.
const PORTS: usize = 7;

/// Why a log is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RegisterLogError {
    /// The log cannot be read, or is no text.
    #[error("cannot read the log: {0}")]
    Text(#[from] TextProblem),
    /// A line has another number of words.
    #[error("line {line}: {found} words, and not {wanted}; is it a log of another configuration?")]
    Words {
        /// The number of the line, counted from 1.
        line: u64,
        /// How many there are.
        found: usize,
        /// How many there should be.
        wanted: usize,
    },
    /// A word is not hex.
    #[error("line {line}: {text:?} is not a hex number of at most 64 bits")]
    Hex {
        /// The number of the line, counted from 1.
        line: u64,
        /// The word as the log has it.
        text: String,
    },
    /// The log stops before its end.
    #[error(
        "after line {line}: the log has no line \"R-END {cycles}\", which the testbench prints after its \
         last cycle; was it cut off?"
    )]
    Unfinished {
        /// The last line, counted from 1.
        line: u64,
        /// The number of cycles read before the log ended.
        cycles: u64,
    },
    /// An input that only the testbench drives is unknown.
    #[error("line {line}: the input {port} is unknown; it is driven by the testbench, never x")]
    UnknownInput {
        /// The number of the line, counted from 1.
        line: u64,
        /// The input port whose bits are unknown.
        port: &'static str,
    },
}

/// One cycle of the log. A `None` is unknown.
#[derive(Debug, Clone, Default)]
pub struct RegisterLine {
    /// Line of the file, counted from 1.
    pub line: u64,
    /// The level of `rst_i`.
    pub reset: bool,
    /// The level of `in_valid_i`.
    pub in_valid: bool,
    /// The level of `in_ready_o`; none where the log has `x` or `z`.
    pub in_ready: Option<u64>,
    /// The value at `address_i`.
    pub address: u32,
    /// The bits at `x_i`, in the input format.
    pub x: i64,
    /// The level of `out_valid_o`; none where the log has `x` or `z`.
    pub out_valid: Option<u64>,
    /// The level of `out_ready_i`.
    pub out_ready: bool,
    /// For each rank its valid flag and its registers, as words.
    pub words: Vec<Option<u64>>,
}

/// Reads a log line by line.
pub struct RegisterLog<'a, R> {
    datapath: &'a Datapath,
    probes: Vec<Probe>,
    input: R,
    text: String,
    current: RegisterLine,
    cycles: u64,
    ended: bool,
}

impl<'a, R: BufRead> RegisterLog<'a, R> {
    /// The log of a data path.
    pub fn new(datapath: &'a Datapath, input: R) -> Self {
        let probes = probes(datapath);
        Self { datapath, probes, input, text: String::new(), current: RegisterLine::default(), cycles: 0, ended: false }
    }

    /// The registers, in the order of a line (valid flags apart).
    #[must_use]
    pub fn probes(&self) -> &[Probe] {
        &self.probes
    }

    /// The next cycle; `None` after the line that says how many there were.
    ///
    /// # Errors
    /// When the log cannot be read, is not one of this data path, or is cut off.
    pub fn next_cycle(&mut self) -> Result<Option<&RegisterLine>, RegisterLogError> {
        loop {
            self.text.clear();
            self.current.line += 1;
            let line = self.current.line;
            let read = self.input.read_line(&mut self.text);
            if read.map_err(TextProblem::from)? == 0 {
                let cycles = self.cycles;
                let unfinished = RegisterLogError::Unfinished { line: line - 1, cycles };
                // A file without any cycle is not one that was cut off; the caller finds no cycle in it.
                return if self.ended || cycles == 0 { Ok(None) } else { Err(unfinished) };
            }
            if self.text.starts_with("R ") {
                self.parse()?;
                self.cycles += 1;
                return Ok(Some(&self.current));
            }
            if let Some(end) = self.text.strip_prefix(END) {
                self.ended = end.trim().parse() == Ok(self.cycles);
            }
        }
    }

    fn parse(&mut self) -> Result<(), RegisterLogError> {
        let line = self.current.line;
        let mut ports = [None; PORTS];
        let mut count = 0;
        self.current.words.clear();
        for text in self.text.split_ascii_whitespace().skip(1) {
            let word = word(text).ok_or_else(|| RegisterLogError::Hex { line, text: text.to_owned() })?;
            match ports.get_mut(count) {
                Some(port) => *port = word,
                None => self.current.words.push(word),
            }
            count += 1;
        }
        let wanted = PORTS + self.datapath.rank_count() + self.probes.len();
        if count != wanted {
            return Err(RegisterLogError::Words { line, found: count, wanted });
        }
        let [reset, in_valid, in_ready, address, x, out_valid, out_ready] = ports;
        let known = |port, word: Option<u64>| word.ok_or(RegisterLogError::UnknownInput { line, port });
        self.current.reset = known("rst_i", reset)? != 0;
        self.current.in_valid = known("in_valid_i", in_valid)? != 0;
        self.current.in_ready = in_ready;
        self.current.address = known("address_i", address)? as u32;
        self.current.x = self.datapath.formats().input.from_word(known("x_i", x)?);
        self.current.out_valid = out_valid;
        self.current.out_ready = known("out_ready_i", out_ready)? != 0;
        Ok(())
    }
}

/// `Some(None)` where it holds an x or z; `None` where it is not hex.
fn word(text: &str) -> Option<Option<u64>> {
    let mut word = 0_u64;
    let mut unknown = false;
    for digit in text.bytes() {
        let value = match digit {
            b'0'..=b'9' => digit - b'0',
            b'a'..=b'f' => digit - b'a' + 10,
            b'A'..=b'F' => digit - b'A' + 10,
            b'x' | b'X' | b'z' | b'Z' => {
                unknown = true;
                0
            }
            _ => return None,
        };
        if word >> 60 != 0 {
            return None;
        }
        word = word << 4 | u64::from(value);
    }
    Some((!unknown).then_some(word))
}
