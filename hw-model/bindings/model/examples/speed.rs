//! How fast the model answers when Rust asks: the measure for bindings (`hw-model/bindings/python/speed.py`).
//!
//! Takes the name of a preset. Measures what each line of standard input names, once, and prints how many nanoseconds
//! of the processor a sample or a call took: so whoever compares lets both sides take turns.

use std::error::Error;
use std::hint::black_box;
use std::io::stdin;

use model::{Addresses, Clocked, Inputs, Model};
use rustix::time::{ClockId, clock_gettime};

const SAMPLES: usize = 1 << 22;
const CALLS: i64 = 20_000;

/// The thread's time of the processor, in nanoseconds: what else the machine does counts little.
fn clock() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e9 + time.tv_nsec as f64
}

/// The time of a job.
fn time<T>(job: impl FnOnce() -> T) -> f64 {
    let start = clock();
    black_box(job());
    clock() - start
}

fn main() -> Result<(), Box<dyn Error>> {
    let model = Model::preset(&std::env::args().nth(1).ok_or("name a preset")?)?;
    let xs: Vec<i64> = (0..SAMPLES as i64).map(|x| x * 2 + 1).collect();
    let addresses: Vec<u32> = (0..SAMPLES as u32).map(|i| i.wrapping_mul(2_654_435_761) >> 24).collect();
    let (mut intensities, mut status) = (vec![0; SAMPLES], vec![0; SAMPLES]);
    let mut pipeline = Clocked::new(&model);
    let calls = |job: &mut dyn FnMut(i64)| time(|| (0..CALLS).for_each(|call| job(call * 80))) / CALLS as f64;
    for line in stdin().lines() {
        let taken = match line?.as_str() {
            "block" => time(|| model.datapath().answer_block(63, &xs, &mut intensities, &mut status)) / SAMPLES as f64,
            "each" => {
                let each = Addresses::Each(&addresses);
                time(|| model.evaluate_all(each, &xs, &mut intensities, &mut status)) / SAMPLES as f64
            }
            "scalar" => calls(&mut |x| drop(black_box(model.evaluate(63, x)))),
            "registers" => calls(&mut |x| drop(black_box(model.registers(63, x)))),
            "tick" => calls(&mut |x| {
                let inputs = Inputs { in_valid: true, address: 63, x, out_ready: x & 7 != 0, ..Inputs::default() };
                drop(black_box(pipeline.tick(&inputs)));
            }),
            what => return Err(format!("{what}: use block, each, scalar, registers or tick").into()),
        };
        println!("{taken}");
    }
    Ok(())
}
