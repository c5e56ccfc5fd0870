//! A block of samples of one exponent at a time: the same lines, without the ranks.
//!
//! The coefficients are hoisted out of the loop, each line runs over an array, and regions are
//! selected instead of branched on, so that a compiler can put several samples in one instruction.

use crate::rom::{FieldName, Row};
use crate::rounding::Lane;

use super::clamp::clamp;
use super::front_end::Region;
use super::ranks::Datapath;
use super::tail::Division;

/// Samples that go through the lines together.
const LANES: usize = 64;

/// The intensities of a block of samples, and the part that answered each.
#[derive(Debug, Clone, Default)]
pub struct Block {
    /// In the output's unit.
    pub intensities: Vec<i64>,
    /// The part that answered.
    pub regions: Vec<Region>,
}

impl Datapath {
    /// Evaluates every x at one address into `block`, whose memory is used again. An address without
    /// a word gives zeros.
    pub fn evaluate_block(&self, address: u32, xs: &[i64], block: &mut Block) {
        block.intensities.clear();
        block.regions.clear();
        block.intensities.resize(xs.len(), 0);
        block.regions.resize(xs.len(), Region::Zero);
        let Some(row) = self.rom.row(address) else {
            return;
        };
        let outputs = block.intensities.chunks_mut(LANES).zip(block.regions.chunks_mut(LANES));
        for (xs, (intensities, regions)) in xs.chunks(LANES).zip(outputs) {
            if self.narrow {
                self.evaluate_lanes::<i64>(row, xs, intensities, regions);
            } else {
                self.evaluate_lanes::<i128>(row, xs, intensities, regions);
            }
        }
    }

    fn evaluate_lanes<L: Lane>(
        &self,
        row: &Row,
        xs: &[i64],
        intensities: &mut [i64],
        regions: &mut [Region],
    ) {
        let cut = L::from_bits(row.get(FieldName::Cut));
        let mut any_tail = false;
        for (&x, region) in xs.iter().zip(regions.iter_mut()) {
            *region = self.front_end.region(L::from_bits(x), cut);
            any_tail |= *region == Region::Tail;
        }
        if self.stages.is_some() {
            self.polynomial_lanes::<L>(row, xs, regions, intensities);
        }
        if any_tail {
            self.tail_lanes::<L>(row, xs, regions, intensities);
        }
    }

    fn polynomial_lanes<L: Lane>(
        &self,
        row: &Row,
        xs: &[i64],
        regions: &[Region],
        intensities: &mut [i64],
    ) {
        let Some([stage1, stage2, stage3]) = &self.stages else {
            return;
        };
        let [c3, c2, c1, c0] = [FieldName::C3, FieldName::C2, FieldName::C1, FieldName::C0]
            .map(|name| L::from_bits(row.get(name)));
        let (one, shift) = (L::from_bits(self.output_one), row.shift());
        for ((&x, &region), intensity) in xs.iter().zip(regions).zip(intensities) {
            let x = self.front_end.clamp_input(L::from_bits(x));
            let v = self.front_end.variable(x, region, shift);
            let t1 = stage1.apply(c3, v, c2);
            let t2 = stage2.apply(t1, v, c1);
            let t3 = stage3.apply(t2, v, c0);
            let answers = region == Region::Polynomial;
            *intensity = if answers { clamp(t3, one).to_bits() } else { 0 };
        }
    }

    fn tail_lanes<L: Lane>(
        &self,
        row: &Row,
        xs: &[i64],
        regions: &[Region],
        intensities: &mut [i64],
    ) {
        let Some(divider) = &self.divider else { return };
        let a = L::from_bits(row.get(FieldName::TailA));
        let b = L::from_bits(row.get(FieldName::TailB));
        let idle = Division { divisor: L::ONE, remainder: L::ZERO, digits: L::ZERO };
        let mut divisions = [idle; LANES];
        for ((&x, &region), division) in xs.iter().zip(regions).zip(&mut divisions) {
            let x = self.front_end.clamp_input(L::from_bits(x));
            *division = divider.begin(self.front_end.tail_x(x, region), a, b);
        }
        for _ in 0..divider.digit_count {
            for division in &mut divisions {
                *division = divider.digit(*division);
            }
        }
        let one = L::from_bits(self.output_one);
        for ((&region, intensity), &division) in regions.iter().zip(intensities).zip(&divisions) {
            let quotient = divider.finish(division, one).to_bits();
            *intensity = if region == Region::Tail { quotient } else { *intensity };
        }
    }
}
