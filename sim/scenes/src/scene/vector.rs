//! Places and directions in three dimensions.
//!
//! Additions, products and square roots only, which are correctly rounded everywhere: the same scene gives
//! the same bits on every machine.

use std::ops::{Add, Mul, Neg, Sub};

/// A place or a direction, right-handed coordinates, in the scene's own unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vector {
    /// Along the first axis.
    pub x: f64,
    /// Along the second axis.
    pub y: f64,
    /// Along the third axis.
    pub z: f64,
}

impl Vector {
    /// The vector of these coordinates.
    #[must_use]
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// The coordinates x, y and z.
    #[must_use]
    pub const fn coordinates(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// The scalar product of two vectors.
    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The vector product of two vectors, by the right hand.
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// The length of the vector.
    #[must_use]
    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    /// The same direction with length 1; none for a length that is 0, not finite, or too small to divide by.
    #[must_use]
    pub fn unit(self) -> Option<Self> {
        // Scaled first, so that squares neither vanish nor overflow.
        let greatest = self.x.abs().max(self.y.abs()).max(self.z.abs());
        if !(greatest >= f64::MIN_POSITIVE && greatest.is_finite() && self.length().is_finite()) {
            return None;
        }
        let scaled = Self::new(self.x / greatest, self.y / greatest, self.z / greatest);
        Some(scaled * (1.0 / scaled.length()))
    }

    /// True when every coordinate is a number.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    /// The lesser of each coordinate.
    #[must_use]
    pub fn least(self, other: Self) -> Self {
        Self::new(self.x.min(other.x), self.y.min(other.y), self.z.min(other.z))
    }

    /// The greater of each coordinate.
    #[must_use]
    pub fn greatest(self, other: Self) -> Self {
        Self::new(self.x.max(other.x), self.y.max(other.y), self.z.max(other.z))
    }
}

impl From<[f64; 3]> for Vector {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x, y, z }
    }
}

impl Add for Vector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl Sub for Vector {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Mul<f64> for Vector {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl Neg for Vector {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}
