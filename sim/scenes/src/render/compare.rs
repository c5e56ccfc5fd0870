//! Several pipelines side by side: what each makes of the same samples, and how it differs from x^n.

use serde::Serialize;

use super::colour::Codes;
use super::figures::{Cycles, Difference, difference};
use super::frame_clock::FrameClock;
use super::heat::{end_of, heat};
use super::highlight::reference;
use super::panels::{Panel, bytes, sheet, thinned};
use super::requests::{ScenePipeline, Which};
use super::samples::Samples;
use super::shading::shade;
use super::sheet::SheetError;
use crate::scene::Scene;

/// A pipeline beside others.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compared {
    /// The name of its configuration.
    pub configuration: String,
    /// The greatest difference from the picture of x^n, in display codes, of any pixel and colour.
    pub picture_greatest_codes: u16,
    /// Its mean over all pixels and colours, in display codes.
    pub picture_mean_codes: f64,
    /// Pixels that differ in any colour.
    pub picture_pixels: u64,
    /// Peak signal to noise over all pixels and colours, in decibel; none for equal pictures.
    pub picture_psnr_db: Option<f64>,
    /// The greatest |highlight − x^n| in codes of linear light: before colours and transfer curve.
    pub highlight_greatest_linear_codes: f64,
    /// The same in display codes, through the transfer curve, of a highlight at full strength.
    pub highlight_greatest_display_codes: u16,
    /// Cycles from the request to its answer, without a stall.
    pub latency: u64,
    /// The pipeline's clock, in MHz: stated, or estimated for a device.
    pub clock_mhz: f64,
    /// Pictures in a second at that clock, where only the samples that need the pipeline go there; none without such
    /// a sample.
    pub frames_per_second: Option<f64>,
}

/// What each of the pipelines makes of the samples, in their order.
#[must_use]
pub fn compare(scene: &Scene, samples: &Samples, pipelines: &[ScenePipeline<'_>], clock: &FrameClock) -> Vec<Compared> {
    let codes = &Codes::new(&scene.image);
    let ideal = reference(scene, samples);
    let wanted = shade(scene, samples, codes, &ideal);
    let one = |pipeline: &ScenePipeline<'_>| {
        let answers = pipeline.answers(samples, Which::Needed);
        let highlights = pipeline.highlights(&answers);
        let clock_mhz = clock.mhz(pipeline.design());
        let Difference { greatest, mean, pixels, psnr } =
            difference(&shade(scene, samples, codes, &highlights), &wanted);
        let both = || highlights.iter().zip(&ideal);
        let apart = both().map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
        let apart_codes = both().map(|(&one, &other)| codes.of(one).abs_diff(codes.of(other))).max();
        Compared {
            configuration: pipeline.design().config().name.clone(),
            picture_greatest_codes: greatest,
            picture_mean_codes: mean,
            picture_pixels: pixels,
            picture_psnr_db: psnr,
            highlight_greatest_linear_codes: apart * f64::from(codes.greatest()),
            highlight_greatest_display_codes: apart_codes.unwrap_or(0),
            latency: pipeline.design().datapath().latency() as u64,
            clock_mhz,
            frames_per_second: Cycles::new(pipeline, answers.requests, clock_mhz).frames_per_second,
        }
    };
    pipelines.iter().map(one).collect()
}

/// x^n and the pipelines in a row, and below each of these its difference from x^n, all on one scale, which ends at
/// `asked` codes, or where there is none at the greatest difference of all.
///
/// # Errors
/// When the words cannot be drawn, or the file not be encoded.
pub fn side_by_side(
    scene: &Scene,
    samples: &Samples,
    pipelines: &[ScenePipeline<'_>],
    asked: Option<u16>,
) -> Result<Vec<u8>, SheetError> {
    let samples = &thinned(samples);
    let codes = &Codes::new(&scene.image);
    let ideal = reference(scene, samples);
    let wanted = shade(scene, samples, codes, &ideal);
    let made: Vec<_> = pipelines
        .iter()
        .map(|pipeline| {
            let highlights = pipeline.highlights(&pipeline.answers(samples, Which::Needed));
            let picture = shade(scene, samples, codes, &highlights);
            let found = difference(&picture, &wanted);
            (pipeline.design().config().name.clone(), bytes(scene, samples, &highlights), picture, found)
        })
        .collect();
    let end = end_of(asked, made.iter().map(|(_, _, _, found)| found.greatest).max().unwrap_or(0));
    let mut panels = vec![Panel { words: "x^n".to_owned(), pixels: bytes(scene, samples, &ideal) }];
    panels.extend(made.iter().map(|(name, pixels, _, found)| {
        let noise = found.psnr.map_or_else(|| "equal".to_owned(), |psnr| format!("{psnr:.1} dB"));
        Panel { words: format!("{name}: {noise}"), pixels: pixels.clone() }
    }));
    let scale = format!("blue darker, orange brighter, to ±{end} codes");
    panels.push(Panel { words: scale, pixels: heat(&wanted, &wanted, end) });
    panels.extend(made.iter().map(|(_, _, picture, found)| Panel {
        words: format!("≤ {} codes off", found.greatest),
        pixels: heat(picture, &wanted, end),
    }));
    sheet(&panels, made.len() as u32 + 1, samples, "pipelines side by side")?.to_png()
}
