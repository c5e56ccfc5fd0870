//! `make bench`: speed beside Verilator's on the emitted RTL, in one run. `--docs FILE` writes the table there as well;
//! names of presets, instead, time these alone.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::AtomicU64;
use std::time::Instant;

use analysis::error_report::{Options, error_report};
use blysk_tests::bench::verilator::{self, Verilated};
use blysk_tests::bench::{Pattern, Rates, Timed, engines, files, significant};
use blysk_tests::rtl::{Failure, ended, failed};
use hw_model::datapath::Block;
use hw_model::design::Design;
use hw_model::presets;

/// The presets that are timed.
const PRESETS: [&str; 3] = ["compact", "precise", "paper"];
/// Turns of everything that is timed.
const TURNS: usize = 7;
/// Cycles of a run; a stream computes some hundred together, so it gets more of them.
const CYCLES: u64 = 4_000_000;
/// Cycles whose results are compared before anything is timed.
const CHECKED: u64 = 500_000;
const WAVE_CYCLES: u64 = 200_000;
const VECTORS: u64 = 100_000;
const QUESTIONS: u64 = 1_000_000;

/// Lines of a table in Markdown.
struct Table(String);

impl Table {
    fn line(&mut self, what: &str, rates: &Rates, unit: &str, ratio: Option<(f64, &str)>) {
        let ratio = ratio.map_or_else(String::new, |(ratio, of)| format!("{} x {of}", significant(ratio)));
        self.row(what, &rates.in_millions(unit), &ratio);
    }

    fn row(&mut self, what: &str, figure: &str, ratio: &str) {
        println!("  {what:<44} {figure:<44} {ratio}");
        let _ = writeln!(self.0, "| {what} | {figure} | {ratio} |");
    }

    fn heading(&mut self, preset: &str) {
        println!("{preset}");
        let _ = writeln!(self.0, "\n## `{preset}`\n\n| what | median (slowest to fastest) | ratio |");
        self.0.push_str("|---|---|---|\n");
    }
}

fn main() -> ExitCode {
    ended(run())
}

fn run() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (docs, named) = match arguments.as_slice() {
        [flag, file] if flag == "--docs" => (Some(PathBuf::from(file)), &[][..]),
        named => (None, named),
    };
    let all = PRESETS.map(str::to_owned);
    let names = if named.is_empty() { &all[..] } else { named };
    let machine = format!("{}; {}", machine(), verilator::version()?);
    println!("{machine}");
    println!("the median of {TURNS} turns, and the slowest and fastest of them\n");
    let mut table = Table(String::new());
    for name in names {
        let preset = presets::ALL.iter().find(|preset| preset.name == name);
        let config = preset.and_then(|preset| preset.config().ok());
        let Some(design) = config.and_then(|config| Design::new(config).ok()) else {
            return failed(format!("{name} is no preset; usage: bench [--docs FILE | PRESET...]"));
        };
        table.heading(name);
        cycles(&design, &mut table)?;
        sweeps(&design, &mut table)?;
        statistics(&design, &mut table)?;
        answers(&design, &mut table)?;
        if name == "compact" {
            written(&design, &mut table)?;
        }
    }
    match docs {
        Some(path) => write_docs(&path, &machine, &table.0),
        None => Ok(()),
    }
}

/// Cycles a second, all three with the same stimulus; their results must be the same first.
fn cycles(design: &Design, table: &mut Table) -> Result<(), Failure> {
    let verilated = Verilated::build(design, false)?;
    Pattern::ALL.into_iter().try_for_each(|pattern| patterned(design, &verilated, pattern, table))
}

fn patterned(design: &Design, verilated: &Verilated, pattern: Pattern, table: &mut Table) -> Result<(), Failure> {
    let theirs = verilated.run(pattern, CHECKED, None)?.checksum;
    let ours = [engines::clocked(design, pattern, CHECKED), engines::streamed(design, pattern, CHECKED)];
    // Equal checksums of nothing but zeros would say nothing.
    let share = engines::share_above_zero(design, pattern, CHECKED);
    if share < 0.05 {
        return failed(format!("{}: {share} of the results are above 0", design.config().name));
    }
    if ours.iter().any(|run| run.checksum != theirs) {
        return failed(format!("{}: results differ from Verilator's", design.config().name));
    }
    let mut rates = [(); 3].map(|()| Rates::default());
    for _ in 0..TURNS {
        rates[0].push(&verilated.run(pattern, CYCLES, None)?);
        rates[1].push(&engines::clocked(design, pattern, CYCLES));
        rates[2].push(&engines::streamed(design, pattern, 20 * CYCLES));
    }
    let [theirs, clocked, streamed] = &rates;
    let ratio = |rates: &Rates| Some((rates.median() / theirs.median(), "Verilator"));
    let what = |who: &str| format!("{who}, {}", pattern.name());
    table.row(&what("results above 0"), &format!("{} %", significant(100.0 * share)), "checksums equal");
    table.line(&what("Verilator, no waves"), theirs, "cycles", None);
    table.line(&what("clocked simulator"), clocked, "cycles", ratio(clocked));
    table.line(&what("many cycles at a time"), streamed, "cycles", ratio(streamed));
    Ok(())
}

/// Samples a second over every x of every exponent.
fn sweeps(design: &Design, table: &mut Table) -> Result<(), Failure> {
    check_runs(design)?;
    let pool = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(|error| Failure(error.to_string()))
    };
    let (one, two) = (pool(1)?, pool(2)?);
    let mut rates = [(); 4].map(|()| Rates::default());
    for _ in 0..TURNS {
        for (rates, (threads, from_cut)) in
            rates.iter_mut().zip([(&one, false), (&two, false), (&one, true), (&two, true)])
        {
            rates.push(&engines::sweep(design, threads, from_cut));
        }
    }
    let [one, two, polynomial, polynomials] = &rates;
    table.line("sweep of all x, one thread", one, "samples", None);
    let ratio = (two.median() / one.median(), "one thread");
    table.line("sweep of all x, two threads", two, "samples", Some(ratio));
    table.line("where the polynomial answers, one thread", polynomial, "samples", None);
    let ratio = (polynomials.median() / polynomial.median(), "one thread");
    table.line("where the polynomial answers, two threads", polynomials, "samples", Some(ratio));
    Ok(())
}

/// Runs give what the ranks of registers give.
fn check_runs(design: &Design) -> Result<(), Failure> {
    let mut block = Block::default();
    let mut run = vec![0; 3000];
    for (address, row) in (0..).zip(design.rows()).step_by(15) {
        for first in [0, (row.cut - 1500).max(0), design.config().input.one() - 2999] {
            let xs: Vec<i64> = (first..).take(run.len()).collect();
            design.datapath().evaluate_run(address, first, &mut run);
            design.datapath().evaluate_block(address, &xs, &mut block);
            let ranks = |&x: &i64| design.datapath().evaluate(address, x).intensity;
            if run != block.intensities || !xs.iter().map(ranks).eq(run.iter().copied()) {
                return failed(format!("{}: a run differs", design.config().name));
            }
        }
    }
    Ok(())
}

/// Every x of every exponent with the parts of its error, on all cores.
fn statistics(design: &Design, table: &mut Table) -> Result<(), Failure> {
    let options = Options { bound: 1.0, exhaustive: true };
    let mut rates = Rates::default();
    let mut seconds = Vec::new();
    for _ in 0..3 {
        let begin = Instant::now();
        let report = error_report(design, options, &AtomicU64::new(0));
        let report = report.map_err(|error| Failure(error.to_string()))?;
        let taken = begin.elapsed().as_secs_f64();
        rates.push(&Timed { count: report.samples, seconds: taken, checksum: 0 });
        seconds.push(taken);
    }
    seconds.sort_by(f64::total_cmp);
    let all = format!("{} s for all", significant(seconds[1]));
    table.row("error statistics of all x, all cores", &rates.in_millions("samples"), &all);
    Ok(())
}

/// Files: vectors beside a plain writer, waves beside Verilator's.
fn written(design: &Design, table: &mut Table) -> Result<(), Failure> {
    let directory = tempfile::tempdir().map_err(|error| Failure(error.to_string()))?;
    let in_directory = |name: &str| directory.path().join(name);
    let verilated = Verilated::build(design, true)?;
    let mut rates = [(); 4].map(|()| Rates::default());
    for _ in 0..TURNS {
        rates[0].push(&files::bundle(design, VECTORS, &in_directory("bundle"))?);
        rates[1].push(&files::naive_vectors(design, VECTORS, &in_directory("naive.mem"))?);
        rates[2].push(&files::waves(design, WAVE_CYCLES, &in_directory("ours.vcd"))?);
        rates[3].push(&verilated.run(Pattern::Random, WAVE_CYCLES, Some(&in_directory("theirs.vcd")))?);
    }
    let [bundle, naive, ours, theirs] = &rates;
    let ratio = |ours: &Rates, theirs: &Rates, of| Some((ours.median() / theirs.median(), of));
    table.line("vectors with `write!`, two files of hex", naive, "bytes", None);
    let of = "`write!`";
    table.line("vectors, all files with their checksums", bundle, "bytes", ratio(bundle, naive, of));
    table.line("Verilator with VCD", theirs, "cycles", None);
    table.line("clocked simulator with VCD", ours, "cycles", ratio(ours, theirs, "Verilator"));
    Ok(())
}

/// Answers a second to a file of questions, text to text in one thread, beside a plain reader of n,x.
fn answers(design: &Design, table: &mut Table) -> Result<(), Failure> {
    let directory = tempfile::tempdir().map_err(|error| Failure(error.to_string()))?;
    let [by_n, by_address] = files::COLUMNS.map(|columns| (columns, directory.path().join(columns)));
    for (columns, path) in [&by_n, &by_address] {
        files::questions(columns, QUESTIONS, path)?;
    }
    let mut rates = [(); 3].map(|()| Rates::default());
    for _ in 0..TURNS {
        let turn = [
            files::naively_answered(design, &by_n.1)?,
            files::answered(design, &by_n.1)?,
            files::answered(design, &by_address.1)?,
        ];
        if let Some(run) = turn.iter().find(|run| run.count != QUESTIONS) {
            return failed(format!("{} answers to {QUESTIONS}", run.count));
        }
        rates.iter_mut().zip(&turn).for_each(|(rates, run)| rates.push(run));
    }
    let [naive, ours, addresses] = &rates;
    let ratio = |rates: &Rates| Some((rates.median() / naive.median(), "`parse`, `writeln!`"));
    table.line("questions n,x, a line at a time", naive, "answers", None);
    table.line("questions n,x, `blysk evaluate`", ours, "answers", ratio(ours));
    table.line("questions address,x_bits, `blysk evaluate`", addresses, "answers", ratio(addresses));
    Ok(())
}

/// The processor and its cores.
fn machine() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| {
        let line = text.lines().find(|line| line.starts_with(name))?;
        line.split_once(": ").map(|(_, value)| value.trim().to_owned())
    };
    let model = field("model name").unwrap_or_else(|| "an unknown processor".to_owned());
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let wide = field("flags").is_some_and(|flags| flags.contains("avx512dq"));
    let vectors = if wide { "with" } else { "without" };
    format!("{model}, {cores} cores, {vectors} AVX-512")
}

fn write_docs(path: &Path, machine: &str, tables: &str) -> Result<(), Failure> {
    let text = format!(
        "# Benchmarks\n\n<!-- Written by `make bench DOCS=1`. -->\n\n\
         On one machine, which others were using as well: {machine}. The ratios say more than the figures: \
         what is compared took turns. Each is the median of {TURNS} turns (3 for the error statistics), with the \
         slowest and the fastest.\n\n\
         - Verilator runs the RTL that `blysk rtl` writes, built with `-O3 -march=native`, under a loop in C++ that \
         generates the same requests with the same generator, one in every cycle. Two patterns: *sweep*, n = 4 and \
         every eighth x from 1 down to 1/2, pass after pass; and *random*, an address and an x at random, 1 − x of all \
         magnitudes. The checksums of {CHECKED} results were equal before anything was timed. Stimulus and checksum \
         are in every figure of cycles, and these are in time of the processor; the other figures are in time of the \
         clock on the wall, except VCD.\n\
         - Verilator computes every register in every cycle. The model computes what is looked at: here the ports \
         alone. Many cycles at a time take a stream without stalls or resets.\n\
         - The sweep of all x computes the intensity of every representable x in [0, 1] for every exponent. Where x \
         is below the cut and there is no tail, that is a fill; so it is given for the x above the cut alone, too.\n\
         - The error statistics are those of `blysk report --exhaustive`.\n\
         - Questions are {QUESTIONS} random lines of a file, x with six to nine decimals; the answers are text and go \
         nowhere. A line at a time: `split`, `parse`, the answer, x^n and a `writeln!`. In time of the processor, one \
         thread.\n{tables}"
    );
    std::fs::write(path, text).map_err(|error| Failure(format!("cannot write {}: {error}", path.display())))
}
