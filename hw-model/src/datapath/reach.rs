//! The least and the greatest value every register takes, over every ROM row and every representable x.
//!
//! Exact, and quicker than trying every x: the lines are evaluated on whole intervals of x. A line is
//! monotone in each of its operands (rounding is, too), so what it can give for a box of operands lies
//! between what it gives at the corners. An interval that cannot beat the best value found is left
//! alone, another is halved, down to single x, where the corners are one point and the value is exact.

use crate::registers::{MAX_DEGREE, Register};
use crate::rom::Row;
use crate::rounding::Lane;

use super::Datapath;
use super::compose::{Anything, Lines, Segment};
use super::front_end::Region;
use super::tail::Divider;

/// The most intervals that one search looks at, in all or for each row, whichever is more. Where a line is flat, their
/// number is about 2^(bits/2): 24 bits take some thousands for a row, and 62 bits would have no end.
const MOST_INTERVALS: u64 = 1 << 22;
const MOST_OF_ROW: u64 = 1 << 16;

/// A value with the place where it is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Extreme {
    /// The value, as the register's bits.
    pub bits: i64,
    /// The address of the ROM row at which it is taken.
    pub address: u32,
    /// The bits of x; none where it is what the part is fed when it does not answer.
    pub x: Option<i64>,
}

/// The least and the greatest value of a register.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reach {
    /// The least value, and where the register takes it.
    pub least: Extreme,
    /// The greatest value, and where the register takes it.
    pub greatest: Extreme,
}

/// What the registers of the polynomial take.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PolynomialReach {
    /// The values of the polynomial's variable v.
    pub v: Reach,
    /// The results of the stages: t1, t2, …
    pub lines: Vec<Reach>,
}

impl PolynomialReach {
    /// Of the last stage's result.
    #[must_use]
    pub fn last(&self) -> &Reach {
        self.lines.last().unwrap_or(&self.v)
    }
}

/// What the registers of the divider take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TailReach {
    /// The values of the x that the divider is given.
    pub x: Reach,
    /// The values of the divisor D.
    pub divisor: Reach,
    /// The remainder before the first quotient bit. Later ones are less than D, and no more is said.
    pub first_remainder: Reach,
    /// The values of the quotient after its last bit.
    pub quotient: Reach,
}

/// Values that lie side by side, both ends included.
#[derive(Clone, Copy)]
struct Interval<L> {
    low: L,
    high: L,
}

/// v, t1, t2, … for an interval of x.
type Intervals<L> = [Interval<L>; 1 + MAX_DEGREE];

impl Datapath {
    /// What the registers of the polynomial take, where there is one, and where it is found in a time that a caller
    /// waits for.
    #[must_use]
    pub fn polynomial_reach(&self) -> Option<PolynomialReach> {
        let stages = self.degree();
        if stages == 0 {
            return None;
        }
        let reach = |line| {
            if self.narrow { self.line_reach::<i64>(line) } else { self.line_reach::<i128>(line) }
        };
        Some(PolynomialReach { v: reach(0)?, lines: (1..=stages).map(reach).collect::<Option<_>>()? })
    }

    /// True where the last stage's result can pass 1, so that the clamp has something to compare. The range analysis
    /// behind its format has room for errors that need not meet; where a domain is all that is asked, the values
    /// themselves decide.
    #[must_use]
    pub fn last_exceeds_one(&self) -> bool {
        let one = self.output_one;
        let room = self.formats.polynomial.as_ref().is_some_and(|f| f.last().max_bits() > one);
        let reached = || self.polynomial_reach().is_none_or(|r| r.last().greatest.bits > one);
        room && (!self.front_end.guarded || reached())
    }

    fn line_reach<L: Lane>(&self, line: usize) -> Option<Reach> {
        let greatest = self.search(line, |lines: &Interval<L>| lines.high)?;
        let mut least = self.search(line, |lines: &Interval<L>| -lines.low)?;
        least.bits = -least.bits;
        Some(Reach { least, greatest })
    }

    /// The place where `worth` of a line is greatest; none where it is not found.
    fn search<L: Lane>(&self, line: usize, worth: impl Fn(&Interval<L>) -> L) -> Option<Extreme> {
        let mut best: Option<(L, Extreme)> = None;
        let mut open = Vec::new();
        let look = |best: &mut Option<(L, Extreme)>, address: u32, x: Option<i64>| {
            let row = self.row(address);
            let lines = x.map_or_else(|| self.idle(&row), |x| self.lines::<L>(&row, x, x));
            let value = worth(&lines[line]);
            if best.is_none_or(|(most, _)| value > most) {
                *best = Some((value, Extreme { bits: value.to_bits(), address, x }));
            }
        };
        for address in 0..self.rom.depth() as u32 {
            if self.can_be_idle(address) {
                look(&mut best, address, None);
            }
            for (first, last) in self.polynomial_spans(&self.row(address)) {
                look(&mut best, address, Some(first));
                look(&mut best, address, Some(last));
                open.push((address, first, last));
            }
        }
        let mut left = MOST_INTERVALS.max(self.rom.depth() as u64 * MOST_OF_ROW);
        while let Some((address, first, last)) = open.pop() {
            left = left.checked_sub(1)?;
            let most = worth(&self.lines::<L>(&self.row(address), first, last)[line]);
            if last - first > 1 && best.is_none_or(|(best, _)| most > best) {
                let middle = first + (last - first) / 2;
                look(&mut best, address, Some(middle));
                open.push((address, first, middle));
                open.push((address, middle, last));
            }
        }
        best.map(|(_, extreme)| extreme)
    }

    /// True where a row's polynomial has an x for which it does not answer, or, like the first row, is read for
    /// addresses without a word.
    fn can_be_idle(&self, address: u32) -> bool {
        let cut = self.front_end.cut(&self.row(address));
        address == 0 || cut > 0 || self.formats.input.is_signed()
    }

    /// The first and the last x at which each segment of a row answers, as x rises; only of those that do. None where
    /// there is no polynomial.
    #[must_use]
    pub fn polynomial_spans(&self, row: &Row) -> Vec<(i64, i64)> {
        if self.degree() == 0 {
            return Vec::new();
        }
        let (cut, greatest) = (self.front_end.cut(row).max(0), self.front_end.greatest);
        let mut end = greatest;
        let mut spans = Vec::new();
        for segment in 0..self.segment_count() {
            let next = segment + 1;
            let hands_over = next < self.segment_count();
            let least = if hands_over { self.front_end.hand_over(row, next).max(cut) } else { cut };
            spans.push((least, end));
            end = end.min(least - 1);
        }
        spans.into_iter().rev().filter(|(first, last)| first <= last).collect()
    }

    /// What the polynomial is given for x from `first` to `last`, both of one segment, and what its lines
    /// make of it.
    fn lines<L: Lane>(&self, row: &Row, first: i64, last: i64) -> Intervals<L> {
        let index = self.front_end.segment_of(row, first);
        let segment = Lines::of(self).segment::<L, Anything>(row, index);
        let variable = |x| {
            let x = L::from_bits(x);
            self.front_end.variable(x, Region::Polynomial, segment.start, segment.shift)
        };
        self.of_variable(&segment, ordered(variable(first), variable(last)))
    }

    /// The same where the polynomial does not answer.
    fn idle<L: Lane>(&self, row: &Row) -> Intervals<L> {
        let segment = Lines::of(self).segment::<L, Anything>(row, 0);
        let v = self.front_end.variable(L::ZERO, Region::Zero, L::ZERO, segment.shift);
        self.of_variable(&segment, Interval { low: v, high: v })
    }

    fn of_variable<L: Lane>(&self, segment: &Segment<L>, v: Interval<L>) -> Intervals<L> {
        let mut intervals = [v; 1 + MAX_DEGREE];
        let degree = self.degree();
        let highest = segment.c[degree];
        let mut t = Interval { low: highest, high: highest };
        for index in 0..degree {
            let addend = segment.c[degree - 1 - index];
            let at = |t, v| Lines::of(self).stage(index, t, v, addend);
            let first = ordered(at(t.low, v.low), at(t.low, v.high));
            let second = ordered(at(t.high, v.low), at(t.high, v.high));
            t = Interval { low: first.low.min(second.low), high: first.high.max(second.high) };
            intervals[index + 1] = t;
        }
        intervals
    }

    /// What the registers of the divider take, where there is one. They all rise or fall with x, so
    /// that the ends of each row's tail say all; the divider is given 0 where it does not answer.
    #[must_use]
    pub fn tail_reach(&self) -> Option<TailReach> {
        let divider = self.divider?;
        let mut found: Option<TailReach> = None;
        for address in 0..self.rom.depth() as u32 {
            let row = self.row(address);
            for x in [0, self.last_of_tail(&row)] {
                let here =
                    if self.narrow { at_end::<i64>(&divider, &row, x) } else { at_end::<i128>(&divider, &row, x) };
                let here = here.map(|bits| {
                    let extreme = Extreme { bits, address, x: Some(x) };
                    Reach { least: extreme, greatest: extreme }
                });
                let [x, divisor, first_remainder, quotient] = here;
                let here = TailReach { x, divisor, first_remainder, quotient };
                found = Some(found.map_or(here, |found| found.with(&here)));
            }
        }
        found
    }

    /// The last x at which the tail of a row answers; 0 where it never does.
    fn last_of_tail(&self, row: &Row) -> i64 {
        let greatest = self.front_end.greatest;
        match self.front_end.variable {
            Some(_) => (self.front_end.cut(row) - 1).clamp(0, greatest),
            None => greatest,
        }
    }
}

/// x, D, the first remainder and the finished quotient.
fn at_end<L: Lane>(divider: &Divider, row: &Row, x: i64) -> [i64; 4] {
    let bits = |field| L::from_bits(row.get(field));
    let begun = divider.begin(L::from_bits(x), bits(Register::TailA), bits(Register::TailB));
    let stages = 0..divider.digit_stages();
    let ended = stages.fold(begun, |division, index| divider.digit_stage(index, division));
    [x, begun.divisor.to_bits(), begun.remainder.to_bits(), ended.digits.to_bits()]
}

fn ordered<L: Lane>(a: L, b: L) -> Interval<L> {
    Interval { low: a.min(b), high: a.max(b) }
}

impl Reach {
    fn with(self, other: &Self) -> Self {
        let least = if other.least.bits < self.least.bits { other.least } else { self.least };
        let rises = other.greatest.bits > self.greatest.bits;
        Self { least, greatest: if rises { other.greatest } else { self.greatest } }
    }
}

impl TailReach {
    fn with(self, other: &Self) -> Self {
        Self {
            x: self.x.with(&other.x),
            divisor: self.divisor.with(&other.divisor),
            first_remainder: self.first_remainder.with(&other.first_remainder),
            quotient: self.quotient.with(&other.quotient),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::config::Config;
    use crate::datapath::Signals;
    use crate::design::Design;

    use super::*;

    /// Every address with every x, one after the other.
    fn tried(datapath: &Datapath, rank: usize, bits: fn(&Signals) -> i64) -> (i64, i64) {
        let input = datapath.formats().input;
        let all = (0..datapath.rom().depth() as u32)
            .flat_map(|address| (input.min_bits()..=input.max_bits()).map(move |x| (address, x)));
        all.fold((i64::MAX, i64::MIN), |(least, greatest), (address, x)| {
            let value = bits(&datapath.passage(address, x)[rank]);
            (least.min(value), greatest.max(value))
        })
    }

    fn same(reach: &Reach, (least, greatest): (i64, i64)) {
        assert_eq!((reach.least.bits, reach.greatest.bits), (least, greatest));
    }

    #[test]
    fn nothing_that_is_tried_is_missed_or_exceeded() {
        let head = r#""name": "s", "exponents": "1..=9", "output": "UQ1.6""#;
        for rest in [
            r#""input": "Q2.7", "method": "hermite", "form": "power", "tail": "rational""#,
            r#""input": "UQ1.8", "method": "three_point", "cut": "minimum", "rounding": "nearest_even""#,
            r#""input": "UQ0.8", "method": "tangent", "cut": "minimum""#,
            r#""input": "UQ1.8", "method": "schlick", "tail": "rational""#,
        ] {
            let config = Config::from_json(&format!("{{{head}, {rest}}}")).unwrap();
            let design = Design::new(config).unwrap();
            let datapath = design.datapath();
            if let Some(reach) = datapath.polynomial_reach() {
                same(&reach.v, tried(datapath, 1, |s| s.v));
                same(&reach.lines[0], tried(datapath, 2, |s| s.t[0]));
                same(&reach.lines[1], tried(datapath, 3, |s| s.t[1]));
                same(&reach.lines[2], tried(datapath, 4, |s| s.t[2]));
            }
            if let Some(reach) = datapath.tail_reach() {
                let last = datapath.rank_count() - 2;
                same(&reach.x, tried(datapath, 1, |s| s.tail_x));
                same(&reach.divisor, tried(datapath, 2, |s| s.division.divisor));
                same(&reach.first_remainder, tried(datapath, 2, |s| s.division.remainder));
                same(&reach.quotient, tried(datapath, last, |s| s.division.digits));
            }
        }
    }
}
