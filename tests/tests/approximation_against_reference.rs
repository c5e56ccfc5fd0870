//! The measured error maxima against 20 digits from 60-digit arithmetic.

use analysis::approximation::{Extent, Peak, approximation};
use blysk_tests::reference::{self, Row};
use hw_model::fit::{Fit, Levels, Method, fit};

/// Relative: ten significant digits are promised.
const DIGITS: f64 = 1e-10;

/// Absolute: where the method is x^n itself, what is left is the noise of evaluating it.
const NOISE: f64 = 1e-15;

/// Relative, of the place in s.
const PLACE: f64 = 1e-6;

fn fit_of(row: &Row) -> Fit {
    let method: Method = row.method.parse().expect("the table names methods");
    fit(method, row.exponent, Levels::default()).expect("n >= 1")
}

/// Compares one cell, if the row has it; returns how many comparisons that was.
fn compare(row: &Row, column: &str, found: Peak, complaints: &mut Vec<String>) -> usize {
    let Some(wanted) = row.value(column) else {
        return 0;
    };
    let error = (found.error - wanted).abs();
    if error.is_nan() || error > (DIGITS * wanted).max(NOISE) {
        let (method, n) = (&row.method, row.exponent);
        complaints.push(format!("{method} n = {n}: {column} = {:e}, wanted {wanted:e}", found.error));
    }
    1
}

#[test]
fn every_maximum_has_ten_digits() {
    let mut compared = 0;
    let mut complaints = Vec::new();
    for row in reference::rows() {
        let fit = fit_of(&row);
        let measure = |region| approximation(&fit, row.exponent, region);
        let epicentre = measure(Extent::epicentre(&fit));
        let relative = epicentre.relative.expect("the epicentre stays above x = 0");
        for (column, found) in [
            ("epi_abs", epicentre.absolute),
            ("epi_rel", relative),
            ("tail_abs", measure(Extent::tail(&fit)).absolute),
            ("full_abs", measure(Extent::WHOLE).absolute),
        ] {
            compared += compare(&row, column, found, &mut complaints);
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
    // Two columns for the four cubics and Schlick, the tail for two, the whole for one.
    assert_eq!(compared, 30 * (2 * 5 + 2 + 1), "maxima compared");
}

#[test]
fn every_maximum_is_where_it_should_be() {
    let mut compared = 0;
    for row in reference::rows() {
        let Some(x) = row.value("epi_abs_x") else {
            continue;
        };
        let fit = fit_of(&row);
        let found = approximation(&fit, row.exponent, Extent::epicentre(&fit)).absolute;
        let (s, error) = (1.0 - x, (found.s / (1.0 - x) - 1.0).abs());
        let (method, n) = (&row.method, row.exponent);
        assert!(error <= PLACE, "{method} n = {n}: at s = {:e}, wanted {s:e}", found.s);
        compared += 1;
    }
    // 150 rows with an epicentre, less eleven in which the method is x^n itself.
    assert_eq!(compared, 139, "places compared");
}

/// The two figures that the paper is quoted for, as they are printed.
#[test]
fn the_printed_figures() {
    for (n, printed) in [(64.0, "0.506510790"), (256.0, "0.542237003")] {
        let fit = fit(Method::Hermite, n, Levels::default()).unwrap();
        let found = approximation(&fit, n, Extent::epicentre(&fit)).absolute;
        assert_eq!(format!("{:.9}", 100.0 * found.error), printed, "n = {n}");
    }
}
