//! The methods as functions of h = 1/n and σ = −n·ln x, smooth down to h = 0.
//!
//! x = e^−hσ and x^n = e^−σ, so that the epicentre is 0 ≤ σ ≤ L = −ln Q for every n. With
//! φ(t) = (1 − e^−t)/t the distance from the highlight is s = 1 − x = h·S, S = σ·φ(hσ), and the points
//! where the methods meet x^n are p = h·P, P = L·φ(hL), and (for `three_point`) h·P′, P′ = M·φ(hM),
//! M = −ln G. Nothing is divided by h: at h = 0 stand the limits for n → ∞.
//!
//! Cubics, Newton's form on the nodes 0, P, P′ (`hermite`: P′ = P, whose divided difference is the slope)
//! in the variable S:
//!
//! ```text
//! f  = 1 + S·(a1 + (S − P)·(a2 + (S − P′)·a3))
//! a1 = (Q − 1)/P
//! a2 = ((G − Q)/(P′ − P) − a1)/P′          three_point
//! a2 = (−R − a1)/P                         hermite, quadratic: f′ = −R at S = P, R = Q/q = e^−(1−h)L
//! a3 = −h·(h² + a1·h + a2·q)/(q·q′)        from f = 0 at S = 1/h; quadratic: 0
//! ```
//!
//! with q = 1 − hP = e^−hL and q′ = e^−hM. The last line is h³ times 0 = 1 + (a1 + (1/h − P)·(a2 + (1/h −
//! P′)·a3))/h. `tangent` is (1 − hS)·(1 − U·S)², U = (1 − k)/P, 1 − k = −expm1(−(1 − h)·L/2). The hyperbolas
//! are N·x/(c + (1 − h)·S): N = Q, c = 1 − P for the tail, N = c = 1 for `schlick`.
//!
//! `minimax` has no formula: its curve is f = 1 − S·(k1·h − S·(k2·h² − S·k3·h³)) with the k of
//! `hw_model::fit` as they are, at one n only. What is enclosed is then the error of those coefficients.
//!
//! These formulas are not those of `hw_model::fit`, on purpose.

use hw_model::fit::{Levels, Method};
use hw_model::highlight::Centred;

use super::claim::Stretch;
use crate::interval::{Interval, Real};

/// One method at one h, or at every h of an interval: its coefficients.
#[derive(Debug, Clone, Copy)]
pub struct Curve<R> {
    h: R,
    shape: Shape<R>,
}

#[derive(Debug, Clone, Copy)]
enum Shape<R> {
    /// P, P′, a1, a2, a3.
    Cubic { p: R, p_far: R, a1: R, a2: R, a3: R },
    /// U.
    Tangent { u: R },
    /// k1·h, k2·h², k3·h³.
    Centred { b: [R; 3] },
    /// N, c.
    Hyperbola { scale: R, at_one: R },
}

/// What both levels give, as intervals.
#[derive(Debug, Clone, Copy)]
pub struct Logs {
    levels: Levels,
    /// L = −ln Q: the epicentre is 0 ≤ σ ≤ L.
    pub l: Interval,
    /// M = −ln G.
    m: Interval,
}

impl Logs {
    /// Encloses the logarithms of both levels.
    #[must_use]
    pub fn new(levels: Levels) -> Self {
        let minus_log = |level| -Interval::exactly(level).ln();
        Self { levels, l: minus_log(levels.q()), m: minus_log(levels.g()) }
    }
}

/// An enclosure of 1/n; exact for a power of two, which has no significand bits.
#[must_use]
pub fn reciprocal(exponent: f64) -> Interval {
    if exponent.to_bits() << 12 == 0 {
        Interval::exactly(1.0 / exponent)
    } else {
        Interval::ONE / Interval::exactly(exponent)
    }
}

impl<R: Real> Curve<R> {
    /// The curve of given coefficients, h = 1/n.
    #[must_use]
    pub fn of_coefficients(coefficients: &Centred, h: R) -> Self {
        let &Centred { k1, k2, k3 } = coefficients;
        let [k1, k2, k3] = [k1, k2, k3].map(R::exactly);
        Self { h, shape: Shape::Centred { b: [k1 * h, k2 * h * h, k3 * h * h * h] } }
    }

    /// The curve that `method` has on `region`; h within [0, 1].
    #[must_use]
    pub fn new(method: Method, region: Stretch, logs: &Logs, h: R) -> Self {
        let one = R::exactly(1.0);
        let l = R::from(logs.l);
        let p = l * (h * l).phi();
        let shape = match (method, region) {
            (Method::Schlick, _) => Shape::Hyperbola { scale: one, at_one: one },
            (Method::Rational, _) | (Method::Composite, Stretch::Tail) => {
                Shape::Hyperbola { scale: R::exactly(logs.levels.q()), at_one: one - p }
            }
            (Method::Tangent, _) => {
                let half_log_k = (one - h) * l * R::exactly(0.5);
                Shape::Tangent { u: -(-half_log_k).expm1() / p }
            }
            // Given coefficients do not come here: see `of_coefficients`.
            (Method::Hermite | Method::ThreePoint | Method::Minimax | Method::Quadratic | Method::Composite, _) => {
                cubic(method, logs, h, p)
            }
        };
        Self { h, shape }
    }

    /// The value f of the method at σ = −n·ln x.
    #[must_use]
    pub fn value(&self, sigma: R) -> R {
        let one = R::exactly(1.0);
        let distance = sigma * (self.h * sigma).phi();
        match self.shape {
            Shape::Cubic { p, p_far, a1, a2, a3 } => {
                one + distance * (a1 + (distance - p) * (a2 + (distance - p_far) * a3))
            }
            Shape::Centred { b: [b1, b2, b3] } => one - distance * (b1 - distance * (b2 - distance * b3)),
            Shape::Tangent { u } => {
                let root = one - u * distance;
                (-(self.h * sigma)).exp() * root * root
            }
            Shape::Hyperbola { scale, at_one } => {
                scale * (-(self.h * sigma)).exp() / (at_one + (one - self.h) * distance)
            }
        }
    }
}

/// Every cubic but `tangent`.
fn cubic<R: Real>(method: Method, logs: &Logs, h: R, p: R) -> Shape<R> {
    let (one, zero) = (R::exactly(1.0), R::exactly(0.0));
    let (l, m) = (R::from(logs.l), R::from(logs.m));
    let level = R::exactly(logs.levels.q());
    let a1 = (level - one) / p;
    let (p_far, q_far, a2) = if method == Method::ThreePoint {
        let p_far = m * (h * m).phi();
        let slope = (R::exactly(logs.levels.g()) - level) / (p_far - p);
        (p_far, (-(h * m)).exp(), (slope - a1) / p_far)
    } else {
        let slope = -(-((one - h) * l)).exp();
        (p, (-(h * l)).exp(), (slope - a1) / p)
    };
    let q = (-(h * l)).exp();
    let a3 = if method == Method::Quadratic { zero } else { -(h * (h * h + a1 * h + a2 * q)) / (q * q_far) };
    Shape::Cubic { p, p_far, a1, a2, a3 }
}

impl Curve<Interval> {
    /// Enclosures of k1, k2, k3 in f = 1 − s·(k1 − s·(k2 − s·k3)), s = h·S; `None` for a hyperbola.
    #[must_use]
    pub fn centred(&self) -> Option<[Interval; 3]> {
        let Self { h, shape } = *self;
        let two = Interval::exactly(2.0);
        let (b1, b2, b3) = match shape {
            Shape::Cubic { p, p_far, a1, a2, a3 } => (p * (a2 - p_far * a3) - a1, a2 - (p + p_far) * a3, -a3),
            // (1 − hS)·(1 − 2US + U²S²)
            Shape::Tangent { u } => (two * u + h, u * (u + two * h), h * u * u),
            Shape::Centred { b: [b1, b2, b3] } => (b1, b2, b3),
            Shape::Hyperbola { .. } => return None,
        };
        Some([b1 / h, b2 / (h * h), b3 / (h * h * h)])
    }
}

/// Is the curve x^n itself? Then no relative width can be asked of its error.
///
/// The conditions of each method have one solution of its shape, and for these n x^n is of the shape and
/// satisfies them: through 0, as cubics without d are, for n = 1, 2, 3; x·(u·x − v)² is x (u = 0) or x³
/// (v = 0); a parabola x or x²; x/(A − B·x) x for B = 0.
#[must_use]
pub fn is_exact(method: Method, region: Stretch, exponent: f64) -> bool {
    let exact: &[f64] = match (method, region) {
        (Method::Composite, Stretch::Tail) | (Method::Rational | Method::Schlick, _) => &[1.0],
        (Method::Hermite | Method::ThreePoint | Method::Minimax | Method::Composite, _) => &[1.0, 2.0, 3.0],
        (Method::Tangent, _) => &[1.0, 3.0],
        (Method::Quadratic, _) => &[1.0, 2.0],
    };
    exact.contains(&exponent)
}
