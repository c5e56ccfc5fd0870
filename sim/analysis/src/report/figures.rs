//! The figures of a report: errors against n (the paper's Fig. 1), and curves (its Fig. 3).

use hw_model::design::Design;
use hw_model::fit::{Method, fit};
use hw_model::format::Overflow;
use hw_model::highlight::{phong, schlick};
use hw_model::quantise::{real, x_bits};

use crate::error_report::{ErrorReport, ErrorRow};
use plot::{Chart, Curve, ReferenceLine, Scale, angle_grid, error_versus_exponent, intensity_versus_angle};

/// Points of a curve.
const CURVE_POINTS: usize = 400;

/// What rounding to [`percent`] leaves is at least this.
const LEAST_PERCENT: f64 = 1e-8;

/// A fraction as the plots and the summary write it: 0.67 %, not 0.6700000000000001 %.
fn percent(fraction: f64) -> f64 {
    (fraction * 1e10).round() / 1e8
}

fn against_n(report: &ErrorReport, name: &str, of: fn(&ErrorRow) -> f64) -> Curve {
    let points = report.rows.iter().map(|row| (row.n, percent(of(row)))).collect();
    Curve::new(name, points)
}

/// Colour and stroke of what stands in several figures, and of what does not.
mod style {
    pub(super) const TOTAL: usize = 0;
    pub(super) const METHOD: usize = 1;
    pub(super) const METHOD_RELATIVE: usize = 2;
    pub(super) const COEFFICIENTS: usize = 3;
    pub(super) const DATA_PATH: usize = 4;
    pub(super) const TOTAL_EVERYWHERE: usize = 5;
    pub(super) const INPUT: usize = 6;
}

/// Absolute and relative error on the epicentre, with the bound.
#[must_use]
pub(super) fn epicentre(report: &ErrorReport) -> Chart {
    let curves = vec![
        against_n(report, "total, absolute", |row| row.total_abs).styled(style::TOTAL),
        against_n(report, "method alone, absolute", |row| row.approximation_abs).styled(style::METHOD),
        against_n(report, "method alone, relative", |row| row.approximation_rel).styled(style::METHOD_RELATIVE),
    ];
    let title = format!("Error on the epicentre, {}", report.configuration);
    error_versus_exponent(title, Scale::Linear, curves, vec![bound(report)])
}

/// The parts of the error and the total on all of [0, 1].
#[must_use]
pub(super) fn full_range(report: &ErrorReport) -> Chart {
    let curves = vec![
        against_n(report, "total on the epicentre", |row| row.total_abs).styled(style::TOTAL),
        against_n(report, "total on all of [0, 1]", |row| row.full_range_abs).styled(style::TOTAL_EVERYWHERE),
        against_n(report, "data path", |row| row.datapath_abs).styled(style::DATA_PATH),
        against_n(report, "ROM coefficients", |row| row.coefficient_abs).styled(style::COEFFICIENTS),
        against_n(report, "input quantisation", |row| row.input_abs).styled(style::INPUT),
    ];
    // A part that is nowhere to be seen (no ROM coefficient is rounded for schlick) has no curve.
    let seen = |curve: &Curve| curve.points.iter().any(|&(_, error)| error >= LEAST_PERCENT);
    let curves = curves.into_iter().filter(seen).collect();
    let title = format!("The parts of the error, {}", report.configuration);
    error_versus_exponent(title, Scale::Log, curves, vec![bound(report)])
}

fn bound(report: &ErrorReport) -> ReferenceLine {
    let bound = percent(report.bound);
    ReferenceLine::new(bound, format!("bound {bound} %"))
}

/// Phong, Schlick, the paper's g and the hardware's output against the angle, for one exponent of the ROM.
#[must_use]
pub(super) fn curves(design: &Design, exponent: f64) -> Chart {
    let grid = angle_grid(exponent, CURVE_POINTS);
    let curve = |name: &str, value: &dyn Fn(f64) -> f64| {
        Curve::new(name, grid.iter().map(|&(degrees, x)| (degrees, value(x))).collect())
    };
    let levels = design.config().levels().unwrap_or_default();
    let mut curves = vec![curve("Phong", &|x| phong(exponent, x)), curve("Schlick", &|x| schlick(exponent, x))];
    if let Ok(fit) = fit(Method::Rational, exponent, levels) {
        // Above q it is not meant, and for small Q it has a pole there.
        let points = grid
            .iter()
            .filter(|(_, x)| 1.0 - x >= fit.epicentre.s)
            .map(|&(degrees, x)| (degrees, fit.value(x)))
            .collect();
        curves.push(Curve::new("tail of [Rom], below Q", points));
    }
    curves.push(curve(&design.config().name, &|x| hardware(design, exponent, x)));
    let title = format!("Highlight for n = {exponent}, {}", design.config().name);
    intensity_versus_angle(title, curves)
}

fn hardware(design: &Design, exponent: f64, x: f64) -> f64 {
    let config = design.config();
    // x is a cosine in [0, 1], which saturates at worst.
    let bits = x_bits(x, config.input, Overflow::Saturate).unwrap_or(0);
    let address = design.rom().address_of(exponent);
    real(design.datapath().evaluate(address, bits).intensity, config.output)
}
