//! What the C boundary and the DPI checker cost: `cargo bench -p blysk-c`. Every figure stands beside another of the
//! same run, as machines differ.
//!
//! - samples and cycles a second through the C ABI (`bench.c`), beside the same calls in Rust;
//! - the emitted RTL in Verilator for 10⁶ random cycles, without a checker, with the ports judged, and with every
//!   register judged too. The fastest of three rounds counts.

#[path = "../tests/support/mod.rs"]
mod support;

use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use model::{Addresses, Clocked, Inputs, Model};
use support::rtl::{emit, newer_verilator, verilate};
use support::{SYSTEM, package, passes, static_library};
use vectors::rtl::REGISTER_CHECKER;

const PRESET: &str = "compact";
const SAMPLES: usize = 1 << 16;
const CYCLES: u32 = 1_000_000;
const ROUNDS: usize = 3;

fn fastest(mut work: impl FnMut()) -> Duration {
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed()
    };
    (0..ROUNDS).map(time).min().expect("there are rounds")
}

/// Samples a second of arrays with one address, and nanoseconds of a clocked cycle, in Rust.
fn rust() -> (f64, f64) {
    let model = Model::preset(PRESET).expect("a preset");
    let xs: Vec<i64> = (0..SAMPLES as i64).map(|i| i * 127 % (1 << 23)).collect();
    let (mut intensities, mut status) = (vec![0; SAMPLES], vec![0; SAMPLES]);
    let arrays = fastest(|| {
        for _ in 0..100 {
            let done = model.evaluate_all(Addresses::One(63), &xs, &mut intensities, &mut status);
            done.expect("x fits");
            black_box(&intensities);
        }
    });
    let mut pipeline = Clocked::new(&model);
    let cycles = fastest(|| {
        for cycle in 0..CYCLES {
            let x = i64::from(cycle) * 127 % (1 << 23);
            let inputs = Inputs { in_valid: true, out_ready: true, address: cycle % 256, x, ..Inputs::default() };
            black_box(pipeline.tick(&inputs).expect("x fits"));
        }
    });
    let nanoseconds = cycles.as_secs_f64() * 1e9 / f64::from(CYCLES);
    (100.0 * SAMPLES as f64 / arrays.as_secs_f64(), nanoseconds)
}

/// The same through the C ABI, as `bench.c` measures it.
fn c() -> (f64, f64) {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bench");
    let source = package().join("benches/bench.c");
    let mut compiler = Command::new("cc");
    compiler.args(["-std=c11", "-O2", "-Wall", "-Wextra", "-Werror", "-I"]).arg(package().join("include"));
    passes(compiler.arg(source).arg(static_library()).args(SYSTEM).arg("-o").arg(&program));
    let said = passes(&mut Command::new(program));
    let mut numbers = said.split_whitespace().filter_map(|word| word.parse::<f64>().ok());
    (numbers.next().expect("samples a second"), numbers.next().expect("nanoseconds"))
}

/// Seconds of a simulation, the fastest round.
fn seconds(program: &Path, directory: &Path, checked: bool) -> f64 {
    let time = fastest(|| {
        let mut command = Command::new(program);
        let said = passes(command.arg(format!("+cycles={CYCLES}")).current_dir(directory));
        assert_eq!(said.lines().any(|line| line.starts_with("PASS ")), checked, "{said}");
    });
    time.as_secs_f64()
}

fn main() {
    // `cargo test --all-targets` starts benchmarks too; this one would build simulators for that.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let ((rust_samples, rust_cycle), (c_samples, c_cycle)) = (rust(), c());
    println!(
        "arrays, preset {PRESET}, one address: Rust {:.1} M samples/s, C {:.1} M samples/s ({:.2} of Rust)",
        rust_samples / 1e6,
        c_samples / 1e6,
        c_samples / rust_samples
    );
    println!(
        "clocked, nothing stalls: Rust {rust_cycle:.1} ns a cycle, C {c_cycle:.1} ns a cycle ({:.2} times Rust)",
        c_cycle / rust_cycle
    );

    let home = newer_verilator();
    let directory = emit(PRESET, "bench");
    let build = |name: &str, flags: &[&str], more: &[&str]| {
        let place = directory.join(name);
        std::fs::create_dir_all(&place).expect("a directory");
        std::fs::rename(verilate(Some(&home), &directory, flags, more), place.join("tb"))
            .expect("the program is moved");
        place.join("tb")
    };
    let bare = build("bare", &["-DUNCHECKED"], &[]);
    let ports = build("ports", &[], &[]);
    let registers = build("registers", &["-DUNCHECKED"], &[REGISTER_CHECKER]);
    let bare = seconds(&bare, &directory, false);
    let [ports, registers] = [ports, registers].map(|program| seconds(&program, &directory, true));
    println!("Verilator, {CYCLES} cycles: {bare:.3} s without a checker");
    for (what, time) in [("ports", ports), ("ports and registers", registers)] {
        let cost = (time - bare) * 1e9 / f64::from(CYCLES);
        println!("  {what} judged: {time:.3} s, {:.2} times that, {cost:.0} ns a cycle more", time / bare);
    }
}
