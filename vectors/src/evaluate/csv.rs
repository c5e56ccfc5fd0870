//! Questions as CSV: n or address, x or its bits; answers as CSV.

use crate::stimulus_file::{bits, exponent, real};
use hw_model::datapath::Datapath;
use hw_model::format::QFormat;

use super::answer::{Answer, Question};
use super::stream::Dialect;

/// What the columns of a question may be.
const KNOWN: &str = "the first line names the columns: n or address, and x or x_bits";

/// CSV with a header.
pub struct Csv<'a> {
    datapath: &'a Datapath,
    columns: Option<Columns>,
    numbers: zmij::Buffer,
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
        Self { datapath, columns: None, numbers: zmij::Buffer::new() }
    }

    fn number(&mut self, value: f64, to: &mut Vec<u8>) {
        let text = self.numbers.format(value);
        to.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
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
    bits(text, port).ok().and_then(|address| u32::try_from(address).ok()).ok_or_else(|| {
        format!("{text:?} is not an address; addresses are 0 to {}", port.max_bits())
    })
}

impl Dialect for Csv<'_> {
    fn header(&self) -> &'static str {
        "n,x,intensity,reference,error_ulp,region,intensity_bits,status\n"
    }

    fn wanted(&self) -> &'static str {
        "write a line `n,x`, and below it a line for each question, such as `64,0.99`"
    }

    fn read(&mut self, line: &str) -> Result<Option<Question>, String> {
        if line.is_empty() || line.starts_with('#') {
            return Ok(None);
        }
        match self.columns {
            Some(columns) => self.question(columns, line).map(Some),
            None => {
                self.columns = Some(Columns::find(line)?);
                Ok(None)
            }
        }
    }

    fn write(&mut self, answer: &Answer, to: &mut Vec<u8>) {
        let datapath = self.datapath;
        let x = answer.x(datapath);
        let (value, reference) = (answer.value(datapath), answer.reference(datapath));
        let error = reference.map(|reference| answer.error_ulp_from(datapath, reference));
        for number in [answer.question.exponent, Some(x), Some(value), reference, error] {
            if let Some(number) = number {
                self.number(number, to);
            }
            to.push(b',');
        }
        to.extend_from_slice(answer.region.name().as_bytes());
        to.push(b',');
        self.number(answer.intensity as f64, to);
        to.push(b',');
        self.number(answer.status.bits().into(), to);
        to.push(b'\n');
    }
}
