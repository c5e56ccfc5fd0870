//! Every coefficient of every fit against 32 digits that share no code with it.

use blysk_tests::reference::{self, Row};
use hw_model::fit::{Curve, Fit, Levels, Method, fit};

/// Relative. The fits round once (1.1e-16); 1/18 and exponents such as 1.1 are themselves f64
/// roundings of what the table was made for, which a coefficient of size n − 1 shows tenfold.
const TOLERANCE: f64 = 2e-15;

/// Four methods with seven coefficients each, two with two.
const COEFFICIENTS: usize = 30 * (4 * 7 + 2 * 2);

fn coefficients(fit: &Fit) -> Vec<(&'static str, f64)> {
    match &fit.curve {
        Curve::Cubic(cubic) => vec![
            ("a", cubic.power.a),
            ("b", cubic.power.b),
            ("c", cubic.power.c),
            ("d", cubic.power.d),
            ("k1", cubic.centred.k1),
            ("k2", cubic.centred.k2),
            ("k3", cubic.centred.k3),
        ],
        Curve::Rational(rational) => vec![("a", rational.a), ("b", rational.b)],
        Curve::Composite { .. } => panic!("the table has no composite"),
    }
}

/// The complaint about one coefficient, if there is one. Where the table has zero, zero is demanded.
fn complaint(row: &Row, name: &str, got: f64) -> Option<String> {
    let wanted = row.value(name).expect("every coefficient has its cell");
    let error = if wanted == 0.0 { got.abs() } else { (got / wanted - 1.0).abs() };
    let allowed = if wanted == 0.0 { 0.0 } else { TOLERANCE };
    (error.is_nan() || error > allowed).then(|| {
        let (method, n) = (&row.method, row.exponent);
        format!("{method} n = {n}: {name} = {got:e}, wanted {wanted:e}, off by {error:e}")
    })
}

#[test]
fn every_coefficient_has_its_digits() {
    let mut compared = 0;
    let mut complaints = Vec::new();
    for row in reference::rows() {
        let method: Method = row.method.parse().expect("the table names methods");
        let fit = fit(method, row.exponent, Levels::default()).expect("n >= 1");
        for (name, got) in coefficients(&fit) {
            compared += 1;
            complaints.extend(complaint(&row, name, got));
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
    assert_eq!(compared, COEFFICIENTS, "coefficients compared");
}

/// The denominator at x = 1, which the table does not hold, from A and B where they still tell it.
#[test]
fn the_denominator_at_one_is_a_minus_b() {
    let mut compared = 0;
    for row in reference::rows().iter().filter(|row| row.exponent <= 1e4) {
        let method: Method = row.method.parse().expect("the table names methods");
        let fit = fit(method, row.exponent, Levels::default()).expect("n >= 1");
        if let Curve::Rational(rational) = fit.curve {
            let difference = row.value("a").unwrap() - row.value("b").unwrap();
            let error = (rational.at_one - difference).abs();
            assert!(error <= 1e-15 * row.exponent, "{method} n = {}: {error:e}", row.exponent);
            compared += 1;
        }
    }
    assert_eq!(compared, 2 * 28);
}
