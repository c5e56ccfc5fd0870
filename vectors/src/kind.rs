//! Why a case was chosen.

use std::fmt;

/// Why a case was chosen. A case chosen for several reasons keeps the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// It kills faults of its row that its neighbours do not ([`crate::faults`]).
    Target,
    /// x = 1, or the greatest x where the format does not reach 1.
    One,
    /// One ulp below or above 1.
    BesideOne,
    /// x = 0, the least x that is not clamped.
    Zero,
    /// x = 1 ulp.
    BesideZero,
    /// The least x at which the polynomial answers.
    Cut,
    /// One ulp below or above the cut.
    BesideCut,
    /// The least x at which the first of two segments answers.
    HandOver,
    /// One ulp below or above it.
    BesideHandOver,
    /// q, where x^n = Q, or one ulp beside it.
    Q,
    /// The greatest |intensity − x^n| found where the polynomial answers.
    WorstPolynomial,
    /// The greatest |intensity − x^n| found below the cut.
    WorstTail,
    /// The rounding of this register is a tie, or the nearest to one that was found.
    Tie(&'static str),
    /// The least value found of a register: its rank and name.
    Least(usize, &'static str),
    /// The greatest value found of a register: its rank and name.
    Greatest(usize, &'static str),
    /// The greatest x of the tail whose quotient is 0.
    QuotientZero,
    /// The x of the tail with the greatest quotient.
    QuotientGreatest,
    /// An end of the input format, or the least step below 0.
    FormatEnd,
    /// An address without a ROM word.
    NoWord,
    /// A point of the even grid.
    Even,
    /// Drawn at random from the seed.
    Random,
    /// One of all inputs, in order.
    Exhaustive,
    /// One of the user's own list.
    Listed,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self {
            Self::Target => "target",
            Self::One => "one",
            Self::BesideOne => "beside_one",
            Self::Zero => "zero",
            Self::BesideZero => "beside_zero",
            Self::Cut => "cut",
            Self::BesideCut => "beside_cut",
            Self::HandOver => "hand_over",
            Self::BesideHandOver => "beside_hand_over",
            Self::Q => "q",
            Self::WorstPolynomial => "worst_polynomial",
            Self::WorstTail => "worst_tail",
            Self::Tie(register) => return write!(f, "tie:{register}"),
            Self::Least(rank, register) => return write!(f, "least:{rank}.{register}"),
            Self::Greatest(rank, register) => return write!(f, "greatest:{rank}.{register}"),
            Self::QuotientZero => "quotient_zero",
            Self::QuotientGreatest => "quotient_greatest",
            Self::FormatEnd => "format_end",
            Self::NoWord => "no_word",
            Self::Even => "even",
            Self::Random => "random",
            Self::Exhaustive => "exhaustive",
            Self::Listed => "listed",
        };
        f.pad(name)
    }
}
