//! Why results do not belong together.

use std::path::PathBuf;

use thiserror::Error;

/// Why results cannot be merged.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Refused {
    /// A file is no result of this job.
    #[error("a result is not believed: {0}; take it away, or run its shard again")]
    NotBelieved(String),
    /// Pieces that are in no result.
    #[error("pieces {first} to {last} are in no result; run {}", shards(.missing))]
    Gap {
        /// The first piece of the first gap.
        first: u64,
        /// The last piece of the first gap.
        last: u64,
        /// Every shard that has a piece that is in no result.
        missing: Vec<u32>,
    },
    /// A piece that is in two results.
    #[error("piece {piece} is in two results, {} and {}; take one of them away", one.display(), other.display())]
    Double {
        /// The first such piece.
        piece: u64,
        /// A result that has it.
        one: PathBuf,
        /// Another one.
        other: PathBuf,
    },
}

/// The first shards of a list, as words.
fn shards(missing: &[u32]) -> String {
    const MOST: usize = 12;
    let listed: Vec<String> = missing.iter().take(MOST).map(ToString::to_string).collect();
    let more = missing.len().saturating_sub(MOST);
    let rest = if more > 0 { format!(" and {more} more, which `blysk shard status` lists") } else { String::new() };
    let noun = if missing.len() == 1 { "shard" } else { "shards" };
    format!("{noun} {}{rest}", listed.join(", "))
}
