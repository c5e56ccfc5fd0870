//! `make fuzz MINUTES=n`: every reader on altered inputs, for as long as is asked; see [`blysk_tests::fuzz`].
//!
//! Each target has the same share of the time, in processes of its own: one that is killed, runs out of memory or out
//! of time is found by what is left of it, its last input is kept, and another one goes on with another seed. As many
//! processes run at a time as there are processors. Exit status 1 says that something was found.

use std::env;
use std::fs;
use std::io::{self, Write};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use blysk_tests::fuzz::campaign::{Campaign, Figures};
use blysk_tests::fuzz::overwrite;
use blysk_tests::fuzz::run::processor_time;
use blysk_tests::fuzz::{SLOWEST, TARGETS, Target};
use peak_alloc::PeakAlloc;
use tempfile::TempDir;
use vectors::checksum::checksum;

/// Counts what runs hold.
#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// The address space of a process, in bytes: more than a run may hold, and less than would hurt a machine.
const ADDRESS_SPACE: u64 = 8 << 30;
/// Runs between two reports of a process.
const REPORTED: u64 = 64;
/// The exit status of a process that found its own run to be too long.
const TOO_LONG: i32 = 3;

const USAGE: &str = "usage: fuzz MINUTES [SEED] [TARGET...]";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["--worker", target, seconds, seed, directory] => {
            work(target, seconds, seed, Path::new(directory)).map(|()| true)
        }
        [minutes, rest @ ..] => supervise(minutes, rest),
        [] => Err(USAGE.to_owned()),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(problem) => {
            let _ = writeln!(io::stderr(), "error: {problem}");
            ExitCode::from(2)
        }
    }
}

fn number<T: std::str::FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("{text:?} is no number here; {USAGE}"))
}

fn said(error: io::Error) -> String {
    error.to_string()
}

/// What became of one target.
#[derive(Default)]
struct Became {
    figures: Figures,
    findings: Vec<String>,
}

/// All targets, as many at a time as there are processors.
fn supervise(minutes: &str, rest: &[&str]) -> Result<bool, String> {
    let minutes: f64 = number(minutes)?;
    let seed: u64 = rest.first().map_or(Ok(1), |seed| number(seed))?;
    let named = rest.get(1..).unwrap_or_default().iter();
    let named = named.map(|name| Target::find(name).ok_or(format!("there is no target {name:?}")));
    let mut targets = named.collect::<Result<Vec<_>, _>>()?;
    if targets.is_empty() {
        targets = TARGETS.to_vec();
    }
    let workers = thread::available_parallelism().map_or(1, NonZero::get);
    let share = minutes * 60.0 * workers.min(targets.len()) as f64 / targets.len() as f64;
    let share = Duration::try_from_secs_f64(share).map_err(|error| format!("{minutes}: {error}"))?;
    let kept = PathBuf::from("results/fuzz");
    fs::create_dir_all(&kept).map_err(said)?;
    let waiting = Mutex::new(targets.iter().rev().collect::<Vec<_>>());
    let clean = thread::scope(|scope| {
        let one = || -> Result<bool, String> {
            let mut clean = true;
            loop {
                let next = waiting.lock().map_err(|error| error.to_string())?.pop();
                let Some(target) = next else { return Ok(clean) };
                let found = one_target(target, share, seed, &kept)?;
                clean &= found.findings.is_empty();
                show(target, &found)?;
            }
        };
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(one)).collect();
        let ends = threads.into_iter().map(|thread| thread.join());
        ends.map(|end| end.map_err(|_| "a thread panicked".to_owned())?).collect::<Result<Vec<_>, _>>()
    })?;
    Ok(clean.into_iter().all(|clean| clean))
}

fn show(target: &Target, found: &Became) -> Result<(), String> {
    let Figures { runs, accepted, slowest, memory } = found.figures;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{:<14} {runs:>9} runs, {accepted:>8} accepted, slowest {:>7.1} ms, most memory {:>7.1} MiB, findings {}",
        target.name,
        slowest.as_secs_f64() * 1e3,
        memory as f64 / (1 << 20) as f64,
        found.findings.len()
    )
    .map_err(said)?;
    found.findings.iter().try_for_each(|finding| writeln!(out, "  {finding}")).map_err(said)
}

/// Processes for one target, one after the other, until its time is over.
fn one_target(target: &Target, share: Duration, seed: u64, kept: &Path) -> Result<Became, String> {
    let begun = Instant::now();
    let mut found = Became::default();
    for round in 0.. {
        let left = share.saturating_sub(begun.elapsed());
        if round > 0 && left < Duration::from_millis(500) {
            break;
        }
        let directory = TempDir::new().map_err(said)?;
        let seed = seed.wrapping_add(round * 1_000_003);
        let worker = env::current_exe().map_err(said)?;
        let status = Command::new("prlimit")
            .arg(format!("--as={ADDRESS_SPACE}"))
            .arg(worker)
            .args(["--worker", target.name, &left.as_secs_f64().to_string(), &seed.to_string()])
            .arg(directory.path())
            .stderr(Stdio::null())
            .status()
            .map_err(|error| format!("cannot run prlimit: {error}"))?;
        add(&mut found.figures, directory.path());
        let input = fs::read(directory.path().join("input")).unwrap_or_default();
        for finding in findings(directory.path(), status.code(), &input) {
            keep(target, &finding, kept, &mut found.findings)?;
        }
    }
    Ok(found)
}

/// What a process said it did.
fn add(figures: &mut Figures, directory: &Path) {
    let text = fs::read_to_string(directory.join("figures")).unwrap_or_default();
    let numbers: Vec<u64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    if let [runs, accepted, slowest, memory] = numbers[..] {
        figures.runs += runs;
        figures.accepted += accepted;
        figures.slowest = figures.slowest.max(Duration::from_micros(slowest));
        figures.memory = figures.memory.max(memory as usize);
    }
}

/// A kind, what was said, and the input.
type Found = (String, String, Vec<u8>);

/// What a process found, and how it ended, if not as it should.
fn findings(directory: &Path, status: Option<i32>, input: &[u8]) -> Vec<Found> {
    let mut found = Vec::new();
    for number in 0.. {
        let name = |what: &str| directory.join(format!("{number}.{what}"));
        let Ok(text) = fs::read_to_string(name("said")) else { break };
        let (kind, said) = text.split_once('\n').unwrap_or((&text, ""));
        let input = fs::read(name("input")).unwrap_or_default();
        found.push((kind.to_owned(), said.to_owned(), input));
    }
    let ended = match status {
        Some(0) => return found,
        Some(TOO_LONG) => ("time-out", format!("longer than {} s", SLOWEST.as_secs())),
        Some(status) => ("abort", format!("the process ended with status {status}")),
        None => ("abort", "the process was killed by a signal".to_owned()),
    };
    found.push((ended.0.to_owned(), ended.1, input.to_vec()));
    found
}

/// Keeps the input of a finding, the first of each kind and place.
fn keep(target: &Target, found: &Found, kept: &Path, all: &mut Vec<String>) -> Result<(), String> {
    let (kind, said_, input) = found;
    let place = said_.lines().next().unwrap_or_default();
    if all.iter().any(|known| known.contains(place)) {
        return Ok(());
    }
    let digest = checksum(input.as_slice()).map_err(said)?.sha256;
    let path = kept.join(format!("{}-{kind}-{}", target.name, &digest[..12]));
    fs::write(&path, input).map_err(said)?;
    all.push(format!("{kind}: {} ({})", said_.replace('\n', " "), path.display()));
    Ok(())
}

/// The number of the run under way.
static RUN: AtomicU64 = AtomicU64::new(0);

/// Ends the process when a run does not end: after [`SLOWEST`] at work, or much more without any.
fn watch() {
    thread::spawn(|| {
        let mut run = (u64::MAX, Instant::now(), processor_time());
        loop {
            thread::sleep(Duration::from_millis(100));
            let now = RUN.load(Ordering::Relaxed);
            if run.0 != now {
                run = (now, Instant::now(), processor_time());
            }
            let worked = processor_time().saturating_sub(run.2);
            if worked > SLOWEST || run.1.elapsed() > 20 * SLOWEST {
                std::process::exit(TOO_LONG);
            }
        }
    });
}

/// One process: runs until its time is over, and leaves the input of each run for the process that looks after its end.
fn work(target: &str, seconds: &str, seed: &str, directory: &Path) -> Result<(), String> {
    let target = Target::find(target).ok_or_else(|| format!("there is no target {target:?}"))?;
    let left = Duration::try_from_secs_f64(number(seconds)?).map_err(|error| error.to_string())?;
    let begun = Instant::now();
    let mut campaign = Campaign::new(target, number(seed)?);
    let mut found: Vec<String> = Vec::new();
    watch();
    loop {
        let input = campaign.input();
        overwrite(&directory.join("input"), &input).map_err(said)?;
        RUN.fetch_add(1, Ordering::Relaxed);
        if let Err(finding) = campaign.run(&input) {
            let text = format!("{}\n{finding:?}", finding.kind());
            if !found.contains(&text) {
                fs::write(directory.join(format!("{}.input", found.len())), &input).map_err(said)?;
                fs::write(directory.join(format!("{}.said", found.len())), &text).map_err(said)?;
                found.push(text);
            }
        }
        let over = begun.elapsed() >= left && campaign.figures.runs > campaign.corpus_len() as u64;
        if over || campaign.figures.runs.is_multiple_of(REPORTED) {
            let Figures { runs, accepted, slowest, memory } = campaign.figures;
            let text = format!("{runs} {accepted} {} {memory}\n", slowest.as_micros());
            fs::write(directory.join("figures"), text).map_err(said)?;
        }
        if over {
            return Ok(());
        }
    }
}
