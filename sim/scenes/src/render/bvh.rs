//! Which surface a ray meets first, among many: a tree of boxes.
//!
//! Our own, because a picture must be the same bytes whatever library version or machine, and because two hundred lines
//! are less than the crates that would bring it: boxes are halved at the median of their longest side, so that the
//! depth is the logarithm of the count and a ray needs a small stack. Planes have no box and are asked one by one.

use std::ops::Range;

use crate::scene::{Shape, Surface, Vector};

use super::rays::Ray;
use super::surfaces::{Hit, meet};

/// Surfaces that a leaf holds at most.
const LEAF: usize = 4;
/// Levels of the tree: a halving for each bit of a count below 2^32, and room.
const DEPTH: usize = 40;

/// The surfaces of a scene, ordered for rays.
#[derive(Debug, Clone)]
pub struct Bvh {
    surfaces: Vec<Surface>,
    planes: Vec<Surface>,
    nodes: Vec<Node>,
}

/// What stands directly below a node of a tree.
pub(crate) enum Below {
    /// Two nodes.
    Halves([usize; 2]),
    /// Surfaces, by their places in the tree.
    Surfaces(Range<usize>),
}

#[derive(Debug, Clone, Copy)]
struct Bounds {
    low: Vector,
    high: Vector,
}

/// A box. A leaf holds `count` surfaces from `first`; otherwise `count` is 0, the near half is the next node and the
/// far half the node `first`.
#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: Bounds,
    first: u32,
    count: u32,
    axis: u8,
}

impl Bounds {
    const NONE: Self = Self {
        low: Vector::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vector::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The box of a shape, none for a plane.
    fn of(shape: &Shape) -> Option<Self> {
        match shape {
            Shape::Plane { .. } => None,
            Shape::Sphere { centre, radius } => {
                let reach = Vector::new(*radius, *radius, *radius);
                Some(Self { low: *centre - reach, high: *centre + reach })
            }
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.corners;
                Some(Self { low: a.least(b).least(c), high: a.greatest(b).greatest(c) })
            }
        }
    }

    fn and(self, other: Self) -> Self {
        Self { low: self.low.least(other.low), high: self.high.greatest(other.high) }
    }

    /// A little more, so that no rounding of a ray's way through the box loses what lies on its sides.
    fn widened(self) -> Self {
        const PART: f64 = 1e-12;
        let most = |v: Vector| v.coordinates().into_iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        let more = PART * most(self.low).max(most(self.high));
        let more = Vector::new(more, more, more);
        Self { low: self.low - more, high: self.high + more }
    }

    /// True where the ray is in the box somewhere between 0 and `limit`.
    fn meets(&self, origin: [f64; 3], inverse: [f64; 3], limit: f64) -> bool {
        let (low, high) = (self.low.coordinates(), self.high.coordinates());
        let (mut enters, mut leaves) = (0.0_f64, limit);
        for axis in 0..3 {
            let near = (low[axis] - origin[axis]) * inverse[axis];
            let far = (high[axis] - origin[axis]) * inverse[axis];
            // 0·∞ is NaN, for a ray in the side of the box: `min` and `max` pass it over.
            enters = enters.max(near.min(far));
            leaves = leaves.min(near.max(far));
        }
        enters <= leaves
    }
}

/// A surface while the tree is built.
struct Item {
    surface: Surface,
    bounds: Bounds,
    middle: [f64; 3],
}

impl Bvh {
    /// A tree of these surfaces.
    #[must_use]
    pub fn new(surfaces: &[Surface]) -> Self {
        let mut items = Vec::with_capacity(surfaces.len());
        let mut planes = Vec::new();
        for surface in surfaces {
            match Bounds::of(&surface.shape) {
                None => planes.push(*surface),
                Some(bounds) => {
                    let middle = ((bounds.low + bounds.high) * 0.5).coordinates();
                    items.push(Item { surface: *surface, bounds, middle });
                }
            }
        }
        let mut nodes = Vec::with_capacity(items.len());
        if !items.is_empty() {
            build(&mut items, 0, &mut nodes);
        }
        let surfaces = items.into_iter().map(|item| item.surface).collect();
        Self { surfaces, planes, nodes }
    }

    /// The number of nodes; what stands below a node comes after it.
    pub(crate) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// What stands directly below a node.
    pub(crate) fn below(&self, node: usize) -> Below {
        let Node { first, count, .. } = self.nodes[node];
        match count {
            0 => Below::Halves([node + 1, first as usize]),
            _ => Below::Surfaces(first as usize..(first + count) as usize),
        }
    }

    /// A surface of the tree, by its place there.
    pub(crate) fn surface(&self, index: usize) -> &Surface {
        &self.surfaces[index]
    }

    /// Where the ray meets a surface first, and the surface's material.
    #[must_use]
    pub fn first(&self, ray: &Ray) -> Option<(Hit, u16)> {
        let mut best: Option<(Hit, u16)> = None;
        let mut limit = f64::INFINITY;
        let mut see = |surface: &Surface, limit: &mut f64| {
            if let Some(hit) = meet(ray, &surface.shape, *limit) {
                *limit = hit.distance;
                best = Some((hit, surface.material));
            }
        };
        for plane in &self.planes {
            see(plane, &mut limit);
        }
        let origin = ray.origin.coordinates();
        let direction = ray.direction.coordinates();
        let inverse = direction.map(|part| 1.0 / part);
        let mut waiting = [0_u32; DEPTH];
        let mut count = usize::from(!self.nodes.is_empty());
        while count > 0 {
            count -= 1;
            let index = waiting[count];
            let node = &self.nodes[index as usize];
            if !node.bounds.meets(origin, inverse, limit) {
                continue;
            }
            if node.count > 0 {
                for surface in &self.surfaces[node.first as usize..][..node.count as usize] {
                    see(surface, &mut limit);
                }
                continue;
            }
            // The half that the ray comes from is asked first: what it meets there hides the rest.
            let (low, high) = (index + 1, node.first);
            let backwards = direction[usize::from(node.axis)] < 0.0;
            (waiting[count], waiting[count + 1]) = if backwards { (low, high) } else { (high, low) };
            count += 2;
        }
        best
    }
}

/// Appends the node of these items, and those below it; `first` is their place among all.
fn build(items: &mut [Item], first: usize, nodes: &mut Vec<Node>) {
    let bounds = items.iter().fold(Bounds::NONE, |bounds, item| bounds.and(item.bounds)).widened();
    let index = nodes.len();
    let (first, count) = (first as u32, items.len() as u32);
    nodes.push(Node { bounds, first, count, axis: 0 });
    if items.len() <= LEAF {
        return;
    }
    let sides = (bounds.high - bounds.low).coordinates();
    let axis = (0..3).fold(0, |longest, axis| if sides[axis] > sides[longest] { axis } else { longest });
    let half = items.len() / 2;
    items.select_nth_unstable_by(half, |one, other| one.middle[axis].total_cmp(&other.middle[axis]));
    let (low, high) = items.split_at_mut(half);
    build(low, first as usize, nodes);
    let far = nodes.len() as u32;
    build(high, first as usize + half, nodes);
    nodes[index] = Node { bounds, first: far, count: 0, axis: axis as u8 };
}
