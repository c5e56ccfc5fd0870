//! The front end: which part answers, and the variable the polynomial is evaluated in.
//!
//! x clamps to [0, 1]. Against the row's cut it falls into a region:
//!
//! | region       | when                                        | intensity             |
//! |--------------|---------------------------------------------|-----------------------|
//! | `polynomial` | x ≥ cut                                     | the stages            |
//! | `tail`       | 0 ≤ x < cut, configuration keeps a divider  | the divider           |
//! | `zero`       | 0 ≤ x < cut without one; x < 0; no ROM word | 0                     |
//!
//! In a configuration with a domain ([`crate::domain`]) the cut is the least x of it, and an x from 0 up to there is
//! refused: the intensity is zero and the status says so.
//!
//! With several segments, the last answers from `cut` up to its hand-over, the one before from there up to its own, and
//! so on: each has coefficients and a shift of its own, and v = (hand-over − x)·2^shift counts from where the one
//! before hands over. From the front end on the coefficients of the segment that answers stand in the places of the
//! first's.
//!
//! A part that does not answer is fed a harmless x, so that what was proved about the ranges of its
//! registers holds for every input: the polynomial gets u = 0, or x = 1 (the greatest x, where the format
//! does not reach 1), which the ranges of every row include, and the divider x = 0.
//!
//! Cut and hand-over may have fewer fraction bits than x; zeros below their last place bring them to the unit of x.
//!
//! Widths: s = 1 − x needs no more bits than x. u = s·2^e is at most (1 − cut)·2^e, a little above 1 (with
//! fitted shifts below 1 in both segments; more where a coarse cut was rounded far down); it is rounded once to u's
//! fraction bits (nothing is dropped where u has as many as x).

use crate::registers::Register;
use crate::rom::Fetched;
use crate::rounding::{Lane, Rounding, round_shift};

/// The part of the pipeline that answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[repr(u8)]
pub enum Region {
    /// The intensity is zero: facing away, below the cut without a tail, or no ROM word.
    #[default]
    Zero = 0,
    /// The polynomial answers: x is at or above the cut.
    Polynomial = 1,
    /// The divider answers: x is below the cut and the configuration keeps a tail.
    Tail = 2,
}

impl Region {
    /// The name used in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Zero => "zero",
            Self::Polynomial => "polynomial",
            Self::Tail => "tail",
        }
    }
}

/// The two variables a polynomial can be evaluated in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// v = x: the power form.
    X,
    /// v = u = (1 − x)·2^e: the centred form.
    ///
    /// In a further segment (hand-over − x)·2^shift.
    U {
        /// Places s is moved up, beyond e, to meet u's fraction bits.
        up: u32,
        /// Fraction bits dropped from s·2^e.
        drop: u32,
        /// How they are dropped.
        rounding: Rounding,
    },
}

/// The front end of one configuration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrontEnd {
    /// 1 in the input's unit, or the greatest x of an input format that does not reach 1.
    pub greatest: i64,
    /// 1 in the input's unit.
    pub one: i64,
    /// The polynomial's variable; none where the divider answers everywhere.
    pub variable: Option<Variable>,
    /// True when the configuration keeps a divider.
    pub tail: bool,
    /// True where the configuration has a domain: no x below the cut is presented.
    pub guarded: bool,
    /// Places that the ROM's cut is moved up, to the input's last: it may have fewer bits than x.
    pub cut_up: u32,
    /// The same of the hand-overs.
    pub hand_over_up: u32,
    /// Segments of the polynomial; 1 where there is none.
    pub segments: usize,
}

impl FrontEnd {
    /// How u is rounded; none where there is no u.
    #[must_use]
    pub const fn rounding(&self) -> Option<Rounding> {
        match self.variable {
            Some(Variable::U { rounding, .. }) => Some(rounding),
            Some(Variable::X) | None => None,
        }
    }

    /// The same front end, u rounded by `mode`.
    #[inline(always)]
    #[must_use]
    pub const fn rounded_by(self, mode: Rounding) -> Self {
        let variable = match self.variable {
            Some(Variable::U { up, drop, .. }) => Some(Variable::U { up, drop, rounding: mode }),
            other => other,
        };
        Self { variable, ..self }
    }

    /// True unless the polynomial's variable is x: the power form.
    #[must_use]
    pub const fn is_centred(&self) -> bool {
        !matches!(self.variable, Some(Variable::X))
    }

    /// True unless the variable is u with no bits dropped.
    #[must_use]
    pub const fn is_plain(&self) -> bool {
        !matches!(self.variable, Some(Variable::U { drop: 0, .. }))
    }

    /// The same plain front end, u rounded by `mode`, with all that the compiler may know of it: it leaves no
    /// choice in a loop.
    #[inline(always)]
    #[must_use]
    pub const fn known_plain(self, centred: bool, mode: Rounding) -> Self {
        let (up, drop) = match self.variable {
            Some(Variable::U { up, drop, .. }) if drop > 0 => (up, drop),
            _ => (0, 1),
        };
        let variable = if centred { Variable::U { up, drop, rounding: mode } } else { Variable::X };
        Self { variable: Some(variable), ..self }
    }

    /// The cut of a row, in the input's unit. At most 63 bits: what a ROM field with x's fraction bits holds.
    #[inline(always)]
    #[must_use]
    pub fn cut(&self, row: &impl Fetched) -> i64 {
        row.get(Register::Cut) << self.cut_up
    }

    /// Where segment k ≥ 1 of a row begins, in the input's unit; as wide as the cut. 0 in a row without that segment.
    #[inline(always)]
    #[must_use]
    pub fn hand_over(&self, row: &impl Fetched, segment: usize) -> i64 {
        row.get(Register::HandOver(segment)) << self.hand_over_up
    }

    /// Where a segment of a row begins, in the input's unit: at 1, or at its hand-over.
    #[inline(always)]
    #[must_use]
    pub fn start(&self, row: &impl Fetched, segment: usize) -> i64 {
        if segment == 0 { self.one } else { self.hand_over(row, segment) }
    }

    /// x clamped to [0, 1].
    #[inline(always)]
    pub fn clamp_input<L: Lane>(&self, x: L) -> L {
        x.max(L::ZERO).min(L::from_bits(self.greatest))
    }

    /// The region of x (not clamped: its sign matters) in a row with this cut.
    #[inline(always)]
    pub fn region<L: Lane>(&self, x: L, cut: L) -> Region {
        if x < L::ZERO {
            Region::Zero
        } else if self.variable.is_some() && x >= cut {
            Region::Polynomial
        } else if self.tail {
            Region::Tail
        } else {
            Region::Zero
        }
    }

    /// Whether x (not clamped) lies outside the domain of a row that there is.
    #[inline(always)]
    pub fn outside<L: Lane>(&self, x: L, region: Region) -> bool {
        self.guarded && region == Region::Zero && x >= L::ZERO
    }

    /// Whether a further segment, or one after it, answers for a clamped x; never where its hand-over is 0.
    #[inline(always)]
    pub fn is_beyond<L: Lane>(&self, x: L, region: Region, hand_over: L) -> bool {
        region == Region::Polynomial && x < hand_over
    }

    /// The segment of a row that answers for a clamped x at or above the cut.
    #[must_use]
    pub fn segment_of(&self, row: &impl Fetched, x: i64) -> usize {
        let beyond = |&k: &usize| self.is_beyond(x, Region::Polynomial, self.hand_over(row, k));
        (1..self.segments).rev().find(beyond).unwrap_or(0)
    }

    /// The polynomial's variable for a clamped x: x itself, or u = (start − x)·2^shift, where start is 1 or
    /// a further segment's. Where the polynomial does not answer, the greatest x, or u = 0.
    #[inline(always)]
    pub fn variable<L: Lane>(&self, x: L, region: Region, start: L, shift: u32) -> L {
        self.variable_at(x, region, start - x, shift)
    }

    /// The same where the distance from x to the start is known; the power form does not look at it.
    #[inline(always)]
    pub(super) fn variable_at<L: Lane>(&self, x: L, region: Region, distance: L, shift: u32) -> L {
        let answers = region == Region::Polynomial;
        match self.variable {
            None => L::ZERO,
            Some(Variable::X) => {
                if answers {
                    x
                } else {
                    L::from_bits(self.greatest)
                }
            }
            Some(Variable::U { up, drop, rounding }) => {
                let s = if answers { distance } else { L::ZERO };
                round_shift(s << (shift + up), drop, rounding)
            }
        }
    }

    /// The divider's x: a clamped x where the tail answers, 0 elsewhere.
    #[inline(always)]
    pub fn tail_x<L: Lane>(&self, x: L, region: Region) -> L {
        if region == Region::Tail { x } else { L::ZERO }
    }
}
