//! What every kind of work can do.

use std::ops::Range;

use crate::error::ShardError;
use crate::merged::Merged;
use crate::part::Part;

/// A kind of work, made ready for one job.
pub trait Kind: Send + Sync {
    /// How many pieces the job has.
    fn pieces(&self) -> u64;

    /// How many pieces each thread has between two checkpoints, at least.
    fn step(&self) -> u64;

    /// Whether a shard may have so many pieces.
    ///
    /// # Errors
    /// When that is more than one run goes through.
    fn fits(&self, pieces: u64) -> Result<(), ShardError> {
        let _ = pieces;
        Ok(())
    }

    /// Whether what measures is there, as it was when the plan was made.
    ///
    /// # Errors
    /// When it is not.
    fn ready(&self) -> Result<(), ShardError> {
        Ok(())
    }

    /// Measures one piece. Nothing but the job and the number of the piece decides what comes back.
    ///
    /// # Errors
    /// When it cannot be measured.
    fn measure(&self, piece: u64) -> Result<Part, ShardError>;

    /// Adds what was found in the next piece.
    fn join(&self, parts: &mut Vec<Part>, next: Part) {
        parts.push(next);
    }

    /// Whether these parts can be what was found in these pieces.
    ///
    /// # Errors
    /// With a sentence on what is wrong.
    fn check(&self, pieces: &Range<u64>, parts: &[Part]) -> Result<(), String>;

    /// The report, of the joined parts of all pieces.
    ///
    /// # Errors
    /// When it cannot be made.
    fn merged(&self, parts: Vec<Part>) -> Result<Merged, ShardError>;
}
