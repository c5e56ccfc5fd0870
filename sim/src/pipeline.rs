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

use hw_model::datapath::{Datapath, Flight, Logic, Signals, Slots, Status};

/// What drives the pipeline during one cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inputs {
    /// Clears every valid flag at the edge.
    pub reset: bool,
    /// Address and x are a request.
    pub in_valid: bool,
    /// ROM address.
    pub address: u32,
    /// x, bits in the input format.
    pub x: i64,
    /// Whoever takes the results can take one.
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
    /// The valid flag.
    pub valid: bool,
    /// False until data is loaded for the first time: hardware shows unknown values there.
    pub loaded: bool,
    /// The data registers.
    pub signals: Signals,
}

/// The registers of every rank, first rank first. They are put together when they are asked for.
#[derive(Debug, Clone, Copy)]
pub struct Ranks<'a> {
    datapath: &'a Datapath,
    valid: u128,
    slots: &'a Slots,
    flights: &'a [Flight],
}

impl<'a> Ranks<'a> {
    /// One rank.
    ///
    /// # Panics
    /// When there is no such rank.
    #[must_use]
    pub fn rank(&self, rank: usize) -> Rank {
        let flight = self.flights.get(usize::from(self.slots.get(rank)));
        Rank {
            valid: self.valid >> rank & 1 == 1,
            loaded: flight.is_some(),
            signals: flight.map(|flight| self.datapath.shown(rank, flight)).unwrap_or_default(),
        }
    }

    /// All of them.
    pub fn iter(self) -> impl Iterator<Item = Rank> + use<'a> {
        (0..self.slots.ranks()).map(move |rank| self.rank(rank))
    }

    /// The last, which shows the result.
    #[must_use]
    pub fn last(&self) -> Rank {
        self.rank(self.slots.ranks() - 1)
    }

    /// The number of valid flags that are set.
    #[must_use]
    pub const fn in_flight(&self) -> u32 {
        self.valid.count_ones()
    }
}

/// The clocked pipeline of one configuration.
///
/// A rank holds the number of the request it shows (see [`Flight`]); a flag of every rank is a bit of one word.
/// So a cycle moves a few bytes, computes the request that enters, and allocates nothing.
#[derive(Debug, Clone)]
pub struct Pipeline<'a> {
    datapath: &'a Datapath,
    logic: Logic,
    /// Every rank's bit.
    all: u128,
    valid_q: u128,
    valid_d: u128,
    /// The ranks that load at the edge.
    loads_d: u128,
    request_d: (u32, i64),
    /// The request that each rank shows; [`NOTHING`] before the first.
    slots: Slots,
    flights: Vec<Flight>,
    /// Requests that no rank shows. Ranks show as many as they are at most, so with one more there is always
    /// room for the next.
    free: Vec<u8>,
}

/// The number of no request. A division has 63 quotient bits at most, so there are far fewer ranks.
const NOTHING: u8 = u8::MAX;

impl<'a> Pipeline<'a> {
    /// An empty pipeline, as after reset.
    #[must_use]
    pub fn new(datapath: &'a Datapath) -> Self {
        let ranks = datapath.rank_count();
        debug_assert!(ranks < 128);
        Self {
            datapath,
            logic: datapath.logic(),
            all: (1 << ranks) - 1,
            valid_q: 0,
            valid_d: 0,
            loads_d: 0,
            request_d: (0, 0),
            slots: Slots::new(ranks, NOTHING),
            flights: vec![datapath.flight(); ranks + 1],
            free: (0..=ranks as u8).collect(),
        }
    }

    /// The data path.
    #[must_use]
    pub const fn datapath(&self) -> &'a Datapath {
        self.datapath
    }

    /// The registers as they are before the next edge.
    #[must_use]
    pub fn ranks(&self) -> Ranks<'_> {
        let Self { datapath, valid_q: valid, slots, flights, .. } = self;
        Ranks { datapath, valid: *valid, slots, flights }
    }

    /// True when no rank holds a request.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.valid_q == 0
    }

    /// One clock cycle: what an RTL simulator shows at the rising edge, and then the edge.
    #[inline]
    pub fn tick(&mut self, inputs: &Inputs) -> Outputs {
        let outputs = self.combinational(inputs);
        self.clock();
        outputs
    }

    /// The outputs of a cycle with these inputs, and what follows for every rank.
    ///
    /// Rule 2, written out: a rank advances when the output is taken or any rank from it on is empty, that is,
    /// when it is not above the last empty one.
    #[inline]
    pub fn combinational(&mut self, inputs: &Inputs) -> Outputs {
        let empty = self.all & !self.valid_q;
        let upto_last_empty = u128::MAX.checked_shr(empty.leading_zeros()).unwrap_or(0);
        let advance = if inputs.out_ready { self.all } else { upto_last_empty };
        let request = inputs.in_valid && !inputs.reset;
        let offered = (self.valid_q << 1 | u128::from(request)) & self.all;
        self.loads_d = advance & offered;
        let valid = self.loads_d | (self.valid_q & !advance);
        self.valid_d = if inputs.reset { 0 } else { valid };
        self.request_d = (inputs.address, inputs.x);
        let last = self.slots.ranks() - 1;
        let shown = self.flights.get(usize::from(self.slots.get(last)));
        Outputs {
            in_ready: advance & 1 == 1 && !inputs.reset,
            out_valid: self.valid_q >> last & 1 == 1,
            intensity: shown.map_or(0, Flight::intensity),
            status: shown.map_or(Status::default(), Flight::status),
        }
    }

    /// The rising edge.
    #[inline]
    pub fn clock(&mut self) {
        self.valid_q = self.valid_d;
        if self.loads_d != 0 {
            self.shift();
        }
    }

    /// Gives every loading rank the request of the rank before it, or the new one.
    #[inline]
    fn shift(&mut self) {
        let last = self.slots.ranks() - 1;
        if self.loads_d == self.all && self.slots.get(last) != NOTHING {
            // What the last rank gives up is the new one's.
            self.slots.turn();
            self.enter();
            return;
        }
        let mut after = NOTHING;
        for rank in (1..=last).rev() {
            let shown = self.slots.get(rank);
            if self.loads_d >> rank & 1 == 1 {
                self.drop_unless(after, shown);
                self.slots.set(rank, self.slots.get(rank - 1));
            }
            after = self.slots.get(rank);
        }
        if self.loads_d & 1 == 1 {
            self.drop_unless(after, self.slots.get(0));
            if let Some(slot) = self.free.pop() {
                self.slots.set(0, slot);
                self.enter();
            }
        }
    }

    #[inline]
    fn enter(&mut self) {
        let (address, x) = self.request_d;
        let slot = usize::from(self.slots.get(0));
        self.logic.enter(self.datapath, address, x, &mut self.flights[slot]);
    }

    /// A request that a rank gives up is free, unless the rank after it shows it. (Those before a rank show later
    /// ones, or the one that it takes in.)
    #[inline]
    fn drop_unless(&mut self, after: u8, shown: u8) {
        if shown != after && shown != NOTHING {
            self.free.push(shown);
        }
    }
}
