//! Every way of running the pipeline gives the same bits, over random configurations.

use std::collections::{BTreeSet, VecDeque};

use hw_model::datapath::{Datapath, Status};
use hw_model::handshake::{Handshake, ReadySlice, ResetKind};
use naive::configurations::{designs, request};
use sim::pipeline::{Inputs, Outputs, Pipeline, Rank};
use sim::stream::{CYCLES, Stream};

/// The handshake's rules as they are written, a rank after the other, each with all its registers; a register slice is
/// a queue of two.
struct Written<'a> {
    datapath: &'a Datapath,
    ranks: Vec<Rank>,
    /// What waits in a slice before the ranks, and behind them, the oldest first.
    requests: VecDeque<(u32, i64)>,
    results: VecDeque<(i64, Status)>,
    /// What the slice behind the ranks showed last.
    shown: (i64, Status),
}

impl<'a> Written<'a> {
    fn new(datapath: &'a Datapath) -> Self {
        let ranks = vec![Rank::default(); datapath.rank_count()];
        Self { datapath, ranks, requests: VecDeque::new(), results: VecDeque::new(), shown: Default::default() }
    }

    fn has(&self, slice: ReadySlice) -> bool {
        self.datapath.control().slice == Some(slice)
    }

    /// Whether the ranks may give a result away, and whether each advances.
    fn advances(&self, inputs: &Inputs) -> (bool, Vec<bool>) {
        let ready = if self.has(ReadySlice::Output) { self.results.len() < 2 } else { inputs.out_ready };
        let ranks = (0..self.ranks.len()).map(|rank| match self.datapath.control().handshake {
            Handshake::ValidReady => ready || self.ranks[rank..].iter().any(|rank| !rank.valid),
            Handshake::Enable => ready,
            Handshake::None => true,
        });
        (ready, ranks.collect())
    }

    fn clear(&mut self) {
        self.ranks.iter_mut().for_each(|rank| rank.valid = false);
        self.requests.clear();
        self.results.clear();
    }

    /// What the ports show before the edge.
    fn outputs(&mut self, inputs: &Inputs) -> Outputs {
        let reset = self.datapath.control().reset;
        if inputs.reset && reset.kind == ResetKind::Asynchronous {
            self.clear();
        }
        let last = self.ranks[self.ranks.len() - 1];
        let sliced = self.has(ReadySlice::Output);
        let (intensity, status) = if sliced { self.shown } else { (last.signals.intensity, last.signals.status) };
        let room = if self.has(ReadySlice::Input) { self.requests.len() < 2 } else { self.advances(inputs).1[0] };
        Outputs {
            in_ready: room && (reset.ready || !inputs.reset),
            out_valid: if sliced { !self.results.is_empty() } else { last.valid },
            intensity,
            status,
        }
    }

    /// The edge.
    fn tick(&mut self, inputs: &Inputs) {
        let (ready, advances) = self.advances(inputs);
        let last = self.ranks[self.ranks.len() - 1];
        if self.has(ReadySlice::Output) {
            if inputs.out_ready {
                self.results.pop_front();
            }
            if last.valid && ready {
                self.results.push_back((last.signals.intensity, last.signals.status));
            }
            self.shown = self.results.front().copied().unwrap_or(self.shown);
        }
        let presented = (inputs.in_valid && !inputs.reset).then_some((inputs.address, inputs.x));
        let request = if self.has(ReadySlice::Input) {
            let room = self.requests.len() < 2;
            let offered = self.requests.front().copied();
            if advances[0] {
                self.requests.pop_front();
            }
            self.requests.extend(presented.filter(|_| room));
            offered.filter(|_| !inputs.reset)
        } else {
            presented
        };
        for index in (0..self.ranks.len()).rev().filter(|&index| advances[index]) {
            let loads = match index.checked_sub(1).map(|before| self.ranks[before]) {
                None => request.map(|(address, x)| self.datapath.fetch(address, x)),
                Some(before) => before.valid.then(|| self.datapath.advance(index, &before.signals)),
            };
            let rank = &mut self.ranks[index];
            (rank.valid, rank.loaded) = (loads.is_some(), rank.loaded || loads.is_some());
            rank.signals = loads.unwrap_or(rank.signals);
        }
        if inputs.reset {
            self.clear();
        }
    }
}

/// Stalls, bubbles and resets in spells of all lengths.
#[test]
fn the_clocked_simulator_shows_every_register_as_the_rules_say() {
    let mut compared = 0;
    let mut controls = BTreeSet::new();
    for (mut source, design) in designs().take(240) {
        let datapath = design.datapath();
        let mut pipeline = Pipeline::new(datapath);
        let mut written = Written::new(datapath);
        controls.insert(format!("{:?}", datapath.control()));
        let requests: Vec<_> = (0..40).map(|_| request(&mut source, &design)).collect();
        let (mut request_in, mut ready_in, mut looks_in) = (1, 1, 1);
        for cycle in 0..600 {
            if source.once_in(30) {
                (request_in, ready_in) = (source.integer(1, 6), source.integer(1, 6));
                // Registers are computed when they are asked for; also after many cycles without a question.
                looks_in = source.one_of(&[1, 1, 60]);
            }
            let (address, x) = source.one_of(&requests);
            let inputs = Inputs {
                reset: source.once_in(50),
                in_valid: source.once_in(request_in),
                address,
                x,
                out_ready: source.once_in(ready_in),
            };
            let place = format!("{}, cycle {cycle}, {:?}", design.config().name, datapath.control());
            assert_eq!(pipeline.combinational(&inputs), written.outputs(&inputs), "{place}");
            pipeline.clock();
            written.tick(&inputs);
            let under_way = written.ranks.iter().filter(|rank| rank.valid).count();
            let waiting = written.requests.len() + written.results.len();
            assert_eq!(pipeline.in_flight() as usize, under_way + waiting, "{place}");
            if !source.once_in(looks_in) {
                continue;
            }
            for (index, (shown, wanted)) in pipeline.ranks().iter().zip(&written.ranks).enumerate() {
                assert_eq!(shown, *wanted, "{place}, rank {index}");
                compared += 1;
            }
        }
    }
    assert!(compared > 100_000, "{compared}");
    // The usual rules, slices at both ends, other handshakes, resets of all kinds.
    assert!(controls.len() > 20, "{controls:?}");
}

/// Every register of every cycle, over several times as many cycles as are computed together, with bubbles
/// from single ones to longer than that.
#[test]
fn many_cycles_at_a_time_show_what_the_clocked_simulator_shows() {
    let mut compared = 0;
    // A stream is of the ranks alone.
    let ranks_alone = designs().filter(|(_, design)| design.datapath().control().slice.is_none());
    for (mut source, design) in ranks_alone.take(60) {
        let datapath = design.datapath();
        let (mut pipeline, mut stream) = (Pipeline::new(datapath), Stream::new(datapath));
        let requests: Vec<_> = (0..40).map(|_| request(&mut source, &design)).collect();
        for _ in 0..6 {
            let every = source.one_of(&[1, 1, 2, 9, 100, 100_000]);
            let one_address = source.once_in(2).then(|| source.one_of(&requests).0);
            let mut drive = || {
                let (address, x) = source.one_of(&requests);
                ((one_address.unwrap_or(address), x), source.once_in(every))
            };
            let driven: Vec<_> = (0..CYCLES).map(|_| drive()).collect();
            stream.run(|addresses, xs, valid| {
                for (cycle, &((address, x), request)) in driven.iter().enumerate() {
                    (addresses[cycle], xs[cycle], valid[cycle]) = (address, x, request);
                }
            });
            let (results, requested) = stream.results();
            for (cycle, &((address, x), in_valid)) in driven.iter().enumerate() {
                let result = datapath.evaluate(address, x);
                assert_eq!(results[cycle], result.intensity, "{address} {x}");
                assert_eq!(stream.status(cycle), result.status, "{address} {x}");
                assert_eq!(requested[cycle], in_valid);
                let inputs = Inputs { reset: false, in_valid, address, x, out_ready: true };
                let outputs = pipeline.combinational(&inputs);
                assert_eq!(stream.outputs(cycle), outputs, "cycle {cycle}");
                for (rank, wanted) in pipeline.ranks().iter().enumerate() {
                    let shown = stream.rank(cycle, rank);
                    assert_eq!(shown, wanted, "{} {cycle} {rank}", design.config().name);
                    compared += 1;
                }
                pipeline.clock();
            }
        }
    }
    assert!(compared > 100_000, "{compared}");
}
