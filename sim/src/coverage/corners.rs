//! Which classes of corners are among the vectors.

use std::collections::{BTreeMap, HashSet};

use hw_model::design::Design;
use serde::Serialize;
use vectors::Sample;
use vectors::stimulus::corners::Corners;

/// A class of corners: those of a name, for every register and rank.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CornerClass {
    /// The name, as `vectors.csv` has it before the colon.
    pub name: String,
    /// Corners of this class that the design has.
    pub available: u64,
    /// Those whose input is among the vectors, whatever it was chosen for.
    pub met: u64,
}

/// Every class of corners that a design has.
pub(super) fn classes(design: &Design, samples: &[Sample]) -> Vec<CornerClass> {
    let asked: HashSet<(u32, i64)> = samples.iter().map(|sample| (sample.case.address, sample.case.x)).collect();
    let mut classes = BTreeMap::<String, (u64, u64)>::new();
    for corner in Corners::new(design, u64::MAX).samples() {
        let kind = corner.kind.to_string();
        let name = kind.split(':').next().unwrap_or(&kind).to_owned();
        let (available, met) = classes.entry(name).or_default();
        *available += 1;
        *met += u64::from(asked.contains(&(corner.case.address, corner.case.x)));
    }
    classes.into_iter().map(|(name, (available, met))| CornerClass { name, available, met }).collect()
}
