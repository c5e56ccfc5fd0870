//! The registers of a data path: the one vocabulary of names.
//!
//! A register is named once, here. Its name in configurations, traces, waves, columns, RTL and documents, its place
//! in the order of a ROM word, and whether a multiplier reads it follow from that. The polynomial of segment `k` has
//! the degree d and Horner's chain of d stages:
//!
//! ```text
//! t1 = c(d−1) ± c(d)·v,   t2 = c(d−2) ± t1·v,   …   t(d) = c0 ± t(d−1)·v
//! ```
//!
//! | register                  | what it holds                                                  | in the ROM |
//! |---------------------------|----------------------------------------------------------------|------------|
//! | `C(k, i)`                 | coefficient of v^i of segment k                                 | yes        |
//! | `Cut`                     | the least x at which a polynomial answers                       | yes        |
//! | `HandOver(k)`, k ≥ 1      | the least x of segment k − 1, from which v of segment k counts  | yes        |
//! | `Shift(k)`                | the places by which the distance to x is moved up to become v   | yes        |
//! | `TailA`, `TailB`          | A and B of the tail x / (A − B·x)                               | yes        |
//! | `X`, `V`, `T(j)`          | the input, the variable, the result of stage j                  |            |
//! | `TailX`, `Divisor`, `Remainder`, `Digits` | the division                                    |            |
//! | `Region`, `Status`, `Intensity` | which part answers, the flags, the answer                 |            |
//! | `Product(j)`, `Sum(j)`    | product and sum of stage j, of the divisor for j = 0            |            |
//! | `Partial(j, i)`           | the product of two pieces of the operands of stage j            |            |
//! | `Distance(k)`, `Beyond`   | how far x lies below the start of segment k; whether it does    |            |
//!
//! The last five stand only in a pipeline that has ranks for them ([`crate::pipelining`]).
//!
//! Segments count from x = 1 downwards: segment 0 begins at 1. Names of segment 0 have no suffix (`c3`, `shift`), those
//! of segment 1 `_outer` (`c3_outer`, `shift_outer`; its `HandOver` is `hand_over`), those of segment k ≥ 2 `_outer`
//! with the number (`c3_outer2`, `shift_outer2`, `hand_over2`).

use std::fmt;
use std::ops::{Index, IndexMut};

/// The greatest degree of a polynomial, and so the most multiply-add stages.
pub const MAX_DEGREE: usize = 4;
/// The most segments of a row.
pub const MAX_SEGMENTS: usize = 8;
/// The degree of \[Rom\]'s polynomials, and of a configuration that does not say otherwise.
pub const CUBIC: usize = 3;

/// One register, by what it holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Register {
    /// Coefficient of v^i of segment k: `C(k, i)`, k < [`MAX_SEGMENTS`], i ≤ [`MAX_DEGREE`].
    C(usize, usize),
    /// The least x at which a polynomial answers.
    Cut,
    /// The places by which s = 1 − x (in segment k: hand-over − x) is moved up to become v.
    Shift(usize),
    /// A of the tail x / (A − B·x).
    TailA,
    /// B of the tail.
    TailB,
    /// The least x of segment k − 1, from which v counts in segment k ≥ 1.
    HandOver(usize),
    /// x, as it was given.
    X,
    /// The variable of the polynomial: x in the power form, u in the centred form.
    V,
    /// The result of stage j, 1 ≤ j ≤ [`MAX_DEGREE`].
    T(usize),
    /// The divider's x.
    TailX,
    /// D = A − B·x.
    Divisor,
    /// The remainder of the division, less than D.
    Remainder,
    /// Quotient bits found, and dividend bits to come.
    Digits,
    /// The part that answers.
    Region,
    /// The flags.
    Status,
    /// The answer.
    Intensity,
    /// The product of stage j, whole; of the divisor for j = 0.
    Product(usize),
    /// The sum of stage j before it is rounded; of the divisor for j = 0.
    Sum(usize),
    /// 1 − x, or for segment k ≥ 1 hand-over − x.
    Distance(usize),
    /// For each further segment whether x lies below its hand-over: bit k − 1 for segment k.
    Beyond,
    /// A product of pieces of the operands of stage j, of the divisor for j = 0: of the lower piece of the multiplicand
    /// for i < 2, and of the lower one of the variable for even i.
    Partial(usize, usize),
}

/// Registers of segment 0 in the ROM: c4 to c0, cut, shift, A and B.
const FIRST: usize = MAX_DEGREE + 1 + 4;
/// Registers of a further segment in the ROM: hand-over, shift, c4 to c0.
const FURTHER: usize = MAX_DEGREE + 1 + 2;

macro_rules! of_segments {
    ($first:literal, $stem:literal) => {
        [
            $first,
            $stem,
            concat!($stem, "2"),
            concat!($stem, "3"),
            concat!($stem, "4"),
            concat!($stem, "5"),
            concat!($stem, "6"),
            concat!($stem, "7"),
        ]
    };
}

/// By power, then by segment.
const C: [[&str; MAX_SEGMENTS]; MAX_DEGREE + 1] = [
    of_segments!("c0", "c0_outer"),
    of_segments!("c1", "c1_outer"),
    of_segments!("c2", "c2_outer"),
    of_segments!("c3", "c3_outer"),
    of_segments!("c4", "c4_outer"),
];
const SHIFT: [&str; MAX_SEGMENTS] = of_segments!("shift", "shift_outer");
/// Segment 0 begins at x = 1, which no register holds.
const HAND_OVER: [&str; MAX_SEGMENTS] = of_segments!("one", "hand_over");
const T: [&str; MAX_DEGREE + 1] = ["t0", "t1", "t2", "t3", "t4"];
const PRODUCT: [&str; MAX_DEGREE + 1] = ["divisor_product", "product1", "product2", "product3", "product4"];
const SUM: [&str; MAX_DEGREE + 1] = ["divisor_sum", "sum1", "sum2", "sum3", "sum4"];
/// Products of pieces: two of either operand.
pub const PARTIALS: usize = 4;
/// By line, the divisor's first.
const PARTIAL: [[&str; PARTIALS]; MAX_DEGREE + 1] = [
    ["divisor_partial0", "divisor_partial1", "divisor_partial2", "divisor_partial3"],
    ["partial1_0", "partial1_1", "partial1_2", "partial1_3"],
    ["partial2_0", "partial2_1", "partial2_2", "partial2_3"],
    ["partial3_0", "partial3_1", "partial3_2", "partial3_3"],
    ["partial4_0", "partial4_1", "partial4_2", "partial4_3"],
];
const DISTANCE: [&str; MAX_SEGMENTS] = of_segments!("distance", "distance_outer");
/// Registers of the least pipeline.
const LEAST: usize = Register::ROM_COUNT + MAX_DEGREE + 9;

impl Register {
    /// How many registers a ROM word can have.
    pub const ROM_COUNT: usize = FIRST + (MAX_SEGMENTS - 1) * FURTHER;
    /// How many registers there are.
    pub const COUNT: usize = LEAST + (2 + PARTIALS) * (MAX_DEGREE + 1) + MAX_SEGMENTS + 1;

    /// Every register of the ROM, in the order in which they are packed into a word from bit 0 up.
    pub fn in_rom() -> impl Iterator<Item = Self> {
        let first = [Self::Cut, Self::Shift(0), Self::TailA, Self::TailB];
        let coefficients = |k| (0..=MAX_DEGREE).rev().map(move |power| Self::C(k, power));
        let further = move |k| [Self::HandOver(k), Self::Shift(k)].into_iter().chain(coefficients(k));
        coefficients(0).chain(first).chain((1..MAX_SEGMENTS).flat_map(further))
    }

    /// Every register.
    pub fn all() -> impl Iterator<Item = Self> {
        let stages = (1..=MAX_DEGREE).map(Self::T);
        let division = [Self::TailX, Self::Divisor, Self::Remainder, Self::Digits];
        let last = [Self::Region, Self::Status, Self::Intensity];
        let least = Self::in_rom().chain([Self::X, Self::V]).chain(stages).chain(division).chain(last);
        let lines = || 0..=MAX_DEGREE;
        let further = lines().map(Self::Product).chain(lines().map(Self::Sum));
        let partials = lines().flat_map(|line| (0..PARTIALS).map(move |part| Self::Partial(line, part)));
        least.chain(further).chain((0..MAX_SEGMENTS).map(Self::Distance)).chain([Self::Beyond]).chain(partials)
    }

    /// Its place in [`Register::all`].
    #[inline(always)]
    #[must_use]
    pub const fn index(self) -> usize {
        match self {
            Self::C(0, power) => MAX_DEGREE - power,
            Self::Cut => MAX_DEGREE + 1,
            Self::Shift(0) => MAX_DEGREE + 2,
            Self::TailA => MAX_DEGREE + 3,
            Self::TailB => MAX_DEGREE + 4,
            Self::HandOver(segment) => Self::of_further(segment),
            Self::Shift(segment) => Self::of_further(segment) + 1,
            Self::C(segment, power) => Self::of_further(segment) + 2 + MAX_DEGREE - power,
            Self::X => Self::ROM_COUNT,
            Self::V => Self::ROM_COUNT + 1,
            Self::T(stage) => Self::ROM_COUNT + 1 + stage,
            Self::TailX => Self::ROM_COUNT + MAX_DEGREE + 2,
            Self::Divisor => Self::ROM_COUNT + MAX_DEGREE + 3,
            Self::Remainder => Self::ROM_COUNT + MAX_DEGREE + 4,
            Self::Digits => Self::ROM_COUNT + MAX_DEGREE + 5,
            Self::Region => Self::ROM_COUNT + MAX_DEGREE + 6,
            Self::Status => Self::ROM_COUNT + MAX_DEGREE + 7,
            Self::Intensity => Self::ROM_COUNT + MAX_DEGREE + 8,
            Self::Product(line) => LEAST + line,
            Self::Sum(line) => LEAST + MAX_DEGREE + 1 + line,
            Self::Distance(segment) => LEAST + 2 * (MAX_DEGREE + 1) + segment,
            Self::Beyond => LEAST + 2 * (MAX_DEGREE + 1) + MAX_SEGMENTS,
            Self::Partial(line, part) => LEAST + 2 * (MAX_DEGREE + 1) + MAX_SEGMENTS + 1 + PARTIALS * line + part,
        }
    }

    /// Where the registers of a segment begin among those of the ROM. `HandOver(0)`, which no hardware has, shares the
    /// place of `HandOver(1)`.
    #[inline(always)]
    const fn of_further(segment: usize) -> usize {
        FIRST + segment.saturating_sub(1) * FURTHER
    }

    /// The name in traces, waves, columns, RTL and documents.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::C(segment, power) => C[power][segment],
            Self::Cut => "cut",
            Self::Shift(segment) => SHIFT[segment],
            Self::TailA => "tail_a",
            Self::TailB => "tail_b",
            Self::HandOver(segment) => HAND_OVER[segment],
            Self::X => "x",
            Self::V => "v",
            Self::T(stage) => T[stage],
            Self::TailX => "tail_x",
            Self::Divisor => "divisor",
            Self::Remainder => "remainder",
            Self::Digits => "digits",
            Self::Region => "region",
            Self::Status => "status",
            Self::Intensity => "intensity",
            Self::Product(line) => PRODUCT[line],
            Self::Sum(line) => SUM[line],
            Self::Distance(segment) => DISTANCE[segment],
            Self::Beyond => "beyond",
            Self::Partial(line, part) => PARTIAL[line][part],
        }
    }

    /// The register of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|register| register.name() == name)
    }

    /// True for what a ROM word can hold.
    #[must_use]
    pub const fn is_in_rom(self) -> bool {
        self.index() < Self::ROM_COUNT
    }

    /// The register that stands for this one where all segments have the same: a format is that of
    /// every segment's.
    #[must_use]
    pub const fn of_any_segment(self) -> Self {
        match self {
            Self::C(_, power) => Self::C(0, power),
            Self::HandOver(_) => Self::HandOver(1),
            other => other,
        }
    }
}

impl fmt::Display for Register {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A value for each register.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Table<T> {
    values: [T; Register::COUNT],
}

impl<T: Copy + Default> Default for Table<T> {
    fn default() -> Self {
        Self { values: [T::default(); Register::COUNT] }
    }
}

impl<T> Index<Register> for Table<T> {
    type Output = T;
    #[inline(always)]
    fn index(&self, register: Register) -> &T {
        &self.values[register.index()]
    }
}

impl<T> IndexMut<Register> for Table<T> {
    #[inline(always)]
    fn index_mut(&mut self, register: Register) -> &mut T {
        &mut self.values[register.index()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_register_has_a_place_and_a_name_of_its_own() {
        let all: Vec<Register> = Register::all().collect();
        assert_eq!(all.len(), Register::COUNT);
        for (place, &register) in all.iter().enumerate() {
            assert_eq!(register.index(), place, "{register}");
            assert_eq!(Register::named(register.name()), Some(register));
            assert_eq!(register.is_in_rom(), place < Register::ROM_COUNT);
        }
        let names: HashSet<&str> = all.iter().map(|register| register.name()).collect();
        assert_eq!(names.len(), all.len());
        assert_eq!(Register::named("one"), None);
    }

    /// Configurations, columns, RTL and documents of the first release have these names.
    #[test]
    fn registers_of_two_segments_have_their_names() {
        let names = |registers: &[Register]| registers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
        let inner: Vec<Register> = (0..=3).map(|power| Register::C(0, power)).collect();
        let outer: Vec<Register> = (0..=3).map(|power| Register::C(1, power)).collect();
        assert_eq!(names(&inner), "c0 c1 c2 c3");
        assert_eq!(names(&outer), "c0_outer c1_outer c2_outer c3_outer");
        let others = [Register::HandOver(1), Register::Shift(0), Register::Shift(1)];
        assert_eq!(names(&others), "hand_over shift shift_outer");
        let third = [Register::C(2, 4), Register::HandOver(2), Register::Shift(2)];
        assert_eq!(names(&third), "c4_outer2 hand_over2 shift_outer2");
        assert_eq!(format!("{:>7}", Register::TailA), " tail_a");
    }
}
