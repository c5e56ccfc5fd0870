//! The formats of every register of a data path.

use crate::format::QFormat;
use crate::registers::{MAX_DEGREE, Register};

/// The formats of the polynomial's registers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PolynomialFormats {
    /// The variable, x or u.
    pub v: QFormat,
    degree: usize,
    coefficients: [QFormat; MAX_DEGREE + 1],
    t: [QFormat; MAX_DEGREE],
}

impl PolynomialFormats {
    /// The formats of v, of c0, c1, …, and of t1, t2, …: as many of these as the degree, 1 to 4, says. Those that the
    /// lists do not have are v's.
    #[must_use]
    pub fn new(v: QFormat, coefficients: &[QFormat], t: &[QFormat]) -> Self {
        let at = |list: &[QFormat], index: usize| list.get(index).copied().unwrap_or(v);
        Self {
            v,
            degree: t.len().clamp(1, MAX_DEGREE),
            coefficients: std::array::from_fn(|power| at(coefficients, power)),
            t: std::array::from_fn(|stage| at(t, stage)),
        }
    }

    /// Of c0, c1, … up to the degree.
    #[must_use]
    pub fn coefficients(&self) -> &[QFormat] {
        &self.coefficients[..=self.degree]
    }

    /// Of t1, t2, …: the results of the stages. The last is in the output's unit.
    #[must_use]
    pub fn t(&self) -> &[QFormat] {
        &self.t[..self.degree]
    }

    /// Of the last stage's result.
    #[must_use]
    pub const fn last(&self) -> QFormat {
        self.t[self.degree - 1]
    }

    /// The number of stages.
    #[must_use]
    pub const fn degree(&self) -> usize {
        self.degree
    }

    /// Of stage j (1 is the first): what it multiplies by v.
    #[must_use]
    pub fn multiplicand(&self, stage: usize) -> QFormat {
        match stage {
            0 | 1 => self.coefficients[self.degree],
            _ => self.t[(stage - 2).min(MAX_DEGREE - 1)],
        }
    }

    /// Of stage j (1 is the first): what it adds the product to.
    #[must_use]
    pub fn addend(&self, stage: usize) -> QFormat {
        self.coefficients[self.degree.saturating_sub(stage)]
    }
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
    /// Where a segment hands over, where there is another; the same for all.
    pub hand_over: Option<QFormat>,
}

impl Formats {
    /// The format of a register that the configuration's budget, or its input and output, decide; none of one that the
    /// configuration does not have, and of the counts and codes, whose widths follow from other things.
    #[must_use]
    pub fn get(&self, register: Register) -> Option<QFormat> {
        let polynomial = self.polynomial.as_ref();
        let tail = self.tail.as_ref();
        match register {
            Register::C(_, power) => polynomial?.coefficients().get(power).copied(),
            Register::T(stage) => polynomial?.t().get(stage.checked_sub(1)?).copied(),
            Register::V => polynomial.map(|p| p.v),
            Register::Cut => self.cut,
            Register::HandOver(_) => self.hand_over,
            Register::TailA => tail.map(|t| t.a),
            Register::TailB => tail.map(|t| t.b),
            Register::Divisor | Register::Remainder => tail.map(|t| t.divisor),
            Register::Digits => tail.map(|t| t.digits),
            Register::X => Some(self.input),
            Register::Intensity => Some(self.output),
            Register::Shift(_) | Register::TailX | Register::Region | Register::Status => None,
            Register::Product(_)
            | Register::Sum(_)
            | Register::Distance(_)
            | Register::Beyond
            | Register::Partial(..) => None,
        }
    }
}
