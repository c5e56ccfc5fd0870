//! Words of registers and numbers, as the page has them.
//!
//! An integer of up to 63 bits travels as text, since a script would round it. A real number travels with its text for
//! people, which is that of the `blysk` command.

use document::facts::{Facts, Known};
use hw_model::datapath::RankRegister;
use hw_model::format::QFormat;
use hw_model::quantise::{decimal, real};
use serde::Serialize;
use vectors::digits::digits;
use vectors::evaluate::Held;

/// A real number.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Real {
    /// The number; null where it is none.
    pub(crate) value: f64,
    /// Its text for people.
    pub(crate) text: String,
}

impl Real {
    /// With this many significant digits.
    pub(crate) fn new(value: f64, significant: usize) -> Self {
        Self { value, text: digits(value, significant) }
    }
}

/// A format.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Format {
    /// As configurations state it: `UQ1.23`.
    pub(crate) name: String,
    /// All bits.
    pub(crate) width: u32,
    /// The bits behind the point, which may be more than there are.
    pub(crate) fraction: u32,
    /// One in the last place, as a real number.
    pub(crate) ulp: f64,
}

impl From<QFormat> for Format {
    fn from(format: QFormat) -> Self {
        let (width, fraction) = (format.width(), format.fraction_bits());
        Self { name: format.to_string(), width, fraction, ulp: format.ulp() }
    }
}

/// What a register can hold.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Range {
    /// The least real value.
    pub(crate) least: String,
    /// The greatest real value.
    pub(crate) greatest: String,
    /// Both as people read them.
    pub(crate) text: String,
    /// `exact`, `bound`, or `format` where nothing more is known than what the format holds.
    pub(crate) known: &'static str,
}

impl Range {
    /// Of a register in a rank.
    pub(crate) fn of(facts: &Facts<'_>, rank: usize, register: &RankRegister) -> Self {
        let held = facts.held(rank, register);
        let shown = |bits| digits(real(bits, register.format), SHOWN);
        Self {
            text: format!("{} … {}", shown(held.least), shown(held.greatest)),
            least: decimal(held.least, register.format),
            greatest: decimal(held.greatest, register.format),
            known: match held.known {
                Known::Exact => "exact",
                Known::Bound => "bound",
                Known::Format => "format",
            },
        }
    }
}

/// A register with what it holds.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Word {
    /// The register's name, without its rank.
    pub(crate) name: &'static str,
    /// The format of the bits.
    pub(crate) format: Format,
    /// The bits as an integer.
    pub(crate) bits: String,
    /// The word in hex.
    pub(crate) hex: String,
    /// Every bit of the word, the highest first.
    pub(crate) binary: String,
    /// The real value with all its decimals.
    pub(crate) decimal: String,
    /// The real value as `blysk evaluate --ranks` shows it.
    pub(crate) value: String,
    /// False where the rank only carries the value on.
    pub(crate) computed: bool,
}

/// Digits of values in tables, as in those of the `blysk` command.
const SHOWN: usize = 9;

impl From<&Held> for Word {
    fn from(held: &Held) -> Self {
        Self {
            name: held.name(),
            format: held.format().into(),
            bits: held.bits.to_string(),
            hex: held.hex(),
            binary: held.binary(),
            decimal: held.decimal(),
            value: digits(held.value(), SHOWN),
            computed: held.register.computed,
        }
    }
}
