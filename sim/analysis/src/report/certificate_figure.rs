//! The plot of a certificate: proved bounds of the error against the exponent.

use bounds::certify::certificate::Claim;
use bounds::certify::claim::{ExponentClaim, Stretch};
use plot::{Chart, Curve, Scale, error_versus_exponent};

/// The upper ends of the enclosures of the absolute error, in per cent, against n. None for a claim about every n at
/// once, and where every error is 0.
#[must_use]
pub fn errors(claim: &Claim) -> Option<Chart> {
    let (title, curves) = match claim {
        Claim::Exponents(claims) => {
            ("Proved bounds of the methods' absolute error".to_owned(), of_methods(&claims.claims))
        }
        Claim::EveryExponent(_) => return None,
        Claim::Hardware(claim) => {
            let against = |name: &str, of: fn(&_) -> f64| {
                Curve::new(name, claim.rows.iter().map(|row| (row.n, 100.0 * of(row))).collect())
            };
            let curves = vec![
                against("epicentre", |row| row.epicentre.upper),
                against("all of [0, 1]", |row| row.full_range.upper),
            ];
            (format!("Proved bounds of the error, {}", claim.configuration.name), curves)
        }
    };
    let mut chart = error_versus_exponent(title, Scale::Log, curves, Vec::new());
    chart.series.retain(|series| !series.points.is_empty());
    (!chart.series.is_empty()).then_some(chart)
}

/// A curve for each method and region, in the order in which they are claimed.
fn of_methods(claims: &[ExponentClaim]) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for claim in claims {
        let region = if claim.region == Stretch::Epicentre { "" } else { ", tail" };
        let name = format!("{}{region}", claim.method);
        let point = (claim.n, 100.0 * claim.absolute.upper());
        match curves.iter_mut().find(|curve| curve.name == name) {
            Some(curve) => curve.points.push(point),
            None => curves.push(Curve::new(name, vec![point])),
        }
    }
    curves
}
