//! Drives the pipeline with a stimulus, cycle by cycle, and counts what happens.
//!
//! The driver keeps the handshake rule: a request that is not taken stays presented, unchanged, and
//! those after it wait. A row of the stimulus is a cycle: its request may be presented from that
//! cycle on, its ready and reset apply in that very cycle. After the last row the pipeline runs
//! with ready high until it is empty.

use std::collections::VecDeque;

use hw_model::datapath::Status;
use vectors::StimulusLine;

use crate::pipeline::{Inputs, Outputs, Pipeline, Ranks};

/// One cycle of stimulus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StimulusCycle {
    /// A request (address, x), or a bubble.
    pub request: Option<(u32, i64)>,
    /// Whether results can be taken in this cycle.
    pub ready: bool,
    /// Whether reset is high in this cycle.
    pub reset: bool,
}

impl From<&StimulusLine> for StimulusCycle {
    /// What a line of a stimulus file drives.
    fn from(line: &StimulusLine) -> Self {
        let request = line.valid.then_some((line.case.address, line.case.x));
        Self { request, ready: line.ready, reset: line.reset }
    }
}

/// Everything visible in one cycle, at the rising edge that ends it.
#[derive(Debug, Clone, Copy)]
pub struct Cycle<'a> {
    /// The number of the cycle, counted from 0.
    pub index: u64,
    /// The levels at the input ports.
    pub inputs: &'a Inputs,
    /// What the pipeline showed.
    pub outputs: &'a Outputs,
    /// Every register before the edge.
    pub ranks: Ranks<'a>,
}

/// What a run counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Counts {
    /// The number of clock cycles.
    pub cycles: u64,
    /// The number of requests that the pipeline took.
    pub requests: u64,
    /// The number of results that were taken from it.
    pub results: u64,
    /// Requests and results lost to a reset.
    pub lost_to_reset: u64,
    /// Cycles in which a result waited because it was not taken. (In a reset it does not wait: it is lost.)
    pub stalls: u64,
    /// Cycles in which the pipeline could take a request and there was none, before the last request.
    pub bubbles: u64,
    /// Cycle of the first request taken.
    first_request: Option<u64>,
    /// Cycle of the last request taken.
    last_request: Option<u64>,
    /// Cycle of the first result taken.
    first_result: Option<u64>,
    /// Cycle of the last result taken.
    last_result: Option<u64>,
    /// Bubbles after the last request so far; they count once another request follows.
    trailing_bubbles: u64,
}

impl Counts {
    /// Mean number of cycles from one request taken to the next; `None` for fewer than two.
    #[must_use]
    pub fn initiation_interval(&self) -> Option<f64> {
        let (first, last) = (self.first_request?, self.last_request?);
        let gaps = self.requests.checked_sub(1).filter(|&gaps| gaps > 0)?;
        Some((last - first) as f64 / gaps as f64)
    }

    /// Cycles for a million results at the rate at which they came, from the first to the last: without those in which
    /// the pipeline fills and empties. `None` for fewer than two.
    #[must_use]
    pub fn cycles_per_million(&self) -> Option<f64> {
        let (first, last) = (self.first_result?, self.last_result?);
        let gaps = self.results.checked_sub(1).filter(|&gaps| gaps > 0)?;
        Some((last - first) as f64 * 1e6 / gaps as f64)
    }

    /// `under_way` is the number of requests in the pipeline before the cycle.
    fn count(&mut self, cycle: &Cycle<'_>, under_way: u32) {
        let Cycle { inputs, outputs, ranks, .. } = cycle;
        self.cycles += 1;
        let taken = inputs.in_valid && outputs.in_ready && !inputs.reset;
        let due = outputs.out_valid && !inputs.reset;
        let taken_from_it = due && ranks.control().takes(inputs.out_ready);
        if taken {
            self.requests += 1;
            self.bubbles += std::mem::take(&mut self.trailing_bubbles);
            self.first_request.get_or_insert(cycle.index);
            self.last_request = Some(cycle.index);
        } else if outputs.in_ready && self.first_request.is_some() {
            self.trailing_bubbles += 1;
        }
        if taken_from_it {
            self.results += 1;
            self.first_result.get_or_insert(cycle.index);
            self.last_result = Some(cycle.index);
        }
        self.stalls += u64::from(due && !taken_from_it);
        if inputs.reset {
            self.lost_to_reset += u64::from(under_way);
        }
    }
}

/// Runs the stimulus to its end and until the pipeline is empty; `observe` sees every cycle.
///
/// # Errors
/// The first error of `observe`.
pub fn run<E>(
    pipeline: &mut Pipeline<'_>,
    stimulus: impl IntoIterator<Item = Result<StimulusCycle, E>>,
    mut observe: impl FnMut(&Cycle<'_>) -> Result<(), E>,
) -> Result<Counts, E> {
    let mut counts = Counts::default();
    let mut waiting = VecDeque::new();
    let mut stimulus = stimulus.into_iter();
    loop {
        let row = stimulus.next().transpose()?;
        if row.is_none() && waiting.is_empty() && pipeline.is_empty() {
            return Ok(counts);
        }
        waiting.extend(row.and_then(|row| row.request));
        let inputs = inputs(row, waiting.front().copied());
        let under_way = pipeline.in_flight();
        let outputs = pipeline.combinational(&inputs);
        let cycle = Cycle { index: counts.cycles, inputs: &inputs, outputs: &outputs, ranks: pipeline.ranks() };
        observe(&cycle)?;
        counts.count(&cycle, under_way);
        pipeline.clock();
        if inputs.in_valid && outputs.in_ready && !inputs.reset {
            waiting.pop_front();
        }
    }
}

/// What the last edge of a run brought: the registers behind it, with nothing presented and ready high. `cycles` went
/// before; this one has no edge, and does not count.
pub fn settle<R>(pipeline: &mut Pipeline<'_>, cycles: u64, observe: impl FnOnce(&Cycle<'_>) -> R) -> R {
    let inputs = inputs(None, None);
    let outputs = pipeline.combinational(&inputs);
    let ranks = pipeline.ranks();
    observe(&Cycle { index: cycles, inputs: &inputs, outputs: &outputs, ranks })
}

fn inputs(row: Option<StimulusCycle>, request: Option<(u32, i64)>) -> Inputs {
    let (address, x) = request.unwrap_or_default();
    Inputs {
        reset: row.is_some_and(|row| row.reset),
        in_valid: request.is_some(),
        address,
        x,
        out_ready: row.is_none_or(|row| row.ready),
    }
}

/// A result that was taken, with the request that it answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Taken {
    /// The cycle in which it was taken.
    pub cycle: u64,
    /// The request's address and x.
    pub request: (u32, i64),
    /// The intensity, bits in the output format.
    pub intensity: i64,
    /// The flags.
    pub status: Status,
}

/// Finds the request of every result: requests do not overtake each other, and a reset loses those under way.
#[derive(Debug, Clone, Default)]
pub struct Results {
    under_way: VecDeque<(u32, i64)>,
}

impl Results {
    /// The result that was taken in this cycle. Every cycle of a run is to be shown, in order.
    pub fn cycle(&mut self, cycle: &Cycle<'_>) -> Option<Taken> {
        let Cycle { index, inputs, outputs, ranks } = cycle;
        if inputs.reset {
            self.under_way.clear();
            return None;
        }
        let taken = outputs.out_valid && ranks.control().takes(inputs.out_ready);
        let request = if taken { self.under_way.pop_front() } else { None };
        if inputs.in_valid && outputs.in_ready {
            self.under_way.push_back((inputs.address, inputs.x));
        }
        let (intensity, status) = (outputs.intensity, outputs.status);
        request.map(|request| Taken { cycle: *index, request, intensity, status })
    }
}
