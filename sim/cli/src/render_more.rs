//! What `blysk render` does beside its pictures: pipelines compared, and a picture with several samples in a pixel.

use std::io::Write;

use anyhow::Context;
use hw_model::design::Design;

use super::bar::Bar;
use super::configuration::{MaybeConfiguration, find_preset};
use super::out::Out;
use super::table::{Cell, Format, Rows, write_folded};
use scenes::render::{Codes, Compared, RowFor, ScenePipeline, Which, encode, samples, smooth};
use scenes::scene::Scene;

/// The side of a square of samples.
pub(super) fn square(text: &str) -> Result<u32, String> {
    let count: Option<u32> = text.parse().ok();
    let side = (2..=8).find(|side| count == Some(side * side));
    side.ok_or_else(|| format!("{text:?} is no square number from 4 to 64; use 4, 9, 16, 25, 36, 49 or 64"))
}

/// The configuration, and the presets beside it, each once.
pub(super) fn designs(configuration: &MaybeConfiguration, presets: &[String]) -> anyhow::Result<Vec<Design>> {
    let mut designs: Vec<Design> = configuration.design()?.into_iter().collect();
    for name in presets {
        if designs.iter().all(|design| design.config().name != *name) {
            designs.push(Design::new(find_preset(name)?.config()?)?);
        }
    }
    Ok(designs)
}

/// What each of them has for the scene.
pub(super) fn pipelines<'a>(
    designs: &'a [Design],
    scene: &Scene,
    rows: RowFor<'_>,
) -> anyhow::Result<Vec<ScenePipeline<'a>>> {
    let of = |design: &'a Design| {
        let name = || design.config().name.clone();
        ScenePipeline::with_rows(design, scene, rows).with_context(name)
    };
    designs.iter().map(of).collect()
}

/// The pipeline's picture with `side` times `side` samples in a pixel.
pub(super) fn smoothed(scene: &Scene, design: &Design, rows: RowFor<'_>, side: u32) -> anyhow::Result<Vec<u8>> {
    let mut larger = scene.clone();
    let (width, height) = (scene.image.width * side, scene.image.height * side);
    larger.resize(width, height).with_context(|| format!("--samples-per-pixel {}", side * side))?;
    let pipeline = ScenePipeline::with_rows(design, &larger, rows)?;
    let bar = Bar::counting(Some(u64::from(width) * u64::from(height)), "samples");
    let samples = samples(&larger, &bar);
    bar.finish();
    let highlights = pipeline.highlights(&pipeline.answers(&samples, Which::Needed));
    let picture = smooth(&larger, &samples, &Codes::new(&scene.image), &highlights, side);
    Ok(encode(&picture, scene.image.transfer)?)
}

/// What each pipeline makes of the scene.
pub(super) fn print_compared(compared: &[Compared], out: &mut Out) -> anyhow::Result<()> {
    if compared.is_empty() {
        return Ok(());
    }
    let mut rows = Rows::new(&[
        "pipeline", "codes", "mean", "PSNR, dB", "pixels", "linear", "display", "latency", "MHz", "frames/s",
    ]);
    for one in compared {
        rows.push(vec![
            one.configuration.as_str().into(),
            Cell::Integer(one.picture_greatest_codes.into()),
            one.picture_mean_codes.into(),
            one.picture_psnr_db.into(),
            Cell::Integer(one.picture_pixels as i64),
            one.highlight_greatest_linear_codes.into(),
            Cell::Integer(one.highlight_greatest_display_codes.into()),
            Cell::Integer(one.latency as i64),
            one.clock_mhz.into(),
            one.frames_per_second.map(|frames| frames.round() as i64).into(),
        ]);
    }
    writeln!(out)?;
    rows.print(out, Format::Table, 4)?;
    let said = "codes, mean, PSNR and pixels: the picture against that of x^n, in display codes; linear and display: \
                the highlight that is furthest from x^n, in codes of linear light and of the display";
    Ok(write_folded(out, said)?)
}
