//! The ranks of registers, and the logic between them.
//!
//! Rank 0 (`fetch`) takes the input and the ROM word; the front end's rank the region and the
//! variable; the middle ranks hold the stages on one side and the divider on the other, whose
//! results wait for each other; the last (`clamp`) the intensity and the status. The number of ranks is the latency.
//! Of a cubic in the least pipeline, whose front end is rank 1:
//!
//! | rank     | polynomial       | tail                     |
//! |----------|------------------|--------------------------|
//! | 2        | stage 1: t1      | divisor, first remainder |
//! | 3        | stage 2: t2      | quotient bits            |
//! | 4        | stage 3: t3      | quotient bits            |
//! | 5 …      | t3 waits         | quotient bits            |
//!
//! Where there are more ranks, [`schedule`](super::schedule) says which takes which step. A rank that takes none copies
//! what is alive.
//!
//! What a rank takes in is computed by the steps of the composition (`compose.rs`), one at a time.

use crate::pipelining::LineStep;
use crate::registers::Register;
use crate::rom::Fetched;
use crate::rounding::Lane;

use super::compose::{Anything, Lines};
use super::front_end::{Region, Variable};
use super::parts::Datapath;
use super::signals::{Signals, Status};

impl Datapath {
    /// What rank 0 takes in: address, x, and the ROM word.
    #[inline]
    #[must_use]
    pub fn fetch(&self, address: u32, x: i64) -> Signals {
        Signals {
            address,
            x,
            row: self.row(address),
            status: Status::default().with(Status::NO_WORD, self.rom.row(address).is_none()),
            ..Signals::default()
        }
    }

    /// What `rank` (1 and up) takes in when the rank before it holds `before`.
    #[must_use]
    pub fn advance(&self, rank: usize, before: &Signals) -> Signals {
        if self.narrow { self.advance_in::<i64>(rank, before) } else { self.advance_in::<i128>(rank, before) }
    }

    fn advance_in<L: Lane>(&self, rank: usize, before: &Signals) -> Signals {
        let (compare, front_end) = (self.pipelining.compare_rank(), self.pipelining.front_end_rank());
        if rank + 1 == self.rank_count() {
            return self.clamp_rank::<L>(before);
        }
        let mut after = match rank {
            _ if rank == compare => self.compare_step::<L>(before),
            _ if rank == front_end => self.choose_step::<L>(before),
            _ => *before,
        };
        if let Some((stage, step)) = self.polynomial_step(rank) {
            self.line_step::<L>(stage, step, &mut after);
        }
        self.tail_step::<L>(rank, &mut after);
        after
    }

    /// The front end, or of a cut one all but the choice of the segment.
    #[inline]
    fn compare_step<L: Lane>(&self, before: &Signals) -> Signals {
        let entered = Lines::of(self).enter::<L, Anything>(before, L::from_bits(before.x));
        let compared = Signals { x: entered.x.to_bits(), region: entered.region, status: entered.status[1], ..*before };
        if self.pipelining.front_end > 0 {
            return self.measured::<L>(compared);
        }
        Signals {
            row: before.row.in_segment(entered.segment),
            v: entered.v.to_bits(),
            tail_x: entered.tail_x.to_bits(),
            ..compared
        }
    }

    /// With the distances from a clamped x to where the segments begin, and the further segments that begin above it.
    pub(super) fn measured<L: Lane>(&self, mut held: Signals) -> Signals {
        let front_end = &self.front_end;
        let x = L::from_bits(held.x);
        held.beyond = 0;
        for segment in 0..self.segment_count() {
            let start = L::from_bits(front_end.start(&held, segment));
            if let Some(Variable::U { .. }) = front_end.variable {
                held.distance[segment] = (start - x).to_bits();
            }
            if segment > 0 && front_end.is_beyond(x, held.region, start) {
                held.beyond |= 1 << (segment - 1);
            }
        }
        held
    }

    /// The segment that answers, chosen by the comparisons of the rank before: its variable and its coefficients.
    #[inline]
    fn choose_step<L: Lane>(&self, before: &Signals) -> Signals {
        let segment = (i64::BITS - before.beyond.leading_zeros()) as usize;
        let [x, distance] = [before.x, before.distance[segment]].map(L::from_bits);
        let (front_end, region) = (&self.front_end, before.region);
        Signals {
            row: before.row.in_segment(segment),
            v: front_end.variable_at(x, region, distance, before.row.shift(segment)).to_bits(),
            tail_x: front_end.tail_x(x, region).to_bits(),
            ..*before
        }
    }

    #[inline]
    fn tail_step<L: Lane>(&self, rank: usize, signals: &mut Signals) {
        let Some(divider) = &self.divider else { return };
        if let Some(step) = self.divisor_step(rank) {
            if step == LineStep::Result {
                let [x, a, b] = [Register::TailX, Register::TailA, Register::TailB]
                    .map(|register| L::from_bits(signals.get(register)));
                signals.division = divider.begin(x, a, b).narrowed();
            }
            self.line_step::<L>(0, step, signals);
        } else if let Some(index) = rank.checked_sub(self.rank_of(Register::Divisor) + 1)
            && index < divider.digit_stages() as usize
        {
            signals.division = divider.digit_stage(index as u32, signals.division.widened::<L>()).narrowed();
        }
    }

    #[inline]
    fn clamp_rank<L: Lane>(&self, before: &Signals) -> Signals {
        let mut after = *before;
        let last = L::from_bits(before.get(Register::T(self.degree())));
        let (answer, status) = Lines::of(self).answer(before.region, last, before.status);
        (after.intensity, after.status) = (answer.to_bits(), status);
        // A tail answers only where there is a divider.
        if let (Region::Tail, Some(divider)) = (before.region, &self.divider) {
            let one = L::from_bits(self.output_one);
            after.intensity = divider.finish(before.division.widened::<L>(), one).to_bits();
        }
        after
    }

    /// The contents of every rank, first to last, as (address, x) passes through on its own.
    #[must_use]
    pub fn passage(&self, address: u32, x: i64) -> Vec<Signals> {
        let mut held = self.fetch(address, x);
        let mut ranks = vec![held];
        for rank in 1..self.rank_count() {
            held = self.advance(rank, &held);
            ranks.push(held);
        }
        ranks
    }

    /// What the last rank holds for (address, x): the intensity, the status, and every value computed on the way.
    #[must_use]
    pub fn evaluate(&self, address: u32, x: i64) -> Signals {
        (1..self.rank_count()).fold(self.fetch(address, x), |held, rank| self.advance(rank, &held))
    }
}

/// What rank 0 holds is what the front end is given.
impl Fetched for Signals {
    #[inline(always)]
    fn get(&self, field: Register) -> i64 {
        self.row.get(field)
    }
    #[inline(always)]
    fn known(&self) -> bool {
        !self.status.contains(Status::NO_WORD)
    }
}
