//! The ways to compute coefficients, each written once for any kind of number.
//!
//! q = Q^(1/n), r the same, l = G^(1/n), p = 1 − q. \[Rom\] prints, for Q = 1/2,
//!
//! ```text
//! hermite      a = ((q−1)(2q+n) + 1)/(2(q−1)²q²)      b = −(q²(4q−3) + n(q²−1) + 1)/(2(q−1)²q²)
//! three_point  a = (l²(Q−1) + G(1−r²) + r² − Q)/N     b = (l³(Q−1) + G(1−r³) − Q + r³)/N
//!              c = (l²(Q−r²) + l²(r³−r^n) + G·r²(1−r))/N
//!              N = l³(1−r²) + l²(r³−1) − r²(r−1)
//! rational     A = 2n·q                               B = 2n − 2
//! ```
//!
//! with q = e^(−0.6931471/n). The three for `three_point` do not solve the system printed above them,
//! so that their exact values are those of the expressions; the others' are those of the conditions.

use hw_model::fit::{Levels, Method};

use super::wide::Real;

/// ln 2 as \[Rom\] has it.
#[expect(clippy::approx_constant, reason = "what the digits that are left out cost is measured here")]
const PRINTED_LN_2: f64 = 0.693_147_1;

/// How the coefficients are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// The formulas as \[Rom\] prints them, and ln 2 as it prints it, 0.6931471.
    #[serde(rename = "printed_ln2")]
    PrintedConstant,
    /// The formulas as \[Rom\] prints them, q = Q^(1/n).
    Printed,
    /// Divided differences, p = 1 − q by subtraction.
    Naive,
    /// The same with p = −expm1(ln Q/n), and no other difference of neighbours that can be had so.
    Stable,
    /// What the hardware's ROM is made from: 106 bits, rounded once.
    Fit,
}

impl Way {
    /// Every way, in the order above.
    pub const ALL: [Self; 5] = [Self::PrintedConstant, Self::Printed, Self::Naive, Self::Stable, Self::Fit];

    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::PrintedConstant => "printed_ln2",
            Self::Printed => "printed",
            Self::Naive => "naive",
            Self::Stable => "stable",
            Self::Fit => "fit",
        }
    }
}

/// The coefficients of one exponent in the two forms. Of `rational` the first holds A and B, the second A − B.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Forms<R> {
    /// a, b, c, d.
    pub power: Vec<R>,
    /// k1, k2, k3.
    pub centred: Vec<R>,
}

/// An exponent and where x^n crosses the levels, computed once for every method.
pub(super) struct At<R> {
    n: R,
    level: R,
    low: R,
    /// r = q = Q^(1/n).
    q: R,
    /// l = G^(1/n).
    l: R,
    log_level: R,
    log_low: R,
}

impl<R: Real> At<R> {
    pub(super) fn new(n: f64, levels: Levels) -> Self {
        let (n, level, low) = (R::of(n), R::of(levels.q()), R::of(levels.g()));
        let (log_level, log_low) = (level.clone().ln(), low.clone().ln());
        let q = R::root_of(levels.q(), &log_level, &n);
        let l = R::root_of(levels.g(), &log_low, &n);
        Self { n, level, low, q, l, log_level, log_low }
    }

    /// 1 − x where x^n is the level of this logarithm, with or without cancellation.
    fn complement(&self, way: Way, x: &R, log: &R) -> R {
        match way {
            Way::Stable => -(log.clone() / self.n.clone()).exp_m1(),
            _ => R::of(1.0) - x.clone(),
        }
    }

    /// p = 1 − q.
    fn p(&self, way: Way) -> R {
        self.complement(way, &self.q, &self.log_level)
    }
}

/// The coefficients of a method in one way; none where the way does not have them.
pub(super) fn forms<R: Real>(method: Method, way: Way, at: &At<R>) -> Option<Forms<R>> {
    let n = || at.n.clone();
    match (method, way) {
        (_, Way::Fit) => None,
        (Method::Hermite, Way::PrintedConstant) => Some(printed_hermite(&at.n, &(R::of(-PRINTED_LN_2) / n()).exp())),
        (Method::Hermite, Way::Printed) => Some(printed_hermite(&at.n, &at.q)),
        (Method::ThreePoint, Way::Printed) => Some(printed_three_point(at)),
        (Method::Rational, Way::Printed) => Some(ratio(R::of(2.0) * n() * at.q.clone(), R::of(2.0) * n() - R::of(2.0))),
        (_, Way::Printed | Way::PrintedConstant) => None,
        (Method::Hermite, _) => Some(hermite(&Differences::new(at, way))),
        (Method::Quadratic, _) => Some(quadratic(&Differences::new(at, way))),
        (Method::ThreePoint, _) => Some(three_point(at, way)),
        (Method::Tangent, _) => Some(tangent(at, way)),
        (Method::Rational, _) => Some(rational(at, way)),
        (_, _) => None,
    }
}

fn printed_hermite<R: Real>(n: &R, q: &R) -> Forms<R> {
    let of = R::of;
    let (n, q) = (|| n.clone(), || q.clone());
    let below = of(2.0) * (q() - of(1.0)) * (q() - of(1.0)) * q() * q();
    let a = ((q() - of(1.0)) * (of(2.0) * q() + n()) + of(1.0)) / below.clone();
    let b = -(q() * q() * (of(4.0) * q() - of(3.0)) + n() * (q() * q() - of(1.0)) + of(1.0)) / below;
    let c = of(1.0) - a.clone() - b.clone();
    of_power(a, b, c)
}

fn printed_three_point<R: Real>(at: &At<R>) -> Forms<R> {
    let of = R::of;
    let (level, low) = (|| at.level.clone(), || at.low.clone());
    let (r, l) = (at.q.clone(), at.l.clone());
    let (r2, l2) = (r.clone() * r.clone(), l.clone() * l.clone());
    let (r3, l3) = (r2.clone() * r.clone(), l2.clone() * l);
    let below =
        l3.clone() * (of(1.0) - r2.clone()) + l2.clone() * (r3.clone() - of(1.0)) - r2.clone() * (r.clone() - of(1.0));
    let a = l2.clone() * (level() - of(1.0)) + low() * (of(1.0) - r2.clone()) + r2.clone() - level();
    let b = l3 * (level() - of(1.0)) + low() * (of(1.0) - r3.clone()) - level() + r3.clone();
    // r^n is Q.
    let c = l2.clone() * (level() - r2.clone()) + l2 * (r3 - level()) + low() * r2 * (of(1.0) - r);
    let over = |above: R| above / below.clone();
    Forms { power: vec![over(a), over(b), over(c)], centred: Vec::new() }
}

/// a, b, c with d = 0, and what follows from them for the centred form.
fn of_power<R: Real>(a: R, b: R, c: R) -> Forms<R> {
    let times = |factor: f64, value: &R| R::of(factor) * value.clone();
    let k1 = times(3.0, &a) + times(2.0, &b) + c.clone();
    let k2 = times(3.0, &a) + b.clone();
    Forms { centred: vec![k1, k2, a.clone()], power: vec![a, b, c, R::of(0.0)] }
}

/// k1, k2, k3 and d, which a condition may demand, and what follows from them for the power form.
fn of_centred<R: Real>(k1: R, k2: R, k3: R, d: R) -> Forms<R> {
    let times = |factor: f64, value: &R| R::of(factor) * value.clone();
    let b = k2.clone() - times(3.0, &k3);
    let c = k1.clone() - times(2.0, &k2) + times(3.0, &k3);
    Forms { power: vec![k3.clone(), b, c, d], centred: vec![k1, k2, k3] }
}

fn ratio<R: Real>(a: R, b: R) -> Forms<R> {
    Forms { power: vec![a.clone(), b.clone()], centred: vec![a - b] }
}

/// D1 = (Q−1)/p, D2 = (−nQ/q − D1)/p, D3 = Q(n−1)/q² − D2.
struct Differences<R> {
    p: R,
    d1: R,
    d2: R,
    d3: R,
}

impl<R: Real> Differences<R> {
    fn new(at: &At<R>, way: Way) -> Self {
        let (p, q, n, level) = (at.p(way), || at.q.clone(), || at.n.clone(), || at.level.clone());
        let d1 = (level() - R::of(1.0)) / p.clone();
        let d2 = (-(n() * level() / q()) - d1.clone()) / p.clone();
        let d3 = level() * (n() - R::of(1.0)) / (q() * q()) - d2.clone();
        Self { p, d1, d2, d3 }
    }
}

fn hermite<R: Real>(differences: &Differences<R>) -> Forms<R> {
    let Differences { p, d1, d2, d3 } = differences.clone();
    let k1 = -(d1 - p.clone() * d2.clone() + p.clone() * p.clone() * d3.clone());
    of_centred(k1, d2 - R::of(2.0) * p * d3.clone(), -d3, R::of(0.0))
}

fn quadratic<R: Real>(differences: &Differences<R>) -> Forms<R> {
    let Differences { p, d1, d2, .. } = differences.clone();
    let k1 = -(d1 - p * d2.clone());
    let d = R::of(1.0) - k1.clone() + d2.clone();
    of_centred(k1, d2, R::of(0.0), d)
}

impl<R: Clone> Clone for Differences<R> {
    fn clone(&self) -> Self {
        Self { p: self.p.clone(), d1: self.d1.clone(), d2: self.d2.clone(), d3: self.d3.clone() }
    }
}

/// e1 = (Q/r − 1)/(r − 1), e2 = (G/l − 1)/(l − 1), a = (e1 − e2)/(r − l), b = e1 − a(1 + r).
fn three_point<R: Real>(at: &At<R>, way: Way) -> Forms<R> {
    let (r, l, n) = (|| at.q.clone(), || at.l.clone(), || at.n.clone());
    // level/x − 1 = level^(1 − 1/n) − 1.
    let excess = |level: &R, x: &R, log: &R| match way {
        Way::Stable => (log.clone() * (n() - R::of(1.0)) / n()).exp_m1(),
        _ => level.clone() / x.clone() - R::of(1.0),
    };
    let quotient = |level: &R, x: &R, log: &R| -(excess(level, x, log) / at.complement(way, x, log));
    let e1 = quotient(&at.level, &at.q, &at.log_level);
    let e2 = quotient(&at.low, &at.l, &at.log_low);
    let between = match way {
        Way::Stable => l() * ((at.log_level.clone() - at.log_low.clone()) / n()).exp_m1(),
        _ => r() - l(),
    };
    let a = (e1.clone() - e2) / between;
    let b = e1 - a.clone() * (R::of(1.0) + r());
    let c = R::of(1.0) - a.clone() - b.clone();
    of_power(a, b, c)
}

/// k = √(Q/r), u = (1 − k)/(1 − r), v = (r − k)/(1 − r), f = x(ux − v)².
fn tangent<R: Real>(at: &At<R>, way: Way) -> Forms<R> {
    let (p, r, n) = (at.p(way), at.q.clone(), || at.n.clone());
    let k = (at.level.clone() / r.clone()).sqrt();
    let (u, v) = match way {
        Way::Stable => {
            let per_n = at.log_level.clone() / (R::of(2.0) * n());
            let u = -(per_n.clone() * (n() - R::of(1.0))).exp_m1();
            (u, k * (per_n * (R::of(3.0) - n())).exp_m1())
        }
        _ => (R::of(1.0) - k.clone(), r - k),
    };
    let (u, v) = (u / p.clone(), v / p);
    let (a, c) = (u.clone() * u.clone(), v.clone() * v.clone());
    of_power(a, -(R::of(2.0) * u * v), c)
}

/// A = nq/Q, B = (n − 1)/Q; A − B = (1 − n·p)/Q.
fn rational<R: Real>(at: &At<R>, way: Way) -> Forms<R> {
    let (n, level) = (|| at.n.clone(), || at.level.clone());
    let a = n() * at.q.clone() / level();
    let b = (n() - R::of(1.0)) / level();
    let difference = match way {
        Way::Stable => (R::of(1.0) - n() * at.p(way)) / level(),
        _ => a.clone() - b.clone(),
    };
    Forms { power: vec![a, b], centred: vec![difference] }
}
