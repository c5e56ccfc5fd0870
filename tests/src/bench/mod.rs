//! Speed, every figure beside what it is to be compared with, in one run.
//!
//! What is compared takes turns, so that a machine that is busy for a while slows all of it down. What is printed
//! is the median of the turns, and the slowest and the fastest. Results are checked before they are timed.

pub mod engines;
pub mod files;
pub mod verilator;

/// Where the stimulus begins: xorshift64, the same in Rust and in C++.
pub const SEED: u64 = 88_172_645_463_325_252;

/// The address of a sweep: n = 4.
pub const ADDRESS: u32 = 3;

/// What is requested in each cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pattern {
    /// Address and x at random; 1 − x of all magnitudes, else nearly all would lie below the cut of their exponent.
    Random,
    /// One address, and every eighth x from 1 down to 1/2, pass after pass.
    Sweep,
}

impl Pattern {
    /// Both patterns, in the order of the tables.
    pub const ALL: [Self; 2] = [Self::Sweep, Self::Random];

    /// For tables and the harness.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Sweep => "sweep",
        }
    }
}

/// The time and the results of one run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timed {
    /// Cycles, samples or bytes.
    pub count: u64,
    /// How long they took.
    pub seconds: f64,
    /// The checksum of all results, in order.
    pub checksum: u64,
}

impl Timed {
    /// Of them a second.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.count as f64 / self.seconds
    }
}

/// The rates of some runs.
#[derive(Debug, Clone, Default)]
pub struct Rates(Vec<f64>);

impl Rates {
    /// Adds the rate of one more run.
    pub fn push(&mut self, run: &Timed) {
        self.0.push(run.rate());
        self.0.sort_by(f64::total_cmp);
    }

    /// The median; NaN of none.
    #[must_use]
    pub fn median(&self) -> f64 {
        self.0.get(self.0.len() / 2).copied().unwrap_or(f64::NAN)
    }

    /// Median, least and greatest with a unit, in millions.
    #[must_use]
    pub fn in_millions(&self, unit: &str) -> String {
        let ends = self.0.first().zip(self.0.last());
        let (least, greatest) = ends.map_or((f64::NAN, f64::NAN), |(&a, &b)| (a, b));
        let [median, least, greatest] = [self.median(), least, greatest].map(|rate| significant(rate / 1e6));
        format!("{median} M {unit}/s ({least} to {greatest})")
    }
}

/// A number with three significant digits.
#[must_use]
pub fn significant(value: f64) -> String {
    let digits = match value {
        _ if value >= 100.0 => 0,
        _ if value >= 10.0 => 1,
        _ => 2,
    };
    format!("{value:.digits$}")
}
