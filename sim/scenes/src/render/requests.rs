//! What the pipeline is asked: x in its own bits, by exponent.

use std::ops::Range;

use hw_model::datapath::front_end::Region;
use hw_model::design::Design;
use hw_model::format::{Overflow, QFormat};
use hw_model::quantise::{real, x_bits};
use thiserror::Error;

use super::samples::Samples;
use crate::scene::Scene;

/// x of a sample in the bits of an input format: rounded to the nearest, a tie to even, and brought into the format.
#[must_use]
pub fn bits(x: f64, input: QFormat) -> i64 {
    // Refused is only what is not finite, which no scene that was checked presents.
    x_bits(x, input, Overflow::Saturate).unwrap_or(0)
}

/// An exponent of the scene that the hardware has not.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "at `materials[{index}].exponent`: the ROM has no word for n = {exponent}; it has {available}; --nearest takes the \
     nearest of these"
)]
pub struct MissingExponent {
    /// The material's place in the scene.
    pub index: usize,
    /// The material's exponent.
    pub exponent: f64,
    /// The exponents of the ROM.
    pub available: String,
}

/// Which row of the ROM serves an exponent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowFor<'a> {
    /// Its own.
    Exactly,
    /// Its own or, where it has none, that of the nearest exponent by ratio: the greatest difference of x^n and x^m
    /// over x depends on m/n alone, and is the same for n/m.
    Nearest,
    /// The second exponent's, where the list has the first; otherwise, as of what is not asked for, the nearest.
    Served(&'a [(f64, f64)]),
}

/// Which samples go to the pipeline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Which {
    /// Every one. What a sample that faces away gets back is thrown away.
    Every,
    /// Those that face the light and the viewer and are not below a cut where the answer is zero.
    Needed,
}

/// The requests of one exponent.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// The exponent that all of its samples have.
    pub exponent: f64,
    /// Where the ROM has it.
    pub address: u32,
    /// Places in [`Samples::samples`], rising.
    pub samples: Vec<u32>,
    /// The x of each, in the input format's unit; a format without a sign has 0 for what is negative.
    pub xs: Vec<i64>,
}

/// What the front end must know of the exponent of a material.
#[derive(Debug, Clone, Copy)]
pub(super) struct MaterialRow {
    exponent: f64,
    address: u32,
    cut: i64,
    /// An x below this is zero without being asked; below every x where something answers down to 0.
    zero_below: f64,
    pub(super) epicentre: i64,
    /// Index of the group of its exponent.
    group: usize,
}

/// The pipeline, and what it has for each material of a scene.
#[derive(Debug)]
pub struct ScenePipeline<'a> {
    pub(super) design: &'a Design,
    /// In the order of the materials.
    pub(super) rows: Vec<MaterialRow>,
    exponents: Vec<f64>,
}

impl<'a> ScenePipeline<'a> {
    /// The pipeline for the materials of this scene, each with a row of its own.
    ///
    /// # Errors
    /// When the ROM has no word for the exponent of a material.
    pub fn new(design: &'a Design, scene: &Scene) -> Result<Self, MissingExponent> {
        Self::with_rows(design, scene, RowFor::Exactly)
    }

    /// The pipeline for the materials of this scene.
    ///
    /// # Errors
    /// When each is to have a row of its own, and the ROM has no word for the exponent of a material.
    pub fn with_rows(design: &'a Design, scene: &Scene, rows: RowFor<'_>) -> Result<Self, MissingExponent> {
        let rom = design.rom();
        let exponents = scene.exponents();
        let front_end = design.datapath().front_end();
        // Rounding moves x by half a unit of its last place at most, so that a whole one below the cut stays below.
        let zero_below = |cut: i64| match front_end.region(cut - 1, cut) {
            Region::Zero => real(cut - 1, design.config().input),
            Region::Polynomial | Region::Tail => f64::NEG_INFINITY,
        };
        let row = |(index, exponent): (usize, f64)| {
            let place = match rows {
                RowFor::Exactly => rom.exponents().position(exponent),
                RowFor::Nearest => nearest(rom.exponents().as_slice(), exponent),
                RowFor::Served(list) => {
                    let serving = list.iter().find(|(n, _)| *n == exponent).map_or(exponent, |&(_, row)| row);
                    nearest(rom.exponents().as_slice(), serving)
                }
            };
            let Some(place) = place else {
                let available = rom.exponents().to_string();
                return Err(MissingExponent { index, exponent, available });
            };
            let cut = front_end.cut(&rom.rows()[place]);
            Ok(MaterialRow {
                exponent,
                address: place as u32,
                cut,
                zero_below: zero_below(cut),
                epicentre: design.rows()[place].first_of_epicentre(design.config()),
                group: exponents.iter().position(|&n| n == exponent).unwrap_or_default(),
            })
        };
        let materials = scene.materials.iter().map(|material| material.exponent);
        let rows = materials.enumerate().map(row).collect::<Result<_, _>>()?;
        Ok(Self { design, rows, exponents })
    }

    /// The exponent of the row that serves each material, in their order.
    pub fn rows(&self) -> impl Iterator<Item = f64> {
        let exponents = self.design.rom().exponents().as_slice();
        self.rows.iter().map(|row| exponents.get(row.address as usize).copied().unwrap_or(row.exponent))
    }

    /// The hardware that is asked.
    #[must_use]
    pub const fn design(&self) -> &Design {
        self.design
    }

    /// x in the pipeline's bits.
    #[must_use]
    pub fn bits(&self, x: f64) -> i64 {
        bits(x, self.design.config().input)
    }

    /// The requests of these samples: a group for each exponent that has any, in rising order.
    #[must_use]
    pub fn requests(&self, samples: &Samples, range: Range<usize>, which: Which) -> Vec<Group> {
        let mut groups: Vec<Group> = self
            .exponents
            .iter()
            .map(|&exponent| Group { exponent, address: 0, samples: Vec::new(), xs: Vec::new() })
            .collect();
        let front_end = self.design.datapath().front_end();
        for index in range {
            let sample = samples.samples[index];
            let row = &self.rows[usize::from(samples.material_of(index))];
            let needed = which == Which::Needed;
            if needed && (sample.faces_away() || sample.x < row.zero_below) {
                continue;
            }
            let x = self.bits(sample.x);
            // What lies within a unit of the cut is known by its bits.
            if needed && front_end.region(x, row.cut) == Region::Zero {
                continue;
            }
            let group = &mut groups[row.group];
            debug_assert!(group.exponent == row.exponent);
            group.address = row.address;
            group.samples.push(index as u32);
            group.xs.push(x);
        }
        groups.retain(|group| !group.xs.is_empty());
        groups
    }
}

/// The place of the exponent nearest to n by ratio, of exponents that rise; the smaller of two that are as near.
fn nearest(exponents: &[f64], n: f64) -> Option<usize> {
    let above = exponents.partition_point(|&m| m < n);
    let ratio = |place: usize| exponents.get(place).map(|&m| (m / n).max(n / m));
    match (above.checked_sub(1).and_then(ratio), ratio(above)) {
        (Some(below), Some(at)) if below <= at => Some(above - 1),
        (_, Some(_)) => Some(above),
        (Some(_), None) => Some(above - 1),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_exponent_is_that_by_ratio() {
        let list = [1.0, 2.0, 8.0, 32.0];
        for (n, place) in
            [(0.5, 0), (1.0, 0), (1.4, 0), (1.5, 1), (3.9, 1), (4.0, 1), (4.1, 2), (16.0, 2), (17.0, 3), (1e9, 3)]
        {
            assert_eq!(nearest(&list, n), Some(place), "{n}");
        }
        assert_eq!(nearest(&[], 3.0), None);
    }
}
