//! The registers of every rank, and when they load.

use hw_model::datapath::{Datapath, Flight, Signals};
use hw_model::handshake::{Control, Handshake};

use super::places::{Places, Remains};
use crate::slice::Slices;

/// One rank of registers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rank {
    /// True when the rank holds a request.
    pub valid: bool,
    /// False until data is loaded for the first time: hardware shows unknown values there.
    pub loaded: bool,
    /// What the data registers of the rank hold.
    pub signals: Signals,
}

/// The registers of every rank, first rank first. They are put together when they are asked for.
#[derive(Debug, Clone, Copy)]
pub struct Ranks<'a> {
    pub(super) datapath: &'a Datapath,
    pub(super) ranks: usize,
    pub(super) places: Places,
    pub(super) flights: &'a [Flight],
    pub(super) remains: &'a Remains,
    pub(super) slices: &'a Slices,
}

impl<'a> Ranks<'a> {
    /// One rank.
    ///
    /// # Panics
    /// When there is no such rank.
    #[must_use]
    pub fn rank(&self, rank: usize) -> Rank {
        assert!(rank < self.ranks);
        let flight = match self.places.shown(rank) {
            Some(number) => Some(&self.flights[number as usize & (self.flights.len() - 1)]),
            None => self.remains.shown(rank),
        };
        Rank {
            valid: self.places.valid >> rank & 1 == 1,
            loaded: flight.is_some(),
            signals: flight.map(|flight| self.datapath.shown(rank, flight)).unwrap_or_default(),
        }
    }

    /// Every rank, the first one first.
    pub fn iter(self) -> impl Iterator<Item = Rank> + use<'a> {
        (0..self.ranks).map(move |rank| self.rank(rank))
    }

    /// The last, which shows the result.
    #[must_use]
    pub fn last(&self) -> Rank {
        self.rank(self.ranks - 1)
    }

    /// The valid flags, the first rank's in bit 0.
    #[must_use]
    pub const fn valid(&self) -> u128 {
        self.places.valid
    }

    /// What stands around the ranks.
    #[must_use]
    pub const fn control(&self) -> &Control {
        self.datapath.control()
    }

    /// The register slices around the ranks.
    #[must_use]
    pub const fn slices(&self) -> &Slices {
        self.slices
    }

    /// True once the ports of the result have shown one: before, hardware shows unknown values there.
    #[must_use]
    pub fn result_loaded(&self) -> bool {
        self.slices.output.map_or_else(|| self.last().loaded, |slice| slice.head.is_some())
    }

    /// The ranks that advance in a cycle with this ready at the ports, the first rank's in bit 0.
    #[must_use]
    pub fn advance(&self, out_ready: bool) -> u128 {
        let ready = self.slices.output.map_or(out_ready, |slice| !slice.spare_valid);
        advance(self.control().handshake, self.places.valid, (1 << self.ranks) - 1, ready)
    }
}

/// The ranks that advance, where the valid flags are these of `all` ranks and the last result is taken or not.
#[inline(always)]
pub(super) fn advance(handshake: Handshake, valid: u128, all: u128, ready: bool) -> u128 {
    match handshake {
        _ if ready => all,
        // Rule 2, written out: where any rank from it on is empty, that is, up to the last empty one.
        Handshake::ValidReady => u128::MAX.checked_shr((all & !valid).leading_zeros()).unwrap_or(0),
        Handshake::Enable => 0,
        Handshake::None => all,
    }
}
