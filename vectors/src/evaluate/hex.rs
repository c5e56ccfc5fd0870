//! Questions and answers as hex words: those of `stimulus.mem` and `expected.mem`.

use crate::packing::WordLayout;
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

    fn read(&mut self, line: &str, questions: &mut Vec<Question>) -> Result<(), String> {
        let word = line.split_once("//").map_or(line, |(word, _)| word).trim();
        if word.is_empty() {
            return Ok(());
        }
        let width = self.stimulus.width;
        let Some(value) = number(word).filter(|value| value >> width == 0) else {
            let digits = self.stimulus.digits();
            return Err(format!(
                "{word:?} is not a word of {width} bits {{address, x}}; write {digits} hex digits, as stimulus.mem"
            ));
        };
        let mut ports = self.stimulus.unpack_ports(value);
        let (Some(address), Some(x)) = (ports.next(), ports.next()) else {
            return Err("the stimulus word has other fields than address and x".to_owned());
        };
        questions.push(Question::at(self.datapath.rom(), address as u32, x));
        Ok(())
    }

    fn write(&mut self, answers: &[Answer], to: &mut Vec<u8>) {
        let digits = self.expected.digits();
        for answer in answers {
            let word = self.expected.pack(&[answer.status.bits().into(), answer.intensity]);
            to.extend((0..digits).rev().map(|place| DIGITS[(word >> (4 * place) & 0xf) as usize]));
            to.push(b'\n');
        }
    }
}

const DIGITS: &[u8; 16] = b"0123456789abcdef";

/// The number of hex digits and nothing else, where it has no more than 128 bits.
fn number(digits: &str) -> Option<u128> {
    digits.bytes().try_fold(0_u128, |number, byte| {
        let digit = char::from(byte).to_digit(16)?;
        (number >> 124 == 0).then_some((number << 4) | u128::from(digit))
    })
}
