//! The ray of a pixel.

use crate::scene::{Image, Vector, View};

/// A ray: what can be seen from a place in a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// The place where it begins.
    pub origin: Vector,
    /// Its direction, of length 1.
    pub direction: Vector,
}

/// The ray through a place of the picture, in pixels from its upper left corner: (0.5, 0.5) is the middle of the first
/// pixel, which is where pictures look.
#[must_use]
pub fn ray(view: &View, image: &Image, column: f64, row: f64) -> Ray {
    let half = f64::from(image.height) / 2.0;
    let scale = view.half_height / half;
    let across = (column - f64::from(image.width) / 2.0) * scale;
    let upwards = (half - row) * scale;
    let direction = view.forward + view.right * across + view.up * upwards;
    // `forward` is at right angles to the rest: the sum is never shorter than it.
    Ray { origin: view.position, direction: direction.unit().unwrap_or(view.forward) }
}
