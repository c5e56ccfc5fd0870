//! Small runs of the pipeline that show its rules, recorded cycle by cycle.

use std::convert::Infallible;

use hw_model::datapath::{Datapath, Signals, Status};
use hw_model::handshake::Handshake;

use sim::pipeline::Pipeline;
use sim::run::{StimulusCycle, run};

/// A request, and what comes of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Request {
    /// The ROM address that it asks for.
    pub(super) address: u32,
    /// The bits of x.
    pub(super) x: i64,
    /// What the last rank holds when the result is there.
    pub(super) result: Signals,
}

/// What one cycle shows, at the rising edge that ends it. Requests are numbers into a list.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    /// Whether there is a reset.
    pub(super) reset: bool,
    /// The request that is presented.
    pub(super) presented: Option<usize>,
    /// The level of `in_ready_o`.
    pub(super) in_ready: bool,
    /// The request in each rank.
    pub(super) ranks: Vec<Option<usize>>,
    /// The level of `out_valid_o`.
    pub(super) out_valid: bool,
    /// The level of `out_ready_i`.
    pub(super) out_ready: bool,
    /// intensity_o, once there was a result.
    pub(super) intensity: Option<i64>,
    /// status_o, once there was a result.
    pub(super) status: Option<Status>,
}

/// Cycles worth a look: the first, the one after the last, and what happens.
pub(super) type Span = (usize, usize, &'static str);

/// A run of some cycles that shows one rule of the handshake, recorded.
pub(super) struct Scenario {
    /// Goes into the name of the file.
    pub(super) name: &'static str,
    /// What the run shows, as a heading.
    pub(super) title: &'static str,
    /// The same at length.
    pub(super) words: String,
    /// The requests, in order.
    pub(super) requests: Vec<Request>,
    /// What every cycle shows, in order.
    pub(super) samples: Vec<Sample>,
    /// The cycles to look at, each span with a word on it.
    pub(super) spans: Vec<Span>,
}

/// What a scenario is made from.
struct Script {
    name: &'static str,
    title: &'static str,
    words: String,
    /// The cycles in which a request becomes there to be taken.
    requests: Vec<usize>,
    /// True where an address without a word would show nothing: its intensity is 0, as if nothing came.
    words_only: bool,
    /// Cycles in which `out_ready_i` is low.
    stalled: std::ops::Range<usize>,
    /// Cycles in reset, beside the first.
    reset: std::ops::Range<usize>,
    cycles: usize,
    spans: Vec<Span>,
}

/// The request whose address has no word.
const WITHOUT_WORD: usize = 3;

/// Every run that is drawn.
pub(super) fn scenarios(datapath: &Datapath) -> Vec<Scenario> {
    let handshake = datapath.control().handshake;
    // Where nothing waits, neither a stall nor what it does to a bubble can be shown.
    let waits = |script: &Script| handshake != Handshake::None || script.stalled.is_empty();
    scripts(datapath).into_iter().filter(waits).map(|script| play(datapath, script)).collect()
}

fn scripts(datapath: &Datapath) -> [Script; 4] {
    let (latency, capacity) = (datapath.latency(), datapath.capacity());
    // The result of a request taken in cycle 1 is there from here on.
    let out = latency + 1;
    [
        Script {
            name: "run",
            title: "A plain run: one request a cycle, one result a cycle",
            words: format!(
                "A is taken at the edge that ends cycle 1; its result is there from cycle {out} on, \
                 {latency} edges later."
            ),
            requests: vec![1, 2, 3, 4],
            words_only: false,
            stalled: 0..0,
            reset: 0..0,
            cycles: latency + 7,
            spans: vec![],
        },
        Script {
            name: "stall",
            title: "A stall: out_ready_i is low, and every register holds",
            words: stall(datapath),
            requests: (1..capacity + 3).collect(),
            words_only: false,
            stalled: out..out + 3,
            reset: 0..0,
            cycles: latency + 9,
            spans: vec![(out, out + 3, "stall")],
        },
        Script {
            name: "bubble",
            title: match datapath.control().handshake {
                Handshake::Enable => "A bubble, and how it stays behind a stall",
                _ => "A bubble, and how it collapses behind a stall",
            },
            words: bubble(datapath).to_owned(),
            requests: vec![1, 4, 5],
            words_only: false,
            stalled: out..out + 3,
            reset: 0..0,
            cycles: latency + 9,
            spans: vec![(2, 4, "bubble"), (out, out + 3, "stall")],
        },
        Script {
            name: "reset",
            title: "A reset: what is in flight is lost",
            words: reset(datapath),
            requests: vec![1, 2, 3, 4],
            words_only: true,
            stalled: 0..0,
            reset: 4..5,
            cycles: latency + 8,
            spans: vec![(4, 5, "reset")],
        },
    ]
}

fn stall(datapath: &Datapath) -> String {
    let ranks = datapath.rank_count();
    match (datapath.control().slice, datapath.control().handshake) {
        (Some(_), _) => {
            let capacity = datapath.capacity();
            format!(
                "The first result is not taken. The slice takes one more, so that {capacity} requests are in flight \
                 before in_ready_o falls; the request that is presented then waits, unchanged. Nothing is lost."
            )
        }
        (None, Handshake::Enable) => {
            "The enable is low: no rank moves, in_ready_o is low as well, and the request that \
             is presented waits, unchanged. Nothing is lost."
                .to_owned()
        }
        _ => format!(
            "All {ranks} ranks are full when the first result is not taken, so in_ready_o falls in \
             the same cycle; the request that is presented waits, unchanged. Nothing is lost."
        ),
    }
}

fn bubble(datapath: &Datapath) -> &'static str {
    match datapath.control().handshake {
        Handshake::Enable => {
            "Between A and B two cycles have no request. While the enable is low, nothing moves: the two empty ranks \
             stay between A and B."
        }
        _ => {
            "Between A and B two cycles have no request. While A waits to be taken, B and C move \
             up into the empty ranks, and in_ready_o stays high: a rank advances when it is \
             empty or the next one advances."
        }
    }
}

fn reset(datapath: &Datapath) -> String {
    let reset = datapath.control().reset;
    let when = if reset.is_asynchronous() {
        "The reset does not wait for the clock: every valid flag is 0 from the beginning of its cycle."
    } else {
        "The reset is sampled at the edge that ends its cycle: every valid flag is 0 after it."
    };
    let request = if reset.ready {
        "in_ready_o does not look at the reset. D, presented meanwhile, is not taken before it ends."
    } else {
        "in_ready_o is low during the reset, so D, presented meanwhile, is taken after it."
    };
    format!("{when} {request} No result of A, B or C comes out.")
}

fn play(datapath: &Datapath, script: Script) -> Scenario {
    let count = script.requests.len();
    let mut requests = requests(datapath, count + usize::from(script.words_only));
    if script.words_only {
        requests.remove(WITHOUT_WORD);
    }
    let cycles = script.cycles;
    let stimulus = (0..cycles).map(|cycle| {
        let which = script.requests.iter().position(|&when| when == cycle);
        Ok::<_, Infallible>(StimulusCycle {
            request: which.map(|which| (requests[which].address, requests[which].x)),
            ready: !script.stalled.contains(&cycle),
            reset: cycle == 0 || script.reset.contains(&cycle),
        })
    });
    let mut samples = Vec::new();
    let number =
        |address: u32, x: i64| requests.iter().position(|request| (request.address, request.x) == (address, x));
    let mut pipeline = Pipeline::new(datapath);
    let ran = run(&mut pipeline, stimulus, |cycle| {
        let shown = cycle.ranks.result_loaded();
        let held = cycle.ranks.iter().map(|rank| {
            let Signals { address, x, .. } = rank.signals;
            if rank.valid { number(address, x) } else { None }
        });
        samples.push(Sample {
            reset: cycle.inputs.reset,
            presented: number(cycle.inputs.address, cycle.inputs.x).filter(|_| cycle.inputs.in_valid),
            in_ready: cycle.outputs.in_ready,
            ranks: held.collect(),
            out_valid: cycle.outputs.out_valid,
            out_ready: cycle.inputs.out_ready,
            intensity: shown.then_some(cycle.outputs.intensity),
            status: shown.then_some(cycle.outputs.status),
        });
        Ok(())
    });
    // `observe` never fails.
    let Ok(_counts) = ran;
    samples.truncate(cycles);
    let Script { name, title, words, spans, .. } = script;
    Scenario { name, title, words, requests, samples, spans }
}

/// Requests of every kind first: on the polynomial (or the divider), x = 1, below the cut, and an
/// address without a word. No two are alike.
fn requests(datapath: &Datapath, count: usize) -> Vec<Request> {
    let greatest = datapath.front_end().greatest;
    let depth = datapath.rom().depth() as u32;
    let request = |index: usize| {
        let spread = (index as u32 * 37 + depth / 4) % depth;
        let cut = datapath.front_end().cut(&datapath.row(spread)).clamp(0, greatest);
        // Different in every request, and far from the ends.
        let own = index as i64;
        let (address, x) = match index {
            1 => (depth - 1, greatest),
            2 => (spread, (cut - (cut >> 5) - own).max(0)),
            WITHOUT_WORD => (depth, greatest - (greatest >> 2) - own),
            _ => (spread, (cut.midpoint(greatest) - own).max(0)),
        };
        Request { address, x, result: datapath.evaluate(address, x) }
    };
    (0..count).map(request).collect()
}

/// What a request is called in pictures and tables.
pub(super) fn name(request: usize) -> String {
    let letter = u8::try_from(request).ok().filter(|&index| index < 26);
    letter.map_or_else(|| format!("R{request}"), |index| char::from(b'A' + index).to_string())
}
