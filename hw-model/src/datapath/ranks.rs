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
use crate::rom::{Fetched, Rom, Row};
use crate::rounding::Lane;

use super::compose::{Anything, Lines};
use super::formats::Formats;
use super::front_end::{FrontEnd, Region};
use super::signals::{RankRegister, Signals, Status};
use super::stage::{MultiplyAdd, Stages};
use super::tail::Divider;

/// Ranks before the middle: fetch and front end.
pub const HEAD_RANKS: usize = 2;

/// The data path of one configuration: every line with its alignment, and the ROM.
#[derive(Debug, Clone, PartialEq)]
pub struct Datapath {
    pub(crate) rom: Rom,
    pub(crate) formats: Formats,
    pub(crate) front_end: FrontEnd,
    pub(crate) stages: Stages,
    pub(crate) divider: Option<Divider>,
    /// 1 in the output's unit, or the greatest intensity of a format that does not reach 1.
    pub(crate) output_one: i64,
    /// True when every line fits an `i64`.
    pub(crate) narrow: bool,
}

/// The name of a register with the name of its rank in front: `stage1.t1`. A register of the divider has the
/// divider's name there, also where a multiply-add stage gives the rank its own: `tail0.divisor`.
#[must_use]
pub fn register_name(rank: usize, rank_name: &str, register: &str) -> String {
    match Register::named(register) {
        Some(Register::Divisor | Register::Remainder | Register::Digits) => {
            format!("tail{}.{register}", rank.saturating_sub(HEAD_RANKS))
        }
        _ => format!("{rank_name}.{register}"),
    }
}

impl Datapath {
    /// The ROM from which rank 0 takes its rows.
    #[must_use]
    pub const fn rom(&self) -> &Rom {
        &self.rom
    }

    /// The formats of every register.
    #[must_use]
    pub const fn formats(&self) -> &Formats {
        &self.formats
    }

    /// The front end's constants.
    #[must_use]
    pub const fn front_end(&self) -> &FrontEnd {
        &self.front_end
    }

    /// The multiply-add lines of the polynomial, in the order of their stages; none where there is no polynomial.
    #[must_use]
    pub fn stages(&self) -> &[MultiplyAdd] {
        self.stages.lines()
    }

    /// The degree of the polynomial, and the number of its stages; 0 where there is no polynomial.
    #[must_use]
    pub const fn degree(&self) -> usize {
        self.stages.degree()
    }

    /// The divider, where there is one.
    #[must_use]
    pub const fn divider(&self) -> Option<&Divider> {
        self.divider.as_ref()
    }

    /// The greatest intensity: 1, or the output format's greatest value where it does not reach 1.
    #[must_use]
    pub const fn output_one(&self) -> i64 {
        self.output_one
    }

    /// The flags of the status port, from bit 0 up.
    #[must_use]
    pub fn status_flags(&self) -> &'static [(Status, &'static str)] {
        let flags = &Status::NAMES;
        if self.front_end.guarded { flags } else { &flags[..flags.len() - 1] }
    }

    /// Bits of the status port.
    #[must_use]
    pub fn status_width(&self) -> u32 {
        self.status_flags().len() as u32
    }

    /// Number of ranks of registers, which is the latency in clock cycles.
    #[must_use]
    pub fn rank_count(&self) -> usize {
        HEAD_RANKS + self.middle_ranks() + 1
    }

    /// Ranks of the divider: its divisor's, and those of its quotient bits.
    #[must_use]
    pub fn divider_ranks(&self) -> usize {
        self.divider.map_or(0, |divider| 1 + divider.digit_stages() as usize)
    }

    fn middle_ranks(&self) -> usize {
        self.degree().max(self.divider_ranks())
    }

    /// The name of a rank, as in traces and waves.
    #[must_use]
    pub fn rank_name(&self, rank: usize) -> String {
        match rank {
            0 => "fetch".to_owned(),
            1 => "front_end".to_owned(),
            _ if rank + 1 == self.rank_count() => "clamp".to_owned(),
            _ if rank < HEAD_RANKS + self.degree() => {
                format!("stage{}", rank + 1 - HEAD_RANKS)
            }
            _ => format!("tail{}", rank - HEAD_RANKS),
        }
    }

    /// The name of a register of a rank, with its part's in front: see [`register_name`].
    #[must_use]
    pub fn register_name(&self, rank: usize, register: &RankRegister) -> String {
        register_name(rank, &self.rank_name(rank), register.name())
    }

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

    /// Segments of the polynomial; 1 where there is no polynomial.
    #[must_use]
    pub const fn segment_count(&self) -> usize {
        self.front_end.segments
    }

    /// The row at an address. An address without a word reads the first row: its values are in every
    /// proved range, and a memory needs no gates behind its outputs. The region makes the intensity 0.
    #[must_use]
    pub fn row(&self, address: u32) -> Row {
        *self.row_at(if self.rom.row(address).is_some() { address } else { 0 })
    }

    /// The row at an address that has one.
    #[inline(always)]
    pub(super) fn row_at(&self, address: u32) -> &Row {
        const NONE: &Row = &Row::EMPTY;
        self.rom.row(address).unwrap_or(NONE)
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
