//! The choice of the smaller hardware, judged by the certificate.
//!
//! Without `allowed` it is the source's bits. With it, outputs of fewer and fewer bits are held against the source,
//! with widths derived anew; the fewest bits whose answers keep the codes at every x are taken. Where none of them
//! does, the source's bits are.

use hw_model::design::Design;
use hw_model::format::QFormat;

use super::certificate::{Display, Part, Proved};
use super::compare::certify;
use super::demand::Demand;
use super::derive::{AskedRow, SpecialiseError, derive, kept};
use super::refused::Refused;
use crate::render::Samples;
use crate::scene::Scene;
use vectors::progress::Progress;

/// Why there is no certified hardware.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReduceError {
    /// It cannot be made.
    #[error(transparent)]
    Specialise(#[from] SpecialiseError),
    /// It was made and does not answer as the source, which would be a mistake of this program.
    #[error("the smaller hardware is not certified: {0}")]
    Refused(#[from] Refused),
}

/// The smaller hardware with what was proved of it.
///
/// # Errors
/// When it cannot be made, or is not certified.
pub fn reduce(
    source: &Design,
    rows: &[AskedRow],
    name: &str,
    display: Display,
    allowed: Option<u16>,
    progress: &dyn Progress,
) -> Result<(Design, (Proved, Vec<Part>)), ReduceError> {
    if allowed.is_some() {
        for bits in 1..source.config().output.fraction_bits() {
            let Some(design) = with_output(source, rows, name, bits)? else { continue };
            if let Ok(found) = certify(source, &design, rows, display, allowed, progress) {
                return Ok((design, found));
            }
        }
    }
    let design = derive(source, rows, name)?;
    let found = certify(source, &design, rows, display, allowed, progress)?;
    Ok((design, found))
}

/// The same parts with an output of this number of fraction bits, in widths that keep its error budget; none where
/// there is no such hardware.
fn with_output(source: &Design, rows: &[AskedRow], name: &str, bits: u32) -> Result<Option<Design>, SpecialiseError> {
    let mut config = kept(source, rows, name)?;
    let Ok(output) = QFormat::unsigned(config.output.integer_bits(), bits) else { return Ok(None) };
    config.output = output;
    // Where segments may end has nothing to do with the output.
    let ends = source.config().widths.of_ends();
    config.widths = ends;
    config.coefficient_steps = Vec::new();
    Ok(Design::new(config).ok())
}

/// A pixel whose x is outside of what was bounded for its exponent: its n, and x.
#[must_use]
pub fn pixels_outside(scene: &Scene, samples: &Samples, demands: &[Demand]) -> Option<(f64, f64)> {
    let outside = |(material, sample): (u16, crate::render::Sample)| {
        let n = scene.materials[usize::from(material)].exponent;
        let demand = demands.iter().find(|demand| demand.exponent == n);
        // A rounding above 1 is 1, as in the pipeline.
        let x = sample.x.min(1.0);
        let inside = demand.is_some_and(|demand| demand.least <= x && x <= demand.greatest);
        (!sample.faces_away() && !inside).then_some((n, sample.x))
    };
    samples.with_material().find_map(outside)
}
