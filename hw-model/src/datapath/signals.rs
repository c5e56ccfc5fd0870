//! What the ranks of registers hold.

use std::fmt;

use crate::format::QFormat;
use crate::registers::{MAX_DEGREE, MAX_SEGMENTS, PARTIALS, Register};
use crate::rom::Row;

use super::front_end::Region;
use super::tail::Division;

/// Status flags that travel with a result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Status(u8);

impl Status {
    /// The address has no ROM word; the intensity is 0.
    pub const NO_WORD: Self = Self(1);
    /// x was above 1 and was taken as 1.
    pub const ABOVE_ONE: Self = Self(2);
    /// x was negative; the intensity is 0.
    pub const FACING_AWAY: Self = Self(4);
    /// The polynomial left [0, 1] and was clamped.
    pub const CLAMPED: Self = Self(8);
    /// x lies outside the domain that the configuration is built for; the intensity is 0.
    pub const OUT_OF_DOMAIN: Self = Self(16);
    /// Every flag with its name, from bit 0 up. Only a configuration with a domain has the last.
    pub const NAMES: [(Self, &'static str); 5] = [
        (Self::NO_WORD, "no_word"),
        (Self::ABOVE_ONE, "above_one"),
        (Self::FACING_AWAY, "facing_away"),
        (Self::CLAMPED, "clamped"),
        (Self::OUT_OF_DOMAIN, "out_of_domain"),
    ];

    /// The flags as the status port shows them.
    #[must_use]
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// The flags of a status port.
    #[must_use]
    pub(super) const fn of_bits(bits: u8) -> Self {
        Self(bits)
    }

    /// True when every flag of `other` is set.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// These flags, and `other` where `condition` holds.
    #[inline]
    #[must_use]
    pub const fn with(self, other: Self, condition: bool) -> Self {
        Self(self.0 | if condition { other.0 } else { 0 })
    }

    /// These flags without those of `other`.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> =
            Self::NAMES.iter().filter(|(flag, _)| self.contains(*flag)).map(|&(_, name)| name).collect();
        f.pad(&if names.is_empty() { "-".to_owned() } else { names.join("+") })
    }
}

/// Everything a rank of registers can hold. Which of it a rank *does* hold (and so costs flip-flops)
/// is said by [`super::Datapath::registers`]; the rest keeps the value of an earlier rank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Signals {
    /// ROM address as given.
    pub address: u32,
    /// x: as given in the first rank, clamped to [0, 1] from the front end on.
    pub x: i64,
    /// The row at the address; the first row where there is none.
    pub row: Row,
    /// Flags raised so far.
    pub status: Status,
    /// The part that answers.
    pub region: Region,
    /// The polynomial's variable, x or u.
    pub v: i64,
    /// The results of the stages: t1 first; the last of the polynomial's is in the output's unit.
    pub t: [i64; MAX_DEGREE],
    /// The divider's x: x where the tail answers, else 0.
    pub tail_x: i64,
    /// The division under way.
    pub division: Division<i64>,
    /// The pipeline's answer, bits in the output format.
    pub intensity: i64,
    /// How far x lies below the start of each segment, where a rank has it.
    pub distance: [i64; MAX_SEGMENTS],
    /// The further segments below whose hand-over x lies, a bit each, where a rank has it.
    pub beyond: i64,
    /// The products of the multiply-adds, the divisor's first, where a rank has them.
    pub product: [i64; MAX_DEGREE + 1],
    /// The products of pieces of their operands, where a rank has them.
    pub partial: [[i64; PARTIALS]; MAX_DEGREE + 1],
    /// Their sums before they are rounded, where a rank has them.
    pub sum: [i64; MAX_DEGREE + 1],
}

impl Signals {
    /// The bits of a register. Of a coefficient: that of the first segment, in whose place from the front end on the
    /// one that answers stands.
    #[must_use]
    pub fn get(&self, register: Register) -> i64 {
        match register {
            Register::X => self.x,
            Register::V => self.v,
            Register::T(stage) => self.t.get(stage.wrapping_sub(1)).copied().unwrap_or_default(),
            Register::TailX => self.tail_x,
            Register::Divisor => self.division.divisor,
            Register::Remainder => self.division.remainder,
            Register::Digits => self.division.digits,
            Register::Region => self.region as i64,
            Register::Status => self.status.bits().into(),
            Register::Intensity => self.intensity,
            Register::Product(line) => self.product[line],
            Register::Sum(line) => self.sum[line],
            Register::Partial(line, part) => self.partial[line][part],
            Register::Distance(segment) => self.distance[segment],
            Register::Beyond => self.beyond,
            field => self.row.get(field),
        }
    }
}

/// A register of a rank.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct RankRegister {
    /// Which register.
    pub register: Register,
    /// Its format.
    pub format: QFormat,
    /// True in the rank that computes the value, false where it is only carried along.
    pub computed: bool,
}

impl RankRegister {
    /// Its name in traces, waves, vectors and RTL.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.register.name()
    }

    /// Its bits.
    #[must_use]
    pub fn bits(&self, signals: &Signals) -> i64 {
        signals.get(self.register)
    }
}

impl fmt::Debug for RankRegister {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.register, self.format)
    }
}
