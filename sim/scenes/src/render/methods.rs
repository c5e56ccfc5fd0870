//! The methods side by side, each as hardware of the same formats.

use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::exponents::Exponents;
use hw_model::fit::Method;
use hw_model::presets;
use rayon::prelude::*;

use super::colour::Codes;
use super::figures::difference;
use super::highlight::reference;
use super::requests::{ScenePipeline, Which};
use super::samples::Samples;
use super::shading::{Picture, shade};
use super::sheet::{Sheet, SheetError};
use crate::scene::{Image, Scene, Transfer};
use plot::canvas::{Anchor, Canvas, MARGIN};

/// The longest side of a panel, in pixels; larger pictures show every k-th column and row.
const PANEL: u32 = 480;
/// A line of words needs so many pixels.
const LEAST_WIDTH: u32 = 260;
const WORDS_HEIGHT: u32 = 24;
const GAP: u32 = 8;
const COLUMNS: u32 = 3;

/// What a panel says below its picture, and the preset whose hardware it takes. Those without a divider show zero where
/// their polynomial ends.
const METHODS: [(&str, &str, Method); 5] = [
    ("schlick", "schlick", Method::Schlick),
    ("quadratic", "compact", Method::Quadratic),
    ("hermite", "compact", Method::Hermite),
    ("composite", "paper", Method::Hermite),
    ("minimax, two segments", "precise", Method::Minimax),
];

/// The hardware of a method for these exponents, in the formats of another configuration; none where the widths that it
/// would need are too great.
fn hardware(preset: &str, method: Method, exponents: &[f64], like: &Config) -> Option<Design> {
    let preset = presets::find(preset)?.config().ok()?;
    let config = Config {
        method,
        exponents: Exponents::new(exponents.to_vec()).ok()?,
        input: like.input,
        output: like.output,
        multiplier_operand_bits: None,
        error_budget_ulp: 1.0,
        ..preset
    };
    Design::new(config).ok()
}

struct Panel {
    words: String,
    pixels: Vec<[u8; 3]>,
}

/// x^n and the methods schlick, quadratic, hermite, composite and minimax as a PNG, each in a panel that says by how
/// many display codes its picture differs from that of x^n.
///
/// # Errors
/// When the words cannot be drawn, or the file not be encoded.
pub fn methods(scene: &Scene, samples: &Samples, like: &Config) -> Result<Vec<u8>, SheetError> {
    let step = samples.width.max(samples.height).div_ceil(PANEL);
    let samples = &samples.every(step);
    let codes = &Codes::new(&scene.image);
    let ideal = reference(scene, samples);
    let wanted = shade(scene, samples, codes, &ideal);
    let first = Panel { words: "x^n".to_owned(), pixels: bytes(scene, samples, &ideal) };
    let exponents = scene.exponents();
    let panel = |&(name, preset, method): &(&str, &str, Method)| {
        let design = hardware(preset, method, &exponents, like);
        let pipeline = design.as_ref().and_then(|design| ScenePipeline::new(design, scene).ok());
        let Some(pipeline) = pipeline else {
            return Panel { words: format!("{name}: too wide"), pixels: Vec::new() };
        };
        let highlights = pipeline.highlights(&pipeline.answers(samples, Which::Needed));
        let picture: Picture = shade(scene, samples, codes, &highlights);
        let greatest = difference(&picture, &wanted).greatest;
        let words = format!("{name}: ≤ {greatest} codes off");
        Panel { words, pixels: bytes(scene, samples, &highlights) }
    };
    let others: Vec<Panel> = METHODS.par_iter().map(panel).collect();
    let panels: Vec<Panel> = std::iter::once(first).chain(others).collect();
    sheet(&panels, samples.width, samples.height)?.to_png()
}

/// The picture as 8 bits in the curve of sRGB, whatever the scene's own codes are.
fn bytes(scene: &Scene, samples: &Samples, highlights: &[f64]) -> Vec<[u8; 3]> {
    let image = Image { display_bits: 8, transfer: Transfer::Srgb, ..scene.image };
    let picture = shade(scene, samples, &Codes::new(&image), highlights);
    picture.codes.iter().map(|colour| colour.map(|code| code as u8)).collect()
}

fn sheet(panels: &[Panel], width: u32, height: u32) -> Result<Sheet, SheetError> {
    let cell = (width.max(LEAST_WIDTH) + GAP, height + WORDS_HEIGHT + GAP);
    let places =
        (0..panels.len() as u32).map(|index| (index % COLUMNS * cell.0, index / COLUMNS * cell.1)).collect::<Vec<_>>();
    let mut canvas = Canvas::new();
    for (panel, &(left, top)) in panels.iter().zip(&places) {
        let middle = f64::from(left) + f64::from(cell.0 - GAP) / 2.0;
        let baseline = f64::from(top + height) + 17.0;
        canvas.text((middle, baseline), &panel.words, Anchor::Middle, 13.0);
    }
    let rows = (panels.len() as u32).div_ceil(COLUMNS);
    let size = (f64::from(COLUMNS * cell.0 - GAP), f64::from(rows * cell.1 - GAP));
    let mut sheet = Sheet::drawn(&canvas.finish(size, "methods", "the methods side by side"))?;
    for (panel, (left, top)) in panels.iter().zip(places) {
        let left = left + (cell.0 - GAP - width) / 2 + MARGIN as u32;
        let top = top + MARGIN as u32;
        sheet.put((left as usize, top as usize), width as usize, &panel.pixels);
    }
    Ok(sheet)
}
