//! Vectors through the clocked pipeline, with stalls and bubbles.

use std::convert::Infallible;

use hw_model::datapath::Datapath;
use vectors::Sample;
use vectors::stimulus::random::Dice;

use crate::pipeline::Pipeline;
use crate::run::{self, Cycle, StimulusCycle};

/// Cycles of one kind of traffic: without trouble, with stalls, with bubbles, with both.
const BLOCK: u64 = 64;

/// Sends the samples in their order, shows every cycle, and gives the number of cycles.
pub(super) fn run(datapath: &Datapath, samples: &[Sample], seed: u64, mut observe: impl FnMut(&Cycle<'_>)) -> u64 {
    let mut dice = Dice::new(seed);
    let mut waiting = samples.iter();
    let mut cycle = 0_u64;
    let stimulus = std::iter::from_fn(|| {
        let mode = cycle / BLOCK;
        let drawn = dice.below(4);
        let (stall, bubble) = (mode & 1 == 1 && drawn & 1 == 1, mode & 2 == 2 && drawn & 2 == 2);
        cycle += 1;
        // Requests that wait would fill the bubbles after them: none comes while results are stalled.
        let request = if bubble || stall { None } else { Some(waiting.next()?) };
        let request = request.map(|sample| (sample.case.address, sample.case.x));
        Some(Ok::<_, Infallible>(StimulusCycle { request, ready: !stall, reset: false }))
    });
    let mut pipeline = Pipeline::new(datapath);
    let counts = run::run(&mut pipeline, stimulus, |cycle| {
        observe(cycle);
        Ok(())
    });
    match counts {
        Ok(counts) => counts.cycles,
        Err(never) => match never {},
    }
}
