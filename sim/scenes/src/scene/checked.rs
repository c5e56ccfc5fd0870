//! A scene whose values were checked.

use super::description::{Angle, Image};
use super::mesh::Triangle;
use super::vector::Vector;

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
    /// The exponents of the materials, each once, rising.
    #[must_use]
    pub fn exponents(&self) -> Vec<f64> {
        let mut exponents: Vec<f64> = self.materials.iter().map(|m| m.exponent).collect();
        exponents.sort_by(f64::total_cmp);
        exponents.dedup();
        exponents
    }
}
