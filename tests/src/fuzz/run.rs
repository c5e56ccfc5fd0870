//! One run of a target, and what is found.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::{Mutex, Once, PoisonError};
use std::time::{Duration, Instant};

use peak_alloc::PeakAlloc;
use rustix::time::{ClockId, clock_gettime};

use super::{MOST_MEMORY, Outcome, Place, SLOWEST, Target};

/// What a run must not do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Finding {
    /// It panicked: what was said, and where.
    Panic(String),
    /// It took longer than [`SLOWEST`].
    TimeOut(Duration),
    /// It held more bytes than [`MOST_MEMORY`].
    Memory(usize),
}

impl Finding {
    /// A word for file names and tables.
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Panic(_) => "panic",
            Self::TimeOut(_) => "time-out",
            Self::Memory(_) => "memory",
        }
    }
}

/// What a run did.
#[derive(Debug, Clone, Copy)]
pub struct Ran {
    /// What was made of the input.
    pub outcome: Outcome,
    /// How long the processors worked on it.
    pub time: Duration,
    /// The most bytes that were held at a time, those of the whole process included. It is counted where the program
    /// has [`PeakAlloc`] as its allocator.
    pub memory: usize,
}

/// What the last panic said. Threads of a run panic too, so it is one for all.
static SAID: Mutex<String> = Mutex::new(String::new());

thread_local! {
    /// Whether this thread is in a run, whose panics are findings and no news.
    static RUNNING: Cell<bool> = const { Cell::new(false) };
}

/// What this process has had of the processors.
#[must_use]
pub fn processor_time() -> Duration {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    Duration::new(time.tv_sec.unsigned_abs(), time.tv_nsec.unsigned_abs() as u32)
}

/// Runs a target once.
///
/// # Errors
/// What it must not do.
pub fn run(target: &Target, input: &[u8], place: &Place) -> Result<Ran, Finding> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let others = take_hook();
        set_hook(Box::new(move |panic| {
            *SAID.lock().unwrap_or_else(PoisonError::into_inner) = panic.to_string();
            if !RUNNING.get() {
                others(panic);
            }
        }));
    });
    PeakAlloc.reset_peak_usage();
    let (begun, worked) = (Instant::now(), processor_time());
    RUNNING.set(true);
    let outcome = catch_unwind(AssertUnwindSafe(|| (target.run)(input, place)));
    RUNNING.set(false);
    let (time, memory) = (begun.elapsed(), PeakAlloc.peak_usage());
    // A run that had to wait for a processor is not a slow one.
    let time = time.min(processor_time().saturating_sub(worked));
    let outcome = outcome.map_err(|_| Finding::Panic(SAID.lock().unwrap_or_else(PoisonError::into_inner).clone()))?;
    if time > SLOWEST {
        return Err(Finding::TimeOut(time));
    }
    if memory > MOST_MEMORY {
        return Err(Finding::Memory(memory));
    }
    Ok(Ran { outcome, time, memory })
}
