//! How far the shards of a plan have come.

use crate::error::ShardError;
use crate::place::Place;
use crate::plan::Plan;
use crate::result::Found;

/// How far a shard has come.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum State {
    /// Its result is there.
    Done,
    /// A checkpoint says that so many of its pieces are measured.
    Begun(u64),
    /// Nothing is there.
    Waiting,
    /// What is there is not believed, for this reason.
    Refused(String),
}

/// A shard and how far it has come.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShardState {
    /// The number of the shard.
    pub index: u32,
    /// How many pieces it has.
    pub pieces: u64,
    /// How far it has come.
    pub state: State,
}

/// How far every shard has come.
///
/// # Errors
/// When there is no plan.
pub fn status(place: Place<'_>) -> Result<Vec<ShardState>, ShardError> {
    let (plan, kind) = Plan::read(place)?;
    (0..plan.shards())
        .map(|index| {
            let pieces = plan.pieces_of(index)?;
            let read = |path: &std::path::Path| Found::read(path, &plan, &*kind);
            let state = match read(&place.result(index)) {
                Ok(found) if found.pieces() == pieces => State::Done,
                Ok(_) => {
                    State::Refused(format!("{}: it has the pieces of another shard", place.result(index).display()))
                }
                Err(Some(why)) => State::Refused(why),
                Err(None) => match read(&place.checkpoint(index)) {
                    Ok(found) => State::Begun(found.pieces().end.saturating_sub(pieces.start)),
                    Err(Some(why)) => State::Refused(why),
                    Err(None) => State::Waiting,
                },
            };
            Ok(ShardState { index, pieces: pieces.end - pieces.start, state })
        })
        .collect()
}
