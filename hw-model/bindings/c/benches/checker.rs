//! What the C boundary and the DPI checker cost: `cargo bench -p blysk-c`. Every figure stands beside another of the
//! same run, as machines differ.
//!
//! - samples and cycles a second through the C ABI (`bench.c`), beside the same calls in Rust;
//! - the emitted RTL in Verilator for 10⁶ random cycles, without a checker, with the ports judged, and with every
//!   register judged too.
//!
//! What counts is processor time, as others may use the machine too. Those that are compared take turns, and of seven
//! turns the fastest counts.

#[path = "../tests/support/mod.rs"]
mod support;

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

use model::{Addresses, Clocked, Inputs, Model};
use rustix::time::{ClockId, clock_gettime};
use support::rtl::{emit, newer_verilator, verilate};
use support::{SYSTEM, package, passes, run, static_library};
use vectors::rtl::REGISTER_CHECKER;

const PRESET: &str = "compact";
const SAMPLES: usize = 1 << 16;
const CYCLES: u32 = 1_000_000;
const ROUNDS: usize = 7;

/// Seconds of the processor that this thread has had.
fn processor_time() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// The least time of each of several measurements that take turns.
fn fastest<const N: usize>(mut measure: impl FnMut() -> [f64; N]) -> [f64; N] {
    (0..ROUNDS).map(|_| measure()).fold([f64::INFINITY; N], |least, now| std::array::from_fn(|i| least[i].min(now[i])))
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = processor_time();
    work();
    processor_time() - start
}

/// Nanoseconds of a sample of arrays with one address, and of a clocked cycle, in Rust.
fn rust() -> [f64; 2] {
    let model = Model::preset(PRESET).expect("a preset");
    let xs: Vec<i64> = (0..SAMPLES as i64).map(|i| i * 127 % (1 << 23)).collect();
    let (mut intensities, mut status) = (vec![0; SAMPLES], vec![0; SAMPLES]);
    let arrays = seconds(|| {
        for _ in 0..100 {
            let done = model.evaluate_all(Addresses::One(63), &xs, &mut intensities, &mut status);
            done.expect("x fits");
            black_box(&intensities);
        }
    });
    let mut pipeline = Clocked::new(&model);
    let cycles = seconds(|| {
        for cycle in 0..CYCLES {
            let x = i64::from(cycle) * 127 % (1 << 23);
            let inputs = Inputs { in_valid: true, out_ready: true, address: cycle % 256, x, ..Inputs::default() };
            black_box(pipeline.tick(&inputs).expect("x fits"));
        }
    });
    [arrays * 1e7 / SAMPLES as f64, cycles * 1e9 / f64::from(CYCLES)]
}

/// `bench.c`, compiled.
fn bench_c() -> PathBuf {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bench_c");
    let source = package().join("benches/bench.c");
    let mut compiler = Command::new("cc");
    compiler.args(["-std=c11", "-O2", "-Wall", "-Wextra", "-Werror", "-I"]).arg(package().join("include"));
    passes(compiler.arg(source).arg(static_library()).args(SYSTEM).arg("-o").arg(&program));
    program
}

/// The same two figures through the C ABI.
fn c(program: &Path) -> [f64; 2] {
    let said = passes(&mut Command::new(program));
    let mut numbers = said.split_whitespace().filter_map(|word| word.parse().ok());
    std::array::from_fn(|_| numbers.next().expect("a number"))
}

/// Seconds that a simulation takes: what the shell says of its user time.
fn simulated(program: &Path, directory: &Path, checked: bool) -> f64 {
    let mut shell = Command::new("bash");
    shell.arg("-c").arg(format!("TIMEFORMAT='seconds %3U'; time \"$0\" +cycles={CYCLES}")).arg(program);
    let output = run(shell.current_dir(directory));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(said.lines().any(|line| line.starts_with("PASS ")), checked, "{said}");
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    let time = errors.lines().find_map(|line| line.strip_prefix("seconds ")?.parse().ok());
    time.unwrap_or_else(|| panic!("no time: {errors}"))
}

fn main() {
    // `cargo test --all-targets` starts benchmarks too; this one would build simulators for that.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let program = bench_c();
    let [rust_sample, rust_cycle, c_sample, c_cycle] = fastest(|| {
        let ([a, b], [c, d]) = (rust(), c(&program));
        [a, b, c, d]
    });
    let [rust_rate, c_rate] = [rust_sample, c_sample].map(|nanoseconds| 1e3 / nanoseconds);
    println!("arrays, preset {PRESET}, one address: Rust {rust_rate:.1} M samples/s, C {c_rate:.1} M samples/s");
    println!("  C has {:.2} of Rust's", c_rate / rust_rate);
    println!("clocked, nothing stalls: Rust {rust_cycle:.1} ns a cycle, C {c_cycle:.1} ns a cycle");
    println!("  C takes {:.2} times Rust's", c_cycle / rust_cycle);

    let home = newer_verilator();
    let directory = emit(PRESET, "dpi_bench");
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
    let [bare, ports, registers] = fastest(|| {
        [(&bare, false), (&ports, true), (&registers, true)]
            .map(|(program, checked)| simulated(program, &directory, checked))
    });
    println!("Verilator, {CYCLES} cycles: {bare:.3} s without a checker");
    for (what, time) in [("ports", ports), ("ports and registers", registers)] {
        let cost = (time - bare) * 1e9 / f64::from(CYCLES);
        println!("  {what} judged: {time:.3} s, {:.2} times that, {cost:.0} ns a cycle more", time / bare);
    }
}
