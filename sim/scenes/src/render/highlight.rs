//! The highlights: the pipeline's answers, and x^n beside them.

use hw_model::datapath::Block;
use hw_model::datapath::front_end::Region;
use hw_model::highlight::phong;
use hw_model::quantise::real;
use rayon::prelude::*;

use super::requests::{ScenePipeline, Which};
use super::samples::Samples;
use crate::scene::Scene;

/// Samples that a thread takes at a time: their bits stay in the second-level cache.
const PIECE: usize = 1 << 13;

/// Where in the highlight a sample lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Zone {
    /// The light is behind the surface, or x is not above 0: zero without asking.
    #[default]
    FacesAway,
    /// Below the cut, with nothing that answers there: zero.
    Zero,
    /// Below the epicentre, and polynomial or divider answer.
    Tail,
    /// x^n is at least Q.
    Epicentre,
}

impl Zone {
    /// All, in the order of tables.
    pub const ALL: [Self; 4] = [Self::Epicentre, Self::Tail, Self::Zero, Self::FacesAway];

    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Epicentre => "epicentre",
            Self::Tail => "below it",
            Self::Zero => "zero",
            Self::FacesAway => "facing away",
        }
    }
}

/// The pipeline's answers to the samples of a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Answers {
    /// In the output format's unit, a place for each sample.
    pub intensities: Vec<i64>,
    /// Where each lies. Of samples that were not asked for, only that they are zero or face away.
    pub parts: Vec<Zone>,
    /// Samples that went to the pipeline.
    pub requests: u64,
}

impl ScenePipeline<'_> {
    /// The pipeline's answers. Each exponent's requests go through the block engine together.
    #[must_use]
    pub fn answers(&self, samples: &Samples, which: Which) -> Answers {
        let mut intensities = vec![0_i64; samples.samples.len()];
        let mut parts = vec![Zone::FacesAway; samples.samples.len()];
        let requests = intensities
            .par_chunks_mut(PIECE)
            .zip(parts.par_chunks_mut(PIECE))
            .enumerate()
            .map_init(Block::default, |block, (piece, (intensities, parts))| {
                self.answer_piece(samples, which, piece * PIECE, intensities, parts, block)
            })
            .sum();
        Answers { intensities, parts, requests }
    }

    fn answer_piece(
        &self,
        samples: &Samples,
        which: Which,
        first: usize,
        intensities: &mut [i64],
        parts: &mut [Zone],
        block: &mut Block,
    ) -> u64 {
        let range = first..first + intensities.len();
        for (sample, part) in samples.samples[range.clone()].iter().zip(parts.iter_mut()) {
            // What is asked below is put in its place there.
            *part = if sample.faces_away() { Zone::FacesAway } else { Zone::Zero };
        }
        let mut count = 0;
        for group in self.requests(samples, range, which) {
            count += group.xs.len() as u64;
            self.design.datapath().evaluate_block(group.address, &group.xs, block);
            let answers = block.intensities.iter().zip(&block.regions);
            for ((&sample, &x), (&intensity, &region)) in group.samples.iter().zip(&group.xs).zip(answers) {
                let place = sample as usize - first;
                if parts[place] == Zone::FacesAway || region == Region::Zero {
                    continue;
                }
                let row = &self.rows[usize::from(samples.material_of(sample as usize))];
                parts[place] = if x >= row.epicentre { Zone::Epicentre } else { Zone::Tail };
                intensities[place] = intensity;
            }
        }
        count
    }

    /// The answers as real numbers.
    #[must_use]
    pub fn highlights(&self, answers: &Answers) -> Vec<f64> {
        let format = self.design.config().output;
        answers.intensities.par_iter().map(|&bits| real(bits, format)).collect()
    }
}

/// x^n of every sample at its unrounded x, correctly rounded; zero for what faces away.
#[must_use]
pub fn reference(scene: &Scene, samples: &Samples) -> Vec<f64> {
    let power = |(index, sample): (usize, &super::samples::Sample)| {
        if sample.faces_away() {
            return 0.0;
        }
        let exponent = scene.materials[usize::from(samples.material_of(index))].exponent;
        // A rounding above 1 is 1, as in the pipeline.
        phong(exponent, sample.x.min(1.0))
    };
    samples.samples.par_iter().enumerate().map(power).collect()
}
