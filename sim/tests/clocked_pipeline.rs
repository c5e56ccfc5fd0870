//! The clocked pipeline against the untimed model, under any interleaving of valid, ready and reset.

use std::convert::Infallible;

use hw_model::config::Config;
use hw_model::datapath::{Datapath, Status};
use hw_model::design::Design;
use hw_model::handshake::{Handshake, ReadySlice};
use hw_model::presets;
use proptest::prelude::*;
use sim::pipeline::{Inputs, Outputs, Pipeline};
use sim::run::{Results, StimulusCycle, run};

fn design(preset: &str) -> Design {
    Design::new(presets::find(preset).unwrap().config().unwrap()).unwrap()
}

/// Small and quick to make, with every kind of rank.
fn small() -> Design {
    let json = r#"{"name": "small", "method": "hermite", "exponents": "1..=8", "input": "Q2.7",
        "output": "UQ1.6", "tail": "rational", "form": "power", "quotient_bits_per_stage": 3}"#;
    Design::new(Config::from_json(json).unwrap()).unwrap()
}

/// A request that stays presented until it is taken, driven with any pattern of gaps; everything that
/// the pipeline took and has not delivered, in order.
struct Bench<'a> {
    pipeline: Pipeline<'a>,
    in_flight: Vec<(u32, i64)>,
    delivered: usize,
}

impl<'a> Bench<'a> {
    fn new(datapath: &'a Datapath) -> Self {
        Self { pipeline: Pipeline::new(datapath), in_flight: Vec::new(), delivered: 0 }
    }

    /// One cycle; true when the request was taken. Checks what must hold in every cycle.
    fn cycle(&mut self, request: Option<(u32, i64)>, out_ready: bool, reset: bool) -> bool {
        let (address, x) = request.unwrap_or((u32::MAX, -1));
        let inputs = Inputs { reset, in_valid: request.is_some(), address, x, out_ready };
        let outputs = self.pipeline.combinational(&inputs);
        self.outputs_do_not_depend_on_ready(&inputs, &outputs);
        let before: Vec<_> = self.pipeline.ranks().iter().collect();
        if outputs.out_valid && !reset {
            let (address, x) = self.in_flight[0];
            let wanted = self.pipeline.datapath().evaluate(address, x);
            assert_eq!((outputs.intensity, outputs.status), (wanted.intensity, wanted.status));
            if out_ready {
                self.in_flight.remove(0);
                self.delivered += 1;
            }
        }
        self.pipeline.clock();
        let last = before.len() - 1;
        if before[last].valid && !out_ready && !reset {
            assert_eq!(self.pipeline.ranks().rank(last), before[last], "a stalled result changed");
        }
        if reset {
            self.in_flight.clear();
            assert!(self.pipeline.is_empty(), "reset leaves nothing in flight");
            assert!(!outputs.in_ready, "nothing is taken during reset");
        }
        let taken = inputs.in_valid && outputs.in_ready;
        if taken {
            self.in_flight.push((address, x));
        }
        let held = self.pipeline.ranks().iter().filter(|rank| rank.valid).count();
        assert_eq!(held, self.in_flight.len(), "requests in flight");
        taken
    }

    /// `valid` is a function of registers alone.
    fn outputs_do_not_depend_on_ready(&self, inputs: &Inputs, outputs: &Outputs) {
        let other = Inputs { out_ready: !inputs.out_ready, in_valid: !inputs.in_valid, ..*inputs };
        let others = self.pipeline.clone().combinational(&other);
        assert_eq!(others.out_valid, outputs.out_valid);
        assert_eq!(others.intensity, outputs.intensity);
    }
}

/// What one cycle does: present (or not) this request, take results, reset (rarely).
fn cycles() -> impl Strategy<Value = Vec<(bool, u32, i64, bool, bool)>> {
    let cycle = (any::<bool>(), 0_u32..10, -256_i64..256, any::<bool>(), prop::bool::weighted(0.02));
    prop::collection::vec(cycle, 1..200)
}

proptest! {
    #[test]
    fn no_interleaving_loses_doubles_or_changes_a_result(cycles in cycles()) {
        let design = small();
        let mut bench = Bench::new(design.datapath());
        let mut waiting = None;
        let (mut taken, mut lost) = (0, 0);
        for (present, address, x, ready, reset) in cycles {
            if waiting.is_none() && present {
                waiting = Some((address, x));
            }
            let in_flight = bench.in_flight.len();
            if bench.cycle(waiting, ready, reset) {
                waiting = None;
                taken += 1;
            }
            if reset {
                lost += in_flight;
            }
        }
        for _ in 0..design.datapath().rank_count() {
            bench.cycle(None, true, false);
        }
        prop_assert_eq!(bench.delivered + lost, taken);
        prop_assert!(bench.in_flight.is_empty());
    }
}

#[test]
fn the_latency_is_the_number_of_ranks_and_a_result_comes_every_cycle() {
    for preset in presets::ALL {
        let design = design(preset.name);
        let datapath = design.datapath();
        let latency = datapath.rank_count();
        let mut pipeline = Pipeline::new(datapath);
        let one = design.config().input.one();
        for cycle in 0..latency + 20 {
            let x = one - cycle as i64;
            let inputs = Inputs { in_valid: true, address: 7, x, out_ready: true, ..Inputs::default() };
            let outputs = pipeline.tick(&inputs);
            assert!(outputs.in_ready);
            assert_eq!(outputs.out_valid, cycle >= latency, "{} cycle {cycle}", preset.name);
            if outputs.out_valid {
                let wanted = datapath.evaluate(7, one - (cycle - latency) as i64);
                assert_eq!(outputs.intensity, wanted.intensity);
            }
        }
    }
}

#[test]
fn bubbles_collapse_behind_a_stall() {
    let design = small();
    let mut pipeline = Pipeline::new(design.datapath());
    let latency = design.datapath().rank_count();
    // Every other cycle a request, never ready: all ranks fill up, then in_ready falls.
    let mut taken = 0;
    for cycle in 0..4 * latency {
        let in_valid = cycle % 2 == 0;
        let outputs = pipeline.tick(&Inputs { in_valid, x: 100, ..Inputs::default() });
        taken += usize::from(in_valid && outputs.in_ready);
    }
    assert_eq!(taken, latency);
    assert!(pipeline.ranks().iter().all(|rank| rank.valid));
    let full = Inputs { in_valid: true, out_ready: true, ..Inputs::default() };
    assert!(pipeline.tick(&full).in_ready, "a full pipeline takes one as it delivers one");
}

/// Where nothing waits, ready is not looked at: each result belongs to its own request all the same.
#[test]
fn results_find_their_requests_though_nobody_is_ready() {
    for handshake in Handshake::ALL {
        let mut config = small().config().clone();
        config.handshake = handshake;
        let design = Design::new(config).unwrap();
        let row = |index: i64| StimulusCycle {
            request: Some((index as u32 % 8, 3 * index)),
            ready: index % 3 != 0,
            reset: index == 0,
        };
        let mut results = Results::default();
        let mut found = 0;
        let counts =
            run(&mut Pipeline::new(design.datapath()), (0..40).map(|index| Ok::<_, Infallible>(row(index))), |cycle| {
                if let Some(taken) = results.cycle(cycle) {
                    let (address, x) = taken.request;
                    let wanted = design.datapath().evaluate(address, x);
                    assert_eq!((taken.intensity, taken.status), (wanted.intensity, wanted.status), "{handshake:?}");
                    found += 1;
                }
                Ok(())
            });
        let Ok(counts) = counts;
        assert_eq!((counts.requests, counts.results, found), (40, 40, 40), "{handshake:?}");
        assert_eq!(counts.stalls > 0, handshake != Handshake::None);
    }
}

/// A slice adds a cycle, and room for two more.
#[test]
fn a_register_slice_delays_by_a_cycle_and_holds_two() {
    for (slice, entries) in [(None, 0), (Some(ReadySlice::Input), 2), (Some(ReadySlice::Output), 2)] {
        let mut config = small().config().clone();
        config.pipelining.ready_slice = slice;
        let design = Design::new(config).unwrap();
        let datapath = design.datapath();
        assert_eq!(datapath.latency(), datapath.rank_count() + entries / 2);
        let mut pipeline = Pipeline::new(datapath);
        // Never taken: requests go in until all is full.
        let waiting = Inputs { in_valid: true, address: 2, x: 100, ..Inputs::default() };
        let mut first = None;
        let mut taken = 0;
        for cycle in 0..3 * datapath.capacity() {
            let outputs = pipeline.tick(&waiting);
            taken += usize::from(outputs.in_ready);
            first = first.or(outputs.out_valid.then_some(cycle));
        }
        assert_eq!(first, Some(datapath.latency()), "{slice:?}");
        assert_eq!(taken, datapath.rank_count() + entries, "{slice:?}");
        assert_eq!(pipeline.in_flight() as usize, datapath.capacity());
        // Taken: all of them come out, one a cycle.
        let taking = Inputs { out_ready: true, ..Inputs::default() };
        let results = (0..datapath.capacity()).filter(|_| pipeline.tick(&taking).out_valid).count();
        assert_eq!(results, datapath.capacity(), "{slice:?}");
        assert!(pipeline.is_empty());
    }
}

#[test]
fn an_exponent_without_a_word_is_a_flag_and_zero() {
    let design = design("paper");
    let address = design.rom().address_of(300.0);
    let last = design.datapath().evaluate(address, design.config().input.one());
    assert_eq!((last.intensity, last.status), (0, Status::NO_WORD));
}

#[test]
fn a_run_counts_what_happened() {
    let design = small();
    let latency = design.datapath().rank_count() as u64;
    let cycle = |request, ready| Ok::<_, Infallible>(StimulusCycle { request, ready, reset: false });
    let one = Some((0, 128));
    // Three requests with a bubble between the second and the third, then results wait two cycles.
    let mut stimulus = vec![cycle(one, true), cycle(one, true), cycle(None, true), cycle(one, true)];
    for index in 4..latency + 2 {
        stimulus.push(cycle(None, index < latency));
    }
    let mut seen = 0;
    let counts = run(&mut Pipeline::new(design.datapath()), stimulus, |cycle| {
        assert_eq!(cycle.index, seen);
        seen += 1;
        Ok(())
    });
    let Ok(counts) = counts;
    assert_eq!((counts.requests, counts.results, counts.lost_to_reset), (3, 3, 0));
    assert_eq!((counts.bubbles, counts.stalls), (1, 2));
    assert_eq!(counts.initiation_interval(), Some(1.5));
    // The stall of two cycles swallows the bubble: three results in a row after latency + 2.
    assert_eq!(counts.cycles, latency + 2 + 3);
    assert_eq!(seen, counts.cycles);
}

#[test]
fn the_example_stimulus_shows_a_stall_a_bubble_and_a_reset() {
    let design = design("paper");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/examples/stimulus.csv");
    let lines = vectors::read_stimulus(path.as_ref(), design.rom(), design.config().input).unwrap();
    let stimulus = lines.iter().map(|line| Ok::<_, Infallible>(StimulusCycle::from(line)));
    let mut flags = Vec::new();
    let counts = run(&mut Pipeline::new(design.datapath()), stimulus, |cycle| {
        if cycle.outputs.out_valid && cycle.inputs.out_ready {
            flags.push(cycle.outputs.status);
        }
        Ok(())
    });
    let Ok(counts) = counts;
    assert!(counts.stalls > 0 && counts.bubbles > 0 && counts.lost_to_reset > 0, "{counts:?}");
    assert!(flags.contains(&Status::ABOVE_ONE), "{flags:?}");
}
