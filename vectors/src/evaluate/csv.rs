//! Questions as CSV: n or address, x or its bits; answers as CSV.

use crate::decimal::Decimal;
use crate::stimulus_file::{bits, exponent, real};
use hw_model::datapath::Datapath;
use hw_model::datapath::front_end::Region;
use hw_model::format::{Overflow, QFormat};
use hw_model::quantise::x_bits;

use super::answer::{Answer, Question, References};
use super::digits::Decimals;
use super::lines::{Room, Texts, Word};
use super::stream::Dialect;

/// What the columns of a question may be.
const KNOWN: &str = "the first line names the columns: n or address, and x or x_bits";

/// CSV with a header.
pub struct Csv<'a> {
    datapath: &'a Datapath,
    columns: Option<Columns>,
    /// The exponent of each address, and its text.
    exponents: Vec<(f64, Word)>,
    /// The name of each region, by its number.
    regions: [Word; 3],
    references: References,
    decimals: [Decimals; 2],
    texts: [Texts; 2],
    room: Room,
}

#[derive(Debug, Clone, Copy)]
struct Columns {
    count: usize,
    which: (usize, Which),
    x: (usize, X),
}

#[derive(Debug, Clone, Copy)]
enum Which {
    Exponent,
    Address,
}

#[derive(Debug, Clone, Copy)]
enum X {
    Real,
    Bits,
}

impl Columns {
    fn find(line: &str) -> Result<Self, String> {
        let (mut which, mut x, mut count) = (None, None, 0);
        for (place, name) in line.split(',').map(unquoted).enumerate() {
            count = place + 1;
            let twice = match name {
                "n" => which.replace((place, Which::Exponent)).is_some(),
                "address" => which.replace((place, Which::Address)).is_some(),
                "x" => x.replace((place, X::Real)).is_some(),
                "x_bits" => x.replace((place, X::Bits)).is_some(),
                _ => return Err(format!("there is no column {name:?}; {KNOWN}")),
            };
            if twice {
                return Err(format!("{name:?} is one column too many; {KNOWN}"));
            }
        }
        match (which, x) {
            (Some(which), Some(x)) => Ok(Self { count, which, x }),
            _ => Err(format!("a column is missing; {KNOWN}")),
        }
    }
}

/// A field without the space around it, or the quotes that some programs put around every field.
fn unquoted(field: &str) -> &str {
    let field = field.trim();
    field.strip_prefix('"').and_then(|field| field.strip_suffix('"')).unwrap_or(field)
}

impl<'a> Csv<'a> {
    /// For the questions of this data path.
    #[must_use]
    pub fn new(datapath: &'a Datapath) -> Self {
        Self {
            datapath,
            columns: None,
            exponents: datapath.rom().exponents().iter().map(|n| (n, Word::number(n))).collect(),
            regions: [Region::Zero, Region::Polynomial, Region::Tail].map(|region| Word::new(region.name())),
            references: References::default(),
            decimals: Default::default(),
            texts: Default::default(),
            room: Room::default(),
        }
    }

    /// The question of two decimals and nothing else, which most lines are, at the beginning of a text, and the rest of
    /// the text. Another line is read field by field.
    #[inline(always)]
    fn plain<'t>(&self, columns: Columns, text: &'t [u8]) -> Option<(Question, &'t [u8])> {
        let (first, rest) = Decimal::begin(text)?;
        let (second, rest) = Decimal::begin(rest.strip_prefix(b",")?)?;
        if columns.count != 2 {
            return None;
        }
        let (which, x) = if columns.x.0 == 1 { (first, second) } else { (second, first) };
        let input = self.datapath.formats().input;
        let x = match columns.x.1 {
            X::Real => x_bits(x.real(), input, Overflow::Refuse).ok()?,
            X::Bits => x.whole().filter(|&x| x <= input.max_bits())?,
        };
        let rom = self.datapath.rom();
        let question = match columns.which.1 {
            Which::Exponent => Question::of(rom, Some(which.real()).filter(|&n| n >= 1.0)?, x),
            Which::Address => {
                let address = which.whole().filter(|address| address >> rom.address_width() == 0)?;
                Question::at(rom, address as u32, x)
            }
        };
        Some((question, rest))
    }

    fn question(&self, columns: Columns, line: &str) -> Result<Question, String> {
        let Columns { count, which: (which_place, which), x: (x_place, x) } = columns;
        let (mut which_text, mut x_text, mut found) = ("", "", 0);
        for field in line.split(',') {
            if found == which_place {
                which_text = unquoted(field);
            } else if found == x_place {
                x_text = unquoted(field);
            }
            found += 1;
        }
        if found != count {
            return Err(format!("there are {found} fields, the first line names {count} columns"));
        }
        let input = self.datapath.formats().input;
        let x = match x {
            X::Real => real(x_text, input).map_err(|problem| format!("field `x`: {problem}")),
            X::Bits => bits(x_text, input).map_err(|problem| format!("field `x_bits`: {problem}")),
        }?;
        let rom = self.datapath.rom();
        match which {
            Which::Exponent => exponent(which_text)
                .map(|exponent| Question::of(rom, exponent, x))
                .map_err(|problem| format!("field `n`: {problem}")),
            Which::Address => address(which_text, rom.address_width())
                .map(|address| Question::at(rom, address, x))
                .map_err(|problem| format!("field `address`: {problem}")),
        }
    }
}

/// An address that the port can carry, in decimal or as `0x…`.
fn address(text: &str, width: u32) -> Result<u32, String> {
    let port = QFormat::field(width);
    bits(text, port)
        .ok()
        .and_then(|address| u32::try_from(address).ok())
        .ok_or_else(|| format!("{text:?} is not an address; addresses are 0 to {}", port.max_bits()))
}

impl Dialect for Csv<'_> {
    fn header(&self) -> &'static str {
        "n,x,intensity,reference,error_ulp,region,intensity_bits,status\n"
    }

    fn wanted(&self) -> &'static str {
        "write a line `n,x`, and below it a line for each question, such as `64,0.99`"
    }

    fn begin(&mut self, text: &str, most: usize, questions: &mut Vec<Question>) -> usize {
        let Some(columns) = self.columns else { return 0 };
        let mut rest = text.as_bytes();
        for _ in 0..most {
            let Some((question, [b'\n', next @ ..])) = self.plain(columns, rest) else { break };
            questions.push(question);
            rest = next;
        }
        text.len() - rest.len()
    }

    fn read(&mut self, line: &str, questions: &mut Vec<Question>) -> Result<(), String> {
        if let Some(columns) = self.columns
            && let Some((question, [])) = self.plain(columns, line.as_bytes())
        {
            questions.push(question);
            return Ok(());
        }
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            return Ok(());
        }
        match self.columns {
            Some(columns) => questions.push(self.question(columns, line)?),
            None => self.columns = Some(Columns::find(line)?),
        }
        Ok(())
    }

    fn write(&mut self, answers: &[Answer], to: &mut Vec<u8>) {
        let datapath = self.datapath;
        let (input, output) = (datapath.formats().input, datapath.formats().output);
        let references = self.references.of(datapath, answers);
        let errors = answers.iter().zip(references);
        let errors = errors.map(|(answer, &reference)| answer.error_ulp(datapath, reference));
        let [reference, error_ulp] = &mut self.texts;
        let reference = reference.of(references.iter().copied());
        let error_ulp = error_ulp.of(errors);
        let [x, intensity] = &mut self.decimals;
        x.of(answers.iter().map(|answer| answer.question.x), input);
        intensity.of(answers.iter().map(|answer| answer.intensity), output);
        let mut lines = self.room.lines(answers.len());
        for (index, answer) in answers.iter().enumerate() {
            match self.exponents.get(answer.question.address as usize) {
                Some((n, word)) if Some(*n) == answer.question.exponent => lines.word(word),
                _ => lines.exponent(answer.question.exponent),
            }
            lines.byte(b',');
            lines.fixed(x, index, answer.question.x, input);
            lines.byte(b',');
            lines.fixed(intensity, index, answer.intensity, output);
            lines.byte(b',');
            lines.number(reference[index]);
            lines.byte(b',');
            lines.number(error_ulp[index]);
            lines.byte(b',');
            lines.word(&self.regions[answer.region as usize]);
            lines.byte(b',');
            lines.whole(answer.intensity);
            lines.byte(b',');
            lines.whole(answer.status.bits().into());
            lines.byte(b'\n');
        }
        to.extend_from_slice(lines.written());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hw_model::design::Design;
    use proptest::prelude::*;

    proptest! {
        /// A line that is read as a whole asks what it asks when it is read field by field.
        #[test]
        fn the_short_way_is_the_long_way(
            first in "[0-9]{0,9}[.]?[0-9]{0,9}",
            second in "[0-9]{0,9}[.]?[0-9]{0,9}|0x[0-9a-f]{1,6}",
            end in "|,| |e1|-",
        ) {
            let design = Design::preset("schlick").unwrap();
            for header in ["n,x", "x,n", "address,x", "n,x_bits", "x_bits,address", "address,x_bits"] {
                let csv = Csv::new(design.datapath());
                let columns = Columns::find(header).unwrap();
                let line = format!("{first},{second}{end}");
                if let Some((question, [])) = csv.plain(columns, line.as_bytes()) {
                    prop_assert_eq!(csv.question(columns, &line), Ok(question), "{} {}", header, line);
                }
            }
        }
    }

    #[test]
    fn most_lines_are_read_the_short_way() {
        let design = Design::preset("schlick").unwrap();
        let csv = Csv::new(design.datapath());
        for (header, line) in [("n,x", "64,0.99"), ("x,n", "1,256"), ("address,x_bits", "63,8304722")] {
            let columns = Columns::find(header).unwrap();
            assert!(csv.plain(columns, line.as_bytes()).is_some(), "{header} {line}");
        }
    }
}
