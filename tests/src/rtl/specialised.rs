//! Hardware for the scenes of `docs/scenes`, as `blysk specialise` derives and certifies it.

use std::sync::atomic::AtomicU64;

use hw_model::design::Design;
use hw_model::presets;
use scenes::scene::Scene;
use scenes::specialise::{Display, demands, reduce, rows};

use super::{Failure, simulators};

/// What a scene leaves of preset `paper`.
///
/// # Errors
/// When the scene cannot be read, or no hardware is certified.
pub fn of_paper(scene: &str) -> Result<Design, Failure> {
    let path = simulators::repository().join("docs/scenes").join(format!("{scene}.json"));
    let text =
        std::fs::read_to_string(&path).map_err(|error| Failure(format!("cannot read {}: {error}", path.display())))?;
    let failure = |error: &dyn std::fmt::Display| Failure(format!("{scene}: {error}"));
    let mut read = |name: &str| std::fs::read_to_string(path.with_file_name(name));
    let scene = Scene::from_json(&text, &mut read).map_err(|error| failure(&error))?;
    let paper = presets::find("paper").ok_or_else(|| failure(&"there is no preset paper"))?;
    let config = paper.config().map_err(|error| failure(&error))?;
    let source = Design::new(config).map_err(|error| failure(&error))?;
    let rows = rows(&source, &demands(&scene)).map_err(|error| failure(&error))?;
    let display = Display { bits: scene.image.display_bits, transfer: scene.image.transfer };
    let reduced = reduce(&source, &rows, &scene.name, display, None, &AtomicU64::new(0));
    reduced.map(|(design, _)| design).map_err(|error| failure(&error))
}
