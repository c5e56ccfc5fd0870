//! What \[Rom\] says of the error of its cubic.

use hw_model::fit::{Levels, Method, fit};

use super::claim::{Claim, ClaimsError};
use super::comparison::{Comparison, Sense};
use super::proof::{self, Enclosed};
use crate::approximation::{ApproximationError, Extent, approximation};

/// An error below this is that of evaluating in f64: for n = 1, 2 and 3 the cubic is x^n itself.
const NOISE: f64 = 1e-14;

/// The error of a method on the epicentre.
fn on_epicentre(method: Method, n: f64) -> Result<ApproximationError, ClaimsError> {
    let fit = fit(method, n, Levels::default())?;
    Ok(approximation(&fit, n, Extent::epicentre(&fit)))
}

fn absolute(n: f64) -> Result<f64, ClaimsError> {
    Ok(on_epicentre(Method::Hermite, n)?.absolute.error)
}

fn relative(n: f64) -> Result<f64, ClaimsError> {
    // The epicentre never reaches x = 0.
    Ok(on_epicentre(Method::Hermite, n)?.relative.map_or(f64::INFINITY, |peak| peak.error))
}

/// How many times the error of the cubic goes into another.
fn times(other: f64, n: f64) -> Result<f64, ClaimsError> {
    let cubic = absolute(n)?;
    Ok(if cubic < NOISE { f64::INFINITY } else { other / cubic })
}

/// The relative error in per cent between two proved numbers.
fn relative_enclosure(n: f64) -> Result<Enclosed, ClaimsError> {
    // An epicentre always has a relative error.
    let bounds = proof::epicentre(Method::Hermite, n)?.relative;
    let found = bounds.as_ref().map_or((0.0, f64::INFINITY), |bounds| (bounds.lower(), bounds.upper()));
    Ok(Enclosed { lower: 100.0 * found.0, upper: 100.0 * found.1 })
}

/// How many times the cubic's error goes into Schlick's, between two proved numbers.
fn schlick_enclosure(n: f64) -> Result<Enclosed, ClaimsError> {
    let schlick = proof::epicentre(Method::Schlick, n)?.absolute;
    let cubic = proof::epicentre(Method::Hermite, n)?.absolute;
    Ok(Enclosed { lower: schlick.lower() / cubic.upper(), upper: schlick.upper() / cubic.lower() })
}

pub(super) fn claims() -> Result<[Claim; 4], ClaimsError> {
    let (source, sentence) = ("Fig. 1 and the sentence before it", "the sentence after Fig. 1");
    let absolute_error = Comparison {
        id: "absolute-error",
        claim: "The error of the cubic does not exceed 0.67 % on the epicentre (Fig. 1: absolute error)",
        source,
        what: "greatest absolute error on the epicentre",
        unit: "%",
        limit: 0.67,
        sense: Sense::AtMost,
        value: &|n| Ok(100.0 * absolute(n)?),
    };
    let relative_error = Comparison {
        id: "relative-error",
        claim: "The same, read as a relative error",
        source,
        what: "greatest relative error on the epicentre",
        unit: "%",
        limit: 0.67,
        sense: Sense::AtMost,
        value: &|n| Ok(100.0 * relative(n)?),
    };
    let schlick_epicentre = Comparison {
        id: "schlick-epicentre",
        claim: "The error is more than 17 times less than Schlick's (epicentre against epicentre)",
        source: sentence,
        what: "Schlick's greatest error on the epicentre over the cubic's",
        unit: "times",
        limit: 17.0,
        sense: Sense::AtLeast,
        value: &|n| times(on_epicentre(Method::Schlick, n)?.absolute.error, n),
    };
    let schlick_whole = Comparison {
        id: "schlick-whole-range",
        claim: "The same, against Schlick's error on all of [0, 1]",
        source: sentence,
        what: "Schlick's greatest error on [0, 1] over the cubic's on the epicentre",
        unit: "times",
        limit: 17.0,
        sense: Sense::AtLeast,
        value: &|n| {
            let schlick = fit(Method::Schlick, n, Levels::default())?;
            times(approximation(&schlick, n, Extent::WHOLE).absolute.error, n)
        },
    };
    Ok([
        proof::for_every_exponent(absolute_error.judged()?, absolute_error.limit)?,
        proof::at_the_boundary(relative_error.judged()?, &relative_error, relative_enclosure)?,
        proof::at_the_boundary(schlick_epicentre.judged()?, &schlick_epicentre, schlick_enclosure)?,
        schlick_whole.judged()?,
    ])
}
