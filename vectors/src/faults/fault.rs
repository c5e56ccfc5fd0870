//! The faults by name.

use std::fmt;

use hw_model::datapath::{Signals, Status};
use hw_model::rom::FieldName;
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
    pub field: FieldName,
    /// By how much the stored integer is wrong: +1 or −1 in its last place.
    pub step: i64,
}

/// A line that rounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RoundingLine {
    /// u = (1 − x)·2^e.
    Variable,
    /// Stage 1, 2 or 3, counted from 0.
    Stage(usize),
    /// D = A − B·x.
    Divisor,
    /// The quotient as the output.
    Quotient,
}

/// A register of the data path that holds a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DataRegister {
    /// The polynomial's variable v.
    V,
    /// After stage 1, 2 or 3, counted from 0.
    T(usize),
    /// The x that the divider is given.
    TailX,
    /// The divisor D = A − B·x.
    Divisor,
    /// The remainder of the division, 0 or more and less than D.
    Remainder,
    /// Dividend bits to come and quotient bits found.
    Digits,
    /// The pipeline's intensity.
    Intensity,
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
    /// e is 1 more in every row.
    ShiftMore,
    /// e is 1 less in every row that has one.
    ShiftLess,
    /// The first segment answers for x > hand_over instead of x ≥ hand_over.
    HandOverExclusive,
    /// The second segment's shift is 1 more in every row.
    ShiftOuterMore,
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
    /// A line rounds by another mode.
    Rounding(RoundingLine, Rounding),
    /// A register of this rank.
    Register(usize, DataRegister, Defect),
    /// A choice between the lines is wrong.
    Logic(Logic),
}

impl DataRegister {
    /// Every register that a fault can damage, in the order of the pipeline.
    pub const ALL: [Self; 9] = [
        Self::V,
        Self::T(0),
        Self::T(1),
        Self::T(2),
        Self::TailX,
        Self::Divisor,
        Self::Remainder,
        Self::Digits,
        Self::Intensity,
    ];

    /// Its name, as [`hw_model::datapath::Register`] has it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::V => "v",
            Self::T(0) => "t1",
            Self::T(1) => "t2",
            Self::T(_) => "t3",
            Self::TailX => "tail_x",
            Self::Divisor => "divisor",
            Self::Remainder => "remainder",
            Self::Digits => "digits",
            Self::Intensity => "intensity",
        }
    }

    /// Its place in what a rank holds.
    pub const fn of(self, signals: &mut Signals) -> &mut i64 {
        match self {
            Self::V => &mut signals.v,
            Self::T(0) => &mut signals.t1,
            Self::T(1) => &mut signals.t2,
            Self::T(_) => &mut signals.t3,
            Self::TailX => &mut signals.tail_x,
            Self::Divisor => &mut signals.division.divisor,
            Self::Remainder => &mut signals.division.remainder,
            Self::Digits => &mut signals.division.digits,
            Self::Intensity => &mut signals.intensity,
        }
    }
}

impl fmt::Display for FieldFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { address, field, step } = self;
        write!(f, "rom:{address}.{field}{step:+}")
    }
}

impl fmt::Display for RoundingLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Variable => f.write_str("u"),
            Self::Stage(index) => f.write_str(DataRegister::T(*index).name()),
            Self::Divisor => f.write_str("divisor"),
            Self::Quotient => f.write_str("quotient"),
        }
    }
}

impl fmt::Display for Logic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self {
            Self::CutExclusive => "cut_exclusive",
            Self::ShiftMore => "shift+1",
            Self::ShiftLess => "shift-1",
            Self::HandOverExclusive => "hand_over_exclusive",
            Self::ShiftOuterMore => "shift_outer+1",
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
            Self::Rounding(line, mode) => write!(f, "rounding:{line}.{mode}"),
            Self::Register(rank, register, defect) => {
                let defect = match defect {
                    Defect::Short => "short",
                    Defect::LowBitStuck => "low_bit_stuck",
                };
                write!(f, "{defect}:{rank}.{}", register.name())
            }
            Self::Logic(logic) => logic.fmt(f),
        }
    }
}
