//! A polynomial that counts from a place of its own.
//!
//! Far from the highlight a polynomial in s = 1 − x has terms that outgrow its value. Counted from the
//! segment's own start, v = s − start, each term is at most of the size of the value there.

use crate::registers::MAX_DEGREE;

/// c0 − v·(c1 − v·(c2 − v·(c3 − v·c4))), v = s − start, s = 1 − x. Of a degree below 4 the last coefficients are 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// The s from which v counts.
    pub start: f64,
    /// c0 to c4: the value at the start, and the coefficients of −v, v², −v³, v⁴.
    pub c: [f64; MAX_DEGREE + 1],
}

impl Segment {
    /// The value at x = 1 − s.
    #[must_use]
    #[inline]
    pub fn value_at_s(&self, s: f64) -> f64 {
        let [c0, c1, c2, c3, c4] = self.c;
        let v = s - self.start;
        c0 - v * (c1 - v * (c2 - v * (c3 - v * c4)))
    }

    /// The slope against s; the slope against x is its negative.
    #[must_use]
    pub fn slope_at_s(&self, s: f64) -> f64 {
        let [_, c1, c2, c3, c4] = self.c;
        let v = s - self.start;
        -c1 + v * (2.0 * c2 - v * (3.0 * c3 - v * (4.0 * c4)))
    }

    /// The same polynomial, counted from another place (Taylor's series, which ends here). Meant for short
    /// moves: over a distance d the coefficients are good to an ulp of the greatest c_i·d^i.
    #[must_use]
    pub fn counted_from(&self, start: f64) -> Self {
        let [_, c1, c2, c3, c4] = self.c;
        let d = start - self.start;
        let c = [
            self.value_at_s(start),
            c1 - d * (2.0 * c2 - d * (3.0 * c3 - d * (4.0 * c4))),
            c2 - d * (3.0 * c3 - d * (6.0 * c4)),
            c3 - d * (4.0 * c4),
            c4,
        ];
        Self { start, c }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_start_does_not_matter(
            c in prop::array::uniform5(-4.0_f64..4.0), s in 0.0_f64..1.0, start in 0.0_f64..1.0
        ) {
            let segment = Segment { start: 0.25, c };
            let moved = segment.counted_from(start);
            prop_assert!((segment.value_at_s(s) - moved.value_at_s(s)).abs() < 1e-13);
            prop_assert!((segment.slope_at_s(s) - moved.slope_at_s(s)).abs() < 1e-13);
            let h = 1e-6;
            let slope = (segment.value_at_s(s + h) - segment.value_at_s(s - h)) / (2.0 * h);
            prop_assert!((slope - segment.slope_at_s(s)).abs() < 1e-8);
        }
    }
}
