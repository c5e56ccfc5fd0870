//! A request in flight: every value that was computed of it so far, each in a place of its own.
//!
//! Ranks of registers hold the same values again and again, carried along. A clocked simulator that keeps
//! requests instead of ranks moves nothing but their numbers: a rank shows a request as far as the rank has
//! computed it, also after the request has gone on (a bubble does not change registers).

use crate::rom::FieldName;
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
    /// c0 to c3 of the segment that answers.
    pub(super) c: [i64; 4],
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

    /// What rank 0 takes in, into a request that nobody shows any more.
    #[inline]
    pub fn enter(&self, address: u32, x: i64, flight: &mut Flight) {
        let known = self.rom.row(address).is_some();
        (flight.address, flight.x) = (address, x);
        flight.row = if known { address } else { 0 };
        flight.status[0] = Status::default().with(Status::NO_WORD, !known);
    }

    /// The logic in front of the ranks from 1 up.
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
    /// What the ranks of the bits in `loads` (from 1 up) take in: rank r of the request that `slots` says.
    #[inline]
    pub fn load(&self, datapath: &Datapath, loads: u128, slots: &Slots, flights: &mut [Flight]) {
        let edge = Edge { datapath, lines: &self.lines, loads, slots, flights };
        match (self.plain, datapath.narrow) {
            (Some((Rounding::NearestUp, true)), _) => edge.load::<i64, Plain<true, true>>(),
            (Some((Rounding::NearestUp, false)), _) => edge.load::<i64, Plain<true, false>>(),
            (_, true) => edge.load::<i64, Anything>(),
            (_, false) => edge.load::<i128, Anything>(),
        }
    }
}

/// A clock edge.
struct Edge<'a> {
    datapath: &'a Datapath,
    lines: &'a Lines,
    loads: u128,
    slots: &'a Slots,
    flights: &'a mut [Flight],
}

impl Edge<'_> {
    #[inline(always)]
    fn load<L: Lane, K: Known>(mut self) {
        let lines = K::lines(*self.lines);
        if let Some(flight) = self.loaded(1) {
            self.front_end::<L>(&lines, flight);
        }
        if let Some(stages) = &lines.stages {
            for (index, stage) in stages.iter().enumerate() {
                if let Some(flight) = self.loaded(MIDDLE + index) {
                    let flight = &mut self.flights[flight];
                    let [c0, c1, c2, c3] = flight.c;
                    let (multiplicand, addend) =
                        [(c3, c2), (flight.t[0], c1), (flight.t[1], c0)][index];
                    let [m, v, a] = [multiplicand, flight.v, addend].map(L::from_bits);
                    flight.t[index] = stage.apply(m, v, a).to_bits();
                }
            }
        }
        if lines.divider.is_some() {
            self.tail::<L>(&lines);
        }
        if let Some(flight) = self.loaded(self.slots.ranks() - 1) {
            let flight = &mut self.flights[flight];
            flight.finish::<L>(&lines);
        }
    }

    /// The request that a rank takes in, where it does.
    #[inline(always)]
    fn loaded(&self, rank: usize) -> Option<usize> {
        (self.loads >> rank & 1 == 1).then(|| self.slots.get(rank).into())
    }

    #[inline(always)]
    fn front_end<L: Lane>(&mut self, lines: &Lines, flight: usize) {
        let flight = &mut self.flights[flight];
        let row = self.datapath.row_at(flight.row);
        let front_end = &lines.front_end;
        let given = L::from_bits(flight.x);
        let x = front_end.clamp_input(given);
        let no_word = flight.status[0].contains(Status::NO_WORD);
        let region = front_end.region(given, L::from_bits(row.get(FieldName::Cut)));
        let region = if no_word { Region::Zero } else { region };
        flight.clamped_x = x.to_bits();
        flight.region = region;
        flight.status[1] = flight.status[0]
            .with(Status::ABOVE_ONE, given > L::from_bits(front_end.one))
            .with(Status::FACING_AWAY, given < L::ZERO);
        let hand_over = L::from_bits(row.get(FieldName::HandOver));
        flight.outer = front_end.is_outer(x, region, hand_over);
        let Segment { start, shift, c } = match flight.outer {
            true => Segment::outer(row),
            false => Segment::first(row, L::from_bits(front_end.one)),
        };
        flight.c = c.map(L::to_bits);
        flight.v = front_end.variable(x, region, start, shift).to_bits();
        flight.tail_x = front_end.tail_x(x, region).to_bits();
    }

    #[inline(always)]
    fn tail<L: Lane>(&mut self, lines: &Lines) {
        let Some(divider) = &lines.divider else { return };
        for index in 0..self.datapath.divider_ranks() {
            let Some(flight) = self.loaded(MIDDLE + index) else { continue };
            let flight = &mut self.flights[flight];
            let division = match index.checked_sub(1) {
                None => {
                    let row = self.datapath.row_at(flight.row);
                    let (a, b) = (row.get(FieldName::TailA), row.get(FieldName::TailB));
                    let [x, a, b] = [flight.tail_x, a, b].map(L::from_bits);
                    divider.begin(x, a, b)
                }
                Some(before) => {
                    let division = flight.divisions[before].widened::<L>();
                    divider.digit_stage(before as u32, division)
                }
            };
            flight.divisions[index] = division.narrowed();
        }
    }
}

impl Flight {
    #[inline(always)]
    fn finish<L: Lane>(&mut self, lines: &Lines) {
        let one = L::from_bits(lines.output_one);
        let [_, _, t3] = self.t;
        let answered = clamp(L::from_bits(t3), one).to_bits();
        let polynomial = self.region == Region::Polynomial;
        self.status[2] = self.status[1].with(Status::CLAMPED, polynomial && answered != t3);
        self.intensity = match (self.region, &lines.divider, self.divisions.last()) {
            (Region::Polynomial, _, _) => answered,
            (Region::Tail, Some(divider), Some(division)) => {
                divider.finish(division.widened::<L>(), one).to_bits()
            }
            _ => 0,
        };
    }
}
