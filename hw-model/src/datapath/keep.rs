//! What a register keeps of the value that its logic gives it: as many low bits as it is wide.
//!
//! The data path never needs this, because the width analysis sized its registers for every value that
//! can come. Hardware with a wrong ROM row or a wrong line has no such promise: there, what does not
//! fit wraps, as it does in RTL.

use crate::format::QFormat;
use crate::rounding::Lane;

use super::formats::Formats;

/// A way to keep a value.
pub(super) trait Keep<L>: Copy {
    /// True when nothing is ever lost.
    const WHOLE: bool;
    fn keep(self, value: L) -> L;
}

/// All of it.
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
    mask: L,
}

impl<L: Lane> Trimmed<L> {
    fn to(format: QFormat) -> Self {
        let mask = (L::ONE << (format.width() - 1)) + ((L::ONE << (format.width() - 1)) - L::ONE);
        Self { lift: -L::from_bits(format.min_bits()), mask }
    }
}

impl<L: Lane> Keep<L> for Trimmed<L> {
    const WHOLE: bool = false;
    #[inline(always)]
    fn keep(self, value: L) -> L {
        ((value + self.lift) & self.mask) - self.lift
    }
}

/// How each register keeps its value.
#[derive(Clone, Copy)]
pub(super) struct Registers<K> {
    pub v: K,
    pub t: [K; 3],
    /// Of the divisor and of every remainder.
    pub divisor: K,
}

impl Registers<Whole> {
    pub const WHOLE: Self = Self { v: Whole, t: [Whole; 3], divisor: Whole };
}

impl<L: Lane> Registers<Trimmed<L>> {
    /// The registers of these formats. Those of a part that is not there are never asked.
    pub fn trimmed(formats: &Formats) -> Self {
        let any = formats.output;
        let [v, t1, t2, t3] = formats.polynomial.map_or([any; 4], |p| [p.v, p.t1, p.t2, p.t3]);
        let divisor = formats.tail.map_or(any, |tail| tail.divisor);
        Self { v: Trimmed::to(v), t: [t1, t2, t3].map(Trimmed::to), divisor: Trimmed::to(divisor) }
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
                assert_eq!(wide, wanted.into(), "{text} {value}");
            }
        }
    }
}
