//! Each method's conditions, asked of the coefficients that came out.

use super::*;
use crate::exponents::MAX_EXPONENT;
use crate::highlight::Cubic;
use crate::highlight::phong_at_s;
use proptest::prelude::*;

/// n from 1 to 10¹², about as many in each decade.
fn exponents() -> impl Strategy<Value = f64> {
    (0.0_f64..12.0).prop_map(core_math::exp10)
}

fn levels() -> impl Strategy<Value = Levels> {
    (0.02_f64..0.98, 0.01_f64..0.98).prop_map(|(q, part)| Levels::new(q, q * part).unwrap())
}

fn cubic(method: Method, exponent: f64, levels: Levels) -> (Fit, Cubic) {
    let fit = fit(method, exponent, levels).unwrap();
    (fit, *fit.cubic().unwrap())
}

/// The slope of x^n at the edge of the epicentre, against s.
fn edge_slope(exponent: f64, levels: Levels, fit: &Fit) -> f64 {
    -exponent * levels.q() / fit.epicentre.x
}

fn close(got: f64, wanted: f64, tolerance: f64) -> Result<(), TestCaseError> {
    prop_assert!((got - wanted).abs() <= tolerance, "{got:e} is not {wanted:e} within {tolerance:e}");
    Ok(())
}

/// What rounding k1, k2, k3 can move a value or slope by, at s up to `s`.
fn rounding(cubic: &Cubic, s: f64) -> f64 {
    let k = cubic.centred;
    let (t1, t2, t3) = (k.k1 * s, k.k2 * s * s, k.k3 * s * s * s);
    8.0 * f64::EPSILON * (1.0 + t1.abs() + t2.abs() + t3.abs())
}

proptest! {
    #[test]
    fn the_edge_is_on_the_reference(n in exponents(), level in 1e-10_f64..1.0) {
        let edge = crossing(n, level).unwrap();
        // Rounding s moves x^n by a part in n·s/x of an ulp: much, where the edge is close to x = 0.
        let tolerance = f64::EPSILON * (4.0 + n * edge.s / edge.x);
        close(phong_at_s(n, edge.s), level, tolerance * level)?;
        close(edge.x + edge.s, 1.0, f64::EPSILON)?;
    }

    #[test]
    fn value_and_slope_agree_at_the_edge(n in exponents(), levels in levels()) {
        for method in [Method::Hermite, Method::Quadratic] {
            let (fit, cubic) = cubic(method, n, levels);
            let p = fit.epicentre.s;
            let tolerance = rounding(&cubic, p);
            prop_assert_eq!(fit.value_at_s(0.0), 1.0);
            close(fit.value_at_s(p), levels.q(), tolerance)?;
            let slope = edge_slope(n, levels, &fit);
            close(fit.slope_at_s(p) / slope, 1.0, 4.0 * tolerance / (p * slope).abs())?;
        }
    }

    #[test]
    fn three_points_are_met(n in exponents(), levels in levels()) {
        let (fit, cubic) = cubic(Method::ThreePoint, n, levels);
        for level in [levels.q(), levels.g()] {
            let s = crossing(n, level).unwrap().s;
            close(fit.value_at_s(s), level, rounding(&cubic, s))?;
        }
    }

    #[test]
    fn the_tangent_touches_zero_at_its_minimum(n in exponents(), levels in levels()) {
        let (fit, cubic) = cubic(Method::Tangent, n, levels);
        close(fit.value_at_s(fit.epicentre.s), levels.q(), rounding(&cubic, fit.epicentre.s))?;
        if n > 3.5 {
            let s = cubic.centred.first_minimum().unwrap();
            prop_assert!((0.0..1.0).contains(&s), "m = 1 - {s} lies in (0, 1) for n > 3");
            close(fit.value_at_s(s), 0.0, rounding(&cubic, s))?;
        }
    }

    #[test]
    fn cubics_without_d_vanish_at_zero(n in exponents(), levels in levels()) {
        for method in [Method::Hermite, Method::ThreePoint, Method::Tangent] {
            let (_, cubic) = cubic(method, n, levels);
            let power = cubic.power;
            prop_assert_eq!(power.d, 0.0);
            prop_assert_eq!(power.a, cubic.centred.k3);
            let size = power.a.abs() + power.b.abs() + power.c.abs();
            close(power.a + power.b + power.c, 1.0, 4.0 * f64::EPSILON * size)?;
        }
    }

    #[test]
    fn the_tail_continues_value_and_slope(n in exponents(), levels in levels()) {
        let fit = fit(Method::Composite, n, levels).unwrap();
        let (p, tail) = (fit.epicentre.s, fit.rational().unwrap());
        // n·p cancels against 1 in the denominator, for small Q up to 50-fold.
        let tolerance = 1e-14 * (1.0 + n * p) / levels.q();
        close(tail.value_at_s(p), levels.q(), tolerance)?;
        let slope = edge_slope(n, levels, &fit);
        close(tail.slope_at_s(p) / slope, 1.0, 8.0 * tolerance)?;
        prop_assert_eq!(tail.value_at_s(1.0), 0.0);
        // Far down g is x/A, also where 1 − x is 1.
        close(fit.value(1e-30) * tail.a, 1e-30, 1e-14 * 1e-30 * (1.0 + n * p))?;
    }

    #[test]
    fn the_first_powers_are_reproduced(levels in levels(), s in 0.0_f64..=1.0) {
        for (method, n) in [
            (Method::Hermite, 1.0), (Method::Hermite, 2.0), (Method::Hermite, 3.0),
            (Method::ThreePoint, 1.0), (Method::ThreePoint, 2.0), (Method::ThreePoint, 3.0),
            (Method::Tangent, 1.0), (Method::Tangent, 3.0),
            (Method::Quadratic, 1.0), (Method::Quadratic, 2.0),
            (Method::Rational, 1.0), (Method::Composite, 2.0), (Method::Schlick, 1.0),
        ] {
            let fit = fit(method, n, levels).unwrap();
            if method != Method::Composite || s <= fit.epicentre.s {
                close(fit.value_at_s(s), phong_at_s(n, s), 1e-15)?;
            }
        }
    }
}

/// The exact monomials are the limit of their neighbours, so the special cases hide no jump.
#[test]
fn the_first_powers_are_limits() {
    let levels = Levels::default();
    for method in [Method::Hermite, Method::ThreePoint, Method::Tangent, Method::Quadratic] {
        for n in [1.0_f64, 2.0, 3.0] {
            let (_, at) = cubic(method, n, levels);
            let (_, above) = cubic(method, n.next_up(), levels);
            for (x, y) in [
                (at.centred.k1, above.centred.k1),
                (at.centred.k2, above.centred.k2),
                (at.centred.k3, above.centred.k3),
                (at.power.b, above.power.b),
                (at.power.c, above.power.c),
                (at.power.d, above.power.d),
            ] {
                assert!((x - y).abs() < 1e-14, "{method} at {n}: {x} against {y}");
            }
        }
    }
}

#[test]
fn what_has_no_fit_is_refused() {
    for n in [0.0, 0.999, -1.0, 1.1e15, f64::INFINITY, f64::NAN] {
        let refusal = fit(Method::Hermite, n, Levels::default()).unwrap_err();
        assert!(refusal.to_string().contains("from 1 to 1e15"), "{refusal}");
    }
    for level in [0.0, -0.5, 1.1, 1e-310, f64::NAN] {
        assert!(crossing(2.0, level).is_err(), "{level}");
    }
    assert_eq!(crossing(2.0, 1.0), Ok(Crossing { x: 1.0, s: 0.0 }));
}

#[test]
fn every_method_fits_the_greatest_exponent() {
    for method in Method::ALL {
        let fit = fit(method, MAX_EXPONENT, Levels::default()).unwrap();
        let half = fit.value_at_s(fit.epicentre.s);
        let wanted = match method {
            Method::Schlick => 0.590_616_1,
            Method::Minimax => 0.499_937_0,
            _ => 0.5,
        };
        assert!((half - wanted).abs() < 1e-7, "{method}: {half}");
    }
}
