//! From light, normal and viewer to what the pipeline is asked.

use crate::scene::{Angle, Light, Origin, Vector};

/// What a place of a surface presents for one light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Presented {
    /// N·L, the cosine between normal and light: from −1 to 1, a rounding more included.
    pub lit: f64,
    /// x of the highlight, the same way: R·V or N·H.
    pub x: f64,
}

impl Presented {
    /// True where there can be no highlight, whatever the pipeline would answer: the light is behind the surface, or
    /// the angle is a right one or more.
    #[must_use]
    pub(crate) fn faces_away(&self) -> bool {
        !(self.lit > 0.0 && self.x > 0.0)
    }
}

/// What a place with this normal presents. `viewer` is the direction to the camera; both have length 1. A light at the
/// very place gives none.
#[must_use]
pub fn presented(angle: Angle, light: &Light, place: Vector, normal: Vector, viewer: Vector) -> Presented {
    let towards = match light.origin {
        Origin::Direction(towards) => towards,
        Origin::Place(at) => (at - place).unit().unwrap_or_default(),
    };
    let lit = normal.dot(towards);
    let x = match angle {
        // R = 2(N·L)N − L
        Angle::Phong => (normal * (2.0 * lit) - towards).dot(viewer),
        // No direction lies halfway between opposite ones; light and viewer are then on different sides.
        Angle::Blinn => (towards + viewer).unit().map_or(0.0, |halfway| normal.dot(halfway)),
    };
    Presented { lit, x }
}
