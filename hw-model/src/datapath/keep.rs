//! What a register keeps of the value that its logic gives it: as many low bits as it is wide.
//!
//! The data path never needs this, because the width analysis sized its registers for every value that
//! can come. Hardware with a wrong ROM row, line or register has no such promise: there, what does not
//! fit wraps, as it does in RTL.

use crate::format::QFormat;
use crate::registers::{MAX_DEGREE, Register};
use crate::rounding::Lane;

use super::parts::Datapath;

/// A register that keeps less than it should.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Damage {
    /// The rank it stands in, counted from 0.
    pub rank: usize,
    /// Which register.
    pub register: Register,
    /// What it keeps: a format of fewer bits, or its own.
    pub format: QFormat,
    /// True when its lowest bit is always 0.
    pub low_bit_stuck: bool,
}

/// A way to keep a value.
pub(super) trait Keep<L>: Copy {
    /// True when nothing is ever lost.
    const WHOLE: bool;
    fn keep(self, value: L) -> L;
}

/// The way to keep a value whole, as the data path does.
#[derive(Clone, Copy)]
pub(super) struct Whole;

impl<L> Keep<L> for Whole {
    const WHOLE: bool = true;
    #[inline(always)]
    fn keep(self, value: L) -> L {
        value
    }
}

/// The bits of a format, the highest of them the sign where it has one.
#[derive(Clone, Copy)]
pub(super) struct Trimmed<L> {
    /// Lifts the format's least value to 0, so that one mask serves both signs.
    lift: L,
    width: L,
    /// All ones, or all but the lowest.
    stuck: L,
}

impl<L: Lane> Trimmed<L> {
    fn to(format: QFormat) -> Self {
        let half = L::ONE << (format.width() - 1);
        let lift = -L::from_bits(format.min_bits());
        Self { lift, width: half + (half - L::ONE), stuck: -L::ONE }
    }
}

impl<L: Lane> Keep<L> for Trimmed<L> {
    const WHOLE: bool = false;
    #[inline(always)]
    fn keep(self, value: L) -> L {
        (((value + self.lift) & self.width) - self.lift) & self.stuck
    }
}

/// How each register keeps its value.
#[derive(Clone, Copy)]
pub(super) struct Registers<K> {
    pub v: K,
    /// Of the stages, the first first.
    pub t: [K; MAX_DEGREE],
    pub tail_x: K,
    pub divisor: K,
    pub remainder: K,
    pub digits: K,
    /// The one stage of the divider whose remainder and digits are kept otherwise; stage 0 begins
    /// the division.
    pub stage: Option<(usize, K, K)>,
}

impl Registers<Whole> {
    pub const WHOLE: Self = Self {
        v: Whole,
        t: [Whole; MAX_DEGREE],
        tail_x: Whole,
        divisor: Whole,
        remainder: Whole,
        digits: Whole,
        stage: None,
    };
}

impl<K: Copy> Registers<K> {
    /// What is kept of the remainder and of the digits behind a stage of the divider.
    #[inline(always)]
    pub fn behind_stage(&self, index: usize) -> (K, K) {
        match self.stage {
            Some((stage, remainder, digits)) if stage == index => (remainder, digits),
            _ => (self.remainder, self.digits),
        }
    }
}

impl<L: Lane> Registers<Trimmed<L>> {
    /// The registers of a data path. Those of a part that is not there are never asked.
    pub fn trimmed(datapath: &Datapath, damage: Option<&Damage>) -> Self {
        let formats = &datapath.formats;
        let of = |register| Trimmed::to(formats.get(register).unwrap_or(formats.output));
        let registers = Self {
            v: of(Register::V),
            t: std::array::from_fn(|stage| of(Register::T(stage + 1))),
            tail_x: of(Register::X),
            divisor: of(Register::Divisor),
            remainder: of(Register::Remainder),
            digits: of(Register::Digits),
            stage: None,
        };
        damage.map_or(registers, |damage| registers.damaged(damage, datapath.rank_of(Register::Divisor)))
    }

    /// `first` is the divisor's rank.
    fn damaged(mut self, damage: &Damage, first: usize) -> Self {
        let mut kept = Trimmed::to(damage.format);
        if damage.low_bit_stuck {
            kept.stuck = -(L::ONE + L::ONE);
        }
        let stage = damage.rank.saturating_sub(first);
        match damage.register {
            Register::V => self.v = kept,
            Register::T(stage @ 1..=MAX_DEGREE) => self.t[stage - 1] = kept,
            Register::TailX => self.tail_x = kept,
            Register::Divisor => self.divisor = kept,
            Register::Remainder => self.stage = Some((stage, kept, self.digits)),
            Register::Digits => self.stage = Some((stage, self.remainder, kept)),
            _ => {}
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_what_a_word_of_the_format_holds() {
        for text in ["UQ3.2", "Q3.2", "UQ1.0", "Q1.0"] {
            let format: QFormat = text.parse().unwrap();
            for value in -200_i64..200 {
                let wanted = format.from_word(value as u64);
                assert_eq!(Trimmed::<i64>::to(format).keep(value), wanted, "{text} {value}");
                let wide = Trimmed::<i128>::to(format).keep(value.into());
                assert_eq!(wide, i128::from(wanted), "{text} {value}");
            }
        }
    }
}
