//! A request in flight: every value that is computed of it, each in a place of its own.
//!
//! Ranks of registers hold the same values again and again, carried along, and all of them follow from the
//! request's address and x. A clocked simulator that counts requests instead of copying ranks moves nothing: a
//! rank shows of a request what has been computed up to it, also after the request has gone on (a bubble does not
//! change registers).

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

/// What lies between the ranks, with what is known of it.
#[derive(Debug, Clone, Copy)]
pub struct Logic {
    pub(super) lines: Lines,
    pub(super) plain: Option<(Rounding, bool)>,
}

impl Logic {
    /// What all ranks take in of a request, in the place of another one; [`Datapath::shown`] says which of it a
    /// rank has.
    pub fn enter(&self, datapath: &Datapath, address: u32, x: i64, flight: &mut Flight) {
        let Flight { divisions, .. } = flight;
        let mut divisions = std::mem::take(divisions);
        *flight = self.dispatch(datapath, address, x, |rank, division| divisions[rank] = division);
        flight.divisions = divisions;
    }

    #[inline(always)]
    fn dispatch(
        &self,
        datapath: &Datapath,
        address: u32,
        x: i64,
        keep: impl FnMut(usize, Division<i64>),
    ) -> Flight {
        match (self.plain, datapath.narrow) {
            (Some((Rounding::NearestUp, true)), _) => {
                self.evaluate_one::<i64, Plain<true, true>>(datapath, address, x, keep)
            }
            (Some((Rounding::NearestUp, false)), _) => {
                self.evaluate_one::<i64, Plain<true, false>>(datapath, address, x, keep)
            }
            (_, true) => self.evaluate_one::<i64, Anything>(datapath, address, x, keep),
            (_, false) => self.evaluate_one::<i128, Anything>(datapath, address, x, keep),
        }
    }

    /// All values but the divisions, of which `keep` is told the rank of the divider and what it holds.
    #[inline(always)]
    fn evaluate_one<L: Lane, K: Known>(
        &self,
        datapath: &Datapath,
        address: u32,
        given: i64,
        mut keep: impl FnMut(usize, Division<i64>),
    ) -> Flight {
        let Lines { front_end, stages, divider, output_one } = K::lines(self.lines);
        let known = datapath.rom.row(address);
        let (row, known) = (known.unwrap_or(datapath.row_at(0)), known.is_some());
        let fetched = Status::default().with(Status::NO_WORD, !known);
        let mut flight = Flight { address, x: given, ..Flight::default() };
        let (given, input_one) = (L::from_bits(given), L::from_bits(front_end.one));
        let one = L::from_bits(output_one);
        let x = front_end.clamp_input(given);
        let region = front_end.region(given, L::from_bits(front_end.cut(row)));
        let region = if known { region } else { Region::Zero };
        let status = fetched
            .with(Status::ABOVE_ONE, given > input_one)
            .with(Status::FACING_AWAY, given < L::ZERO)
            .with(Status::OUT_OF_DOMAIN, known && front_end.outside(given, region));
        let hand_over = L::from_bits(front_end.hand_over(row));
        let outer = front_end.is_outer(x, region, hand_over);
        let segment =
            if outer { Segment::outer(row, hand_over) } else { Segment::first(row, input_one) };
        let Segment { start, shift, c: [c0, c1, c2, c3] } = segment;
        let v = front_end.variable(x, region, start, shift);
        let tail_x = front_end.tail_x(x, region);
        (flight.clamped_x, flight.region, flight.outer) = (x.to_bits(), region, outer);
        (flight.v, flight.tail_x) = (v.to_bits(), tail_x.to_bits());
        flight.status = [fetched, status, status];
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
            let mut division = divider.begin(tail_x, a, b);
            keep(0, division.narrowed());
            for stage in 0..divider.digit_stages() {
                division = divider.digit_stage(stage, division);
                keep(stage as usize + 1, division.narrowed());
            }
            if region == Region::Tail {
                flight.intensity = divider.finish(division, one).to_bits();
            }
        }
        flight
    }
}
