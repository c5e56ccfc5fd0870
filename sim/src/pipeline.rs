//! Registers, clock and handshake around the model's data path. Nothing is computed here.
//!
//! A cycle has two phases. *Combinational*: from the registers (`_q`) and the inputs follow the
//! outputs and what every register will take in (`_d`). *Clock*: `_d` becomes `_q`.
//!
//! Handshake rules:
//!
//! 1. A transfer takes place at a rising edge where valid and ready are both high and reset is low.
//! 2. A rank advances when it is empty or the rank after it advances; the last one when it is empty or
//!    `out_ready` is high. So bubbles collapse, and a stall holds every bit.
//! 3. `out_valid` depends on registers only, never on `out_ready` or `in_valid`.
//! 4. Reset is synchronous and clears the valid flags; `in_ready` is low while it is high. What was
//!    in flight is lost.
//! 5. A rank's data registers are loaded when it advances and a request is offered to it; a bubble does
//!    not change them. Reset does not gate that in ranks from 1 up; only their flags become 0.

use std::ops::Deref;

use hw_model::datapath::{Datapath, Flight, Logic, Requests, Signals, Status};

/// What drives the pipeline during one cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inputs {
    /// Clears every valid flag at the edge.
    pub reset: bool,
    /// Address and x are a request.
    pub in_valid: bool,
    /// The request's ROM address.
    pub address: u32,
    /// x, bits in the input format.
    pub x: i64,
    /// The receiver of the results can take one.
    pub out_ready: bool,
}

/// What the pipeline shows at the edge that ends the cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Outputs {
    /// The request is taken if it is valid.
    pub in_ready: bool,
    /// Intensity and status are a result.
    pub out_valid: bool,
    /// Bits in the output format.
    pub intensity: i64,
    /// Flags of the result.
    pub status: Status,
}

/// One rank of registers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rank {
    /// True when the rank holds a request.
    pub valid: bool,
    /// False until data is loaded for the first time: hardware shows unknown values there.
    pub loaded: bool,
    /// What the data registers of the rank hold.
    pub signals: Signals,
}

/// The registers of every rank, first rank first. They are put together when they are asked for.
#[derive(Debug, Clone, Copy)]
pub struct Ranks<'a> {
    datapath: &'a Datapath,
    ranks: usize,
    places: Places,
    flights: &'a [Flight],
    remains: &'a Remains,
}

impl<'a> Ranks<'a> {
    /// One rank.
    ///
    /// # Panics
    /// When there is no such rank.
    #[must_use]
    pub fn rank(&self, rank: usize) -> Rank {
        assert!(rank < self.ranks);
        let flight = match self.places.shown(rank) {
            Some(number) => Some(&self.flights[number as usize & (self.flights.len() - 1)]),
            None => self.remains.shown(rank),
        };
        Rank {
            valid: self.places.valid >> rank & 1 == 1,
            loaded: flight.is_some(),
            signals: flight.map(|flight| self.datapath.shown(rank, flight)).unwrap_or_default(),
        }
    }

    /// Every rank, the first one first.
    pub fn iter(self) -> impl Iterator<Item = Rank> + use<'a> {
        (0..self.ranks).map(move |rank| self.rank(rank))
    }

    /// The last, which shows the result.
    #[must_use]
    pub fn last(&self) -> Rank {
        self.rank(self.ranks - 1)
    }

    /// The valid flags, the first rank's in bit 0.
    #[must_use]
    pub const fn valid(&self) -> u128 {
        self.places.valid
    }

    /// The number of valid flags that are set.
    #[must_use]
    pub const fn in_flight(&self) -> u32 {
        self.places.valid.count_ones()
    }
}

/// Where the requests are. They are numbered as they enter.
///
/// Requests do not overtake each other, so the valid flags and the number of those that have left say which request
/// stands where: behind a rank are those that left and one for each valid flag from it on. The last of these is what
/// the rank shows, whether it still holds it or has passed it on.
#[derive(Debug, Clone, Copy)]
struct Places {
    /// A flag of every rank is a bit.
    valid: u128,
    /// Requests that left, counting those that a reset lost.
    left: u64,
    /// The same when the last reset ended.
    before: u64,
}

impl Places {
    /// The number of the request that a rank shows; none before it has loaded one since the last reset.
    #[inline]
    fn shown(&self, rank: usize) -> Option<u64> {
        let passed = self.left + u64::from((self.valid >> rank).count_ones());
        (passed > self.before).then(|| passed - 1)
    }
}

/// What ranks showed at the last reset, which clears flags but no data.
#[derive(Debug, Clone)]
struct Remains {
    /// Ranks that had loaded a request: a bit each.
    loaded: u128,
    flights: Vec<Flight>,
}

impl Remains {
    fn shown(&self, rank: usize) -> Option<&Flight> {
        (self.loaded >> rank & 1 == 1).then(|| &self.flights[rank])
    }
}

/// What the rising edge brings.
#[derive(Debug, Clone, Copy, Default)]
struct Edge {
    /// The valid flags behind it, were there no reset.
    valid: u128,
    reset: bool,
    /// The first rank takes a request in.
    takes: bool,
    /// The last one gives its result away.
    leaves: bool,
    address: u32,
    x: i64,
}

/// Results that are computed together: as many as a vector register has lanes.
const TOGETHER: usize = 8;

/// Places for requests: more than there are ranks, and as many again as are computed together. A division has 63
/// quotient bits at most, so there are fewer than 128 ranks.
const PLACES: usize = 256;

/// The clocked pipeline of a data path that its caller keeps.
pub type Pipeline<'a> = Clocked<&'a Datapath>;

/// The clocked pipeline of one configuration, whose data path `D` refers to: by a reference ([`Pipeline`]), or by a
/// shared pointer where the pipeline must live by itself, as in a library that other languages call.
///
/// A cycle moves flags and counters only, and allocates nothing. Results are computed when the first of them comes to
/// the output, side by side for all requests that have entered by then. What other registers hold is computed when
/// a caller asks for it ([`Pipeline::ranks`]).
#[derive(Debug, Clone)]
pub struct Clocked<D> {
    datapath: D,
    logic: Logic,
    ranks: usize,
    /// Every rank's bit, and the last one's.
    all: u128,
    last: u128,
    places_q: Places,
    edge_d: Edge,
    /// The number of requests that entered so far.
    entered: u64,
    /// The last of them, each in the place of its number, with their results.
    requests: Box<Requests<PLACES, TOGETHER>>,
    /// Requests up to this one have a result.
    answered: u64,
    /// The same with all their values, of requests up to `looked_at`.
    flights: Vec<Flight>,
    looked_at: u64,
    remains: Remains,
}

impl<D: Deref<Target = Datapath>> Clocked<D> {
    /// An empty pipeline, as after reset.
    #[must_use]
    pub fn new(datapath: D) -> Self {
        let ranks = datapath.rank_count();
        debug_assert!(ranks < 128);
        Self {
            logic: datapath.logic(),
            ranks,
            all: (1 << ranks) - 1,
            last: 1 << (ranks - 1),
            places_q: Places { valid: 0, left: 0, before: 0 },
            edge_d: Edge::default(),
            entered: 0,
            requests: datapath.requests(),
            answered: 0,
            flights: vec![datapath.flight(); (ranks + 1).next_power_of_two()],
            looked_at: 0,
            remains: Remains { loaded: 0, flights: vec![datapath.flight(); ranks] },
            datapath,
        }
    }

    /// The data path that is clocked.
    #[must_use]
    pub fn datapath(&self) -> &Datapath {
        &self.datapath
    }

    /// The registers as they are before the next edge.
    #[must_use]
    pub fn ranks(&mut self) -> Ranks<'_> {
        let places = self.flights.len() as u64;
        for number in self.looked_at.max(self.entered.saturating_sub(places))..self.entered {
            let (address, x) = self.request(number);
            let place = number as usize & (self.flights.len() - 1);
            self.logic.enter(&self.datapath, address, x, &mut self.flights[place]);
        }
        self.looked_at = self.entered;
        let Self { datapath, ranks, places_q: places, flights, remains, .. } = self;
        Ranks { datapath, ranks: *ranks, places: *places, flights, remains }
    }

    /// True when no rank holds a request.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.places_q.valid == 0
    }

    /// One clock cycle: what an RTL simulator shows at the rising edge, and then the edge.
    #[inline(always)]
    pub fn tick(&mut self, inputs: &Inputs) -> Outputs {
        let (outputs, edge) = self.cycle(inputs);
        self.rise(edge);
        outputs
    }

    /// The outputs of a cycle with these inputs, and what follows for every rank.
    #[inline(always)]
    pub fn combinational(&mut self, inputs: &Inputs) -> Outputs {
        let (outputs, edge) = self.cycle(inputs);
        self.edge_d = edge;
        outputs
    }

    /// The rising edge of the clock: registers take in what the combinational phase found.
    #[inline(always)]
    pub fn clock(&mut self) {
        self.rise(self.edge_d);
    }

    /// The combinational phase. Rule 2, written out: a rank advances when the output is taken or any rank from it on is
    /// empty, that is, when it is not above the last empty one.
    #[inline(always)]
    fn cycle(&mut self, inputs: &Inputs) -> (Outputs, Edge) {
        let Inputs { reset, address, x, .. } = *inputs;
        let valid = self.places_q.valid;
        // A full pipeline that moves stays full.
        if valid == self.all && inputs.in_valid && inputs.out_ready && !reset {
            let (intensity, status) = self.next_result();
            let edge = Edge { valid, reset, takes: true, leaves: true, address, x };
            return (Outputs { in_ready: true, out_valid: true, intensity, status }, edge);
        }
        let request = inputs.in_valid && !reset;
        let offered = (valid << 1 | u128::from(request)) & self.all;
        let (valid_d, advances) = if inputs.out_ready {
            (offered, true)
        } else {
            let empty = self.all & !valid;
            let advance = u128::MAX.checked_shr(empty.leading_zeros()).unwrap_or(0);
            (advance & offered | valid & !advance, empty != 0)
        };
        let out_valid = valid & self.last != 0;
        let (intensity, status) = if out_valid { self.next_result() } else { self.last_result() };
        let in_ready = advances && !reset;
        let (takes, leaves) = (request && advances, out_valid && inputs.out_ready);
        let edge = Edge { valid: valid_d, reset, takes, leaves, address, x };
        (Outputs { in_ready, out_valid, intensity, status }, edge)
    }

    #[inline(always)]
    fn rise(&mut self, edge: Edge) {
        if edge.takes {
            let place = place(self.entered);
            (self.requests.addresses[place], self.requests.xs[place]) = (edge.address, edge.x);
            self.entered += 1;
            if self.entered - self.answered == TOGETHER as u64 {
                self.answer();
            }
        }
        self.places_q.valid = edge.valid;
        self.places_q.left += u64::from(edge.leaves);
        if edge.reset {
            self.reset();
        }
    }

    /// The result of the request that leaves next.
    #[inline(always)]
    fn next_result(&mut self) -> (i64, Status) {
        if self.answered <= self.places_q.left {
            self.answer();
        }
        self.result(self.places_q.left)
    }

    /// Computes results from the first request on that has none. Places behind the last request hold others, which
    /// get the result that they had.
    #[inline(never)]
    fn answer(&mut self) {
        let first = place(self.answered);
        let end = self.logic.evaluate(&self.datapath, &mut self.requests, first);
        self.answered = self.entered.min(self.answered + (end - first) as u64);
    }

    #[inline(always)]
    fn result(&self, number: u64) -> (i64, Status) {
        let place = place(number);
        (self.requests.intensities()[place], self.requests.status(place))
    }

    #[inline(always)]
    fn request(&self, number: u64) -> (u32, i64) {
        let place = place(number);
        (self.requests.addresses[place], self.requests.xs[place])
    }

    /// What the last rank shows while it is empty: what it held before.
    fn last_result(&self) -> (i64, Status) {
        let last = self.ranks - 1;
        if let Some(number) = self.places_q.shown(last) {
            return self.result(number);
        }
        self.remains.shown(last).map_or_else(Default::default, |flight| (flight.intensity(), flight.status()))
    }

    /// The flags become 0, and all requests are lost; what ranks show of them stays.
    #[cold]
    fn reset(&mut self) {
        for rank in 0..self.ranks {
            if let Some(number) = self.places_q.shown(rank) {
                let (address, x) = self.request(number);
                let flight = &mut self.remains.flights[rank];
                self.logic.enter(&self.datapath, address, x, flight);
                self.remains.loaded |= 1 << rank;
            }
        }
        self.places_q = Places { valid: 0, left: self.entered, before: self.entered };
        self.answered = self.entered;
    }
}

#[inline(always)]
const fn place(number: u64) -> usize {
    number as usize % PLACES
}
