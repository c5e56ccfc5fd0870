//! Batch files for Slurm, written beside a plan.

use vectors::WholeFile;

use crate::error::ShardError;
use crate::place::Place;
use crate::plan::Plan;

/// An array of jobs, a shard each.
const SHARDS: &str = include_str!("recipe/shards.sbatch");
/// The job that merges, once the array is done.
const MERGE: &str = include_str!("recipe/merge.sbatch");

/// What stands in the array's file for the number of the last shard.
const LAST: &str = "LAST_SHARD";

/// Writes `shards.sbatch` and `merge.sbatch` into the directory of a plan.
///
/// # Errors
/// When they cannot be written.
pub fn write(plan: &Plan, place: Place<'_>) -> Result<(), ShardError> {
    let last = plan.shards() - 1;
    let array = SHARDS.replace(LAST, &last.to_string());
    for (name, text) in [("shards.sbatch", array.as_str()), ("merge.sbatch", MERGE)] {
        WholeFile::create(place.0.join(name))?.fill(text)?;
    }
    Ok(())
}
