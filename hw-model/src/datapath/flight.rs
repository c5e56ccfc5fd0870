//! A request in flight: every value that was computed of it so far, each in a place of its own.
//!
//! Ranks of registers hold the same values again and again, carried along. A clocked simulator that keeps
//! requests instead of ranks moves nothing but their numbers: a rank shows of a request what has been computed
//! up to it, also after the request has gone on (a bubble does not change registers).

use crate::rom::{FieldName, Row};
use crate::rounding::{Lane, Rounding};

use super::block::{Lines, Segment};
use super::clamp::clamp;
use super::front_end::Region;
use super::ranks::Datapath;
use super::run::{Anything, Known, Plain};
use super::signals::{Signals, Status};
use super::tail::Division;

/// The rank of the first line of the middle.
const MIDDLE: usize = 2;

/// The values of a request.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Flight {
    pub(super) address: u32,
    /// The row's address; 0 where there is none.
    pub(super) row: u32,
    pub(super) x: i64,
    pub(super) clamped_x: i64,
    pub(super) region: Region,
    /// The second segment answers.
    pub(super) outer: bool,
    /// As fetched, from the front end on, and in the last rank.
    pub(super) status: [Status; 3],
    pub(super) v: i64,
    pub(super) t: [i64; 3],
    pub(super) tail_x: i64,
    /// The division behind each of the divider's ranks.
    pub(super) divisions: Vec<Division<i64>>,
    pub(super) intensity: i64,
}

impl Flight {
    /// The intensity, once the last rank has computed it.
    #[must_use]
    pub const fn intensity(&self) -> i64 {
        self.intensity
    }

    /// The flags of the result.
    #[must_use]
    pub const fn status(&self) -> Status {
        self.status[2]
    }
}

impl Datapath {
    /// Ranks of the divider.
    pub(super) fn divider_ranks(&self) -> usize {
        self.divider.map_or(0, |divider| 1 + divider.digit_stages() as usize)
    }

    /// A request with room for all its values.
    #[must_use]
    pub fn flight(&self) -> Flight {
        Flight { divisions: vec![Division::default(); self.divider_ranks()], ..Flight::default() }
    }

    /// The logic between the ranks.
    #[must_use]
    pub fn logic(&self) -> Logic {
        let lines = Lines::of(self);
        let plain = lines.plainly_rounded().filter(|_| self.narrow && lines.stages.is_some());
        Logic { lines, plain }
    }

    /// The request as `rank` shows it.
    #[must_use]
    pub fn shown(&self, rank: usize, flight: &Flight) -> Signals {
        let last = self.rank_count() - 1;
        let from = |computed: usize, bits: i64| if rank >= computed { bits } else { 0 };
        let [fetched, given, result] = flight.status;
        let division = rank
            .checked_sub(MIDDLE)
            .and_then(|index| flight.divisions.get(index).or(flight.divisions.last()));
        let row = self.row(flight.address);
        Signals {
            address: flight.address,
            x: if rank == 0 { flight.x } else { flight.clamped_x },
            row: if flight.outer && rank > 0 { row.in_outer() } else { row },
            status: match rank {
                0 => fetched,
                _ if rank == last => result,
                _ => given,
            },
            region: if rank == 0 { Region::default() } else { flight.region },
            v: from(1, flight.v),
            t1: from(MIDDLE, flight.t[0]),
            t2: from(MIDDLE + 1, flight.t[1]),
            t3: from(MIDDLE + 2, flight.t[2]),
            tail_x: from(1, flight.tail_x),
            division: division.copied().unwrap_or_default(),
            intensity: from(last, flight.intensity),
        }
    }
}

/// Which request each rank shows: a ring, so that all ranks together go on by a turn of it.
#[derive(Debug, Clone)]
pub struct Slots {
    ring: Vec<u8>,
    head: usize,
}

impl Slots {
    /// The same for every rank.
    #[must_use]
    pub fn new(ranks: usize, slot: u8) -> Self {
        Self { ring: vec![slot; ranks], head: 0 }
    }

    /// The number of ranks.
    #[must_use]
    pub fn ranks(&self) -> usize {
        self.ring.len()
    }

    #[inline(always)]
    fn place(&self, rank: usize) -> usize {
        let place = self.head + rank;
        if place < self.ring.len() { place } else { place - self.ring.len() }
    }

    /// The request of a rank.
    #[inline(always)]
    #[must_use]
    pub fn get(&self, rank: usize) -> u8 {
        self.ring[self.place(rank)]
    }

    /// Gives a rank another request.
    #[inline(always)]
    pub fn set(&mut self, rank: usize, slot: u8) {
        let place = self.place(rank);
        self.ring[place] = slot;
    }

    /// Gives every rank the request of the rank before it, and the first that of the last.
    #[inline(always)]
    pub const fn turn(&mut self) {
        self.head = match self.head {
            0 => self.ring.len() - 1,
            head => head - 1,
        };
    }
}

/// What lies between the ranks, with what is known of it.
#[derive(Debug, Clone, Copy)]
pub struct Logic {
    pub(super) lines: Lines,
    pub(super) plain: Option<(Rounding, bool)>,
}

impl Logic {
    /// What all ranks will take in of a request, in the place of one that nobody shows any more.
    ///
    /// A request's values follow from its address and x alone, whenever it goes on from rank to rank. So they are
    /// computed when it enters, and [`Datapath::shown`] says which of them a rank has.
    #[inline]
    pub fn enter(&self, datapath: &Datapath, address: u32, x: i64, flight: &mut Flight) {
        let known = datapath.rom.row(address).is_some();
        (flight.address, flight.x) = (address, x);
        flight.row = if known { address } else { 0 };
        flight.status[0] = Status::default().with(Status::NO_WORD, !known);
        let row = datapath.row_at(flight.row);
        match (self.plain, datapath.narrow) {
            (Some((Rounding::NearestUp, true)), _) => {
                self.evaluate_one::<i64, Plain<true, true>>(row, known, flight);
            }
            (Some((Rounding::NearestUp, false)), _) => {
                self.evaluate_one::<i64, Plain<true, false>>(row, known, flight);
            }
            (_, true) => self.evaluate_one::<i64, Anything>(row, known, flight),
            (_, false) => self.evaluate_one::<i128, Anything>(row, known, flight),
        }
    }

    #[inline(always)]
    fn evaluate_one<L: Lane, K: Known>(&self, row: &Row, known: bool, flight: &mut Flight) {
        let Lines { front_end, stages, divider, output_one } = K::lines(self.lines);
        let (given, input_one) = (L::from_bits(flight.x), L::from_bits(front_end.one));
        let one = L::from_bits(output_one);
        let x = front_end.clamp_input(given);
        let region = front_end.region(given, L::from_bits(row.get(FieldName::Cut)));
        let region = if known { region } else { Region::Zero };
        let status = flight.status[0]
            .with(Status::ABOVE_ONE, given > input_one)
            .with(Status::FACING_AWAY, given < L::ZERO);
        let hand_over = L::from_bits(row.get(FieldName::HandOver));
        let outer = front_end.is_outer(x, region, hand_over);
        let segment = if outer { Segment::outer(row) } else { Segment::first(row, input_one) };
        let Segment { start, shift, c: [c0, c1, c2, c3] } = segment;
        let v = front_end.variable(x, region, start, shift);
        (flight.clamped_x, flight.region, flight.outer) = (x.to_bits(), region, outer);
        (flight.v, flight.tail_x) = (v.to_bits(), front_end.tail_x(x, region).to_bits());
        (flight.status[1], flight.status[2], flight.intensity) = (status, status, 0);
        if let Some([stage1, stage2, stage3]) = stages {
            let t1 = stage1.apply(c3, v, c2);
            let t2 = stage2.apply(t1, v, c1);
            let t3 = stage3.apply(t2, v, c0);
            flight.t = [t1, t2, t3].map(L::to_bits);
            let answered = clamp(t3, one);
            let answers = region == Region::Polynomial;
            flight.status[2] = status.with(Status::CLAMPED, answers && answered != t3);
            flight.intensity = if answers { answered.to_bits() } else { 0 };
        }
        if let Some(divider) = divider {
            let [a, b] =
                [FieldName::TailA, FieldName::TailB].map(|name| L::from_bits(row.get(name)));
            let mut division = divider.begin(front_end.tail_x(x, region), a, b);
            for (stage, behind) in (0_u32..).zip(&mut flight.divisions) {
                if let Some(stage) = stage.checked_sub(1) {
                    division = divider.digit_stage(stage, division);
                }
                *behind = division.narrowed();
            }
            if region == Region::Tail {
                flight.intensity = divider.finish(division, one).to_bits();
            }
        }
    }
}
