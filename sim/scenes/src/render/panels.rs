//! Small pictures side by side, each with a line of words below it.

use super::colour::Codes;
use super::samples::Samples;
use super::shading::shade;
use super::sheet::{Sheet, SheetError};
use crate::scene::{Image, Scene, Transfer};
use plot::canvas::{Anchor, Canvas, MARGIN};

/// The longest side of a panel, in pixels; larger pictures show every k-th column and row.
const PANEL: u32 = 480;
/// A line of words needs so many pixels.
const LEAST_WIDTH: u32 = 260;
const WORDS_HEIGHT: u32 = 24;
const GAP: u32 = 8;

/// A picture and what it is. Without pixels it is words alone.
pub(super) struct Panel {
    pub words: String,
    pub pixels: Vec<[u8; 3]>,
}

/// The samples that a panel has room for.
pub(super) fn thinned(samples: &Samples) -> Samples {
    samples.every(samples.width.max(samples.height).div_ceil(PANEL))
}

/// The picture as 8 bits in the curve of sRGB, whatever the scene's own codes are.
pub(super) fn bytes(scene: &Scene, samples: &Samples, highlights: &[f64]) -> Vec<[u8; 3]> {
    let image = Image { display_bits: 8, transfer: Transfer::Srgb, ..scene.image };
    let picture = shade(scene, samples, &Codes::new(&image), highlights);
    picture.codes.iter().map(|colour| colour.map(|code| code as u8)).collect()
}

/// The panels in rows of so many columns, in the order of the list; `words` say what the sheet shows.
pub(super) fn sheet(panels: &[Panel], columns: u32, samples: &Samples, words: &str) -> Result<Sheet, SheetError> {
    let (width, height) = (samples.width, samples.height);
    let cell = (width.max(LEAST_WIDTH) + GAP, height + WORDS_HEIGHT + GAP);
    let places =
        (0..panels.len() as u32).map(|index| (index % columns * cell.0, index / columns * cell.1)).collect::<Vec<_>>();
    let mut canvas = Canvas::new();
    for (panel, &(left, top)) in panels.iter().zip(&places) {
        let middle = f64::from(left) + f64::from(cell.0 - GAP) / 2.0;
        let baseline = f64::from(top + height) + 17.0;
        canvas.text((middle, baseline), &panel.words, Anchor::Middle, 13.0);
    }
    let rows = (panels.len() as u32).div_ceil(columns);
    let size = (f64::from(columns * cell.0 - GAP), f64::from(rows * cell.1 - GAP));
    let mut sheet = Sheet::drawn(&canvas.finish(size, "panels", words))?;
    for (panel, (left, top)) in panels.iter().zip(places) {
        let left = left + (cell.0 - GAP - width) / 2 + MARGIN as u32;
        let top = top + MARGIN as u32;
        sheet.put((left as usize, top as usize), width as usize, &panel.pixels);
    }
    Ok(sheet)
}
