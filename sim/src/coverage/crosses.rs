//! Regions crossed with stalls, bubbles and the regions that follow them.

use std::collections::BTreeMap;

use hw_model::datapath::Datapath;
use hw_model::datapath::front_end::Region;
use hw_model::registers::Register;
use serde::Serialize;

use super::fixed::regions;
use crate::run::Cycle;

/// What befell the requests of a region.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct RegionTraffic {
    /// The region.
    pub region: &'static str,
    /// Requests that this region answered.
    pub requests: u64,
    /// Ranks that know the region.
    pub ranks: usize,
    /// Those in which a request of this region was held by a stall.
    pub stalled: usize,
    /// Those in which a request of this region had a bubble behind it.
    pub before_bubble: usize,
    /// Those in which it had a request behind it.
    pub before_request: usize,
}

/// A region followed by another one, or by itself.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Passage {
    /// The region of a request.
    pub from: &'static str,
    /// The region of the next request.
    pub to: &'static str,
    /// How often the one followed the other.
    pub count: u64,
}

/// What is seen of one region in one rank.
#[derive(Debug, Clone, Copy, Default)]
struct Seen {
    stalled: bool,
    before_bubble: bool,
    before_request: bool,
}

/// The crosses of a run.
pub(super) struct Crosses {
    regions: Vec<Region>,
    /// Ranks that hold the region.
    ranks: Vec<usize>,
    seen: BTreeMap<(u8, usize), Seen>,
    requests: BTreeMap<u8, u64>,
    passages: BTreeMap<(u8, u8), u64>,
    /// The region of the request before, where it is first known.
    before: Option<u8>,
    /// Requests whose region was seen, and those that have entered the first rank that knows it.
    moved: bool,
}

impl Crosses {
    pub(super) fn new(datapath: &Datapath) -> Self {
        let knows =
            |rank: &usize| datapath.registers(*rank).iter().any(|register| register.register == Register::Region);
        Self {
            regions: regions(datapath),
            ranks: (0..datapath.rank_count()).filter(knows).collect(),
            seen: BTreeMap::new(),
            requests: BTreeMap::new(),
            passages: BTreeMap::new(),
            before: None,
            moved: true,
        }
    }

    /// Looks at a cycle: what each rank holds, and whether the edge moves it.
    pub(super) fn see(&mut self, cycle: &Cycle<'_>) {
        let valid = cycle.ranks.valid();
        let held = |rank: usize| valid >> rank & 1 == 1;
        let advance = cycle.ranks.advance(cycle.inputs.out_ready);
        let moves = |rank: usize| advance >> rank & 1 == 1;
        for &rank in &self.ranks {
            if !held(rank) {
                continue;
            }
            let region = cycle.ranks.rank(rank).signals.region as u8;
            let seen = self.seen.entry((region, rank)).or_default();
            seen.stalled |= !moves(rank);
            seen.before_bubble |= !held(rank - 1);
            seen.before_request |= held(rank - 1);
        }
        if let Some(&first) = self.ranks.first() {
            if held(first) && self.moved {
                let region = cycle.ranks.rank(first).signals.region as u8;
                *self.requests.entry(region).or_default() += 1;
                if let Some(before) = self.before.replace(region) {
                    *self.passages.entry((before, region)).or_default() += 1;
                }
            }
            // What it holds in the next cycle is another request, or none.
            self.moved = moves(first);
        }
    }

    pub(super) fn traffic(&self) -> Vec<RegionTraffic> {
        let of = |&region: &Region| {
            let count = |what: fn(&Seen) -> bool| {
                self.ranks.iter().filter(|rank| self.seen.get(&(region as u8, **rank)).is_some_and(what)).count()
            };
            RegionTraffic {
                region: region.name(),
                requests: self.requests.get(&(region as u8)).copied().unwrap_or_default(),
                ranks: self.ranks.len(),
                stalled: count(|seen| seen.stalled),
                before_bubble: count(|seen| seen.before_bubble),
                before_request: count(|seen| seen.before_request),
            }
        };
        self.regions.iter().map(of).collect()
    }

    pub(super) fn passages(&self) -> Vec<Passage> {
        let pairs = self.regions.iter().flat_map(|&from| self.regions.iter().map(move |&to| (from, to)));
        let passage = |(from, to): (Region, Region)| Passage {
            from: from.name(),
            to: to.name(),
            count: self.passages.get(&(from as u8, to as u8)).copied().unwrap_or_default(),
        };
        pairs.map(passage).collect()
    }
}
