//! A mesh that the project makes itself: a tube along a torus knot.
//!
//! The knot winds p times round the axis of a torus and q times through its hole. A tube around it bends in every
//! direction, so that its highlights meet every angle.

use std::f64::consts::TAU;
use std::fmt::Write;

use thiserror::Error;

use super::vector::Vector;

/// The radius of the torus's middle line, in the mesh's unit; the torus itself has half of it.
const RADIUS: f64 = 1.0;
const HALF: f64 = 0.5;

/// A tube along a torus knot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// Turns round the axis, 1 to 16.
    pub around: u32,
    /// Turns through the hole, 1 to 16; one of the two numbers divides nothing of the other.
    pub through: u32,
    /// Corners along the knot, 3 to 100 000.
    pub along: u32,
    /// Corners round the tube, 3 to 10 000.
    pub sides: u32,
    /// The tube's radius, 0.01 to 0.5; the torus knot itself lies within 1.5 of the middle.
    pub tube: f64,
}

/// Why there is no such knot.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct KnotError(String);

impl Knot {
    /// A knot of these numbers.
    ///
    /// # Errors
    /// When a number is out of range, or the turns have a common divisor, so that the line closes early.
    pub fn new(around: u32, through: u32, along: u32, sides: u32, tube: f64) -> Result<Self, KnotError> {
        for (name, value, greatest) in [("around", around, 16), ("through", through, 16)] {
            if !(1..=greatest).contains(&value) {
                return Err(KnotError(format!("--{name} {value}: use 1 to {greatest}")));
            }
        }
        let common = |d: u32| around.is_multiple_of(d) && through.is_multiple_of(d);
        if (2..=around.min(through)).any(common) {
            let said = format!(
                "--around {around} and --through {through} have a common divisor, and the line would \
                 close early; use for example 2 and 3"
            );
            return Err(KnotError(said));
        }
        for (name, value, greatest) in [("along", along, 100_000), ("sides", sides, 10_000)] {
            if !(3..=greatest).contains(&value) {
                return Err(KnotError(format!("--{name} {value}: use 3 to {greatest}")));
            }
        }
        if !(0.01..=0.5).contains(&tube) {
            return Err(KnotError(format!("--tube {tube}: use 0.01 to 0.5")));
        }
        Ok(Self { around, through, along, sides, tube })
    }

    /// Triangles of the mesh.
    #[must_use]
    pub fn triangle_count(&self) -> u64 {
        2 * u64::from(self.along) * u64::from(self.sides)
    }

    /// The mesh as a Wavefront OBJ file: corners with six decimals, triangles turned outwards, no normals.
    #[must_use]
    pub fn to_obj(&self, origin: &str) -> String {
        let mut text = format!("# {origin}\n# {} triangles\n", self.triangle_count());
        for index in 0..self.along {
            let [centre, normal, binormal] = self.frame(index);
            for side in 0..self.sides {
                let angle = TAU * f64::from(side) / f64::from(self.sides);
                let (out, across) = (core_math::cos(angle), core_math::sin(angle));
                let place = centre + (normal * out + binormal * across) * self.tube;
                let [x, y, z] = place.coordinates().map(plain);
                // Writing to a String does not fail.
                let _ = writeln!(text, "v {x:.6} {y:.6} {z:.6}");
            }
        }
        let corner = |along: u32, side: u32| (along % self.along) * self.sides + side % self.sides + 1;
        for along in 0..self.along {
            for side in 0..self.sides {
                let here = [corner(along, side), corner(along, side + 1)];
                let next = [corner(along + 1, side), corner(along + 1, side + 1)];
                let _ = writeln!(text, "f {} {} {}", here[0], here[1], next[0]);
                let _ = writeln!(text, "f {} {} {}", here[1], next[1], next[0]);
            }
        }
        text
    }

    /// The line at one of the corners along it: its place, and two directions across it. The first lies across the
    /// direction to the torus's axis and returns with the line, so that the tube's ends meet.
    fn frame(&self, index: u32) -> [Vector; 3] {
        let angle = TAU * f64::from(index) / f64::from(self.along);
        let (around, through) = (f64::from(self.around), f64::from(self.through));
        let (sin, cos) = (core_math::sin, core_math::cos);
        let (turn, hole) = (around * angle, through * angle);
        let distance = RADIUS + HALF * cos(hole);
        let place = Vector::new(distance * cos(turn), distance * sin(turn), HALF * sin(hole));
        let change = -HALF * through * sin(hole);
        let tangent = Vector::new(
            change * cos(turn) - around * distance * sin(turn),
            change * sin(turn) + around * distance * cos(turn),
            HALF * through * cos(hole),
        );
        // Outwards from the torus: never along the line, which runs on its surface.
        let outwards = Vector::new(cos(hole) * cos(turn), cos(hole) * sin(turn), sin(hole));
        let tangent = tangent.unit().unwrap_or_default();
        let normal = (outwards - tangent * outwards.dot(tangent)).unit().unwrap_or_default();
        [place, normal, tangent.cross(normal)]
    }
}

/// -0.000000 and 0.000000 are one number.
fn plain(coordinate: f64) -> f64 {
    if coordinate.abs() < 5e-7 { 0.0 } else { coordinate }
}
