//! Vectors of intervals: every place or direction of a tile of the picture at once.

use std::ops::{Add, Mul, Neg, Sub};

use crate::scene::{Image, Vector, View};
use bounds::interval::Interval;

/// A vector whose coordinates are intervals.
#[derive(Debug, Clone, Copy)]
pub(super) struct Space([Interval; 3]);

impl Space {
    /// Every vector.
    pub(super) const UNKNOWN: Self = Self([Interval::UNKNOWN; 3]);

    /// The vector of intervals that holds one vector alone.
    pub(super) fn exactly(vector: Vector) -> Self {
        Self(vector.coordinates().map(Interval::exactly))
    }

    /// The least box that holds both.
    pub(super) fn hull(self, other: Self) -> Self {
        Self(std::array::from_fn(|index| self.0[index].hull(other.0[index])))
    }

    pub(super) fn dot(self, other: Self) -> Interval {
        let [x, y, z] = self.0;
        let [a, b, c] = other.0;
        x * a + y * b + z * c
    }

    pub(super) fn cross(self, other: Self) -> Self {
        let [x, y, z] = self.0;
        let [a, b, c] = other.0;
        Self([y * c - z * b, z * a - x * c, x * b - y * a])
    }

    /// The square of the length, for every vector at once.
    pub(super) fn square(self) -> Interval {
        let [x, y, z] = self.0.map(Interval::square);
        x + y + z
    }

    /// Every vector divided by every length; each coordinate of a vector of length 1 lies from −1 to 1.
    pub(super) fn over(self, length: Interval) -> Self {
        let unit = Interval::new(-1.0, 1.0);
        Self(self.0.map(|part| (part / length).within(-1.0, 1.0).unwrap_or(unit)))
    }
}

impl Add for Space {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|index| self.0[index] + other.0[index]))
    }
}
impl Sub for Space {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}
impl Neg for Space {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|part| -part))
    }
}
impl Mul<Interval> for Space {
    type Output = Self;
    fn mul(self, factor: Interval) -> Self {
        Self(self.0.map(|part| part * factor))
    }
}

/// The rays of a tile: forward + across·right + upwards·up, as `render::ray` has them, not brought to length 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rays {
    view: [Space; 4],
    across: Interval,
    upwards: Interval,
    /// The directions of all rays of the tile.
    pub(super) direction: Space,
    /// The lengths of these directions.
    pub(super) length: Interval,
}

impl Rays {
    /// The rays through a tile, in pixels from the upper left corner of the picture.
    pub(super) fn new(view: &View, image: &Image, columns: Interval, rows: Interval) -> Self {
        let exactly = Interval::exactly;
        let half = |side: u32| exactly(f64::from(side) / 2.0);
        let scale = exactly(view.half_height) / half(image.height);
        let across = (columns - half(image.width)) * scale;
        let upwards = (half(image.height) - rows) * scale;
        let view = [view.position, view.forward, view.right, view.up].map(Space::exactly);
        let [_, forward, right, up] = view;
        let direction = forward + right * across + up * upwards;
        Self { view, across, upwards, direction, length: direction.square().sqrt() }
    }

    /// The place they begin at.
    pub(super) const fn origin(&self) -> Space {
        self.view[0]
    }

    /// `vector` × direction: taken apart, so that a tile that is small gives a product that is.
    pub(super) fn crossed_by(&self, vector: Space) -> Space {
        let [_, forward, right, up] = self.view;
        let turned = vector.cross(right) * self.across + vector.cross(up) * self.upwards;
        vector.cross(forward) + turned
    }
}
