//! A DUT's ports, and its registers where they are seen, held against the clocked model in every cycle.
//!
//! Before the first reset hardware may show anything: comparing begins with the cycle after it. What the registers of
//! a rank hold before the rank has loaded a request is not compared, and a result only while one is due.

use std::collections::VecDeque;
use std::fmt;

use hw_model::handshake::ReadySlice;
use sim::pipeline::{Inputs, Outputs, Rank};

use crate::clocked::Clocked;
use crate::difference::{Departure, Difference, Request, check_word};
use crate::handle::Model;

/// The ports of a DUT at a rising edge. What is x or z is `None`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Seen {
    /// The level of `rst_i`.
    pub reset: Option<bool>,
    /// The level of `in_valid_i`.
    pub in_valid: Option<bool>,
    /// The level of `in_ready_o`.
    pub in_ready: Option<bool>,
    /// The word on `address_i`.
    pub address: Option<u32>,
    /// The word on `x_i`; bits above its width are ignored.
    pub x: Option<u64>,
    /// The level of `out_valid_o`.
    pub out_valid: Option<bool>,
    /// The level of `out_ready_i`.
    pub out_ready: Option<bool>,
    /// The word on `intensity_o`.
    pub intensity: Option<u64>,
    /// The word on `status_o`.
    pub status: Option<u64>,
}

/// What was seen so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Clock cycles.
    pub cycles: u64,
    /// Results taken.
    pub results: u64,
    /// Cycles in which a result waited.
    pub stalls: u64,
    /// Cycles in which a request could have been taken and there was none.
    pub bubbles: u64,
    /// Times that reset went high, after the first.
    pub resets: u64,
    /// Values compared: intensity and status of results, and registers.
    pub compared: u64,
    /// Cycles in which something differed.
    pub failures: u64,
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cycles, stalls, bubbles, resets, compared, .. } = self;
        write!(f, "{cycles} cycles, {stalls} stalls, {bubbles} bubbles, {resets} resets, {compared} values compared")
    }
}

/// What a scoreboard says in the end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verdict {
    /// Whether results were taken, and nothing differed.
    pub passed: bool,
    /// The line that begins with `PASS` or `FAIL`.
    pub line: String,
}

/// Judges a DUT cycle by cycle.
///
/// ```
/// use model::{Model, Scoreboard, Seen};
///
/// let mut scoreboard = Scoreboard::new(&Model::preset("compact")?);
/// let low = Some(false);
/// let seen = Seen { reset: Some(true), in_valid: low, out_ready: low, ..Seen::default() };
/// scoreboard.cycle(&seen, None)?; // before the edge of a reset outputs may be unknown
/// let seen = Seen { reset: low, ..seen };
/// let difference = scoreboard.cycle(&seen, None).unwrap_err();
/// assert!(difference.to_string().starts_with("cycle 1: in_ready_o is x, expected 1"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Scoreboard {
    clocked: Clocked,
    /// Requests in the pipeline, the oldest first.
    requests: VecDeque<Request>,
    counts: Counts,
    was_reset: bool,
    in_reset: bool,
    first: Option<Difference>,
}

impl Scoreboard {
    /// A scoreboard that has seen nothing.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let clocked = Clocked::new(model);
        let (requests, counts) = (VecDeque::new(), Counts::default());
        Self { clocked, requests, counts, was_reset: false, in_reset: false, first: None }
    }

    /// Judges the cycle that this rising edge ends. `registers` are the words of the DUT's registers before the edge,
    /// in the order of [`Model::probes`], where they can be seen.
    ///
    /// # Errors
    /// The first thing that differs, in the order: what drives the DUT and is unknown, handshake, registers from the
    /// first rank on, result. The cycles after it can be judged all the same.
    pub fn cycle(&mut self, seen: &Seen, registers: Option<&[Option<u64>]>) -> Result<(), Difference> {
        let inputs = self.inputs(seen);
        // An x that was made of a word fits, so this is no error.
        let outputs = self.clocked.combinational(&inputs).map_err(|error| Difference(error.to_string()))?;
        let found = if self.was_reset { self.departure(seen, &inputs, &outputs, registers) } else { Ok(()) };
        let cycle = self.counts.cycles;
        self.count(&inputs, &outputs);
        self.clocked.clock();
        found.map_err(|departure| self.fail(&departure.in_words(self.clocked.model(), cycle)))
    }

    /// What was seen so far.
    #[must_use]
    pub const fn counts(&self) -> Counts {
        self.counts
    }

    /// Whether the DUT passes by what was seen so far. One of which nothing was seen does not.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let Counts { cycles, results, failures, .. } = self.counts;
        let line = match &self.first {
            Some(first) => format!("FAIL {failures} of {cycles} cycles differ; the first: {first}"),
            None if !self.was_reset => format!("FAIL rst_i was not high in {cycles} cycles: nothing was compared"),
            None if results == 0 => format!("FAIL no result was taken in {cycles} cycles: they show little"),
            None => format!("PASS {results} results"),
        };
        Verdict { passed: line.starts_with("PASS"), line }
    }

    fn fail(&mut self, difference: &Difference) -> Difference {
        self.counts.failures += 1;
        self.first.get_or_insert_with(|| difference.clone());
        difference.clone()
    }

    /// The inputs, where unknown bits are 0: before the first reset nobody need have driven them.
    fn inputs(&self, seen: &Seen) -> Inputs {
        let x = self.clocked.model().datapath().formats().input.from_word(seen.x.unwrap_or(0));
        let [reset, in_valid, out_ready] =
            [seen.reset, seen.in_valid, seen.out_ready].map(|level| level.unwrap_or(false));
        Inputs { reset, in_valid, out_ready, address: seen.address.unwrap_or(0), x }
    }

    fn departure(
        &mut self,
        seen: &Seen,
        inputs: &Inputs,
        outputs: &Outputs,
        registers: Option<&[Option<u64>]>,
    ) -> Result<(), Departure> {
        inputs_known(seen, inputs)?;
        let why_ready = self.clocked.model().datapath().control().ready_rule();
        Departure::check_level("in_ready_o", seen.in_ready, outputs.in_ready, why_ready)?;
        if seen.out_valid != Some(outputs.out_valid) {
            let latency = self.clocked.model().latency();
            let why_valid = format!("the latency is {latency} cycles, and more where it is stalled");
            Departure::check_level("out_valid_o", seen.out_valid, outputs.out_valid, &why_valid)?;
        }
        if let Some(words) = registers {
            self.registers(words)?;
        }
        if outputs.out_valid { self.result(seen, outputs, registers.is_some()) } else { Ok(()) }
    }

    fn registers(&mut self, words: &[Option<u64>]) -> Result<(), Departure> {
        let ranks = self.clocked.ranks();
        let control = self.clocked.model().datapath().control();
        let in_ranks = ranks.iter().filter(|rank| rank.valid).count();
        // The oldest requests have results in a slice behind the ranks already.
        let behind = match control.slice {
            Some(ReadySlice::Output) => self.requests.len().saturating_sub(in_ranks),
            Some(ReadySlice::Input) | None => 0,
        };
        let probes = self.clocked.model().probes();
        for (probe, &got) in probes.iter().zip(words).filter(|(probe, _)| ranks[probe.rank].loaded) {
            let wanted = probe.register.format.to_word(probe.register.bits(&ranks[probe.rank].signals));
            check_word(probe, got, wanted).map_err(|what| Departure {
                what,
                request: request_in(&self.requests, &ranks, probe.rank, behind),
                registers_seen: true,
            })?;
            self.counts.compared += 1;
        }
        Ok(())
    }

    fn result(&mut self, seen: &Seen, outputs: &Outputs, registers_seen: bool) -> Result<(), Departure> {
        let model = self.clocked.model();
        let probes = model.probes();
        let request = self.requests.front().copied();
        let format = model.datapath().formats().output;
        let ports = [
            ("intensity", seen.intensity, format.to_word(outputs.intensity)),
            ("status", seen.status, u64::from(outputs.status.bits())),
        ];
        for (name, got, wanted) in ports {
            // The last register of this name is the one that the port shows.
            let shown = probes.iter().rev().find(|probe| probe.register.name() == name);
            let differs = shown.and_then(|probe| check_word(probe, got, wanted).err());
            if let Some(what) = differs {
                return Err(Departure { what, request, registers_seen });
            }
            self.counts.compared += 1;
        }
        Ok(())
    }

    fn count(&mut self, inputs: &Inputs, outputs: &Outputs) {
        let counts = &mut self.counts;
        let due = outputs.out_valid && !inputs.reset;
        let taken = due && self.clocked.model().datapath().control().takes(inputs.out_ready);
        counts.cycles += 1;
        counts.results += u64::from(taken);
        counts.stalls += u64::from(due && !taken);
        counts.bubbles += u64::from(outputs.in_ready && !inputs.in_valid);
        counts.resets += u64::from(inputs.reset && !self.in_reset && self.was_reset);
        if taken {
            self.requests.pop_front();
        }
        if inputs.in_valid && outputs.in_ready {
            self.requests.push_back((inputs.address, inputs.x));
        }
        if inputs.reset {
            self.requests.clear();
        }
        self.in_reset = inputs.reset;
        self.was_reset |= inputs.reset;
    }
}

/// The request that a rank holds, where it holds one; so many requests have left the ranks and not the pipeline.
fn request_in(requests: &VecDeque<Request>, ranks: &[Rank], rank: usize, behind: usize) -> Option<Request> {
    let before = behind + ranks.iter().skip(rank + 1).filter(|rank| rank.valid).count();
    if ranks[rank].valid { requests.get(before).copied() } else { None }
}

/// What drives the DUT must be known: where a request is valid its address and x too.
fn inputs_known(seen: &Seen, inputs: &Inputs) -> Result<(), Departure> {
    let request = inputs.in_valid && !inputs.reset;
    let unknown = [
        ("rst_i", seen.reset.is_none()),
        ("in_valid_i", seen.in_valid.is_none()),
        ("out_ready_i", seen.out_ready.is_none()),
        ("address_i", request && seen.address.is_none()),
        ("x_i", request && seen.x.is_none()),
    ];
    unknown.iter().find(|(_, is)| *is).map_or(Ok(()), |(port, _)| Err(Departure::unknown(port)))
}
