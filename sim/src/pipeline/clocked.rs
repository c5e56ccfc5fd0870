//! The clock: one cycle after another.

use std::ops::Deref;

use hw_model::datapath::{Datapath, Flight, Logic, Requests, Status};
use hw_model::handshake::Control;

use super::places::{Places, Remains};
use super::ports::{Inputs, Outputs};
use super::ranks::{Ranks, advance};
use crate::slice::Slices;

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
    control: Control,
    /// True where the rules are those above and no slice stands anywhere.
    plain: bool,
    slices_q: Slices,
    /// The same behind the next edge, were there no reset.
    slices_d: Slices,
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
        let control = *datapath.control();
        debug_assert!(ranks < 128);
        Self {
            logic: datapath.logic(),
            ranks,
            control,
            plain: control == Control::default(),
            slices_q: Slices::of(&control),
            slices_d: Slices::of(&control),
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
        let Self { datapath, ranks, places_q: places, flights, remains, slices_q: slices, .. } = self;
        Ranks { datapath, ranks: *ranks, places: *places, flights, remains, slices }
    }

    /// The register slices as they are before the next edge.
    #[must_use]
    pub const fn slices(&self) -> &Slices {
        &self.slices_q
    }

    /// True when no rank and no slice holds a request.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.in_flight() == 0
    }

    /// The number of requests under way, in ranks and in slices.
    #[must_use]
    pub fn in_flight(&self) -> u32 {
        self.places_q.valid.count_ones() + self.slices_q.in_flight()
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

    /// The combinational phase: of the ranks alone, or with what else stands around them.
    #[inline(always)]
    fn cycle(&mut self, inputs: &Inputs) -> (Outputs, Edge) {
        if self.plain { self.cycle_of_ranks(inputs) } else { self.cycle_in_control(inputs) }
    }

    /// The ranks between the slices, where there are any. Reset and what is presented are told to both.
    #[inline(never)]
    fn cycle_in_control(&mut self, inputs: &Inputs) -> (Outputs, Edge) {
        let reset = self.control.reset;
        if inputs.reset && reset.is_asynchronous() {
            self.clear();
        }
        let Slices { input, output } = self.slices_q;
        let mut of_ranks = *inputs;
        if let Some(slice) = input {
            of_ranks.in_valid = slice.head_valid;
            (of_ranks.address, of_ranks.x) = slice.head.unwrap_or_default();
        }
        if let Some(slice) = output {
            of_ranks.out_ready = !slice.spare_valid;
        }
        let (ranks, edge) = self.cycle_of_ranks(&of_ranks);
        // The ranks' own ready, which a reset does not hide from the slice before them.
        let advances = self.advance(of_ranks.out_ready) & 1 == 1;
        let room = input.map_or(advances, |slice| !slice.spare_valid);
        let mut outputs = Outputs { in_ready: room && (reset.ready || !inputs.reset), ..ranks };
        if let Some(slice) = input {
            let offered = (inputs.in_valid && !inputs.reset).then_some((inputs.address, inputs.x));
            self.slices_d.input = Some(slice.next(offered, advances));
        }
        if let Some(slice) = output {
            let offered = ranks.out_valid.then_some((ranks.intensity, ranks.status));
            self.slices_d.output = Some(slice.next(offered, inputs.out_ready));
            let (intensity, status) = slice.head.unwrap_or_default();
            outputs = Outputs { out_valid: slice.head_valid, intensity, status, ..outputs };
        }
        (outputs, edge)
    }

    #[inline(always)]
    fn advance(&self, ready: bool) -> u128 {
        advance(self.control.handshake, self.places_q.valid, self.all, ready)
    }

    /// The combinational phase of the ranks alone.
    #[inline(always)]
    fn cycle_of_ranks(&mut self, inputs: &Inputs) -> (Outputs, Edge) {
        let Inputs { reset, address, x, .. } = *inputs;
        let valid = self.places_q.valid;
        // A full pipeline that moves stays full.
        if valid == self.all && inputs.in_valid && inputs.out_ready && !reset {
            let (intensity, status) = self.next_result();
            let edge = Edge { valid, reset, takes: true, leaves: true, address, x };
            return (Outputs { in_ready: true, out_valid: true, intensity, status }, edge);
        }
        let advance = self.advance(inputs.out_ready);
        let request = inputs.in_valid && !reset;
        let offered = (valid << 1 | u128::from(request)) & self.all;
        let out_valid = valid & self.last != 0;
        let (intensity, status) = if out_valid { self.next_result() } else { self.last_result() };
        let first = advance & 1 == 1;
        let edge = Edge {
            valid: advance & offered | valid & !advance,
            reset,
            takes: request && first,
            leaves: out_valid && advance & self.last != 0,
            address,
            x,
        };
        (Outputs { in_ready: first && !reset, out_valid, intensity, status }, edge)
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
        if !self.plain {
            self.slices_q = self.slices_d;
        }
        if edge.reset {
            self.clear();
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

    /// The flags become 0, and all requests are lost; what ranks show of them stays. Doing it again changes nothing.
    #[cold]
    fn clear(&mut self) {
        self.slices_q = self.slices_q.cleared();
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
