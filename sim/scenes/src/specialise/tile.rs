//! What every place of a tile of the picture presents, by the formulas of `render::surfaces` and `render::angle` in
//! intervals.

use super::space::{Rays, Space};
use crate::scene::{Angle, Light, Origin, Shape, Vector};
use bounds::interval::Interval;

/// Places of a surface that are seen: the cosine between normal and viewer, and the rest a light needs.
pub(super) struct Met {
    /// To the camera, length 1.
    pub viewer: Space,
    /// The normal that shades, length 1.
    pub normal: Space,
    /// N·V.
    pub facing: Interval,
    /// Where it is.
    pub place: Space,
}

/// Where the rays of a tile meet a plane.
enum Plane {
    Met(Met),
    Missed,
    /// Rounding leaves open on which side of it the camera is.
    Open,
}

/// Every x that is asked for.
const ANYTHING: Interval = Interval::UNIT;

/// x of all places of a tile that show the surface by this light; none where no place does. A triangle is not looked at
/// by tiles: it presents anything from 0 to 1.
pub(super) fn presented(rays: &Rays, shape: &Shape, angle: Angle, light: &Light) -> Option<Interval> {
    let met = match shape {
        Shape::Sphere { centre, radius } => sphere(rays, *centre, *radius)?,
        Shape::Plane { point, normal } => match plane(rays, *point, *normal) {
            Plane::Met(met) => met,
            Plane::Missed => return None,
            Plane::Open => return Some(ANYTHING),
        },
        Shape::Triangle(_) => return Some(ANYTHING),
    };
    met.lit_by(angle, light)
}

impl Met {
    /// x of all these places by this light; none where no place is lit.
    pub(super) fn lit_by(&self, angle: Angle, light: &Light) -> Option<Interval> {
        let towards = match light.origin {
            Origin::Direction(towards) => Space::exactly(towards),
            Origin::Place(at) => {
                let to = Space::exactly(at) - self.place;
                to.over(to.square().sqrt())
            }
        };
        let lit = cosine(self.normal.dot(towards));
        if lit.high() <= 0.0 {
            return None;
        }
        // What faces away is never asked for.
        let lit = lit.within(0.0, 1.0)?;
        let between = cosine(towards.dot(self.viewer));
        let x = match angle {
            // R·V = 2(N·L)(N·V) − L·V
            Angle::Phong => Interval::exactly(2.0) * lit * self.facing - between,
            // N·H = (N·L + N·V)/|L + V|, and |L + V|² = 2 + 2 L·V
            Angle::Blinn => {
                let two = Interval::exactly(2.0);
                (lit + self.facing) / (two + two * between).sqrt()
            }
        };
        x.within(0.0, 1.0)
    }
}

/// A cosine of real vectors: what rounding outwards adds beyond ±1 is none.
pub(super) fn cosine(value: Interval) -> Interval {
    value.within(-1.0, 1.0).unwrap_or(Interval::new(-1.0, 1.0))
}

/// With c from the camera to the centre and d the direction: the ray passes the centre at b = d × (c × d)/d², and
/// meets the ball where r² − b² is not negative. |c × d| is small where the ray passes near the centre, which
/// c − d(c·d) would find as a difference of what is large.
fn sphere(rays: &Rays, centre: Vector, radius: f64) -> Option<Met> {
    let to = Space::exactly(centre) - rays.origin();
    let along = to.dot(rays.direction) / rays.length;
    if along.high() <= 0.0 {
        return None;
    }
    let radius = Interval::exactly(radius);
    let crossed = rays.crossed_by(to);
    let inside = radius.square() - crossed.square() / rays.length.square();
    if inside.high() < 0.0 {
        return None;
    }
    let half = inside.sqrt();
    let beside = rays.direction.cross(crossed) * (Interval::ONE / rays.length.square());
    let ahead = rays.direction.over(rays.length);
    let normal = (-(ahead * half) - beside).over(radius);
    let place = rays.origin() + ahead * (along - half);
    // Beside is at right angles to the ray.
    Some(Met { viewer: -ahead, normal, facing: cosine(half / radius), place })
}

/// The camera is on one side of the plane, which the normal is turned to. It is missed
/// where no ray goes to the other side.
fn plane(rays: &Rays, point: Vector, normal: Vector) -> Plane {
    let normal = Space::exactly(normal);
    let height = (rays.origin() - Space::exactly(point)).dot(normal);
    let normal = if height.low() > 0.0 {
        normal
    } else if height.high() < 0.0 {
        -normal
    } else {
        return Plane::Open;
    };
    let ahead = rays.direction.over(rays.length);
    let Some(facing) = (-normal.dot(rays.direction) / rays.length).within(0.0, 1.0) else {
        return Plane::Missed;
    };
    let distance = Interval::new(height.least_magnitude(), height.greatest_magnitude()) / facing;
    let place = rays.origin() + ahead * distance;
    Plane::Met(Met { viewer: -ahead, normal, facing, place })
}
