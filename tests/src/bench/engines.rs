//! The model's own engines, each under the stimulus that the others get.

use std::hint::black_box;
use std::time::Instant;

use hw_model::design::Design;
use multiversion::multiversion;
use rayon::prelude::*;
use sim::pipeline::{Inputs, Pipeline};
use sim::stream::{CYCLES, Stream};

use super::{ADDRESS, Pattern, SEED, Timed};

/// x that are evaluated together in a sweep.
const BLOCK: usize = 2048;

/// Requests: the same as in `harness.cpp`.
pub(super) trait Stimulus {
    fn new() -> Self;
    fn next(&mut self) -> (u32, i64);
}

pub(super) struct Random(u64);

impl Stimulus for Random {
    fn new() -> Self {
        Self(SEED)
    }

    #[inline(always)]
    fn next(&mut self) -> (u32, i64) {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        let s = (self.0 >> 16 & 0x7f_ffff) >> (self.0 >> 40 & 7);
        (self.0 as u32 & 0xff, 0x7f_ffff - s as i64)
    }
}

struct Sweep(i64);

impl Stimulus for Sweep {
    fn new() -> Self {
        Self(0)
    }

    #[inline(always)]
    fn next(&mut self) -> (u32, i64) {
        // From 1 down to 1/2, and again; a pass is short enough for every engine to make several.
        let s = (self.0 & 0x7_ffff) << 3;
        self.0 += 1;
        (ADDRESS, 0x7f_ffff - s)
    }
}

/// Every result times an odd number of its own, so that their order matters; the same as in `harness.cpp`.
struct Checksum {
    sum: u64,
    weight: u64,
}

impl Checksum {
    const NONE: Self = Self { sum: 0, weight: 1 };

    #[inline(always)]
    const fn add(&mut self, intensity: i64, status: u8) {
        let result = (intensity as u64) << 4 | status as u64;
        self.sum = self.sum.wrapping_add(result.wrapping_mul(self.weight));
        self.weight = self.weight.wrapping_add(2);
    }
}

fn timed(count: u64, run: impl FnOnce() -> u64) -> Timed {
    let begin = Instant::now();
    let checksum = black_box(run());
    Timed { count, seconds: begin.elapsed().as_secs_f64(), checksum }
}

/// The same of what one thread does, in time of the processor.
fn timed_alone(count: u64, run: impl FnOnce() -> u64) -> Timed {
    let begin = processor();
    let checksum = black_box(run());
    Timed { count, seconds: processor() - begin, checksum }
}

/// Seconds that this thread has had of the processor, so that others on the machine take nothing away.
pub(super) fn processor() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

/// The share of results above 0 among this number of requests.
#[must_use]
pub fn share_above_zero(design: &Design, pattern: Pattern, requests: u64) -> f64 {
    match pattern {
        Pattern::Random => above_zero(design, Random::new(), requests),
        Pattern::Sweep => above_zero(design, Sweep::new(), requests),
    }
}

fn above_zero(design: &Design, mut stimulus: impl Stimulus, requests: u64) -> f64 {
    let mut logic = design.datapath().flight();
    let count = (0..requests).filter(|_| {
        let (address, x) = stimulus.next();
        design.datapath().logic().enter(design.datapath(), address, x, &mut logic);
        logic.intensity() > 0
    });
    count.count() as f64 / requests as f64
}

/// The clocked simulator, a cycle after the other.
#[must_use]
pub fn clocked(design: &Design, pattern: Pattern, cycles: u64) -> Timed {
    let mut pipeline = Pipeline::new(design.datapath());
    timed_alone(cycles, || match pattern {
        Pattern::Random => clock_random(&mut pipeline, cycles),
        Pattern::Sweep => clock_sweep(&mut pipeline, cycles),
    })
}

// Verilator's harness is compiled for the machine it runs on; so are the loops around our engines.

#[multiversion(targets("x86_64+bmi1+bmi2+lzcnt+popcnt"))]
fn clock_random(pipeline: &mut Pipeline<'_>, cycles: u64) -> u64 {
    clock_with(pipeline, Random::new(), cycles)
}

#[multiversion(targets("x86_64+bmi1+bmi2+lzcnt+popcnt"))]
fn clock_sweep(pipeline: &mut Pipeline<'_>, cycles: u64) -> u64 {
    clock_with(pipeline, Sweep::new(), cycles)
}

#[inline(always)]
fn clock_with(pipeline: &mut Pipeline<'_>, mut stimulus: impl Stimulus, cycles: u64) -> u64 {
    let mut checksum = Checksum::NONE;
    for _ in 0..cycles {
        let (address, x) = stimulus.next();
        let inputs = Inputs { reset: false, in_valid: true, address, x, out_ready: true };
        let outputs = pipeline.tick(&inputs);
        if outputs.out_valid {
            checksum.add(outputs.intensity, outputs.status.bits());
        }
    }
    checksum.sum
}

/// Many cycles at a time. The results of the last latency are not yet shown, as in the others.
#[must_use]
pub fn streamed(design: &Design, pattern: Pattern, cycles: u64) -> Timed {
    let mut stream = Stream::new(design.datapath());
    let shown = cycles.saturating_sub(design.datapath().rank_count() as u64);
    timed_alone(cycles, || match pattern {
        Pattern::Random => stream_random(&mut stream, cycles, shown),
        Pattern::Sweep => stream_sweep(&mut stream, cycles, shown),
    })
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn stream_random(stream: &mut Stream<'_>, cycles: u64, shown: u64) -> u64 {
    stream_with(stream, Random::new(), cycles, shown)
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn stream_sweep(stream: &mut Stream<'_>, cycles: u64, shown: u64) -> u64 {
    stream_with(stream, Sweep::new(), cycles, shown)
}

#[inline(always)]
fn stream_with(stream: &mut Stream<'_>, mut stimulus: impl Stimulus, cycles: u64, mut left: u64) -> u64 {
    let mut checksum = Checksum::NONE;
    for _ in 0..cycles.div_ceil(CYCLES as u64) {
        stream.run(|addresses, xs, valid| {
            for (address, x) in addresses.iter_mut().zip(xs) {
                (*address, *x) = stimulus.next();
            }
            *valid = [true; CYCLES];
        });
        let (intensities, _) = stream.results();
        let shown = left.min(CYCLES as u64) as usize;
        for (result, &intensity) in intensities.iter().enumerate().take(shown) {
            checksum.add(intensity, stream.status(result).bits());
        }
        left -= shown as u64;
    }
    checksum.sum
}

/// Every x of every exponent, or those from the cut on; the sum of all intensities, so that the order of the
/// threads does not matter.
#[must_use]
pub fn sweep(design: &Design, threads: &rayon::ThreadPool, from_cut: bool) -> Timed {
    let greatest = design.datapath().front_end().greatest;
    let firsts = design.rows().iter().map(|row| if from_cut { row.cut } else { 0 });
    let firsts: Vec<i64> = firsts.collect();
    let count = firsts.iter().map(|first| (greatest - first + 1).max(0) as u64).sum();
    let row = |(address, &first): (usize, &i64)| {
        let mut intensities = vec![0; BLOCK];
        let mut total = 0_u64;
        for x in (first..=greatest).step_by(BLOCK) {
            let len = (greatest - x + 1).min(BLOCK as i64) as usize;
            let block = &mut intensities[..len];
            design.datapath().evaluate_run(address as u32, x, block);
            // Looked at, and cheaply: adding all up would take longer than computing them.
            total = total.wrapping_add(block.iter().step_by(64).sum::<i64>() as u64);
        }
        total
    };
    timed(count, || threads.install(|| firsts.par_iter().enumerate().map(row).reduce(|| 0, u64::wrapping_add)))
}
