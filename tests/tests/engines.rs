//! Every way of running the pipeline gives the same bits, over random configurations.

use hw_model::datapath::Datapath;
use naive::configurations::{designs, request};
use sim::pipeline::{Inputs, Pipeline, Rank};
use sim::stream::{CYCLES, Stream};

/// The handshake's rules as they are written, a rank after the other, each with all its registers.
struct Written<'a> {
    datapath: &'a Datapath,
    ranks: Vec<Rank>,
}

impl Written<'_> {
    fn tick(&mut self, inputs: &Inputs) {
        let mut ready = inputs.out_ready;
        for index in (0..self.ranks.len()).rev() {
            let held = self.ranks[index];
            let before = index.checked_sub(1).map(|before| self.ranks[before]);
            let advances = !held.valid || ready;
            let offered = before.map_or(inputs.in_valid && !inputs.reset, |before: Rank| before.valid);
            let rank = &mut self.ranks[index];
            if advances && offered {
                rank.loaded = true;
                rank.signals = match before {
                    None => self.datapath.fetch(inputs.address, inputs.x),
                    Some(before) => self.datapath.advance(index, &before.signals),
                };
            }
            rank.valid = (if advances { offered } else { held.valid }) && !inputs.reset;
            ready = advances;
        }
    }
}

/// Stalls, bubbles and resets in spells of all lengths.
#[test]
fn the_clocked_simulator_shows_every_register_as_the_rules_say() {
    let mut compared = 0;
    for (mut source, design) in designs().take(120) {
        let datapath = design.datapath();
        let mut pipeline = Pipeline::new(datapath);
        let mut written = Written { datapath, ranks: vec![Rank::default(); datapath.rank_count()] };
        let requests: Vec<_> = (0..40).map(|_| request(&mut source, &design)).collect();
        let (mut request_in, mut ready_in, mut looks_in) = (1, 1, 1);
        for cycle in 0..1000 {
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
            let outputs = pipeline.combinational(&inputs);
            let last = written.ranks[written.ranks.len() - 1];
            assert_eq!(outputs.out_valid, last.valid);
            let result = (last.signals.intensity, last.signals.status);
            assert_eq!((outputs.intensity, outputs.status), result);
            let (ready, valid) = (inputs.out_ready, written.ranks.iter().all(|rank| rank.valid));
            assert_eq!(outputs.in_ready, (ready || !valid) && !inputs.reset);
            pipeline.clock();
            written.tick(&inputs);
            if !source.once_in(looks_in) {
                continue;
            }
            for (index, (shown, wanted)) in pipeline.ranks().iter().zip(&written.ranks).enumerate() {
                let name = &design.config().name;
                assert_eq!(shown, *wanted, "{name}, cycle {cycle}, rank {index}");
                compared += 1;
            }
        }
    }
    assert!(compared > 100_000, "{compared}");
}

/// Every register of every cycle, over several times as many cycles as are computed together, with bubbles
/// from single ones to longer than that.
#[test]
fn many_cycles_at_a_time_show_what_the_clocked_simulator_shows() {
    let mut compared = 0;
    for (mut source, design) in designs().take(60) {
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
