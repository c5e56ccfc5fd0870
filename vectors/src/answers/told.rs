//! A verdict in words.

use std::fmt;

use hw_model::datapath::Status;
use hw_model::quantise::decimal;

use super::column::Got;
use super::verdict::{Failure, Field, Verdict};
use crate::table::hex;

/// `PASS` with the number of vectors; or `FAIL` with the first vector that differs, where it departs, and how many
/// fail. The last line has no end.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(failure) = &self.first else { return write!(f, "PASS {} vectors", self.vectors) };
        self.failure(failure, f)?;
        self.summary(f)
    }
}

impl Verdict {
    /// The first vector that fails: what it is, its ports, and where it departs.
    fn failure(&self, failure: &Failure, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let vector = &failure.vector;
        let n = vector.case.exponent.map_or_else(|| "none".to_owned(), |n| n.to_string());
        let (address, x) = (vector.case.address, vector.case.x);
        let x = format!("{} ({})", hex(x, self.input), decimal(x, self.input));
        write!(f, "FAIL vector {}: n = {n} (address {address}), x = {x}", vector.index)?;
        let Some(line) = failure.line else {
            return writeln!(f, ": no answer");
        };
        writeln!(f, ", line {line} of the log")?;
        for port in failure.fields.iter().filter(|field| !field.is_register()) {
            match port.name.as_str() {
                "status" if port.differs() => writeln!(f, "  {}", told(port, flags))?,
                "status" => {}
                _ => writeln!(f, "  {}", told(port, |bits| decimal(bits, port.format)))?,
            }
        }
        let departs = |field: &&Field| field.is_register() && field.differs();
        if let Some(first) = failure.fields.iter().find(departs) {
            let told = told(first, |bits| decimal(bits, first.format));
            writeln!(f, "  departs first at {told}")?;
        }
        Ok(())
    }

    /// How many vectors fail, by where they depart.
    fn summary(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} vectors fail", self.failing(), self.vectors)?;
        for (rank, count) in &self.departures {
            // A log of ports alone shows the last rank, whatever went wrong before.
            match self.registers {
                0 => write!(f, "\n  {count} differ at the ports")?,
                _ => write!(f, "\n  {count} depart first at {rank}")?,
            }
        }
        if self.unanswered > 0 {
            write!(f, "\n  {} have no answer", self.unanswered)?;
        }
        if self.registers == 0 && !self.departures.is_empty() {
            write!(f, "\nColumns of registers in the log, such as front_end.region, would tell where.")?;
        }
        Ok(())
    }
}

/// What a port or register holds and should hold, as bits and as `shown`.
fn told(field: &Field, shown: impl Fn(i64) -> String) -> String {
    let known = |bits| format!("{} ({})", hex(bits, field.format), shown(bits));
    let got = match &field.got {
        Got::Known(bits) => known(*bits),
        Got::Unknown(text) => format!("{text} (unknown bits)"),
    };
    if field.differs() {
        format!("{}: got {got}, expected {}", field.name, known(field.expected))
    } else {
        format!("{}: got {got}, as expected", field.name)
    }
}

/// The flags by name, as in `vectors.csv`.
fn flags(bits: i64) -> String {
    let with = |status: Status, (flag, _): (Status, &str)| status.with(flag, bits & i64::from(flag.bits()) != 0);
    Status::NAMES.into_iter().fold(Status::default(), with).to_string()
}
