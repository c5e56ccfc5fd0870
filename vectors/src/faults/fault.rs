//! The faults by name.

use std::fmt;

use hw_model::datapath::{Signals, Status};
use hw_model::registers::{MAX_DEGREE, MAX_SEGMENTS, PARTIALS, Register};
use hw_model::rounding::Rounding;

/// Faults of the handshake: which cycle a result comes in, and whether it comes at all. They need a
/// clock and a stalled consumer to be seen; vectors one at a time, each waited for, show the right
/// answer under all of them.
pub const HANDSHAKE: [&str; 3] = ["latency+1", "latency-1", "stall_lost"];

/// A stored field of a row that is one unit of its last place more or less.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct FieldFault {
    /// The address of the ROM row.
    pub address: u32,
    /// The field of the row that is wrong.
    pub field: Register,
    /// By how much the stored integer is wrong: +1 or −1 in its last place.
    pub step: i64,
}

/// What is wrong with a register.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Defect {
    /// The top bit is missing: what needs it wraps.
    Short,
    /// The lowest bit is always 0.
    LowBitStuck,
}

/// A mistake in the choices between the lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Logic {
    /// The polynomial answers for x > cut instead of x ≥ cut.
    CutExclusive,
    /// The shift of this segment is 1 more in every row.
    ShiftMore(usize),
    /// The first segment's shift is 1 less in every row that has one.
    ShiftLess,
    /// This segment, 1 or further, answers for x ≤ its hand-over instead of x < hand-over.
    HandOverExclusive(usize),
    /// x above 1 is not clamped.
    NoInputClamp,
    /// The sign bit of x counts as its highest bit.
    NegativeAsUnsigned,
    /// Where the polynomial should answer, the other part does, and the other way round.
    RegionsSwapped,
    /// A polynomial below 0 is shown as it is.
    NoClampBelow,
    /// A polynomial above 1 is shown as it is.
    NoClampAbove,
    /// A quotient above 1 is shown as it is.
    NoQuotientClamp,
    /// This flag is never raised.
    NoFlag(Status),
    /// The last quotient bit is not looked for.
    DigitMissing,
}

/// One mistake in the hardware: everything else is right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Fault {
    /// A ROM field is one unit off in its last place.
    Field(FieldFault),
    /// The row at this address and the next have each other's words.
    Swap(u32),
    /// The line that gives this register its value rounds by another mode: V, T(j), the divisor, or for the quotient
    /// the intensity.
    Rounding(Register, Rounding),
    /// A register of this rank that holds a number of the data path.
    Register(usize, Register, Defect),
    /// A choice.
    Logic(Logic),
}

/// True for the registers of the data path that hold numbers: what has a defect shows in them.
#[must_use]
pub const fn is_data(register: Register) -> bool {
    use Register::{Digits, Distance, Divisor, Intensity, Partial, Product, Remainder, Sum, T, TailX, V};
    matches!(
        register,
        V | T(_) | Distance(_) | Partial(..) | Product(_) | Sum(_) | TailX | Divisor | Remainder | Digits | Intensity
    )
}

/// The place of a register that [`is_data`] in what a rank holds; none of another one.
pub const fn place(register: Register, signals: &mut Signals) -> Option<&mut i64> {
    match register {
        Register::V => Some(&mut signals.v),
        Register::T(stage @ 1..=MAX_DEGREE) => Some(&mut signals.t[stage - 1]),
        Register::TailX => Some(&mut signals.tail_x),
        Register::Divisor => Some(&mut signals.division.divisor),
        Register::Remainder => Some(&mut signals.division.remainder),
        Register::Digits => Some(&mut signals.division.digits),
        Register::Intensity => Some(&mut signals.intensity),
        Register::Product(line @ 0..=MAX_DEGREE) => Some(&mut signals.product[line]),
        Register::Partial(line @ 0..=MAX_DEGREE, part @ 0..PARTIALS) => Some(&mut signals.partial[line][part]),
        Register::Sum(line @ 0..=MAX_DEGREE) => Some(&mut signals.sum[line]),
        Register::Distance(segment @ 0..MAX_SEGMENTS) => Some(&mut signals.distance[segment]),
        _ => None,
    }
}

impl fmt::Display for FieldFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { address, field, step } = self;
        write!(f, "rom:{address}.{field}{step:+}")
    }
}

/// The name of a line that rounds, by the register that takes its result: u, t1, …, divisor, quotient.
#[must_use]
pub const fn line_name(register: Register) -> &'static str {
    match register {
        Register::V => "u",
        Register::Intensity => "quotient",
        register => register.name(),
    }
}

impl fmt::Display for Logic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self {
            Self::CutExclusive => "cut_exclusive",
            Self::ShiftMore(segment) => return write!(f, "{}+1", Register::Shift(*segment)),
            Self::ShiftLess => "shift-1",
            Self::HandOverExclusive(segment) => {
                return write!(f, "{}_exclusive", Register::HandOver(*segment));
            }
            Self::NoInputClamp => "no_input_clamp",
            Self::NegativeAsUnsigned => "negative_as_unsigned",
            Self::RegionsSwapped => "regions_swapped",
            Self::NoClampBelow => "no_clamp_below",
            Self::NoClampAbove => "no_clamp_above",
            Self::NoQuotientClamp => "no_quotient_clamp",
            Self::NoFlag(flag) => return write!(f, "no_flag:{flag}"),
            Self::DigitMissing => "digit_missing",
        };
        f.write_str(name)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Field(fault) => fault.fmt(f),
            Self::Swap(address) => write!(f, "swap:{address}-{}", address + 1),
            Self::Rounding(line, mode) => write!(f, "rounding:{}.{mode}", line_name(*line)),
            Self::Register(rank, register, defect) => {
                let defect = match defect {
                    Defect::Short => "short",
                    Defect::LowBitStuck => "low_bit_stuck",
                };
                write!(f, "{defect}:{rank}.{register}")
            }
            Self::Logic(logic) => logic.fmt(f),
        }
    }
}
