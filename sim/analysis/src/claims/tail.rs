//! What \[Rom\] says of its rational tail.

use hw_model::fit::{Levels, Method, crossing, fit};

use super::boundary::GREATEST;
use super::claim::{Claim, ClaimsError, Evidence, Judgement, command};
use super::comparison::{Comparison, Sense};
use crate::approximation::{Extent, approximation};

/// A range of the tail with what is claimed for it.
struct Range {
    id: &'static str,
    claim: &'static str,
    high: f64,
    low: f64,
    percent: f64,
}

const RANGES: [Range; 3] = [
    Range {
        id: "tail-1-percent",
        claim: "The relative error of the tail is at most 1 % for 0.42 < x^n < 0.5",
        high: 0.5,
        low: 0.42,
        percent: 1.0,
    },
    Range {
        id: "tail-3-percent",
        claim: "It is at most 3 % for 0.37 < x^n < 0.42",
        high: 0.42,
        low: 0.37,
        percent: 3.0,
    },
    Range {
        id: "tail-10-percent",
        claim: "It is at most 10 % for 0.27 < x^n < 0.37",
        high: 0.37,
        low: 0.27,
        percent: 10.0,
    },
];

pub(super) fn claims() -> Result<Vec<Claim>, ClaimsError> {
    let mut claims = RANGES.iter().map(range).collect::<Result<Vec<_>, _>>()?;
    claims.push(all_ranges()?);
    claims.push(composite()?);
    Ok(claims)
}

fn range(range: &Range) -> Result<Claim, ClaimsError> {
    let comparison = Comparison {
        id: range.id,
        claim: range.claim,
        source: "the sentence before Fig. 3",
        what: "greatest relative error of the tail in that range",
        unit: "%",
        limit: range.percent,
        sense: Sense::AtMost,
        value: &|n| Ok(100.0 * relative_between(n, range.high, range.low)?),
    };
    comparison.judged()
}

/// The sentence as a whole: it holds where all of its parts do.
fn all_ranges() -> Result<Claim, ClaimsError> {
    let comparison = Comparison {
        id: "tail-ranges",
        claim: "All three ranges of the tail together",
        source: "the sentence before Fig. 3",
        what: "relative error over what is claimed, in the worst of the three ranges",
        unit: "times",
        limit: 1.0,
        sense: Sense::AtMost,
        value: &|n| {
            RANGES.iter().try_fold(0.0, |worst: f64, range| {
                let error = relative_between(n, range.high, range.low)?;
                Ok(worst.max(100.0 * error / range.percent))
            })
        },
    };
    comparison.judged()
}

/// The greatest relative error of the rational tail where low ≤ x^n ≤ high.
fn relative_between(n: f64, high: f64, low: f64) -> Result<f64, ClaimsError> {
    let tail = fit(Method::Rational, n, Levels::default())?;
    let region = Extent { s_low: crossing(n, high)?.s, s_high: crossing(n, low)?.s };
    // Neither end is x = 0.
    Ok(approximation(&tail, n, region).relative.map_or(f64::INFINITY, |peak| peak.error))
}

/// "Realistically" is not a number; what it amounts to stands beside Schlick's.
fn composite() -> Result<Claim, ClaimsError> {
    let n = GREATEST as f64;
    let whole = |method| -> Result<f64, ClaimsError> {
        let fit = fit(method, n, Levels::default())?;
        Ok(100.0 * approximation(&fit, n, Extent::WHOLE).absolute.error)
    };
    let (composite, schlick) = (whole(Method::Composite)?, whole(Method::Schlick)?);
    let evidence = |what: &str, value| Evidence { what: what.to_owned(), n: Some(n), value, limit: None, unit: "%" };
    Ok(Claim {
        id: "composite",
        claim: "The function reproduces both the epicentre and the zone where the highlight fades realistically",
        source: "conclusions",
        computed: format!(
            "greatest absolute error on [0, 1] {composite:.3} % at n = 10^9; Schlick's is {schlick:.3} %"
        ),
        holds_for: "-".to_owned(),
        fails_from: None,
        verdict: Judgement::NoFigure,
        command: command("composite"),
        evidence: vec![
            evidence("composite, greatest absolute error on [0, 1]", composite),
            evidence("Schlick, greatest absolute error on [0, 1]", schlick),
        ],
    })
}
