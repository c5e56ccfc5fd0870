//! Which request stands in which rank, and what ranks show of those that left or were lost.

use hw_model::datapath::Flight;

/// Where the requests are. They are numbered as they enter.
///
/// Requests do not overtake each other, so the valid flags and the number of those that have left say which request
/// stands where: behind a rank are those that left and one for each valid flag from it on. The last of these is what
/// the rank shows, whether it still holds it or has passed it on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    /// A flag of every rank is a bit.
    pub(super) valid: u128,
    /// Requests that left, counting those that a reset lost.
    pub(super) left: u64,
    /// The same when the last reset ended.
    pub(super) before: u64,
}

impl Places {
    /// The number of the request that a rank shows; none before it has loaded one since the last reset.
    #[inline]
    pub(super) fn shown(&self, rank: usize) -> Option<u64> {
        let passed = self.left + u64::from((self.valid >> rank).count_ones());
        (passed > self.before).then(|| passed - 1)
    }
}

/// What ranks showed at the last reset, which clears flags but no data.
#[derive(Debug, Clone)]
pub(super) struct Remains {
    /// Ranks that had loaded a request: a bit each.
    pub(super) loaded: u128,
    pub(super) flights: Vec<Flight>,
}

impl Remains {
    pub(super) fn shown(&self, rank: usize) -> Option<&Flight> {
        (self.loaded >> rank & 1 == 1).then(|| &self.flights[rank])
    }
}
