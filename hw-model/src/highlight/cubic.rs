//! Cubic polynomials in their two forms.
//!
//! | form    | value                      | coefficients for large n                               |
//! |---------|----------------------------|--------------------------------------------------------|
//! | centred | 1 − s·(k1 − s·(k2 − s·k3)) | k_i·p^i of size 1 or less: no term outgrows the value  |
//! | power   | a·x³ + b·x² + c·x + d      | all of size n², for a value of size 1                  |
//!
//! with s = 1 − x. The same polynomial, but in f64 the power form loses about 2·log10(n) digits,
//! both in evaluation and in the conversion from one form to the other. So a fit computes each
//! form's coefficients by themselves ([`Cubic`]), and real values come from the centred form.

use super::segment::Segment;

/// 1 − s·(k1 − s·(k2 − s·k3)), s = 1 − x. The value at x = 1 is 1 by construction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Centred {
    /// Slope at x = 1; of size n.
    pub k1: f64,
    /// Coefficient of s²; of size n².
    pub k2: f64,
    /// Coefficient of −s³; of size n² where f(0) = 0 is demanded, n³ where not.
    pub k3: f64,
}

/// a·x³ + b·x² + c·x + d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Power {
    /// Coefficient of x³.
    pub a: f64,
    /// Coefficient of x².
    pub b: f64,
    /// Coefficient of x.
    pub c: f64,
    /// Value at x = 0.
    pub d: f64,
}

/// One cubic in both forms, each coefficient rounded from the real one.
///
/// Neither form is converted from the other's rounded coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// The form to evaluate.
    pub centred: Centred,
    /// The form of \[Rom\], for hardware that computes it.
    pub power: Power,
}

impl Centred {
    /// The value at x = 1 − s.
    #[must_use]
    #[inline]
    pub fn value_at_s(&self, s: f64) -> f64 {
        1.0 - s * (self.k1 - s * (self.k2 - s * self.k3))
    }

    /// The slope against s, d/ds; the slope against x is its negative.
    #[must_use]
    pub fn slope_at_s(&self, s: f64) -> f64 {
        -self.k1 + s * (2.0 * self.k2 - s * (3.0 * self.k3))
    }

    /// The value at x.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        self.value_at_s(1.0 - x)
    }

    /// The smallest s > 0 at which the cubic has a local minimum, if it has one.
    ///
    /// The derivative vanishes at s = (k2 ± √D)/(3·k3), D = k2² − 3·k1·k3, and the second derivative
    /// 2·k2 − 6·k3·s is positive at the root with the minus sign, whatever the sign of k3: a cubic
    /// has at most one local minimum. For k2 ≥ 0 that root is k1/(k2 + √D), which neither cancels
    /// nor minds k3 = 0.
    #[must_use]
    pub fn first_minimum(&self) -> Option<f64> {
        let Self { k1, k2, k3 } = *self;
        let discriminant = difference_of_products(k2, k2, 3.0 * k1, k3);
        if discriminant.is_nan() || discriminant <= 0.0 {
            return None;
        }
        let root = discriminant.sqrt();
        let s = if k2 >= 0.0 { k1 / (k2 + root) } else { (k2 - root) / (3.0 * k3) };
        (s > 0.0 && s.is_finite()).then_some(s)
    }
}

impl Cubic {
    /// The centred form as a segment that counts from s = 0.
    #[must_use]
    pub const fn segment(&self) -> Segment {
        let Centred { k1, k2, k3 } = self.centred;
        Segment { start: 0.0, c: [1.0, k1, k2, k3, 0.0] }
    }
}

impl Power {
    /// The value at x by Horner's rule; for large n it has lost about 2·log10(n) of its 16 digits.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        ((self.a * x + self.b) * x + self.c) * x + self.d
    }
}

impl From<Centred> for Power {
    fn from(Centred { k1, k2, k3 }: Centred) -> Self {
        Self { a: k3, b: k2 - 3.0 * k3, c: k1 - 2.0 * k2 + 3.0 * k3, d: 1.0 - k1 + k2 - k3 }
    }
}

/// Takes f(1) = 1 for granted: a + b + c + d = 1, so d carries no information of its own.
impl From<Power> for Centred {
    fn from(Power { a, b, c, .. }: Power) -> Self {
        Self { k1: 3.0 * a + 2.0 * b + c, k2: 3.0 * a + b, k3: a }
    }
}

/// a·b − c·d with an error of at most 1.5 ulp of the result (Kahan; Jeannerod, Louvet and Muller 2013).
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let cd = c * d;
    let error = (-c).mul_add(d, cd);
    a.mul_add(b, -cd) + error
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const CUBE: Centred = Centred { k1: 3.0, k2: 3.0, k3: 1.0 };

    #[test]
    fn forms_of_the_cube() {
        let power = Power { a: 1.0, b: 0.0, c: 0.0, d: 0.0 };
        assert_eq!(Power::from(CUBE), power);
        assert_eq!(Centred::from(power), CUBE);
        assert_eq!((CUBE.value(0.5), power.value(0.5)), (0.125, 0.125));
        assert_eq!(CUBE.slope_at_s(0.5), -0.75);
    }

    #[test]
    fn minima_of_every_kind() {
        let minimum = |k1, k2, k3| Centred { k1, k2, k3 }.first_minimum();
        // slope −1 + 4s − 3s²: minimum at 1/3, maximum at 1
        assert!((minimum(1.0, 2.0, 1.0).unwrap() - 1.0 / 3.0).abs() < 1e-16);
        // a parabola, and the parabola that opens downwards
        assert_eq!(minimum(2.0, 1.0, 0.0), Some(1.0));
        assert_eq!(minimum(2.0, -1.0, 0.0), None);
        // k3 < 0: slope −1 + 3s²
        assert!((minimum(1.0, 0.0, -1.0).unwrap() - (1.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        // slope −1 − 2s + 3s²: the formula for k2 < 0
        assert_eq!(minimum(1.0, -1.0, -1.0), Some(1.0));
        // x³ only has an inflection; a line has nothing; 1 + 2s + s² has its minimum at s = −1
        assert_eq!(CUBE.first_minimum(), None);
        assert_eq!(minimum(1.0, 0.0, 0.0), None);
        assert_eq!(minimum(-2.0, 1.0, 0.0), None);
    }

    proptest! {
        #[test]
        fn a_minimum_is_lower_than_its_neighbours(
            k1 in -10.0_f64..10.0, k2 in -10.0_f64..10.0, k3 in -10.0_f64..10.0,
        ) {
            let cubic = Centred { k1, k2, k3 };
            if let Some(s) = cubic.first_minimum() {
                let h = 1e-3 * s;
                let curvature = 2.0 * k2 - 6.0 * k3 * s;
                prop_assert!(curvature >= 0.0);
                let scale = k1.abs() + 2.0 * k2.abs() * s + 3.0 * k3.abs() * s * s;
                prop_assert!(cubic.slope_at_s(s).abs() <= 1e-14 * scale);
                let noise = 1e-15 * (1.0 + s * scale);
                prop_assert!(cubic.value_at_s(s - h) >= cubic.value_at_s(s) - noise);
            }
        }

        #[test]
        fn forms_agree_and_come_back(
            k1 in -1e3_f64..1e3, k2 in -1e3_f64..1e3, k3 in -1e3_f64..1e3, x in 0.0_f64..1.0,
        ) {
            let centred = Centred { k1, k2, k3 };
            let power = Power::from(centred);
            prop_assert!((power.value(x) - centred.value(x)).abs() < 1e-10);
            let back = Centred::from(power);
            prop_assert!((back.k1 - k1).abs() < 1e-10 && (back.k2 - k2).abs() < 1e-10);
            prop_assert_eq!(back.k3, k3);
        }
    }
}
