//! How far a fit is from x^n: the greatest absolute and relative error over a continuous interval.
//!
//! This is the first of the four parts of the total error, the method's own: real coefficients, no
//! datapath. The maximum of a smooth error lies where its slope vanishes or at an end. So a grid
//! finds the cells with the highest errors, and bisection on the slope then places each maximum to
//! the last digits, which comparing values (flat at a maximum) could do to half of them only.
//!
//! Everything is computed in s = 1 − x; near the highlight x has no digits left to tell.

use hw_model::fit::Fit;
use hw_model::highlight::{Centred, Segment, phong_at_s};

/// Grid cells over the region, and again over the part of it nearest to the highlight.
const CELLS: u32 = 256;

/// The width, in units of 1/n, of the part that gets cells of its own: over it x^n falls by e⁻⁴⁰, and
/// what a method does at the scale of the highlight happens there.
const HIGHLIGHT: f64 = 40.0;

/// Peaks of the grid that are refined. A cubic error has at most four extrema on the epicentre.
const REFINED: usize = 6;

/// Halvings of a cell: 2⁻⁵⁵ of two cells is below the last digit of s.
const HALVINGS: u32 = 55;

/// An interval of s = 1 − x, 0 ≤ low ≤ high ≤ 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Its end nearer to the highlight.
    pub s_low: f64,
    /// Its end farther from the highlight.
    pub s_high: f64,
}

impl Extent {
    /// All of [0, 1].
    pub const WHOLE: Self = Self { s_low: 0.0, s_high: 1.0 };

    /// The epicentre, x in [q, 1].
    #[must_use]
    pub const fn epicentre(fit: &Fit) -> Self {
        Self { s_low: 0.0, s_high: fit.epicentre.s }
    }

    /// The tail, x in [0, q].
    #[must_use]
    pub const fn tail(fit: &Fit) -> Self {
        Self { s_low: fit.epicentre.s, s_high: 1.0 }
    }

    /// The region's grid, increasing.
    fn grid(self, exponent: f64) -> Vec<f64> {
        let Self { s_low, s_high } = self;
        let near = s_high.min(s_low + HIGHLIGHT / exponent);
        let points = |end: f64| {
            let step = (end - s_low) / f64::from(CELLS);
            // The last point is the end itself, not a rounding of it.
            (0..CELLS).map(move |i| s_low + step * f64::from(i)).chain([end])
        };
        let mut grid: Vec<f64> = points(near).chain(points(s_high)).collect();
        grid.sort_by(f64::total_cmp);
        grid.dedup();
        grid
    }
}

/// The greatest error of one kind, and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The error's magnitude, as a fraction (not in per cent).
    pub error: f64,
    /// Where, as s = 1 − x.
    pub s: f64,
}

impl Peak {
    /// Where, as x; near the highlight of a large exponent `s` says it better.
    #[must_use]
    pub fn x(self) -> f64 {
        1.0 - self.s
    }
}

/// The greatest errors over a region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ApproximationError {
    /// max |f(x) − x^n|.
    pub absolute: Peak,
    /// max |f(x)/x^n − 1|. `None` when the region reaches x = 0, where x^n vanishes; infinite when
    /// x^n underflows in it and f does not.
    pub relative: Option<Peak>,
}

impl ApproximationError {
    /// The greater of each, of two regions side by side.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        let greater = |a: Peak, b: Peak| if b.error > a.error { b } else { a };
        Self {
            absolute: greater(self.absolute, other.absolute),
            relative: self.relative.zip(other.relative).map(|(a, b)| greater(a, b)),
        }
    }
}

/// What is measured: a value at x = 1 − s, and its slope against s.
pub trait Approximant {
    /// The value at x = 1 − s.
    fn value_at_s(&self, s: f64) -> f64;
    /// The derivative of the value with respect to s.
    fn slope_at_s(&self, s: f64) -> f64;
}

macro_rules! approximant {
    ($($kind:ty),*) => {$(
        impl Approximant for $kind {
            fn value_at_s(&self, s: f64) -> f64 {
                self.value_at_s(s)
            }
            fn slope_at_s(&self, s: f64) -> f64 {
                self.slope_at_s(s)
            }
        }
    )*};
}
approximant!(Fit, Centred, Segment);

/// Measures `fit`, which was made for `exponent`, over a region.
///
/// The error's magnitude is accurate to about 10⁻¹⁵ absolutely, the noise of evaluating f.
#[must_use]
pub fn approximation(fit: &impl Approximant, exponent: f64, region: Extent) -> ApproximationError {
    let grid = region.grid(exponent);
    let power = |s| phong_at_s(exponent, s);
    let absolute = greatest(
        &grid,
        |s| fit.value_at_s(s) - power(s),
        // d/ds of −(1 − s)^n is n·(1 − s)^(n − 1)
        |s| fit.slope_at_s(s) + exponent * phong_at_s(exponent - 1.0, s),
    );
    let relative = (region.s_high < 1.0).then(|| {
        greatest(
            &grid,
            |s| relative_error(fit.value_at_s(s), power(s)),
            // d/ds of f/x^n has the sign of f′·x + n·f
            |s| fit.slope_at_s(s) * (1.0 - s) + exponent * fit.value_at_s(s),
        )
    });
    ApproximationError { absolute, relative }
}

/// value/power − 1; the difference is taken first, where it is nearly exact.
fn relative_error(value: f64, power: f64) -> f64 {
    let difference = value - power;
    if difference == 0.0 {
        return 0.0;
    }
    difference / power
}

/// The greatest |error| between the ends of the grid; `slope` has the sign of its derivative.
fn greatest(grid: &[f64], error: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64) -> Peak {
    let errors: Vec<f64> = grid.iter().map(|&s| error(s)).collect();
    let mut peaks = peaks(&errors);
    peaks.sort_by(|&i, &j| errors[j].abs().total_cmp(&errors[i].abs()));
    let mut best = Peak { error: 0.0, s: grid[0] };
    for &i in peaks.iter().take(REFINED) {
        let (left, right) = (grid[i.saturating_sub(1)], grid[(i + 1).min(grid.len() - 1)]);
        let rising = |s: f64| slope(s) * errors[i] > 0.0;
        let summit = (rising(left) && !rising(right)).then(|| bisect(left, right, rising));
        for s in [Some(grid[i]), summit].into_iter().flatten() {
            let magnitude = error(s).abs();
            if magnitude > best.error {
                best = Peak { error: magnitude, s };
            }
        }
    }
    best
}

/// The places whose magnitude no neighbour exceeds.
fn peaks(errors: &[f64]) -> Vec<usize> {
    let magnitude = |i: usize| errors.get(i).map_or(0.0, |error| error.abs());
    (0..errors.len())
        .filter(|&i| {
            let before = if i == 0 { 0.0 } else { magnitude(i - 1) };
            magnitude(i) >= before && magnitude(i) >= magnitude(i + 1)
        })
        .collect()
}

/// Where `rising` turns from true to false.
fn bisect(mut left: f64, mut right: f64, rising: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = left + 0.5 * (right - left);
        if rising(middle) {
            left = middle;
        } else {
            right = middle;
        }
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;
    use hw_model::fit::{Levels, Method, fit};
    use proptest::prelude::*;

    #[test]
    fn an_error_that_is_known() {
        // Schlick at n = 2 on all of [0, 1]: x/(2 − x) − x², which is greatest where
        // 2/(2 − x)² = 2x, x·(2 − x)² = 1, x = (3 − √5)/2.
        let schlick = fit(Method::Schlick, 2.0, Levels::default()).unwrap();
        let found = approximation(&schlick, 2.0, Extent::WHOLE);
        let x = (3.0 - 5.0_f64.sqrt()) / 2.0;
        assert!((found.absolute.x() - x).abs() < 1e-14, "{found:?}");
        assert!((found.absolute.error - (x / (2.0 - x) - x * x)).abs() < 1e-16);
        assert_eq!(found.relative, None);
    }

    #[test]
    fn a_cubic_far_below_its_epicentre_is_seen_too() {
        // Below the cut the Hermite cubic rises to about 0.047·n² near x = 1/3.
        let hermite = fit(Method::Hermite, 1024.0, Levels::default()).unwrap();
        let found = approximation(&hermite, 1024.0, Extent::WHOLE).absolute;
        assert!((found.error - 49_313.0).abs() < 1.0, "{found:?}");
        assert!((found.x() - 1.0 / 3.0).abs() < 1e-3, "{found:?}");
    }

    proptest! {
        /// No point of the region beats the maximum, and the maximum is attained where it says.
        #[test]
        fn it_is_the_maximum(decades in 0.0_f64..9.0, part in 0.0_f64..=1.0, which in 0_usize..7) {
            let (n, method) = (10.0_f64.powf(decades), Method::ALL[which]);
            let fit = fit(method, n, Levels::default()).unwrap();
            for region in [Extent::epicentre(&fit), Extent { s_low: 0.0, s_high: (4.0 / n).min(0.99) }] {
                let found = approximation(&fit, n, region);
                let s = region.s_low + part * (region.s_high - region.s_low);
                let absolute = |s| (fit.value_at_s(s) - phong_at_s(n, s)).abs();
                prop_assert!(absolute(s) <= found.absolute.error + 2e-15);
                prop_assert_eq!(absolute(found.absolute.s), found.absolute.error);
                let relative = found.relative.unwrap();
                prop_assert!(absolute(s) / phong_at_s(n, s) <= relative.error * (1.0 + 1e-12) + 2e-13);
                prop_assert!((region.s_low..=region.s_high).contains(&relative.s));
            }
        }
    }
}
