//! Lists of x, one for each row of the ROM, taken in rounds.

use hw_model::design::Design;

use super::even::spread;
use crate::case::{Case, Sample};
use crate::kind::Kind;

/// An x of a row, and why it was chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Point {
    pub kind: Kind,
    pub x: i64,
}

/// At most `limit` samples: the first of each list, then `after_first`, then the second of each list, and
/// so on. A round that is cut short is spread over the rows.
pub fn in_rounds(design: &Design, lists: &[Vec<Point>], after_first: &[Sample], limit: u64) -> Vec<Sample> {
    let limit = usize::try_from(limit).unwrap_or(usize::MAX);
    let longest = lists.iter().map(Vec::len).max().unwrap_or(0);
    let mut samples = Vec::new();
    for round in 0..longest.max(1) {
        let addresses: Vec<usize> = (0..lists.len()).filter(|&address| lists[address].len() > round).collect();
        let left = limit - samples.len();
        let taken = addresses.len().min(left) as u64;
        samples.extend((0..taken).map(|index| {
            let address = addresses[spread(index, taken, addresses.len() as u64) as usize];
            let Point { kind, x } = lists[address][round];
            Sample { case: Case::at(design.rom(), address as u32, x), kind }
        }));
        if round == 0 {
            let left = limit - samples.len();
            samples.extend(after_first.iter().take(left));
        }
    }
    samples
}
