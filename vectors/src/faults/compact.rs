//! The smallest set of vectors that kills every fault that can be killed.
//!
//! 1. For each row, every x is tried under every fault of the row. x that kill the same faults are
//!    worth the same, so one of each sort is kept, and of those the fewest that kill all are taken:
//!    exactly the fewest ([`super::cover`]). Rows share no faults, so the sum over the rows is a bound that
//!    no set of vectors can be below.
//! 2. The faults of the whole pipeline are tried on these vectors; for those that survive, the design's
//!    corners are tried, and those that kill most are added.
//! 3. What still survives is tried on every input. A fault that survives that is equivalent.

use std::collections::HashSet;
use std::ops::RangeInclusive;

use hw_model::datapath::front_end::FrontEnd;
use hw_model::design::Design;

use super::cover::fewest;
use super::evaluate::{Faulty, Model};
use super::fault::Fault;
use super::list::pipeline_faults;
use super::rows::{Mask, RowFaults};
use super::screen::Screen;
use crate::case::{Case, Sample};
use crate::kind::Kind;
use crate::limits::inputs;
use crate::stimulus::corners::Corners;

/// x that are evaluated together.
const CHUNK: i64 = 4096;

/// Who does work that can be shared out.
pub trait Workers {
    /// The results of `job` for 0 to `count` − 1, in this order, worked out in any order.
    fn run<T: Send>(&self, count: u32, job: impl Fn(u32) -> T + Sync) -> Vec<T>;
}

/// One after the other.
#[derive(Debug, Clone, Copy, Default)]
pub struct OneByOne;

impl Workers for OneByOne {
    fn run<T: Send>(&self, count: u32, job: impl Fn(u32) -> T + Sync) -> Vec<T> {
        (0..count).map(job).collect()
    }
}

/// What became of a fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaultFate {
    /// The fault that is judged.
    pub fault: Fault,
    /// The first vector that kills it; none when no input does.
    pub killed_by: Option<u64>,
}

/// The set, and what it kills.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Compact {
    samples: Vec<Sample>,
    verdicts: Vec<FaultFate>,
    lower_bound: u64,
    inputs: u64,
}

impl Compact {
    /// Searches. Goes through every x of every row several times; [`inputs`] says how many there are.
    #[must_use]
    pub fn search(design: &Design, workers: &impl Workers) -> Self {
        let depth = design.rom().depth() as u32;
        let covers = workers.run(depth, |address| RowCover::search(design, address));
        let mut set = Self { inputs: inputs(design) as u64, ..Self::default() };
        for cover in &covers {
            set.add_row(design, cover);
        }
        // Only an address without a word shows that its flag is missing, and no fault of a row.
        set.lower_bound = set.samples.len() as u64 + 1;
        set.add_pipeline(design, workers);
        set
    }

    /// The vectors of the smallest set found, as vectors.
    #[must_use]
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Every fault: first those of each row, then those of the pipeline.
    #[must_use]
    pub fn verdicts(&self) -> &[FaultFate] {
        &self.verdicts
    }

    /// No set with fewer vectors kills every fault that can be killed.
    #[must_use]
    pub const fn lower_bound(&self) -> u64 {
        self.lower_bound
    }

    /// The inputs that tell a fault from the right hardware, if any does: x of [0, 1] times words.
    #[must_use]
    pub const fn inputs(&self) -> u64 {
        self.inputs
    }

    /// Faults that no input kills.
    pub fn equivalent(&self) -> impl Iterator<Item = Fault> {
        self.verdicts.iter().filter(|v| v.killed_by.is_none()).map(|v| v.fault)
    }

    fn add_row(&mut self, design: &Design, cover: &RowCover) {
        let first = self.samples.len() as u64;
        for (bit, fault) in cover.faults.iter().enumerate() {
            let kills = |(_, mask): &(i64, Mask)| mask >> bit & 1 == 1;
            let killed_by = cover.chosen.iter().position(kills).map(|at| first + at as u64);
            self.verdicts.push(FaultFate { fault: *fault, killed_by });
        }
        self.samples.extend(
            cover
                .chosen
                .iter()
                .map(|&(x, _)| Sample { case: Case::at(design.rom(), cover.address, x), kind: Kind::Target }),
        );
    }

    fn add_pipeline(&mut self, design: &Design, workers: &impl Workers) {
        let model = Model::new(design.datapath());
        let faults = pipeline_faults(design.datapath());
        let faulty: Vec<Faulty<'_>> = faults.iter().map(|&fault| model.faulty(fault)).collect();
        let mut hunt = Hunt { design, faulty: &faulty, killed_by: vec![None; faulty.len()] };
        hunt.try_all(&self.samples, 0);
        self.extend(&mut hunt, Corners::new(design, u64::MAX).samples());
        let found = hunt.exhaust(workers);
        self.extend(&mut hunt, &found);
        let verdicts = faults.iter().zip(&hunt.killed_by);
        self.verdicts.extend(verdicts.map(|(&fault, &killed_by)| FaultFate { fault, killed_by }));
    }

    /// Adds candidates while they kill what survives, each time the one that kills most.
    fn extend(&mut self, hunt: &mut Hunt<'_>, candidates: &[Sample]) {
        let survivors = hunt.survivors();
        let kills: Vec<Vec<usize>> = candidates.iter().map(|sample| hunt.kills(&survivors, sample.case)).collect();
        loop {
            let gain = |kills: &Vec<usize>| kills.iter().filter(|&&fault| hunt.killed_by[fault].is_none()).count();
            let gains = kills.iter().map(gain).enumerate();
            // Of equal ones the first.
            let Some((best, 1..)) = gains.rev().max_by_key(|&(_, gain)| gain) else { return };
            let sample = Sample { kind: Kind::Target, ..candidates[best] };
            hunt.try_all(&[sample], self.samples.len() as u64);
            self.samples.push(sample);
        }
    }
}

/// The fewest x of a row that kill every fault of it that can be killed.
#[derive(Debug)]
struct RowCover {
    address: u32,
    faults: Vec<Fault>,
    chosen: Vec<(i64, Mask)>,
}

impl RowCover {
    fn search(design: &Design, address: u32) -> Self {
        let mut row = RowFaults::new(design.datapath(), address);
        let front_end = *design.datapath().front_end();
        let found: Vec<(i64, Mask)> = exhaust(&mut row, Mask::MAX, front_end).collect();
        let masks: Vec<Mask> = found.iter().map(|(_, mask)| *mask).collect();
        let all = masks.iter().fold(0, |set, mask| set | mask);
        let mut chosen: Vec<(i64, Mask)> = fewest(&masks, all).into_iter().map(|index| found[index]).collect();
        chosen.sort_unstable();
        let faults = row.faults().iter().copied().map(Fault::Field).collect();
        Self { address, faults, chosen }
    }
}

/// Every sort of x in a row, told apart by what it kills of `wanted`: the least x of each sort, increasing.
/// Beyond [0, 1] there are no more sorts: above 1 the front end takes x as 1, and below 0 no row is asked.
pub fn exhaust(row: &mut RowFaults<'_>, wanted: Mask, front_end: FrontEnd) -> impl Iterator<Item = (i64, Mask)> {
    let (mut seen, mut masks) = (HashSet::from([0]), Vec::new());
    chunks(0..=front_end.greatest).flat_map(move |xs| {
        row.killed(&xs, wanted, &mut masks);
        let sorts = xs.into_iter().zip(masks.iter().copied());
        let is_new = |&(_, mask): &(i64, Mask)| seen.insert(mask);
        sorts.filter(is_new).collect::<Vec<_>>()
    })
}

/// The hunt for the faults of the pipeline.
struct Hunt<'a> {
    design: &'a Design,
    faulty: &'a [Faulty<'a>],
    killed_by: Vec<Option<u64>>,
}

impl Hunt<'_> {
    fn survivors(&self) -> Vec<usize> {
        (0..self.faulty.len()).filter(|&fault| self.killed_by[fault].is_none()).collect()
    }

    /// Notes which of these vectors, the first of them number `first`, kills what survived so far.
    fn try_all(&mut self, samples: &[Sample], first: u64) {
        let mut survivors = self.survivors();
        for (index, sample) in (first..).zip(samples) {
            let killed = self.kills(&survivors, sample.case);
            for &fault in &killed {
                self.killed_by[fault] = Some(index);
            }
            survivors.retain(|fault| !killed.contains(fault));
        }
    }

    /// Those of `faults` that a case kills.
    fn kills(&self, faults: &[usize], case: Case) -> Vec<usize> {
        let passage = self.design.datapath().passage(case.address, case.x);
        faults.iter().copied().filter(|&fault| self.faulty[fault].is_killed(&passage)).collect()
    }

    /// For each row and each fault that survived, the least x that kills it.
    fn exhaust(&self, workers: &impl Workers) -> Vec<Sample> {
        let survivors = self.survivors();
        if survivors.is_empty() {
            return Vec::new();
        }
        let depth = self.design.rom().depth() as u32;
        workers.run(depth, |address| self.exhaust_row(address, survivors.clone())).concat()
    }

    fn exhaust_row(&self, address: u32, mut survivors: Vec<usize>) -> Vec<Sample> {
        let datapath = self.design.datapath();
        let row = datapath.row(address);
        let (mut screen, mut found) = (Screen::default(), Vec::new());
        for xs in chunks(self.every_x(&survivors)) {
            screen.take(datapath, &row, &xs);
            survivors.retain(|&fault| {
                let faulty = &self.faulty[fault];
                let suspects = screen.suspects(faulty, &row, &xs);
                let killer = suspects.into_iter().map(|x| Case::at(self.design.rom(), address, x));
                let killer = killer.into_iter().find(|case| faulty.is_killed(&datapath.passage(case.address, case.x)));
                found.extend(killer.map(|case| Sample { case, kind: Kind::Target }));
                killer.is_none()
            });
            if survivors.is_empty() {
                break;
            }
        }
        found
    }

    /// Every x of [0, 1]; every x of the format where a fault looks at x as it was given. Behind the
    /// front end an x beyond [0, 1] is another one with a flag, and the corners have those.
    fn every_x(&self, faults: &[usize]) -> RangeInclusive<i64> {
        let as_given = |&fault: &usize| {
            let faulty = &self.faulty[fault];
            matches!(faulty.fault(), Fault::Logic(_)) && faulty.rank() == 1
        };
        let input = self.design.config().input;
        match faults.iter().any(as_given) {
            true => input.min_bits()..=input.max_bits(),
            false => 0..=self.design.datapath().front_end().greatest,
        }
    }
}

/// A range in pieces of at most [`CHUNK`].
fn chunks(range: RangeInclusive<i64>) -> impl Iterator<Item = Vec<i64>> {
    let (first, last) = range.into_inner();
    let starts = (0..=(last - first) / CHUNK).map(move |index| first + index * CHUNK);
    starts.map(move |start| (start..=last.min(start + (CHUNK - 1))).collect())
}
