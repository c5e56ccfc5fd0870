//! How much is gone through, kept and written: every limit of work that has to do with inputs, in one place.
//!
//! An input is an x with an exponent (a ROM word). What looks at each input once may look at [`MOST_INPUTS`]; what
//! looks at each of them several times, [`Sweep::looks`], may look at as many times fewer.

use hw_model::design::Design;
use hw_model::exponents::MAX_COUNT;
use hw_model::format::QFormat;
use thiserror::Error;

/// The most looks at an input in one run of a command, 2^40: hours of work.
pub const MOST_INPUTS: u128 = 1 << 40;

/// The most inputs of which something is kept in memory at the same time, 2^26: half a gigabyte of real numbers.
pub const MOST_KEPT: u128 = 1 << 26;

/// The most vectors of one bundle, 2^22. The table of the `paper` preset has about 600 bytes a line, so this is some
/// 2.5 GB.
pub const MAX_VECTORS: u64 = 1 << 22;

/// The most numbers and addresses of a memory file: one of each for every word.
pub const MOST_NUMBERS: usize = 2 * MAX_VECTORS as usize;

/// The most cycles of a stimulus that is read, 2^24: they take 700 MB.
pub const MOST_CYCLES: usize = 1 << 24;

/// The most words of a ROM image: as many as a list of exponents is long.
pub const MOST_WORDS: u64 = MAX_COUNT as u64;

/// The most shards of a job, 2^16: more than a cluster's array of jobs takes at once.
pub const MOST_SHARDS: u32 = 1 << 16;

/// The most pieces that a job is cut into, 2^32: so many are numbered, and none of them is kept in memory.
pub const MOST_PIECES: u64 = 1 << 32;

/// The longest configuration that `blysk serve` takes, 64 KiB: a preset has 600 bytes.
pub const MOST_SERVED_TEXT: usize = 64 << 10;

/// The most rows times segments of a configuration in `blysk serve`, 2^12: fitting so many takes seconds.
pub const MOST_SERVED_ROWS: usize = 1 << 12;

/// The most points of a curve of `blysk serve`: a plot is not many more pixels wide.
pub const MOST_SERVED_POINTS: usize = 400;

/// The most pipelines that `blysk serve` keeps to be clocked by hand; the one that was not clocked for longest goes.
pub const MOST_SERVED_SESSIONS: usize = 16;

/// The most clock cycles of one such pipeline.
pub const MOST_SERVED_CYCLES: u64 = 4096;

/// Seconds that `blysk serve` waits for an answer: RTL with its vectors takes some of them.
pub const SERVED_SECONDS: u64 = 120;

/// Requests of `blysk serve` that may wait for a worker.
pub const SERVED_WAITING: usize = 16;

/// How many inputs a design has: every x of [0, 1] in every row.
#[must_use]
pub fn inputs(design: &Design) -> u128 {
    (design.datapath().front_end().greatest as u128 + 1) * design.rom().depth() as u128
}

/// What goes over inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sweep {
    /// `blysk report --exhaustive`: every x of every exponent once.
    Report,
    /// `blysk certify` of a configuration, and its `--check`.
    Certify,
    /// `blysk stability`, the pairs of neighbouring x.
    Stability,
    /// `blysk pareto`: every x of every exponent once for all contenders.
    Pareto,
    /// `blysk specialise` and its `--check`.
    Specialise,
    /// `blysk vectors --strategy compact`.
    Compact,
    /// `blysk design`: every x for each design that is tried.
    Design,
    /// `blysk refine`: every x for each set of integers that is tried.
    Refine,
    /// `blysk shard run`: every x of every exponent of one shard.
    Shard,
}

impl Sweep {
    /// Every sweep, in the order above.
    pub const ALL: [Self; 9] = [
        Self::Report,
        Self::Certify,
        Self::Stability,
        Self::Pareto,
        Self::Specialise,
        Self::Compact,
        Self::Design,
        Self::Refine,
        Self::Shard,
    ];

    /// What its errors call it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Report => "--exhaustive",
            Self::Certify => "certify",
            Self::Stability => "seams",
            Self::Pareto => "pareto",
            Self::Specialise => "specialise",
            Self::Compact => "strategy compact",
            Self::Design => "design",
            Self::Refine => "refine",
            Self::Shard => "shard",
        }
    }

    /// What its errors call that which it counts.
    const fn counted(self) -> &'static str {
        match self {
            Self::Stability => "pairs of neighbouring x",
            _ => "samples",
        }
    }

    /// About how often each input is looked at.
    #[must_use]
    pub const fn looks(self) -> u128 {
        match self {
            Self::Report | Self::Certify | Self::Stability | Self::Pareto | Self::Shard => 1,
            // Two data paths, and with --allow-codes one pass for each width of the output.
            Self::Specialise | Self::Compact => 16,
            // A pass for every change that is tried.
            Self::Design | Self::Refine => 64,
        }
    }

    /// The most inputs it goes through.
    #[must_use]
    pub const fn most(self) -> u128 {
        MOST_INPUTS / self.looks()
    }

    /// What else than a narrower input would help.
    const fn remedy(self) -> &'static str {
        match self {
            Self::Report => "fewer exponents, or leave --exhaustive out",
            Self::Certify => "fewer exponents",
            Self::Stability | Self::Design => "fewer --exponents",
            Self::Refine => "fewer --exponents, or a shorter --range",
            Self::Pareto => "fewer --exponents, or --every K",
            Self::Specialise => "a scene of fewer exponents",
            Self::Compact => "fewer exponents, or another strategy",
            Self::Shard => "more --shards",
        }
    }

    /// The number of inputs as a `u64`, where it is within the limit of the sweep; `input` is the format of x.
    ///
    /// # Errors
    /// When there are more: the message says how many fraction bits of x would be within the limit.
    pub fn within(self, inputs: u128, input: QFormat) -> Result<u64, TooManyInputs> {
        self.at_most(self.most(), inputs, input, "gone through")
    }

    /// The same of inputs of which something is kept: the longest run of x of one exponent.
    ///
    /// # Errors
    /// When they are too many.
    pub fn kept(self, inputs: u128, input: QFormat) -> Result<u64, TooManyInputs> {
        self.at_most(MOST_KEPT, inputs, input, "kept in memory, of one exponent")
    }

    fn at_most(self, most: u128, inputs: u128, input: QFormat, done: &'static str) -> Result<u64, TooManyInputs> {
        if inputs > most {
            return Err(TooManyInputs { sweep: self, inputs, most, done, input });
        }
        Ok(inputs as u64)
    }
}

/// More inputs than a command goes through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "{}: {inputs} {} are more than the {most} (2^{}) that are {done}; {}",
    sweep.name(), sweep.counted(), most.ilog2(), self.advice()
)]
pub struct TooManyInputs {
    /// What would go through them.
    pub sweep: Sweep,
    /// How many there are.
    pub inputs: u128,
    /// How many there may be.
    pub most: u128,
    /// What is done with them.
    done: &'static str,
    /// The format of x.
    pub input: QFormat,
}

impl TooManyInputs {
    /// Fraction bits of x with which there would not be too many; none where no x is narrow enough.
    #[must_use]
    pub fn fitting_bits(&self) -> Option<u32> {
        // A bit less halves them, but for the last x of each exponent: hence "less than", and not "at most".
        let fits = |bits: &u32| self.inputs >> (self.input.fraction_bits() - bits) < self.most;
        (1..self.input.fraction_bits()).rev().find(fits)
    }

    fn advice(&self) -> String {
        let (input, remedy) = (self.input, self.sweep.remedy());
        let format = match self.sweep {
            Sweep::Design | Sweep::Pareto => "--input",
            _ => "input format",
        };
        match self.fitting_bits() {
            Some(bits) => {
                format!("x is {input}: use a narrower {format} of {bits} fraction bits or fewer, or {remedy}")
            }
            None => format!("x is {input}: use a narrower {format}, and {remedy}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_to_fit_does() {
        for sweep in Sweep::ALL {
            for exponents in [1_u128, 3, 8, 256, 65536] {
                for fraction in 1..=62 {
                    let format = QFormat::unsigned(1, fraction).unwrap();
                    let inputs = |bits: u32| exponents * ((1 << bits) + 1);
                    let Err(error) = sweep.within(inputs(fraction), format) else { continue };
                    let bits = error.fitting_bits().unwrap();
                    assert!(inputs(bits) <= sweep.most(), "{error}");
                    assert!(inputs(bits + 1) >= sweep.most(), "{error} could say more");
                    assert!(error.to_string().contains(&format!("of {bits} fraction bits")));
                }
            }
        }
    }

    #[test]
    fn the_limit_itself_is_within() {
        let format: QFormat = "UQ1.40".parse().unwrap();
        assert_eq!(Sweep::Report.within(1 << 40, format), Ok(1 << 40));
        assert!(Sweep::Report.within((1 << 40) + 1, format).is_err());
        assert!(Sweep::Refine.kept(MOST_KEPT + 1, format).is_err());
    }
}
