//! The composition: front end, multiply-adds, clamp and selection, and the division beside them. It stands here once.
//!
//! ```text
//! row, x → enter ─→ region, v ─→ stage 1 … stage d ─→ answer ─→ intensity, status
//!             └───→ divider's x ─→ divide ─→ quotient ─┘
//! ```
//!
//! It is generic over where the row comes from ([`Fetched`]), over what is known of the lines when a loop over them is
//! compiled ([`Known`]), and over what a register keeps of its value ([`Registers`]). The engines
//! ([`block`](super::block), [`run`](super::run), [`requests`](super::requests), [`flight`](super::flight)) choose
//! these, and what they loop over; [`ranks`](super::ranks) takes the same steps one at a time.

use crate::registers::{CUBIC, MAX_DEGREE, Register};
use crate::rom::Fetched;
use crate::rounding::{Lane, Rounding};

use super::clamp::clamp;
use super::front_end::{FrontEnd, Region};
use super::keep::{Keep, Registers};
use super::parts::Datapath;
use super::signals::Status;
use super::stage::{MultiplyAdd, Stages};
use super::tail::{Divider, Division};

/// The lines of a data path, out of their ranks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lines {
    pub(super) front_end: FrontEnd,
    pub(super) stages: Stages,
    pub(super) divider: Option<Divider>,
    pub(super) output_one: i64,
}

/// What one segment brings to the polynomial.
#[derive(Clone, Copy)]
pub(super) struct Segment<L> {
    pub(super) start: L,
    pub(super) shift: u32,
    /// c0, c1, …
    pub(super) c: [L; MAX_DEGREE + 1],
}

/// What the front end makes of a request.
#[derive(Clone, Copy)]
pub(super) struct Entered<L> {
    /// Clamped to [0, 1].
    pub(super) x: L,
    pub(super) region: Region,
    /// The segment that answers; 0 where none does.
    pub(super) segment: usize,
    pub(super) c: [L; MAX_DEGREE + 1],
    pub(super) v: L,
    pub(super) tail_x: L,
    /// As it was fetched, and as the front end knows it.
    pub(super) status: [Status; 2],
}

/// A request with all but its division.
#[derive(Clone, Copy)]
pub(super) struct Composed<L> {
    pub(super) entered: Entered<L>,
    /// The results of the stages.
    pub(super) t: [L; MAX_DEGREE],
    /// What the last stage gives: the polynomial, not clamped.
    pub(super) polynomial: L,
    /// The polynomial's answer, or 0.
    pub(super) intensity: L,
    pub(super) status: Status,
}

/// What is known of the lines when a loop over them is compiled.
pub(super) trait Known {
    /// The degree; 0 where it is asked for in each turn.
    const DEGREE: usize;
    /// The number of segments, or a greater one (a segment that is not there never answers); 0 where it is asked for.
    const SEGMENTS: usize;
    /// The same lines, with what is known of them as constants.
    #[inline(always)]
    fn lines(lines: Lines) -> Lines {
        lines
    }
}

/// What holds for every configuration.
pub(super) struct Anything;

/// A cubic of at most two segments.
pub(super) struct Cubics;

/// A cubic of at most two segments, every line of which rounds to the nearest, a tie up (otherwise down).
pub(super) struct RoundedCubics<const NEAREST: bool>;

/// A cubic of so many segments, every line of which rounds to the nearest, a tie up (otherwise down), and is plain, in
/// the centred form, which subtracts (otherwise in the power form).
pub(super) struct Plain<const NEAREST: bool, const SUBTRACT: bool, const SEGMENTS: usize>;

const fn mode(nearest: bool) -> Rounding {
    if nearest { Rounding::NearestUp } else { Rounding::Floor }
}

impl Known for Anything {
    const DEGREE: usize = 0;
    const SEGMENTS: usize = 0;
}

impl Known for Cubics {
    const DEGREE: usize = CUBIC;
    const SEGMENTS: usize = 2;
}

impl<const NEAREST: bool> Known for RoundedCubics<NEAREST> {
    const DEGREE: usize = CUBIC;
    const SEGMENTS: usize = 2;

    #[inline(always)]
    fn lines(lines: Lines) -> Lines {
        let mode = mode(NEAREST);
        Lines {
            front_end: lines.front_end.rounded_by(mode),
            stages: lines.stages.map(|stage| stage.rounded_by(mode)),
            divider: lines.divider.map(|divider| divider.rounded_by(mode)),
            ..lines
        }
    }
}

impl<const NEAREST: bool, const SUBTRACT: bool, const SEGMENTS: usize> Known for Plain<NEAREST, SUBTRACT, SEGMENTS> {
    const DEGREE: usize = CUBIC;
    const SEGMENTS: usize = SEGMENTS;

    #[inline(always)]
    fn lines(lines: Lines) -> Lines {
        let mode = mode(NEAREST);
        Lines {
            front_end: lines.front_end.known_plain(SUBTRACT, mode),
            stages: lines.stages.map(|stage| stage.rounded_by(mode).known_plain(SUBTRACT)),
            divider: lines.divider.map(|divider| divider.rounded_by(mode)),
            ..lines
        }
    }
}

impl Lines {
    pub(super) fn of(datapath: &Datapath) -> Self {
        Self {
            front_end: datapath.front_end,
            stages: datapath.stages,
            divider: datapath.divider,
            output_one: datapath.output_one,
        }
    }

    /// True for a cubic of at most two segments, and where there is no polynomial.
    pub(super) fn are_cubics(&self) -> bool {
        matches!(self.stages.degree(), 0 | CUBIC) && self.front_end.segments <= 2
    }

    /// The mode of every line, where they have one in common.
    pub(super) fn rounding(&self) -> Option<Rounding> {
        let front_end = self.front_end.rounding();
        let stages = self.stages.lines().iter().map(MultiplyAdd::rounding);
        let divider = self.divider.iter().flat_map(|d| [d.rounding, d.divisor.rounding()]);
        let mut modes = front_end.into_iter().chain(stages).chain(divider);
        let first = modes.next()?;
        modes.all(|mode| mode == first).then_some(first)
    }

    /// The mode of every line, and whether they are of the centred form, where they have one in common, are plain, and
    /// are those of a cubic of at most two segments.
    pub(super) fn plainly_rounded(&self) -> Option<(Rounding, bool)> {
        let mode = self.rounding().filter(|_| self.are_cubics())?;
        let centred = self.front_end.is_centred();
        let alike = |stage: &MultiplyAdd| stage.is_plain() && stage.subtracts() == centred;
        (self.front_end.is_plain() && self.stages.lines().iter().all(alike)).then_some((mode, centred))
    }

    /// The front end: which part answers, in which segment, and the variable of the polynomial.
    ///
    /// The fields of all segments are loaded, and one chosen: a choice of the address would not fit into vectors.
    #[inline(always)]
    pub(super) fn enter<L: Lane, K: Known>(&self, row: &impl Fetched, given: L) -> Entered<L> {
        let front_end = &self.front_end;
        let one = L::from_bits(front_end.one);
        let x = front_end.clamp_input(given);
        let region = if !row.known() {
            Region::Zero
        } else if row.is_polynomial() {
            Region::Polynomial
        } else {
            front_end.region(given, L::from_bits(front_end.cut(row)))
        };
        let segments = if K::SEGMENTS > 0 { K::SEGMENTS } else { front_end.segments };
        let mut index = 0;
        let mut segment = self.segment::<L, K>(row, 0);
        for further in 1..segments {
            let other = self.segment::<L, K>(row, further);
            if front_end.is_beyond(x, region, other.start) {
                (index, segment) = (further, other);
            }
        }
        let Segment { start, shift, c } = segment;
        let fetched = Status::default().with(Status::NO_WORD, !row.known());
        let status = fetched
            .with(Status::ABOVE_ONE, given > one)
            .with(Status::FACING_AWAY, given < L::ZERO)
            .with(Status::OUT_OF_DOMAIN, row.known() && front_end.outside(given, region));
        Entered {
            x,
            region,
            segment: index,
            c,
            v: front_end.variable(x, region, start, shift),
            tail_x: front_end.tail_x(x, region),
            status: [fetched, status],
        }
    }

    #[inline(always)]
    pub(super) fn segment<L: Lane, K: Known>(&self, row: &impl Fetched, index: usize) -> Segment<L> {
        let degree = self.degree::<K>();
        Segment {
            start: L::from_bits(self.front_end.start(row, index)),
            shift: row.get(Register::Shift(index)) as u32,
            c: std::array::from_fn(|power| {
                let bits = if power <= degree { row.get(Register::C(index, power)) } else { 0 };
                L::from_bits(bits)
            }),
        }
    }

    #[inline(always)]
    fn degree<K: Known>(&self) -> usize {
        if K::DEGREE > 0 { K::DEGREE } else { self.stages.degree() }
    }

    /// What stage `index` (0 is the first) gives, when the one before it gave `t` (the first: when the highest
    /// coefficient is `t`).
    #[inline(always)]
    pub(super) fn stage<L: Lane>(&self, index: usize, t: L, v: L, addend: L) -> L {
        self.stages.line(index).apply(t, v, addend)
    }

    /// The polynomial at v, not clamped, and the results of all stages; 0 where there is none.
    #[inline(always)]
    pub(super) fn polynomial<L: Lane, K: Known, R: Keep<L>>(
        &self,
        c: &[L; MAX_DEGREE + 1],
        v: L,
        keep: &Registers<R>,
    ) -> (L, [L; MAX_DEGREE]) {
        let degree = self.degree::<K>();
        let mut results = [L::ZERO; MAX_DEGREE];
        let mut t = c[degree];
        for index in 0..degree {
            t = keep.t[index].keep(self.stage(index, t, v, c[degree - 1 - index]));
            results[index] = t;
        }
        (t, results)
    }

    /// The polynomial's answer in [0, 1], and the flags with what the clamp has to say; 0 where another part answers.
    #[inline(always)]
    pub(super) fn answer<L: Lane>(&self, region: Region, t: L, status: Status) -> (L, Status) {
        let clamped = clamp(t, L::from_bits(self.output_one));
        let answers = region == Region::Polynomial;
        let status = status.with(Status::CLAMPED, answers && clamped != t);
        (if answers { clamped } else { L::ZERO }, status)
    }

    /// A request, but for its division.
    #[inline(always)]
    pub(super) fn compose<L: Lane, K: Known, R: Keep<L>>(
        &self,
        row: &impl Fetched,
        given: L,
        keep: &Registers<R>,
    ) -> Composed<L> {
        let mut entered = self.enter::<L, K>(row, given);
        entered.v = keep.v.keep(entered.v);
        entered.tail_x = keep.tail_x.keep(entered.tail_x);
        let (polynomial, t) = self.polynomial::<L, K, R>(&entered.c, entered.v, keep);
        let (intensity, status) = self.answer(entered.region, polynomial, entered.status[1]);
        Composed { entered, t, polynomial, intensity, status }
    }
}

/// Divisions side by side, an array for each register, so that lanes lie side by side.
pub(super) struct Divisions<D, const W: usize> {
    divisors: [D; W],
    remainders: [D; W],
    digits: [D; W],
}

impl<D: Lane, const W: usize> Divisions<D, W> {
    /// One of them.
    #[inline(always)]
    pub(super) fn get(&self, index: usize) -> Division<D> {
        let (divisor, remainder) = (self.divisors[index], self.remainders[index]);
        Division { divisor, remainder, digits: self.digits[index] }
    }
}

impl Divider {
    /// The quotients of `count` divisions (at most `W`), each in the output's unit, at most `one`. `operands` gives x,
    /// A and B of each in lanes `L`; the division itself goes in lanes `D`. `behind` is told each of the divider's
    /// ranks and what it holds.
    #[inline(always)]
    pub(super) fn divide<L: Lane, D: Lane, R: Keep<L> + Keep<D>, const W: usize>(
        &self,
        count: usize,
        operands: impl Fn(usize) -> [L; 3],
        one: i64,
        keep: &Registers<R>,
        mut behind: impl FnMut(usize, &Divisions<D, W>),
    ) -> Divisions<D, W> {
        let mut all = Divisions { divisors: [D::ONE; W], remainders: [D::ZERO; W], digits: [D::ZERO; W] };
        let (keep_remainder, keep_digits) = keep.behind_stage(0);
        let lanes = all.divisors.iter_mut().zip(&mut all.remainders).zip(&mut all.digits);
        for (index, ((divisor, remainder), digits)) in lanes.enumerate().take(count) {
            let [x, a, b] = operands(index);
            let begun = self.begin(x, a, b);
            let kept: [L; 3] = [
                keep.divisor.keep(begun.divisor),
                keep_remainder.keep(begun.remainder),
                keep_digits.keep(begun.digits),
            ];
            [*divisor, *remainder, *digits] = kept.map(|value| D::from_bits(value.to_bits()));
        }
        behind(0, &all);
        for digit in 0..self.digit_count {
            self.digit_of_all(&all.divisors, &mut all.remainders, &mut all.digits);
            if self.ends_stage(digit) {
                let stage = 1 + (digit / self.digits_per_stage) as usize;
                if !<R as Keep<D>>::WHOLE {
                    let (keep_remainder, keep_digits) = keep.behind_stage(stage);
                    all.remainders = all.remainders.map(|remainder| keep_remainder.keep(remainder));
                    all.digits = all.digits.map(|digits| keep_digits.keep(digits));
                }
                behind(stage, &all);
            }
        }
        let one = D::from_bits(one);
        for index in 0..W.min(count) {
            all.digits[index] = self.finish(all.get(index), one);
        }
        all
    }
}

impl<D: Lane, const W: usize> Divisions<D, W> {
    /// The quotients, once the divisions are finished.
    #[inline(always)]
    pub(super) const fn quotients(&self) -> &[D; W] {
        &self.digits
    }
}
