//! Designs that were asked about, with what does not change of them.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use document::facts::Facts;
use hw_model::datapath::Datapath;
use hw_model::design::Design;

use crate::configuration::Configuration;
use crate::figures::Figures;
use crate::refusal::Refusal;
use crate::words::Range;

/// Designs that are kept: somebody compares a few.
const KEPT: usize = 8;

/// A design, and what takes a while to find out of it.
#[derive(Debug)]
pub(crate) struct Known {
    /// How it was asked for.
    pub(crate) configuration: Configuration,
    /// The design.
    pub(crate) design: Design,
    ranges: OnceLock<Vec<Vec<Range>>>,
    figures: OnceLock<Figures>,
}

impl Known {
    fn new(configuration: &Configuration) -> Result<Self, Refusal> {
        let design = configuration.design()?;
        let configuration = configuration.clone();
        Ok(Self { configuration, design, ranges: OnceLock::new(), figures: OnceLock::new() })
    }

    /// The data path of the design.
    pub(crate) const fn datapath(&self) -> &Datapath {
        self.design.datapath()
    }

    /// What the design errs and costs.
    pub(crate) fn figures(&self) -> Result<&Figures, Refusal> {
        if let Some(figures) = self.figures.get() {
            return Ok(figures);
        }
        let figures = Figures::of(&self.design)?;
        Ok(self.figures.get_or_init(|| figures))
    }

    /// What every register of every rank can hold, in the order of [`Datapath::registers`].
    pub(crate) fn ranges(&self) -> &[Vec<Range>] {
        self.ranges.get_or_init(|| {
            let (facts, datapath) = (Facts::new(&self.design), self.datapath());
            let of_rank = |rank| datapath.registers(rank).iter().map(|r| Range::of(&facts, rank, r)).collect();
            (0..datapath.rank_count()).map(of_rank).collect()
        })
    }
}

/// The last designs, the one that was asked about last at the end.
#[derive(Debug, Default)]
pub(crate) struct Cache(Mutex<VecDeque<Arc<Known>>>);

impl Cache {
    /// The design of a configuration, made where it is not kept.
    ///
    /// # Errors
    /// When the configuration gives none.
    pub(crate) fn get(&self, configuration: &Configuration) -> Result<Arc<Known>, Refusal> {
        if let Some(known) = self.find(configuration) {
            return Ok(known);
        }
        // Others are answered meanwhile; who asks for the same makes the same.
        let known = Arc::new(Known::new(configuration)?);
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.len() == KEPT {
            kept.pop_front();
        }
        kept.push_back(Arc::clone(&known));
        Ok(known)
    }

    fn find(&self, configuration: &Configuration) -> Option<Arc<Known>> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = kept.iter().position(|known| known.configuration == *configuration)?;
        let known = kept.remove(place)?;
        kept.push_back(Arc::clone(&known));
        Some(known)
    }
}
