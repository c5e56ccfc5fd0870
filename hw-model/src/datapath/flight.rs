//! A request in flight: every value that is computed of it, each in a place of its own.
//!
//! Ranks of registers hold the same values again and again, carried along, and all of them follow from the
//! request's address and x. A clocked simulator that counts requests instead of copying ranks moves nothing: a
//! rank shows of a request what has been computed up to it, also after the request has gone on (a bubble does not
//! change registers).

use crate::pipelining::LineStep;
use crate::registers::{MAX_DEGREE, Register};
use crate::rom::{Fetched, Row};
use crate::rounding::{Lane, Rounding};

use super::compose::{Anything, Known, Lines, Plain};
use super::front_end::Region;
use super::keep::{Registers, Whole};
use super::parts::Datapath;
use super::signals::{Signals, Status};
use super::tail::Division;

/// The values of a request.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Flight {
    pub(super) address: u32,
    pub(super) x: i64,
    pub(super) clamped_x: i64,
    pub(super) region: Region,
    /// The segment that answers.
    pub(super) segment: usize,
    /// As fetched, from the front end on, and in the last rank.
    pub(super) status: [Status; 3],
    pub(super) v: i64,
    pub(super) t: [i64; MAX_DEGREE],
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
    /// A request with room for all its values.
    #[must_use]
    pub fn flight(&self) -> Flight {
        Flight { divisions: vec![Division::default(); self.division_ranks()], ..Flight::default() }
    }

    /// The logic between the ranks.
    #[must_use]
    pub fn logic(&self) -> Logic {
        let lines = Lines::of(self);
        let plain = lines.plainly_rounded().filter(|_| self.narrow && self.degree() > 0);
        Logic { lines, plain }
    }

    /// The request as `rank` shows it.
    #[must_use]
    pub fn shown(&self, rank: usize, flight: &Flight) -> Signals {
        let last = self.rank_count() - 1;
        let (compare, front_end) = (self.pipelining.compare_rank(), self.pipelining.front_end_rank());
        let from = |computed: usize, bits: i64| if rank >= computed { bits } else { 0 };
        let [fetched, given, result] = flight.status;
        let division = rank
            .checked_sub(self.rank_of(Register::Divisor))
            .and_then(|index| flight.divisions.get(index).or(flight.divisions.last()));
        let row = self.row(flight.address);
        let shown = Signals {
            address: flight.address,
            x: if rank < compare { flight.x } else { flight.clamped_x },
            row,
            status: match rank {
                _ if rank < compare => fetched,
                _ if rank == last => result,
                _ => given,
            },
            region: if rank < compare { Region::default() } else { flight.region },
            v: from(front_end, flight.v),
            t: std::array::from_fn(|stage| from(self.rank_of(Register::T(stage + 1)), flight.t[stage])),
            tail_x: from(front_end, flight.tail_x),
            division: division.copied().unwrap_or_default(),
            intensity: from(last, flight.intensity),
            ..Signals::default()
        };
        let mut shown = if compare < front_end && rank >= compare { self.measured::<i128>(shown) } else { shown };
        if rank >= front_end {
            shown.row = row.in_segment(flight.segment);
        }
        self.with_lines(rank, &mut shown);
        shown
    }

    /// Adds the products and sums that a rank shows, where there are registers for them: they follow from what else it
    /// shows.
    fn with_lines(&self, rank: usize, shown: &mut Signals) {
        type Of = fn(usize) -> Register;
        let kept = [
            (self.pipelining.product > 1, LineStep::Partial, (|line| Register::Partial(line, 0)) as Of),
            (self.pipelining.product > 0, LineStep::Product, Register::Product),
            (self.pipelining.sum, LineStep::Sum, Register::Sum),
        ];
        for (_, step, register) in kept.into_iter().filter(|(there, ..)| *there) {
            for line in (0..=self.degree()).filter(|&line| rank >= self.rank_of(register(line))) {
                self.line_step::<i128>(line, step, shown);
            }
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
    fn dispatch(&self, datapath: &Datapath, address: u32, x: i64, keep: impl FnMut(usize, Division<i64>)) -> Flight {
        match (self.plain, datapath.narrow) {
            (Some((Rounding::NearestUp, true)), _) => {
                self.evaluate_one::<i64, Plain<true, true, 2>>(datapath, address, x, keep)
            }
            (Some((Rounding::NearestUp, false)), _) => {
                self.evaluate_one::<i64, Plain<true, false, 2>>(datapath, address, x, keep)
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
        let lines = K::lines(self.lines);
        let found = datapath.rom.row(address);
        let row = Word { row: found.unwrap_or(datapath.row_at(0)), known: found.is_some() };
        let composed = lines.compose::<L, K, Whole>(&row, L::from_bits(given), &Registers::WHOLE);
        let entered = composed.entered;
        let [fetched, status] = entered.status;
        let mut flight = Flight {
            address,
            x: given,
            clamped_x: entered.x.to_bits(),
            region: entered.region,
            segment: entered.segment,
            status: [fetched, status, composed.status],
            v: entered.v.to_bits(),
            t: composed.t.map(L::to_bits),
            tail_x: entered.tail_x.to_bits(),
            divisions: Vec::new(),
            intensity: composed.intensity.to_bits(),
        };
        if let Some(divider) = lines.divider {
            let operands = |_| {
                let [a, b] = [Register::TailA, Register::TailB].map(|name| L::from_bits(row.get(name)));
                [entered.tail_x, a, b]
            };
            let divisions = divider.divide::<L, L, Whole, 1>(
                1,
                operands,
                lines.output_one,
                &Registers::WHOLE,
                |rank, divisions| keep(rank, divisions.get(0).narrowed()),
            );
            if entered.region == Region::Tail {
                flight.intensity = divisions.quotients()[0].to_bits();
            }
        }
        flight
    }
}

/// The row at an address, or the first for one without a word.
struct Word<'a> {
    row: &'a Row,
    known: bool,
}

impl Fetched for Word<'_> {
    #[inline(always)]
    fn get(&self, field: Register) -> i64 {
        self.row.get(field)
    }
    #[inline(always)]
    fn known(&self) -> bool {
        self.known
    }
}
