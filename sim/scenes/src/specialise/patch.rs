//! What the triangles of a mesh present, in intervals: boxes of a tree with the normals in them, triangles, and pieces
//! of triangles.
//!
//! For each of these there is a box of places and a box of normals, on the side that the viewer sees. The camera is one
//! place, so that it sees a triangle from one side; a triangle that may be seen edge on has normals of both sides. What
//! lies outside the picture goes, so that a close-up keeps what it shows.

use super::search::Places;
use super::space::Space;
use super::tile::{Met, cosine};
use crate::render::{Below, Bvh, Ray, meet, presented};
use crate::scene::{Angle, Image, Light, Scene, Shape, Surface, Triangle, Vector, View};
use bounds::interval::Interval;

/// Pieces that were cut more often are not cut further: weights stay exact, and bounds have long been near.
const DEEPEST: u32 = 64;

/// The sides of the picture are this part of it further out, so that rounding them loses nothing.
const WIDENED: f64 = 1.0 + 1e-12;

/// The triangles of one exponent in a tree.
pub(super) struct Patches {
    tree: Bvh,
    /// For each node of the tree what lies below it.
    nodes: Vec<Patch>,
    view: View,
    sides: Sides,
    angle: Angle,
}

/// Places and normals of some triangles, or of a piece of one: a box of each.
#[derive(Clone, Copy)]
struct Patch {
    places: Space,
    /// Of the side that is seen; between the corners of a triangle they are shorter than 1.
    normals: Space,
}

/// The four sides of what the picture shows, and the plane of the camera: for a place p from the camera, p·side is
/// positive outside.
struct Sides([Space; 5]);

/// Which triangles, or which piece of one.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    of: Of,
    depth: u32,
}

#[derive(Clone, Copy)]
enum Of {
    /// All triangles below a node.
    Node(usize),
    /// The piece of a triangle between three places, each by its weights of the triangle's corners. Weights are halves
    /// of halves, so exact.
    Triangle(usize, [[f64; 3]; 3]),
}

/// The weights of a triangle's own corners.
const CORNERS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Patches {
    /// A tree of triangles, seen as the scene is.
    pub(super) fn new(scene: &Scene, triangles: impl Iterator<Item = Surface>) -> Self {
        let tree = Bvh::new(&triangles.collect::<Vec<_>>());
        let camera = Space::exactly(scene.view.position);
        // From the last to the first: what stands below a node comes after it.
        let mut nodes: Vec<Patch> = Vec::with_capacity(tree.node_count());
        for node in (0..tree.node_count()).rev() {
            let known = |below: usize| nodes.get(tree.node_count() - 1 - below).copied();
            let patch = match tree.below(node) {
                Below::Halves(halves) => halves.into_iter().filter_map(known).reduce(Patch::and),
                Below::Surfaces(range) => {
                    let of = |index| Some(Patch::of(triangle(&tree, index)?, &CORNERS, camera));
                    range.filter_map(of).reduce(Patch::and)
                }
            };
            nodes.push(patch.unwrap_or(Patch::ANYTHING));
        }
        nodes.reverse();
        Self { tree, nodes, view: scene.view, sides: Sides::new(&scene.view, &scene.image), angle: scene.angle }
    }

    /// The same in one light.
    pub(super) const fn lit_by<'a>(&'a self, light: &'a Light) -> Lit<'a> {
        Lit { patches: self, light }
    }

    fn patch(&self, piece: &Piece) -> Patch {
        let found = match piece.of {
            Of::Node(node) => self.nodes.get(node).copied(),
            Of::Triangle(index, corners) => {
                let camera = Space::exactly(self.view.position);
                triangle(&self.tree, index).map(|triangle| Patch::of(triangle, &corners, camera))
            }
        };
        found.unwrap_or(Patch::ANYTHING)
    }
}

fn triangle(tree: &Bvh, index: usize) -> Option<&Triangle> {
    match &tree.surface(index).shape {
        Shape::Triangle(triangle) => Some(triangle),
        Shape::Sphere { .. } | Shape::Plane { .. } => None,
    }
}

impl Patch {
    const ANYTHING: Self = Self { places: Space::UNKNOWN, normals: Space::UNKNOWN };

    /// The piece of a triangle between these places.
    fn of(triangle: &Triangle, corners: &[[f64; 3]; 3], camera: Space) -> Self {
        let normals = between(&triangle.normals, corners);
        let normals = match side(triangle, camera) {
            Some(true) => normals,
            Some(false) => -normals,
            None => normals.hull(-normals),
        };
        Self { places: between(&triangle.corners, corners), normals }
    }

    fn and(self, other: Self) -> Self {
        Self { places: self.places.hull(other.places), normals: self.normals.hull(other.normals) }
    }
}

/// A box of what lies between three places or normals.
fn between(of: &[Vector; 3], corners: &[[f64; 3]; 3]) -> Space {
    let [a, b, c] = of.map(Space::exactly);
    let [first, second, third] = corners.map(|weights| {
        let [u, v, w] = weights.map(Interval::exactly);
        a * u + b * v + c * w
    });
    first.hull(second).hull(third)
}

/// Whether the normals between the corners are those that the camera sees (true), or their opposites; none where
/// rounding leaves that open, or not all of them are on one side of the plane.
fn side(triangle: &Triangle, camera: Space) -> Option<bool> {
    let [a, b, c] = triangle.corners.map(Space::exactly);
    let plane = (b - a).cross(c - a);
    let outwards = triangle.normals.map(|normal| positive(Space::exactly(normal).dot(plane)));
    let outwards = if outwards.iter().all(|one| *one == outwards[0]) { outwards[0]? } else { return None };
    Some(positive((camera - a).dot(plane))? == outwards)
}

/// True where every number is above 0, false where every one is below it.
fn positive(value: Interval) -> Option<bool> {
    if value.low() > 0.0 {
        Some(true)
    } else if value.high() < 0.0 {
        Some(false)
    } else {
        None
    }
}

impl Sides {
    fn new(view: &View, image: &Image) -> Self {
        let half_height = Interval::exactly(view.half_height) * Interval::exactly(WIDENED);
        let ratio = Interval::exactly(f64::from(image.width)) / Interval::exactly(f64::from(image.height));
        let [forward, right, up] = [view.forward, view.right, view.up].map(Space::exactly);
        let (across, upwards) = (forward * (half_height * ratio), forward * half_height);
        Self([right - across, -right - across, up - upwards, -up - upwards, -forward])
    }

    /// True where every place of the box, from the camera, is outside of one side of the picture.
    fn exclude(&self, from_camera: Space) -> bool {
        self.0.iter().any(|side| side.dot(from_camera).low() > 0.0)
    }
}

/// The triangles of one exponent in one light.
pub(super) struct Lit<'a> {
    patches: &'a Patches,
    light: &'a Light,
}

impl Places for Lit<'_> {
    type Part = Piece;

    fn whole(&self) -> Option<Piece> {
        (self.patches.tree.node_count() > 0).then_some(Piece { of: Of::Node(0), depth: 0 })
    }

    fn bound(&self, piece: &Piece) -> Option<Interval> {
        let Patch { places, normals } = self.patches.patch(piece);
        let from_camera = places - Space::exactly(self.patches.view.position);
        if self.patches.sides.exclude(from_camera) {
            return None;
        }
        let viewer = -from_camera.over(from_camera.square().sqrt());
        let normal = normals.over(normals.square().sqrt());
        let met = Met { viewer, normal, facing: cosine(normal.dot(viewer)), place: places };
        met.lit_by(self.patches.angle, self.light)
    }

    /// x in the middle of a piece of a triangle.
    fn sample(&self, piece: &Piece) -> Option<f64> {
        let Of::Triangle(index, corners) = piece.of else { return None };
        let triangle = triangle(&self.patches.tree, index)?;
        let weights: [f64; 3] = std::array::from_fn(|corner| corners.iter().map(|of| of[corner]).sum::<f64>() / 3.0);
        let [a, b, c] = triangle.corners;
        let place = a * weights[0] + b * weights[1] + c * weights[2];
        let Patches { view, angle, sides, .. } = self.patches;
        let from_camera = place - view.position;
        if sides.exclude(Space::exactly(from_camera)) {
            return None;
        }
        let ray = Ray { origin: view.position, direction: from_camera.unit()? };
        let hit = meet(&ray, &Shape::Triangle(*triangle), f64::INFINITY)?;
        let found = presented(*angle, self.light, place, hit.normal, -ray.direction);
        (!found.faces_away()).then_some(found.x)
    }

    fn cut(&self, piece: &Piece) -> Option<Vec<Piece>> {
        let depth = piece.depth + 1;
        let tree = &self.patches.tree;
        let parts: Vec<Of> = match piece.of {
            Of::Node(node) => match tree.below(node) {
                Below::Halves(halves) => halves.map(Of::Node).into(),
                Below::Surfaces(range) => range.map(|index| Of::Triangle(index, CORNERS)).collect(),
            },
            Of::Triangle(index, corners) if depth <= DEEPEST => {
                halves(triangle(tree, index)?, corners).map(|corners| Of::Triangle(index, corners)).into()
            }
            Of::Triangle(..) => return None,
        };
        Some(parts.into_iter().map(|of| Piece { of, depth }).collect())
    }

    fn depth(&self, piece: &Piece) -> u32 {
        piece.depth
    }
}

/// A piece of a triangle, cut across its longest edge.
fn halves(triangle: &Triangle, corners: [[f64; 3]; 3]) -> [[[f64; 3]; 3]; 2] {
    let [a, b, c] = triangle.corners;
    let places = corners.map(|[u, v, w]| a * u + b * v + c * w);
    let length = |edge: usize| (places[(edge + 1) % 3] - places[edge]).length();
    let longest = (1..3).fold(0, |longest, edge| if length(edge) > length(longest) { edge } else { longest });
    let [from, to, opposite] = [0, 1, 2].map(|step| corners[(longest + step) % 3]);
    let middle = std::array::from_fn(|index| (from[index] + to[index]) / 2.0);
    [[from, middle, opposite], [middle, to, opposite]]
}
