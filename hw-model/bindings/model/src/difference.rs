//! Where a DUT departs from the model, in words.

use std::fmt::Write as _;

use hw_model::format::QFormat;
use hw_model::quantise::real;
use thiserror::Error;
use vectors::rtl::probes::Probe;

use crate::handle::Model;

/// Where a DUT departs from the model, in words: cycle, port or register, what it is and what was expected, the
/// request that it belongs to, and what the registers of that request should be where the DUT's were not seen.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Difference(pub(crate) String);

/// A request that was taken: address, and bits of x.
pub(crate) type Request = (u32, i64);

/// The first thing that differs in a cycle.
pub(crate) struct Departure {
    pub what: String,
    /// The request that it belongs to, where it belongs to one.
    pub request: Option<Request>,
    /// Whether the DUT's registers were seen, and so need not be told.
    pub registers_seen: bool,
}

impl Departure {
    /// Of an input that the testbench drives.
    pub fn unknown(port: &str) -> Self {
        Self::of_port(format!("{port} has an x or z in it, and it is what the testbench drives"))
    }

    /// Of a port of the handshake, unless it shows what it should.
    pub fn check_level(port: &str, got: Option<bool>, wanted: bool, why: &str) -> Result<(), Self> {
        if got == Some(wanted) {
            return Ok(());
        }
        let got = got.map_or('x', |level| if level { '1' } else { '0' });
        Err(Self::of_port(format!("{port} is {got}, expected {}: {why}", u8::from(wanted))))
    }

    fn of_port(what: String) -> Self {
        Self { what, request: None, registers_seen: false }
    }

    /// What a user is told.
    pub fn in_words(&self, model: &Model, cycle: u64) -> Difference {
        let Self { what, request, registers_seen } = self;
        let mut text = format!("cycle {cycle}: {what}");
        let Some((address, x)) = *request else { return Difference(text) };
        let exponents = model.design().rom().exponents().as_slice();
        let exponent = exponents.get(address as usize).map_or_else(|| "no ROM word".to_owned(), |n| format!("n = {n}"));
        let format = model.datapath().formats().input;
        // Writing to a String cannot fail.
        let _ = write!(text, "\n  request: address {address} ({exponent}), x = {}", shown(format, format.to_word(x)));
        if !registers_seen && let Ok(bits) = model.registers(address, x) {
            text += "\n  its registers should be:";
            let probes = model.probes().iter().zip(bits).filter(|(probe, _)| probe.register.computed);
            for (probe, bits) in probes {
                let format = probe.register.format;
                let _ = write!(text, "\n    {:<24} {}", probe.name, shown(format, format.to_word(bits)));
            }
        }
        Difference(text)
    }
}

/// What a register is and should be, unless it is what it should.
pub(crate) fn check_word(probe: &Probe, got: Option<u64>, wanted: u64) -> Result<(), String> {
    let format = probe.register.format;
    if got == Some(wanted) {
        return Ok(());
    }
    let got = got.map_or_else(|| "x".to_owned(), |got| shown(format, got));
    Err(format!("{} is {got}, expected {}", probe.name, shown(format, wanted)))
}

/// A word as Verilog writes it, with its value: `16'h434b (0.525726318)`.
fn shown(format: QFormat, word: u64) -> String {
    let width = format.width();
    let digits = width.div_ceil(4) as usize;
    if format.fraction_bits() == 0 {
        return format!("{width}'h{word:0digits$x} ({})", format.from_word(word));
    }
    let value = format!("{:.9}", real(format.from_word(word), format));
    let value = value.trim_end_matches('0').trim_end_matches('.');
    format!("{width}'h{word:0digits$x} ({value})")
}
