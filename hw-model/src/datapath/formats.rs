//! The formats of every register of a data path.

use crate::format::QFormat;

/// The formats of the polynomial's registers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PolynomialFormats {
    /// The variable, x or u.
    pub v: QFormat,
    /// c0, c1, c2, c3.
    pub coefficients: [QFormat; 4],
    /// Of t1, the result of stage 1.
    pub t1: QFormat,
    /// Of t2, the result of stage 2.
    pub t2: QFormat,
    /// After stage 3, in the output's unit.
    pub t3: QFormat,
}

/// The formats of the divider's registers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TailFormats {
    /// Of A, the addend of the divisor D = A − B·x.
    pub a: QFormat,
    /// Of B, the multiplicand of the divisor D = A − B·x.
    pub b: QFormat,
    /// D = A − B·x, and every remainder.
    pub divisor: QFormat,
    /// Quotient bits and dividend bits to come.
    pub digits: QFormat,
}

/// The formats of every register.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Formats {
    /// Of x at the input port.
    pub input: QFormat,
    /// Of the intensity at the output port.
    pub output: QFormat,
    /// The polynomial's, where there is one.
    pub polynomial: Option<PolynomialFormats>,
    /// The divider's, where there is one.
    pub tail: Option<TailFormats>,
    /// The cut, where there is a polynomial.
    pub cut: Option<QFormat>,
    /// The shift count, in the centred form.
    pub shift: Option<QFormat>,
    /// Where the first segment hands over, where there is a second.
    pub hand_over: Option<QFormat>,
    /// The shift count of the second segment.
    pub shift_outer: Option<QFormat>,
}
