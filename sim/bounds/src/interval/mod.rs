//! Interval arithmetic on f64 with outward rounding.
//!
//! An [`Interval`] is a set of reals that is known to hold some real number. Each operation returns a
//! set that holds its result for every choice from the operands. IEEE 754 rounds +, −, ×, ÷ to the
//! nearest f64, so the real result lies between the neighbours of the computed one: one `next_down`
//! below, one `next_up` above. The same holds for `exp`, `expm1` and `log` of `core-math`, which are
//! correctly rounded. (The platform's own are not, and differ between platforms.)
//!
//! What is not known is said: where no finite bound can be given (a divisor that holds zero, 0·∞, the
//! logarithm of a number that may be negative) the result is [`Interval::UNKNOWN`], all reals, which
//! is within no bound.

mod functions;
mod number;
mod slopes;

pub use number::Interval;
pub use slopes::{Real, Slopes};
