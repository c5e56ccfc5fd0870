//! A case: what one clock cycle puts on the pipeline's input ports; and how cases are chosen.

use std::fmt;
use std::str::FromStr;

use hw_model::rom::Rom;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::kind::Kind;

/// One input of the pipeline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    /// n; none for an address that no exponent led to.
    pub exponent: Option<f64>,
    /// The ROM address, which stands for n in the hardware. From the ROM's depth up it has no word.
    pub address: u32,
    /// x in the unit of the input format, within that format; it may lie outside [0, 1].
    pub x: i64,
}

impl Case {
    /// The case of an address; its exponent is the one the ROM has there.
    #[inline]
    #[must_use]
    pub fn at(rom: &Rom, address: u32, x: i64) -> Self {
        let exponent = rom.exponents().as_slice().get(address as usize).copied();
        Self { exponent, address, x }
    }

    /// The case of an exponent; without a ROM word it goes to the first address past the end.
    #[inline]
    #[must_use]
    pub fn of(rom: &Rom, exponent: f64, x: i64) -> Self {
        Self { exponent: Some(exponent), address: rom.address_of(exponent), x }
    }
}

/// A case and why it was chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The input: an address and an x.
    pub case: Case,
    /// Why it was chosen.
    pub kind: Kind,
}

/// How cases are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Strategy {
    /// Targets first ([`crate::stimulus::targets`]), and corners until three quarters of the count are
    /// full, an even grid for an eighth, seeded random for the rest.
    #[default]
    Mixed,
    /// As few as kill every fault that can be killed ([`crate::faults::compact`]); the count is not asked.
    Compact,
    /// Where hardware goes wrong: ends, the cut, ties, extremes ([`crate::stimulus::corners`]).
    Corners,
    /// Evenly spaced over [0, 1] ([`crate::stimulus::even`]).
    Even,
    /// Vectors drawn from a seed ([`crate::stimulus::random`]).
    Random,
    /// Every address with every x; the count is not asked.
    Exhaustive,
    /// A list of the user's own ([`crate::evaluate::questions()`]); the count is not asked.
    List,
}

impl Strategy {
    /// Every strategy that chooses by itself, the default first: all but [`Strategy::List`].
    pub const ALL: [Self; 6] = [Self::Mixed, Self::Compact, Self::Corners, Self::Even, Self::Random, Self::Exhaustive];

    /// True where the strategy itself says how many cases there are.
    #[must_use]
    pub const fn counts_itself(self) -> bool {
        matches!(self, Self::Compact | Self::Exhaustive | Self::List)
    }

    /// The name used on the command line and in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mixed => "mixed",
            Self::Compact => "compact",
            Self::Corners => "corners",
            Self::Even => "even",
            Self::Random => "random",
            Self::Exhaustive => "exhaustive",
            Self::List => "list",
        }
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// How many vectors a command chooses unless it is told.
pub const DEFAULT_COUNT: u64 = 4096;

/// The seed of a command's random vectors unless it is told.
pub const DEFAULT_SEED: u64 = 1;

/// The options that choose these vectors, as they would be typed.
#[must_use]
pub fn options(strategy: Strategy, count: u64, seed: u64) -> String {
    let count = if strategy == Strategy::Compact { String::new() } else { format!(" --count {count}") };
    format!("--strategy {strategy}{count} --seed {seed}")
}

/// The text is not a strategy.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0:?} is not a strategy; use mixed, compact, corners, even, random or exhaustive")]
pub struct StrategyError(pub String);

impl FromStr for Strategy {
    type Err = StrategyError;

    fn from_str(text: &str) -> Result<Self, StrategyError> {
        Self::ALL.into_iter().find(|strategy| strategy.name() == text).ok_or_else(|| StrategyError(text.to_owned()))
    }
}
