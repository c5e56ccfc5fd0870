//! How fast the model answers when Rust asks: the measure for bindings (`hw-model/bindings/python/speed.py`).
//!
//! Prints a line of JSON for each preset that is named: samples of an array a second, and nanoseconds of a call.

use std::hint::black_box;

use model::{Addresses, Clocked, Inputs, Model};
use rustix::time::{ClockId, clock_gettime};

const SAMPLES: usize = 1 << 22;
const CALLS: u32 = 100_000;

/// The thread's time of the processor, in seconds: what else the machine does counts little.
fn clock() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// The least time of several runs, in seconds.
fn seconds(mut job: impl FnMut()) -> f64 {
    let time = |_| {
        let start = clock();
        job();
        clock() - start
    };
    (0..5).map(time).fold(f64::INFINITY, f64::min)
}

fn main() -> Result<(), model::Error> {
    for name in std::env::args().skip(1) {
        let model = Model::preset(&name)?;
        let xs: Vec<i64> = (0..SAMPLES as i64).map(|x| x * 2 + 1).collect();
        let addresses: Vec<u32> = (0..SAMPLES as u32).map(|i| i.wrapping_mul(2_654_435_761) >> 24).collect();
        let (mut intensities, mut status) = (vec![0; SAMPLES], vec![0; SAMPLES]);
        let block = seconds(|| model.datapath().answer_block(63, &xs, &mut intensities, &mut status));
        let mut all = |addresses| model.evaluate_all(addresses, &xs, &mut intensities, &mut status);
        let mut result = Ok(());
        let one = seconds(|| result = all(Addresses::One(63)));
        result?;
        let mut result = Ok(());
        let each = seconds(|| result = all(Addresses::Each(&addresses)));
        result?;
        let calls = |job: &mut dyn FnMut(i64)| {
            seconds(|| (0..i64::from(CALLS)).for_each(|call| job(call * 80))) / f64::from(CALLS) * 1e9
        };
        let scalar = calls(&mut |x| drop(black_box(model.evaluate(63, x))));
        let registers = calls(&mut |x| drop(black_box(model.registers(63, x))));
        let mut pipeline = Clocked::new(&model);
        let tick = calls(&mut |x| {
            let inputs = Inputs { in_valid: true, address: 63, x, out_ready: x & 7 != 0, ..Inputs::default() };
            drop(black_box(pipeline.tick(&inputs)));
        });
        let rate = |seconds: f64| SAMPLES as f64 / seconds;
        println!(
            "{{\"preset\": \"{name}\", \"block\": {}, \"one\": {}, \"each\": {}, \"scalar_ns\": {scalar}, \
             \"registers_ns\": {registers}, \"tick_ns\": {tick}}}",
            rate(block),
            rate(one),
            rate(each)
        );
    }
    Ok(())
}
