//! The ranks of registers, and the logic between them.
//!
//! Rank 0 (`fetch`) takes the input and the ROM word; rank 1 (`front_end`) the region and the
//! variable; the middle ranks hold the stages on one side and the divider on the other, whose
//! results wait for each other; the last (`clamp`) the intensity and the status. The number of ranks is the latency.
//! Of a cubic:
//!
//! | rank     | polynomial       | tail                     |
//! |----------|------------------|--------------------------|
//! | 2        | stage 1: t1      | divisor, first remainder |
//! | 3        | stage 2: t2      | quotient bits            |
//! | 4        | stage 3: t3      | quotient bits            |
//! | 5 …      | t3 waits         | quotient bits            |
//!
//! What a rank takes in is computed by the steps of the composition (`compose.rs`), one at a time.

use crate::registers::Register;
use crate::rom::Fetched;
use crate::rounding::Lane;

use super::compose::{Anything, Lines};
use super::front_end::Region;
use super::parts::{Datapath, HEAD_RANKS};
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
        if rank == 1 {
            self.front_end_rank::<L>(before)
        } else if rank + 1 == self.rank_count() {
            self.clamp_rank::<L>(before)
        } else {
            let mut after = *before;
            self.polynomial_rank::<L>(rank - HEAD_RANKS, &mut after);
            self.tail_rank::<L>(rank - HEAD_RANKS, &mut after);
            after
        }
    }

    #[inline]
    fn front_end_rank<L: Lane>(&self, before: &Signals) -> Signals {
        let entered = Lines::of(self).enter::<L, Anything>(before, L::from_bits(before.x));
        Signals {
            x: entered.x.to_bits(),
            region: entered.region,
            row: before.row.in_segment(entered.segment),
            status: entered.status[1],
            v: entered.v.to_bits(),
            tail_x: entered.tail_x.to_bits(),
            ..*before
        }
    }

    #[inline]
    fn polynomial_rank<L: Lane>(&self, index: usize, signals: &mut Signals) {
        let degree = self.degree();
        if index >= degree {
            return;
        }
        let before = if index == 0 { Register::C(0, degree) } else { Register::T(index) };
        let addend = Register::C(0, degree - 1 - index);
        let [t, v, addend] = [before, Register::V, addend].map(|register| L::from_bits(signals.get(register)));
        signals.t[index] = Lines::of(self).stage(index, t, v, addend).to_bits();
    }

    #[inline]
    fn tail_rank<L: Lane>(&self, index: usize, signals: &mut Signals) {
        let Some(divider) = &self.divider else { return };
        let division = if index == 0 {
            let [x, a, b] =
                [Register::TailX, Register::TailA, Register::TailB].map(|register| L::from_bits(signals.get(register)));
            divider.begin(x, a, b)
        } else {
            divider.digit_stage(index as u32 - 1, signals.division.widened::<L>())
        };
        signals.division = division.narrowed();
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
