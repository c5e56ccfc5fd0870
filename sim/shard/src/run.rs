//! Running one shard, from its last checkpoint to its end.

use std::fs;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::Path;
use std::time::{Duration, Instant};

use rayon::prelude::*;
use vectors::WholeFile;
use vectors::progress::Progress;

use crate::error::ShardError;
use crate::kind::Kind;
use crate::part::Part;
use crate::place::Place;
use crate::plan::Plan;
use crate::result::Found;

/// What came of running a shard.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ran {
    /// The pieces of the shard.
    pub pieces: Range<u64>,
    /// The pieces that were measured now; none where the result was there.
    pub measured: Range<u64>,
    /// What was there and not believed, with the reasons.
    pub not_believed: Vec<String>,
}

/// Runs the shard of this number of a plan that was read. `every` is the time between two checkpoints, at least. Pieces
/// go to all threads; the bytes of the result do not depend on their number, nor on checkpoints.
///
/// # Errors
/// When there is no such shard, it cannot be measured, or its result cannot be written.
pub fn run(
    place: Place<'_>,
    (plan, kind): (&Plan, &dyn Kind),
    index: u32,
    every: Duration,
    progress: &dyn Progress,
) -> Result<Ran, ShardError> {
    let pieces = plan.pieces_of(index)?;
    let (result, checkpoint) = (place.result(index), place.checkpoint(index));
    let mut not_believed = Vec::new();
    let mut believed = |path: &Path| {
        let found = Found::read(path, plan, kind);
        found.map_err(|why| not_believed.extend(why)).ok()
    };
    if let Some(found) = believed(&result)
        && found.pieces() == pieces
    {
        remove(&checkpoint)?;
        return Ok(Ran { measured: pieces.end..pieces.end, pieces, not_believed });
    }
    let begun = believed(&checkpoint).filter(|found| found.pieces().start == pieces.start);
    let begun = begun.filter(|found| found.pieces().end <= pieces.end);
    kind.ready()?;
    // Shards that begin together all make the directories: whoever comes second finds them there.
    for path in [&result, &checkpoint] {
        let directory = path.parent().unwrap_or(path);
        fs::create_dir_all(directory).map_err(|cause| ShardError::Io { path: directory.to_owned(), cause })?;
    }
    // Before the work, so that a place where nothing can be written is found at once.
    let file = WholeFile::create(&result)?;
    let mut shard = Shard::new(plan, kind, pieces.clone(), begun);
    let measured = shard.done..pieces.end;
    progress.advance(shard.done - pieces.start);
    let mut last = Instant::now();
    while shard.done < pieces.end {
        progress.advance(shard.step()?);
        if shard.done < pieces.end && last.elapsed() >= every {
            WholeFile::create(&checkpoint)?.fill(shard.found().to_json())?;
            last = Instant::now();
        }
    }
    file.fill(shard.found().to_json())?;
    remove(&checkpoint)?;
    Ok(Ran { pieces, measured, not_believed })
}

/// A shard under way.
struct Shard<'a> {
    plan: &'a Plan,
    kind: &'a dyn Kind,
    pieces: Range<u64>,
    /// The first piece that is not measured.
    done: u64,
    parts: Vec<Part>,
}

impl<'a> Shard<'a> {
    fn new(plan: &'a Plan, kind: &'a dyn Kind, pieces: Range<u64>, begun: Option<Found>) -> Self {
        let done = begun.as_ref().map_or(pieces.start, |found| found.pieces().end);
        let parts = begun.map(Found::into_parts).unwrap_or_default();
        Self { plan, kind, pieces, done, parts }
    }

    /// Measures some pieces more, and returns their number.
    fn step(&mut self) -> Result<u64, ShardError> {
        let threads = rayon::current_num_threads() as u64;
        let end = self.pieces.end.min(self.done + self.kind.step() * threads);
        let measured = (self.done..end).into_par_iter().map(|piece| self.kind.measure(piece));
        for part in measured.collect::<Result<Vec<_>, _>>()? {
            self.kind.join(&mut self.parts, part);
        }
        let count = end - self.done;
        self.done = end;
        Ok(count)
    }

    fn found(&self) -> Found {
        Found::new(self.plan, self.pieces.start..self.done, self.parts.clone())
    }
}

/// A checkpoint of a shard that is done tells nothing more.
fn remove(checkpoint: &Path) -> Result<(), ShardError> {
    match fs::remove_file(checkpoint) {
        Err(cause) if cause.kind() != ErrorKind::NotFound => Err(ShardError::Io { path: checkpoint.to_owned(), cause }),
        _ => Ok(()),
    }
}
