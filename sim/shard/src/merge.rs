//! Putting the results of all shards together.
//!
//! What is merged is every file of the directory of results, whatever its name: results say themselves which pieces
//! they are of. The files must have every piece of the job once, be of this job, and of this version of the program.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::ShardError;
use crate::merged::Merged;
use crate::place::Place;
use crate::plan::Plan;
use crate::refused::Refused;
use crate::result::Found;

/// Merges the results of a plan.
///
/// # Errors
/// When a piece is in no result or in two, a result is not of this job and version, or the report cannot be made.
pub fn merge(place: Place<'_>) -> Result<Merged, ShardError> {
    let (plan, kind) = Plan::read(place)?;
    let mut found = Vec::new();
    for path in results(&place.results())? {
        match Found::read(&path, &plan, &*kind) {
            Ok(result) => found.push((path, result)),
            Err(why) => return Err(Refused::NotBelieved(why.unwrap_or_else(|| path.display().to_string())).into()),
        }
    }
    found.sort_by_key(|(_, result)| (result.pieces().start, result.pieces().end));
    complete(&plan, kind.pieces(), &found)?;
    let mut parts = Vec::new();
    for (_, result) in found {
        for part in result.into_parts() {
            kind.join(&mut parts, part);
        }
    }
    kind.merged(parts)
}

/// Every piece is in one result. The results are sorted.
fn complete(plan: &Plan, pieces: u64, found: &[(PathBuf, Found)]) -> Result<(), Refused> {
    let mut next = 0;
    let mut gaps = Vec::new();
    let mut before: Option<&PathBuf> = None;
    for (path, result) in found {
        let own = result.pieces();
        if let Some(one) = before.filter(|_| own.start < next) {
            return Err(Refused::Double { piece: own.start, one: one.clone(), other: path.clone() });
        }
        if own.start > next {
            gaps.push(next..own.start);
        }
        (next, before) = (own.end, Some(path));
    }
    if next < pieces {
        gaps.push(next..pieces);
    }
    let Some(first) = gaps.first().cloned() else { return Ok(()) };
    let mut missing: Vec<u32> = gaps.iter().flat_map(|gap| plan.shards_of(gap)).collect();
    missing.dedup();
    Err(Refused::Gap { first: first.start, last: first.end - 1, missing })
}

/// The files of a directory of results in the order of their names; none where there is no such directory. Hidden files
/// are those that a shard is writing.
fn results(directory: &Path) -> Result<Vec<PathBuf>, ShardError> {
    let at = |cause| ShardError::Io { path: directory.to_owned(), cause };
    let entries = match fs::read_dir(directory) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(at(error)),
    };
    let mut paths = Vec::new();
    for entry in entries {
        let entry = entry.map_err(at)?;
        if !entry.file_name().to_string_lossy().starts_with('.') {
            paths.push(entry.path());
        }
    }
    paths.sort();
    Ok(paths)
}
