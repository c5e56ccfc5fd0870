//! Questions and answers as hex words: those of `stimulus.mem` and `expected.mem`.

use std::io::Write;

use crate::packing::WordLayout;
use dashu_int::UBig;
use hw_model::datapath::Datapath;

use super::answer::{Answer, Question};
use super::stream::Dialect;

/// A word a line: `{address, x}` in, `{status, intensity}` out, as the memory files of a bundle have them.
#[derive(Debug)]
pub struct Hex<'a> {
    datapath: &'a Datapath,
    stimulus: WordLayout,
    expected: WordLayout,
}

impl<'a> Hex<'a> {
    /// For the questions of this data path.
    #[must_use]
    pub fn new(datapath: &'a Datapath) -> Self {
        let (stimulus, expected) = (WordLayout::stimulus(datapath), WordLayout::expected(datapath));
        Self { datapath, stimulus, expected }
    }
}

impl Dialect for Hex<'_> {
    fn header(&self) -> &'static str {
        ""
    }

    fn wanted(&self) -> &'static str {
        "write a word {address, x} in hex on a line for each question, as in stimulus.mem"
    }

    fn read(&mut self, line: &str) -> Result<Option<Question>, String> {
        let word = line.split_once("//").map_or(line, |(word, _)| word).trim();
        if word.is_empty() {
            return Ok(None);
        }
        let digits = self.stimulus.digits();
        let value = Some(word).filter(|word| word.bytes().all(|byte| byte.is_ascii_hexdigit()));
        let value = value.and_then(|word| UBig::from_str_radix(word, 16).ok());
        match value.filter(|value| (value >> self.stimulus.width as usize).is_zero()) {
            Some(value) => match self.stimulus.unpack(&value)[..] {
                [address, x] => Ok(Some(Question::at(self.datapath.rom(), address as u32, x))),
                _ => Err("the stimulus word has other fields than address and x".to_owned()),
            },
            None => Err(format!(
                "{word:?} is not a word of {} bits {{address, x}}; write {digits} hex digits, as stimulus.mem",
                self.stimulus.width
            )),
        }
    }

    fn write(&mut self, answer: &Answer, to: &mut Vec<u8>) {
        let word = self.expected.pack(&[answer.status.bits().into(), answer.intensity]);
        // Writing to memory cannot fail.
        let _ = writeln!(to, "{word:0digits$x}", digits = self.expected.digits());
    }
}
