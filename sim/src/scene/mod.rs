//! Scenes: what is seen, by which light, with which exponents.
//!
//! ```text
//! JSON ─► Description (form) ─► Scene (values checked, meshes loaded) ─► crate::render
//! ```
//!
//! Nothing here knows pixels or hardware: a [`Scene`] is camera, lights, materials and surfaces, and what it can
//! present to the pipeline follows from them alone.

mod check;
pub mod description;
mod error;
mod knot;
mod mesh;
mod obj;
mod polygon;
mod vector;

use std::io;

pub use check::{DISPLAY_BITS, GREATEST_SIDE, MOST_SAMPLES};
pub use description::{Angle, Description, Image, Normals, Transfer};
pub use error::{MeshError, SceneError};
pub use knot::{Knot, KnotError};
pub use mesh::{Triangle, triangles};
pub use vector::Vector;
use vectors::text_file::decimal_comma;

/// A scene whose values were checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Letters, digits, - and _.
    pub name: String,
    /// The picture's size and display codes.
    pub image: Image,
    /// Which angle the highlight falls off with.
    pub angle: Angle,
    /// Where the picture is seen from.
    pub view: View,
    /// Linear colour of pixels that show nothing.
    pub background: Vector,
    /// Linear colour of the light from everywhere.
    pub ambient_light: Vector,
    /// The lights, 1 or more.
    pub lights: Vec<Light>,
    /// The materials, 1 or more.
    pub materials: Vec<Material>,
    /// The surfaces, 1 or more.
    pub surfaces: Vec<Surface>,
}

/// Where the picture is seen from: three directions of length 1 at right angles, and how much of each makes the
/// ray of a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Where the camera is.
    pub position: Vector,
    /// The direction into the picture.
    pub forward: Vector,
    /// To the right of it.
    pub right: Vector,
    /// The direction upwards in the picture.
    pub up: Vector,
    /// Half the height of the picture, at distance 1: the tangent of half the field of view.
    pub half_height: f64,
}

/// A light of a scene, without fall-off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Where its light comes from.
    pub origin: Origin,
    /// Linear colour, 0 and up.
    pub colour: Vector,
}

/// Where light comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Origin {
    /// From this direction (length 1, towards the light), everywhere.
    Direction(Vector),
    /// From this place, with the same strength at every distance.
    Place(Vector),
}

/// What a surface is made of: its colours and its exponent.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// No other has it.
    pub name: String,
    /// n, at least 1.
    pub exponent: f64,
    /// Linear colour, 0 to 1, times the ambient light.
    pub ambient: Vector,
    /// Linear colour, 0 to 1, times light and cosine.
    pub diffuse: Vector,
    /// Linear colour, 0 to 1, times light and highlight.
    pub specular: Vector,
}

/// Something to be seen, and the place of its material in [`Scene::materials`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// The shape, with its place.
    pub shape: Shape,
    /// Index of its material.
    pub material: u16,
}

/// Where a surface is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A ball, seen from outside.
    Sphere {
        /// The middle of the ball.
        centre: Vector,
        /// The radius, above 0.
        radius: f64,
    },
    /// A plane without end, seen from both sides.
    Plane {
        /// A place on it.
        point: Vector,
        /// The normal, of length 1.
        normal: Vector,
    },
    /// A triangle, seen from both sides.
    Triangle(Triangle),
}

impl Scene {
    /// Reads a scene. `read` gives the text of a mesh file by the name the scene has for it.
    ///
    /// # Errors
    /// When the text is no scene, a value cannot be used, or a mesh cannot be read or used; with the way to it.
    pub fn from_json(
        text: &str,
        read: &mut dyn FnMut(&str) -> io::Result<String>,
    ) -> Result<Self, SceneError> {
        let wrong = |path, source: serde_json::Error| {
            let hint = decimal_comma(text, &source).unwrap_or_default();
            SceneError::Json { path, source, hint }
        };
        let mut deserializer = serde_json::Deserializer::from_str(text);
        let description: Description = serde_path_to_error::deserialize(&mut deserializer)
            .map_err(|error| {
                // Where the text ends too early, the last step has no name.
                let path = error.path().to_string();
                let path = path.trim_end_matches('?').trim_end_matches('.').to_owned();
                wrong(path, error.into_inner())
            })?;
        let whole = |source| wrong(String::new(), source);
        deserializer.end().map_err(whole)?;
        check::scene(&description, read)
    }

    /// The same scene in a picture of another size; the field of view is that of its height.
    ///
    /// # Errors
    /// When the size is out of range; the scene is as it was.
    pub fn resize(&mut self, width: u32, height: u32) -> Result<(), SceneError> {
        let image = Image { width, height, ..self.image };
        check::image(&image, self.lights.len())?;
        self.image = image;
        Ok(())
    }

    /// The exponents of the materials, each once, rising.
    #[must_use]
    pub fn exponents(&self) -> Vec<f64> {
        let mut exponents: Vec<f64> = self.materials.iter().map(|m| m.exponent).collect();
        exponents.sort_by(f64::total_cmp);
        exponents.dedup();
        exponents
    }
}

/// The JSON schema of scenes, as `docs/scene.schema.json` holds it.
#[must_use]
pub fn schema() -> String {
    // A schema made of types is plain JSON: serialising it cannot fail.
    let schema = schemars::schema_for!(Description);
    let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
    text.push('\n');
    text
}
