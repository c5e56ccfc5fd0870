//! What kinds share whose pieces are runs of x of ROM rows, and whose parts are rows.

use std::ops::Range;

use analysis::pieces::Pieces;
use hw_model::design::Design;
use vectors::limits::Sweep;

use crate::error::ShardError;
use crate::part::Part;

/// Whether one run goes through so many pieces of a design.
pub(super) fn fits(design: &Design, pieces: &Pieces, count: u64) -> Result<(), ShardError> {
    let inputs = u128::from(count) * u128::from(pieces.at(0).inputs());
    Sweep::Shard.within(inputs, design.config().input)?;
    Ok(())
}

/// The rows that some pieces are of, each with the first and the last x.
fn rows(pieces: Pieces, range: &Range<u64>) -> impl Iterator<Item = (u32, i64, i64)> {
    let (per_row, range) = (pieces.per_row(), range.clone());
    (range.start / per_row..range.end.div_ceil(per_row)).map(move |row| {
        let first = pieces.at(range.start.max(row * per_row));
        let last = pieces.at((range.end - 1).min((row + 1) * per_row - 1));
        (first.address, first.first, last.last)
    })
}

/// Whether parts are the rows of these pieces. `told` gives of a part its address and its number of samples, and what
/// is wrong with what it says of x from first to last; nothing for a part of another kind.
pub(super) fn check_rows(
    pieces: &Pieces,
    range: &Range<u64>,
    parts: &[Part],
    told: impl Fn(&Part, (i64, i64)) -> Option<(u32, u64, Option<String>)>,
) -> Result<(), String> {
    let mut rows = rows(*pieces, range);
    for part in parts {
        let (wanted, first, last) = rows.next().ok_or_else(|| "it has more rows than its pieces have".to_owned())?;
        let (address, samples, wrong) =
            told(part, (first, last)).ok_or_else(|| "a part is not of the kind of the job".to_owned())?;
        let own = (last - first + 1) as u64;
        if address != wanted || samples != own {
            return Err(format!(
                "{samples} samples of address {address}: its pieces have {own} samples of address {wanted}"
            ));
        }
        if let Some(wrong) = wrong {
            return Err(format!("address {address}: {wrong}"));
        }
    }
    match rows.next() {
        None => Ok(()),
        Some((address, ..)) => Err(format!("there is nothing of address {address}")),
    }
}

/// One part to a piece.
pub(super) fn count(pieces: &Range<u64>, parts: &[Part]) -> Result<(), String> {
    let wanted = pieces.end - pieces.start;
    if parts.len() as u64 == wanted {
        return Ok(());
    }
    Err(format!("it has {} parts, and its pieces give {wanted}", parts.len()))
}
