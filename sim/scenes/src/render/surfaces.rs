//! Where a ray meets a surface.

use crate::scene::{Shape, Triangle, Vector};

use super::rays::Ray;

/// A place where a ray meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Distance along the ray, above 0.
    pub distance: f64,
    /// The normal that shades, of length 1, turned so that the surface is seen from its outside.
    pub normal: Vector,
}

/// Where `ray` first meets `shape`, nearer than `limit`.
#[must_use]
pub fn meet(ray: &Ray, shape: &Shape, limit: f64) -> Option<Hit> {
    match shape {
        Shape::Sphere { centre, radius } => sphere(ray, *centre, *radius, limit),
        Shape::Plane { point, normal } => plane(ray, *point, *normal, limit),
        Shape::Triangle(corners) => triangle(ray, corners, limit),
    }
}

/// From the distance of the centre to the ray, squared: the usual b² − 4ac loses half of the digits for a ball that is
/// small and far away.
fn sphere(ray: &Ray, centre: Vector, radius: f64, limit: f64) -> Option<Hit> {
    let to = centre - ray.origin;
    let along = to.dot(ray.direction);
    let beside = to - ray.direction * along;
    let inside = radius * radius - beside.dot(beside);
    if inside < 0.0 || along <= 0.0 {
        return None;
    }
    // The camera is outside every ball: the nearer place is the one that is seen.
    let half = inside.sqrt();
    let distance = along - half;
    if !(distance > 0.0 && distance < limit) {
        return None;
    }
    let normal = (ray.direction * -half - beside).unit()?;
    Some(Hit { distance, normal })
}

fn plane(ray: &Ray, point: Vector, normal: Vector, limit: f64) -> Option<Hit> {
    let towards = normal.dot(ray.direction);
    let distance = (point - ray.origin).dot(normal) / towards;
    // False where the ray runs along the plane and the quotient is not finite.
    let met = distance > 0.0 && distance < limit;
    met.then(|| Hit { distance, normal: if towards > 0.0 { -normal } else { normal } })
}

/// Möller and Trumbore's: weights of the corners and distance by Cramer's rule. Edges belong to both triangles, so that
/// no ray slips between them.
fn triangle(ray: &Ray, triangle: &Triangle, limit: f64) -> Option<Hit> {
    let [a, b, c] = triangle.corners;
    let (first, second) = (b - a, c - a);
    let across = ray.direction.cross(second);
    let volume = first.dot(across);
    if volume == 0.0 {
        return None;
    }
    let from = ray.origin - a;
    let beta = from.dot(across) / volume;
    if !(0.0..=1.0).contains(&beta) {
        return None;
    }
    let other = from.cross(first);
    let gamma = ray.direction.dot(other) / volume;
    if gamma < 0.0 || beta + gamma > 1.0 {
        return None;
    }
    let distance = second.dot(other) / volume;
    if !(distance > 0.0 && distance < limit) {
        return None;
    }
    let [na, nb, nc] = triangle.normals;
    let normal = na * (1.0 - beta - gamma) + nb * beta + nc * gamma;
    // The flat plane says which side is seen; the interpolated normal may differ from it near an outline.
    let seen_from_behind = triangle.plane_normal().dot(ray.direction) > 0.0;
    let outwards = normal.dot(triangle.plane_normal()) >= 0.0;
    let normal = if seen_from_behind == outwards { -normal } else { normal };
    Some(Hit { distance, normal: normal.unit()? })
}
