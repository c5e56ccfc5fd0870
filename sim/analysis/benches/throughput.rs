//! Samples a second through each way of running the pipeline, beside the f64 reference alone:
//! the ratio to `reference` is what matters, the numbers belong to the machine.
//!
//! Each case is checked once before it is timed.

use analysis::sweep::{Xs, sweep_row};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use hw_model::datapath::Block;
use hw_model::design::Design;
use hw_model::highlight::phong;
use hw_model::presets;
use sim::pipeline::{Inputs, Pipeline};

const PRESETS: [&str; 6] = ["paper", "blooming", "tangent", "compact", "precise", "schlick"];
/// n = 64.
const ADDRESS: u32 = 63;
/// Samples of a run: every 128th x of a preset's input.
const STEP: usize = 128;

fn main() {
    divan::main();
}

fn design(preset: &str) -> Design {
    let preset = presets::ALL.iter().find(|known| known.name == preset).expect("a preset");
    Design::new(preset.config().expect("presets parse")).expect("presets make hardware")
}

fn samples(design: &Design) -> Vec<i64> {
    (0..=design.config().input.one()).step_by(STEP).collect()
}

/// x^n in f64, correctly rounded: what every error is measured against.
#[divan::bench]
fn reference(bencher: Bencher<'_, '_>) {
    let xs: Vec<f64> = (0..=65_536).map(|i| f64::from(i) / 65_536.0).collect();
    bencher.counter(ItemsCount::new(xs.len())).bench(|| xs.iter().map(|&x| phong(64.0, black_box(x))).sum::<f64>());
}

/// A block of samples at a time.
#[divan::bench(args = PRESETS)]
fn block(bencher: Bencher<'_, '_>, preset: &str) {
    let design = design(preset);
    let xs = samples(&design);
    let mut block = Block::default();
    design.datapath().evaluate_block(ADDRESS, &xs, &mut block);
    for (&x, &intensity) in xs.iter().zip(&block.intensities) {
        assert_eq!(intensity, design.datapath().evaluate(ADDRESS, x).intensity);
    }
    bencher.counter(ItemsCount::new(xs.len())).bench_local(|| {
        design.datapath().evaluate_block(ADDRESS, black_box(&xs), &mut block);
        block.intensities.last().copied()
    });
}

/// The same with every error taken apart, as in `blysk report --exhaustive`.
#[divan::bench(args = PRESETS)]
fn sweep(bencher: Bencher<'_, '_>, preset: &str) {
    let design = design(preset);
    let xs = samples(&design);
    let errors = sweep_row(&design, ADDRESS, Xs::List(&xs));
    let budget = design.config().error_budget_ulp * design.config().output.ulp();
    assert!(errors.implementation.error <= budget);
    bencher.counter(ItemsCount::new(xs.len())).bench_local(|| sweep_row(&design, ADDRESS, Xs::List(black_box(&xs))));
}

/// The clocked pipeline, a request and a result in every cycle.
#[divan::bench(args = PRESETS)]
fn clocked(bencher: Bencher<'_, '_>, preset: &str) {
    let design = design(preset);
    let xs = samples(&design);
    let run = || {
        let mut pipeline = Pipeline::new(design.datapath());
        let drive = |&x: &i64| {
            let inputs = Inputs { in_valid: true, address: ADDRESS, x, out_ready: true, ..Inputs::default() };
            pipeline.tick(&inputs).intensity
        };
        xs.iter().map(drive).last()
    };
    let behind = xs.len() - 1 - design.datapath().rank_count();
    assert_eq!(run(), Some(design.datapath().evaluate(ADDRESS, xs[behind]).intensity));
    bencher.counter(ItemsCount::new(xs.len())).bench_local(run);
}
