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
use super::panels::{Panel, bytes, sheet, thinned};
use super::requests::{ScenePipeline, Which};
use super::samples::Samples;
use super::shading::{Picture, shade};
use super::sheet::SheetError;
use crate::scene::Scene;

/// Panels side by side.
const COLUMNS: u32 = 4;

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

/// x^n, the pipeline itself, and hardware of the methods schlick, quadratic, hermite, composite and minimax in its
/// formats, as a PNG: each in a panel that says by how many display codes its picture differs from that of x^n.
///
/// # Errors
/// When the words cannot be drawn, or the file not be encoded.
pub fn methods(scene: &Scene, samples: &Samples, pipeline: &ScenePipeline<'_>) -> Result<Vec<u8>, SheetError> {
    let samples = &thinned(samples);
    let codes = &Codes::new(&scene.image);
    let ideal = reference(scene, samples);
    let wanted = shade(scene, samples, codes, &ideal);
    let first = Panel { words: "x^n".to_owned(), pixels: bytes(scene, samples, &ideal) };
    let exponents = scene.exponents();
    let shown = |name: &str, pipeline: &ScenePipeline<'_>| {
        let highlights = pipeline.highlights(&pipeline.answers(samples, Which::Needed));
        let picture: Picture = shade(scene, samples, codes, &highlights);
        let greatest = difference(&picture, &wanted).greatest;
        let words = format!("{name}: ≤ {greatest} codes off");
        Panel { words, pixels: bytes(scene, samples, &highlights) }
    };
    let like = pipeline.design().config();
    let panel = |&(name, preset, method): &(&str, &str, Method)| {
        let design = hardware(preset, method, &exponents, like);
        match design.as_ref().and_then(|design| ScenePipeline::new(design, scene).ok()) {
            Some(pipeline) => shown(name, &pipeline),
            None => Panel { words: format!("{name}: too wide"), pixels: Vec::new() },
        }
    };
    // A preset may have the name of a method.
    let own = shown(&format!("this configuration, {}", like.name), pipeline);
    let others: Vec<Panel> = METHODS.par_iter().map(panel).collect();
    let panels: Vec<Panel> = [first, own].into_iter().chain(others).collect();
    sheet(&panels, COLUMNS, samples, "the methods side by side")?.to_png()
}
