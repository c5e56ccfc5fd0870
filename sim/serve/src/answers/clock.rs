//! The clocked pipeline, driven by hand: what its ports and ranks show, cycle by cycle.

use std::sync::Arc;

use hw_model::datapath::Datapath;
use serde::{Deserialize, Serialize};
use sim::pipeline::{Inputs, Outputs, Ranks};
use vectors::evaluate::Held;
use vectors::limits::MOST_SERVED_CYCLES;
use vectors::rtl::probes::ports;

use super::highlight::{X, question};
use crate::configuration::Configuration;
use crate::known::Known;
use crate::refusal::Refusal;
use crate::sessions::{Session, Sessions};
use crate::words::Word;

/// Of which hardware a pipeline is wanted.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OpenAsk {
    /// Of which configuration.
    pub(crate) configuration: Configuration,
}

/// A pipeline to be clocked.
#[derive(Debug, Serialize)]
pub(crate) struct Opened {
    session: u64,
    /// The ports as the RTL names them, the clock first.
    ports: Vec<&'static str>,
    ranks: Vec<Rank>,
    most_cycles: u64,
}

/// What drives the ports, and for how many cycles.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ClockAsk {
    session: u64,
    reset: bool,
    in_valid: bool,
    n: String,
    x: X,
    out_ready: bool,
    /// Clock edges, 0 to [`MOST_AT_ONCE`]; with 0 the answer is what the ports show before the next one.
    cycles: u64,
}

/// Clock edges in one request.
const MOST_AT_ONCE: u64 = 64;

/// What was seen.
#[derive(Debug, Serialize)]
pub(crate) struct Clocked {
    /// At each edge.
    cycles: Vec<Cycle>,
    /// With the same inputs before the edge that comes next.
    now: Cycle,
    /// Every rank before that edge.
    ranks: Vec<Rank>,
}

/// The ports at an edge, and the ranks' flags before it.
#[derive(Debug, Serialize)]
struct Cycle {
    /// Counted from 0.
    cycle: u64,
    reset: bool,
    in_valid: bool,
    in_ready: bool,
    address: u32,
    x: String,
    out_valid: bool,
    out_ready: bool,
    intensity: String,
    status: String,
    /// Which ranks hold a request, the first one first.
    valid: Vec<bool>,
}

/// A rank before the next edge.
#[derive(Debug, Serialize)]
struct Rank {
    name: String,
    /// It holds a request.
    valid: bool,
    /// It holds a request and does not advance at the next edge.
    stalled: bool,
    /// False before it has loaded anything: hardware shows unknown values there.
    loaded: bool,
    registers: Vec<Word>,
}

impl Opened {
    /// Opens a pipeline.
    pub(crate) fn new(known: Arc<Known>, sessions: &Sessions) -> Result<Self, Refusal> {
        let ports = ports(known.datapath()).map(|port| port.name).into();
        let session = sessions.open(known);
        let ranks = sessions.with(session, |session| Ok(ranks(session, true)))?;
        Ok(Self { session, ports, ranks, most_cycles: MOST_SERVED_CYCLES })
    }
}

impl Clocked {
    /// Drives a pipeline.
    ///
    /// # Errors
    /// When there is none of this number, it was clocked too often, or the request on its ports is none.
    pub(crate) fn of(sessions: &Sessions, ask: &ClockAsk) -> Result<Self, Refusal> {
        sessions.with(ask.session, |session| drive(session, ask))
    }
}

fn drive(session: &mut Session, ask: &ClockAsk) -> Result<Clocked, Refusal> {
    if ask.cycles > MOST_AT_ONCE {
        return Err(Refusal::unusable(format!(
            "cycles: {} at once are too many; ask for 0 to {MOST_AT_ONCE}",
            ask.cycles
        )));
    }
    if session.cycles + ask.cycles > MOST_SERVED_CYCLES {
        let message = format!("a pipeline is clocked {MOST_SERVED_CYCLES} times at most here; begin with a new one");
        return Err(Refusal::unusable(message));
    }
    let question = question(session.pipeline.datapath(), &ask.n, &ask.x)?;
    let inputs = Inputs {
        reset: ask.reset,
        in_valid: ask.in_valid,
        address: question.address,
        x: question.x,
        out_ready: ask.out_ready,
    };
    let cycles = (0..ask.cycles).map(|_| {
        let seen = look(session, &inputs);
        session.pipeline.clock();
        session.cycles += 1;
        seen
    });
    let cycles = cycles.collect();
    Ok(Clocked { cycles, now: look(session, &inputs), ranks: ranks(session, inputs.out_ready) })
}

/// The ports with these inputs, before the edge.
fn look(session: &mut Session, inputs: &Inputs) -> Cycle {
    let outputs = session.pipeline.combinational(inputs);
    Cycle::new(session.cycles, inputs, &outputs, session.pipeline.ranks())
}

impl Cycle {
    fn new(cycle: u64, inputs: &Inputs, outputs: &Outputs, ranks: Ranks<'_>) -> Self {
        Self {
            cycle,
            reset: inputs.reset,
            in_valid: inputs.in_valid,
            in_ready: outputs.in_ready,
            address: inputs.address,
            x: inputs.x.to_string(),
            out_valid: outputs.out_valid,
            out_ready: inputs.out_ready,
            intensity: outputs.intensity.to_string(),
            status: outputs.status.to_string(),
            valid: ranks.iter().map(|rank| rank.valid).collect(),
        }
    }
}

fn ranks(session: &mut Session, out_ready: bool) -> Vec<Rank> {
    let ranks = session.pipeline.ranks();
    let advance = ranks.advance(out_ready);
    let seen: Vec<_> = ranks.iter().collect();
    let datapath: &Datapath = session.pipeline.datapath();
    let rank = |(number, rank): (usize, &sim::pipeline::Rank)| Rank {
        name: datapath.rank_name(number),
        valid: rank.valid,
        stalled: rank.valid && advance >> number & 1 == 0,
        loaded: rank.loaded,
        registers: Held::of_rank(datapath, number, &rank.signals).iter().map(Word::from).collect(),
    };
    seen.iter().enumerate().map(rank).collect()
}
