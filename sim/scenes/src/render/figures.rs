//! What a picture shows of the pipeline, in numbers: differences, regions, cycles. No times.

use serde::Serialize;

use super::highlight::{Answers, Zone};
use super::requests::ScenePipeline;
use super::samples::Samples;
use super::shading::Picture;
use crate::scene::Scene;

/// How two pictures differ, in display codes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Difference {
    /// The greatest of any pixel and colour.
    pub greatest: u16,
    /// The mean over all pixels and colours.
    pub mean: f64,
    /// The number of pixels with a difference in any colour.
    pub pixels: u64,
    /// Peak signal to noise over all pixels and colours, in decibel: 20·log10(greatest code / RMS difference). None
    /// for equal pictures.
    pub psnr: Option<f64>,
}

/// The difference of two pictures of the same size and bits.
#[must_use]
pub fn difference(one: &Picture, other: &Picture) -> Difference {
    let mut greatest = 0;
    let (mut sum, mut squares, mut pixels) = (0_u64, 0_u64, 0);
    for (one, other) in one.codes.iter().zip(&other.codes) {
        pixels += u64::from(one != other);
        for (one, other) in one.iter().zip(other) {
            let difference = one.abs_diff(*other);
            greatest = greatest.max(difference);
            sum += u64::from(difference);
            squares += u64::from(difference) * u64::from(difference);
        }
    }
    let count = 3.0 * one.codes.len() as f64;
    let peak = f64::from((1_u32 << one.bits) - 1);
    let psnr = |squares: u64| 10.0 * core_math::log10(peak * peak * count / squares as f64);
    Difference { greatest, mean: sum as f64 / count, pixels, psnr: (squares > 0).then(|| psnr(squares)) }
}

/// The samples of one material, or of all.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MaterialFigures {
    /// The name of the material.
    pub material: String,
    /// The exponent of the material.
    pub exponent: f64,
    /// The number of its samples: pixels times lights.
    pub samples: u64,
    /// Of these, x^n ≥ Q.
    pub epicentre: u64,
    /// Below the epicentre, and polynomial or divider answer.
    #[serde(rename = "below_epicentre")]
    pub tail: u64,
    /// Below the cut, and nothing answers.
    pub zero: u64,
    /// The light is behind the surface, or x is not above 0.
    pub facing_away: u64,
    /// Greatest |highlight − x^n|, as a fraction of full intensity.
    pub highlight_greatest: f64,
    /// Its mean over the samples that do not face away.
    pub highlight_mean: f64,
    /// The greatest in display codes of linear light: times the greatest code, before colours and transfer curve.
    pub highlight_greatest_codes: f64,
}

impl MaterialFigures {
    /// Samples in this part.
    #[must_use]
    pub const fn count(&self, part: Zone) -> u64 {
        match part {
            Zone::Epicentre => self.epicentre,
            Zone::Tail => self.tail,
            Zone::Zero => self.zero,
            Zone::FacesAway => self.facing_away,
        }
    }

    const fn counter(&mut self, part: Zone) -> &mut u64 {
        match part {
            Zone::Epicentre => &mut self.epicentre,
            Zone::Tail => &mut self.tail,
            Zone::Zero => &mut self.zero,
            Zone::FacesAway => &mut self.facing_away,
        }
    }
}

/// The samples of every material, in the order of the scene. `highlights` are the pipeline's, `reference` x^n.
#[must_use]
pub fn by_material(
    scene: &Scene,
    samples: &Samples,
    answers: &Answers,
    highlights: &[f64],
    reference: &[f64],
) -> Vec<MaterialFigures> {
    let peak = f64::from((1_u32 << scene.image.display_bits) - 1);
    let mut figures: Vec<MaterialFigures> = scene
        .materials
        .iter()
        .map(|material| MaterialFigures {
            material: material.name.clone(),
            exponent: material.exponent,
            samples: 0,
            epicentre: 0,
            tail: 0,
            zero: 0,
            facing_away: 0,
            highlight_greatest: 0.0,
            highlight_mean: 0.0,
            highlight_greatest_codes: 0.0,
        })
        .collect();
    let errors = highlights.iter().zip(reference).map(|(one, other)| (one - other).abs());
    let samples = samples.with_material().map(|(material, _)| usize::from(material));
    for ((material, &part), error) in samples.zip(&answers.parts).zip(errors) {
        let of = &mut figures[material];
        of.samples += 1;
        *of.counter(part) += 1;
        of.highlight_greatest = of.highlight_greatest.max(error);
        of.highlight_mean += error;
    }
    for of in &mut figures {
        of.highlight_mean /= (of.samples - of.facing_away).max(1) as f64;
        of.highlight_greatest_codes = of.highlight_greatest * peak;
    }
    figures
}

/// Clock cycles of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cycles {
    /// Samples that go to the pipeline, one in a cycle.
    pub requests: u64,
    /// Cycles from the first request to the last answer: requests and, after the last of them, the latency.
    pub cycles: u64,
    /// Pictures in a second.
    pub frames_per_second: Option<f64>,
}

impl Cycles {
    /// The cycles that this number of requests takes, and frames a second at this clock, in MHz. Without a request
    /// there is no cycle and no rate.
    #[must_use]
    pub fn new(pipeline: &ScenePipeline<'_>, requests: u64, clock_mhz: f64) -> Self {
        let latency = pipeline.design.datapath().latency() as u64;
        let cycles = if requests > 0 { requests + latency } else { 0 };
        let frames_per_second = (cycles > 0).then(|| clock_mhz * 1e6 / cycles as f64);
        Self { requests, cycles, frames_per_second }
    }
}
