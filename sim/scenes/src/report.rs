//! `render.json` and `render.csv`: what a picture shows of the pipeline, without times.

use serde::Serialize;
use thiserror::Error;
use vectors::output_text;
use vectors::whole_file::{OutputError, OutputSet};

use crate::render::{Compared, Cycles, Difference, MaterialFigures};
use crate::scene::{Image, Scene, Transfer};

/// The pictures of a rendering.
pub const PICTURES: [&str; 4] = ["reference.png", "pipeline.png", "difference.png", "methods.png"];

/// The tables of a rendering.
pub const TABLES: [&str; 2] = ["render.csv", "render.json"];

/// What a rendering has beside these where pipelines are compared.
pub const COMPARED: [&str; 3] = ["compare.png", "compare.csv", "compare.json"];

/// The picture with several samples in a pixel.
pub const SMOOTH: &str = "smooth.png";

/// Why a rendering was not written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderFilesError {
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A row that does not become CSV.
    #[error("render.csv: {0}")]
    Csv(#[from] csv::Error),
    /// Figures that do not become JSON.
    #[error("render.json: {0}")]
    Json(#[from] serde_json::Error),
}

/// The figures of a rendering.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RenderReport {
    /// The name of the scene.
    pub scene: String,
    /// The name of the configuration.
    pub configuration: String,
    /// The angle that x is the cosine of: `phong` or `blinn`.
    pub angle: &'static str,
    /// Pixels of a row.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
    /// Bits of a display code.
    pub display_bits: u32,
    /// The transfer curve: `srgb` or `linear`.
    pub transfer: &'static str,
    /// The number of lights.
    pub lights: usize,
    /// Pixels that show nothing.
    pub background_pixels: u64,
    /// The picture of the pipeline against that of x^n.
    pub picture: Difference,
    /// The samples of each material.
    pub materials: Vec<MaterialFigures>,
    /// The clock of the cycles, in MHz.
    pub clock_mhz: f64,
    /// The device on which the clock is estimated; none where it was stated.
    pub clock_device: Option<String>,
    /// Where every sample goes to the pipeline.
    pub every: Cycles,
    /// Where software leaves out those that face away or lie below the cut.
    pub needed: Cycles,
}

impl RenderReport {
    /// `render.csv`: a row for each material.
    ///
    /// # Errors
    /// Never for what a rendering gives; the type says what the crate says.
    pub fn csv(&self) -> Result<Vec<u8>, csv::Error> {
        output_text::csv(&self.materials)
    }

    /// `render.json`: everything.
    ///
    /// # Errors
    /// Never for what a rendering gives; the type says what the crate says.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        output_text::json(self)
    }
}

/// The names of a picture's curve and its bits, for the report.
#[must_use]
pub const fn transfer_name(image: &Image) -> &'static str {
    match image.transfer {
        Transfer::Srgb => "srgb",
        Transfer::Linear => "linear",
    }
}

/// Adds pictures and tables to `set`: `pictures` in the order of [`PICTURES`].
///
/// # Errors
/// When a file cannot be written.
pub fn write(set: &mut OutputSet, report: &RenderReport, pictures: &[Vec<u8>; 4]) -> Result<(), RenderFilesError> {
    for (name, picture) in PICTURES.into_iter().zip(pictures) {
        set.write(name, picture)?;
    }
    let [csv, json] = TABLES;
    set.write(csv, report.csv()?)?;
    set.write(json, report.json()?)?;
    Ok(())
}

/// Adds what [`COMPARED`] names to `set`.
///
/// # Errors
/// When a file cannot be written.
pub fn write_compared(set: &mut OutputSet, rows: &[Compared], picture: &[u8]) -> Result<(), RenderFilesError> {
    let [png, csv, json] = COMPARED;
    set.write(png, picture)?;
    set.write(csv, output_text::csv(rows)?)?;
    set.write(json, output_text::json(rows)?)?;
    Ok(())
}

/// Pixels of the picture that show nothing.
#[must_use]
pub fn background(scene: &Scene, surface_pixels: usize) -> u64 {
    u64::from(scene.image.width) * u64::from(scene.image.height) - surface_pixels as u64
}
