//! Many cycles at a time, for a stream without stalls.
//!
//! While results are always taken, a request that is taken in cycle c stands in rank r during cycle c + 1 + r,
//! whatever comes before and after it. So the results of many cycles can be computed side by side, and the registers
//! of any cycle are then those of the request that stands there: [`Stream::rank`] shows what
//! [`Pipeline`](crate::pipeline::Pipeline) shows, bubbles included.

use hw_model::datapath::{Datapath, Flight, Logic, Requests, Status};

use crate::pipeline::{Outputs, Rank};

/// Cycles that are computed together; more than there can be ranks, since a division has 63 quotient bits at most.
pub const CYCLES: usize = 128;

/// A stream under way.
#[derive(Debug, Clone)]
pub struct Stream<'a> {
    datapath: &'a Datapath,
    logic: Logic,
    ranks: usize,
    /// Cycles before those of `now`.
    begin: u64,
    now: Cycles,
    before: Cycles,
    /// The last request before those of `before`.
    earlier: Option<Flight>,
}

/// The requests of some cycles, one for each cycle; in a bubble it stands for nothing and has no result.
#[derive(Debug, Clone)]
struct Cycles {
    requests: Box<Requests<CYCLES, CYCLES>>,
    valid: [bool; CYCLES],
}

impl Cycles {
    fn last_request(&self, upto: usize) -> Option<usize> {
        (0..=upto).rev().find(|&cycle| self.valid[cycle])
    }
}

impl<'a> Stream<'a> {
    /// An empty pipeline, as after reset, before its first cycle.
    #[must_use]
    pub fn new(datapath: &'a Datapath) -> Self {
        let cycles = Cycles { requests: datapath.requests(), valid: [false; CYCLES] };
        Self {
            datapath,
            logic: datapath.logic(),
            ranks: datapath.rank_count(),
            begin: 0,
            now: cycles.clone(),
            before: cycles,
            earlier: None,
        }
    }

    /// The next [`CYCLES`] cycles. `drive` writes the inputs of each: addresses, x, and whether they are a
    /// request.
    #[inline]
    pub fn run(&mut self, drive: impl FnOnce(&mut [u32; CYCLES], &mut [i64; CYCLES], &mut [bool; CYCLES])) {
        if let Some(last) = self.before.last_request(CYCLES - 1) {
            self.earlier = Some(self.flight(&self.before, last));
        }
        std::mem::swap(&mut self.now, &mut self.before);
        let Cycles { requests, valid } = &mut self.now;
        drive(&mut requests.addresses, &mut requests.xs, valid);
        self.logic.evaluate(self.datapath, requests, 0);
        self.begin += CYCLES as u64;
    }

    /// The results of the requests of the last [`run`](Self::run), and which of them are requests; result k
    /// is shown a latency after cycle k.
    #[must_use]
    pub fn results(&self) -> (&[i64; CYCLES], &[bool; CYCLES]) {
        (self.now.requests.intensities(), &self.now.valid)
    }

    /// The flags of one of these results.
    #[must_use]
    pub fn status(&self, result: usize) -> Status {
        self.now.requests.status(result)
    }

    /// The registers of a rank before the edge of a cycle, counted in the last [`run`](Self::run).
    ///
    /// # Panics
    /// When the stream has fewer cycles.
    #[must_use]
    pub fn rank(&self, cycle: usize, rank: usize) -> Rank {
        assert!(cycle < CYCLES);
        // Counted from the first of the cycles before. There are fewer ranks than cycles.
        let entered = CYCLES + cycle - 1 - rank;
        let flight = self.request_upto(entered);
        let valid = if entered < CYCLES { self.before.valid[entered] } else { self.now.valid[entered - CYCLES] };
        let signals = flight.as_ref().map(|flight| self.datapath.shown(rank, flight));
        Rank { valid, loaded: signals.is_some(), signals: signals.unwrap_or_default() }
    }

    /// What the ports show in a cycle.
    #[must_use]
    pub fn outputs(&self, cycle: usize) -> Outputs {
        let last = self.rank(cycle, self.ranks - 1);
        let Rank { valid, signals, .. } = last;
        Outputs { in_ready: true, out_valid: valid, intensity: signals.intensity, status: signals.status }
    }

    /// The last request taken up to a cycle.
    fn request_upto(&self, cycle: usize) -> Option<Flight> {
        let now = cycle.checked_sub(CYCLES).and_then(|cycle| self.now.last_request(cycle));
        if let Some(cycle) = now {
            return Some(self.flight(&self.now, cycle));
        }
        match self.before.last_request(cycle.min(CYCLES - 1)) {
            Some(cycle) => Some(self.flight(&self.before, cycle)),
            None => self.earlier.clone(),
        }
    }

    fn flight(&self, cycles: &Cycles, cycle: usize) -> Flight {
        cycles.requests.flight(self.datapath, &self.logic, cycle)
    }

    /// Cycles computed so far.
    #[must_use]
    pub const fn cycles(&self) -> u64 {
        self.begin
    }
}
