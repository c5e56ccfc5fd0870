//! What a shard found: a list of parts, in the order of the pieces.

use analysis::sweep::RowErrors;
use bounds::certify::claim::{EveryClaim, ExponentClaim};
use serde::{Deserialize, Serialize};

use crate::rtl::Counts;

/// The most bytes that a run of a program prints, 2^24.
pub const MOST_PRINTED: usize = 1 << 24;

/// A part of what a shard found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// The errors of a run of pieces of one ROM row.
    Errors(RowPart),
    /// The comparison of RTL and model over a run of pieces of one ROM row.
    Rtl(RtlPart),
    /// The enclosure of one method at one exponent.
    Claim(ExponentClaim),
    /// What one run of a program printed.
    Printed(Printed),
    /// The enclosure of one method at every real exponent.
    EveryClaim(EveryClaim),
}

/// The errors of consecutive pieces of one ROM row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RowPart {
    /// The address of the row.
    pub address: u32,
    /// The greatest errors over the x of these pieces.
    pub errors: RowErrors,
}

/// The comparison of RTL and model over consecutive pieces of one ROM row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RtlPart {
    /// The address of the row.
    pub address: u32,
    /// How many results agree and differ.
    pub counts: Counts,
}

/// What one run of a program printed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Printed {
    /// The exit status, 0 to 255.
    pub status: i32,
    /// Standard output.
    pub text: String,
}
