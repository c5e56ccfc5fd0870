//! What \[Rom\] says of where the cubics are negative and how many extrema they have.

use hw_model::fit::{Levels, Method, fit};
use hw_model::highlight::Cubic;
use rayon::prelude::*;

use super::boundary::{GREATEST, examined};
use super::claim::{Claim, ClaimsError, Evidence, Judgement, command};

/// Steps of n in an interval of length 1 when fractional exponents are scanned.
const STEPS: u32 = 1 << 12;

/// The value of a cubic where it is lowest in (0, 1): at its one local minimum, or towards x = 0 where it
/// has none. The value at x = 0 is the constant term; the centred form would lose it for large n.
fn lowest_value(cubic: &Cubic) -> f64 {
    let minimum = cubic.centred.first_minimum().filter(|&s| s < 1.0);
    minimum.map_or(cubic.power.d, |s| cubic.centred.value_at_s(s))
}

/// The same in per cent.
fn percent(method: Method, levels: Levels, n: f64) -> Result<f64, ClaimsError> {
    Ok(fit(method, n, levels)?.cubic().map_or(0.0, |cubic| 100.0 * lowest_value(cubic)))
}

/// The exponent of the least value, and that value, the first where several are equal.
fn lowest(exponents: Vec<f64>, method: Method, levels: Levels) -> Result<(f64, f64), ClaimsError> {
    let all: Vec<(f64, f64)> =
        exponents.into_par_iter().map(|n| Ok((n, percent(method, levels, n)?))).collect::<Result<_, ClaimsError>>()?;
    Ok(all.into_iter().reduce(|low, next| if next.1 < low.1 { next } else { low }).unwrap_or((1.0, 0.0)))
}

fn integers() -> Vec<f64> {
    examined().into_iter().map(|n| n as f64).collect()
}

/// Fractional exponents strictly between `below` and `below` + 1.
fn between(below: u32) -> Vec<f64> {
    (1..STEPS).map(|i| f64::from(below) + f64::from(i) / f64::from(STEPS)).collect()
}

/// G = 1/k with the Q of the paper.
fn one_over(k: u32) -> Result<Levels, ClaimsError> {
    Ok(Levels::new(Levels::default().q(), 1.0 / f64::from(k))?)
}

/// No examined exponent from 3 on has a negative zone.
fn never_negative(k: u32) -> Result<bool, ClaimsError> {
    let exponents = integers().into_iter().filter(|&n| n >= 3.0).collect();
    Ok(lowest(exponents, Method::ThreePoint, one_over(k)?)?.1 >= 0.0)
}

fn minimum(what: String, n: f64, value: f64, limit: Option<f64>) -> Evidence {
    Evidence { what, n: Some(n), value, limit, unit: "%" }
}

pub(super) fn claims() -> Result<[Claim; 4], ClaimsError> {
    Ok([no_negative_zone()?, optimal()?, extrema()?, negative()?])
}

fn no_negative_zone() -> Result<Claim, ClaimsError> {
    let levels = Levels::default();
    let what = "value at the minimum of the three-point cubic";
    let (at_integer, integer) = lowest(integers(), Method::ThreePoint, levels)?;
    let (at_fraction, fraction) = lowest(between(2), Method::ThreePoint, levels)?;
    let greatest = GREATEST as f64;
    let last = percent(Method::ThreePoint, levels, greatest)?;
    let verdict = match (integer >= 0.0, fraction >= 0.0) {
        (true, true) => Judgement::Holds,
        (true, false) => Judgement::HoldsForIntegers,
        (false, _) => Judgement::Fails,
    };
    Ok(Claim {
        id: "negative-zone",
        claim: "With Q = 0.5 and G = 1/18 the function does not go below zero",
        source: "the paragraph after the 15th formula",
        computed: format!(
            "the value at its minimum is {integer:.3} % or more for integer n ({last:+.3} % at n = 10^9), but \
             {fraction:.3} % at n = {at_fraction:.3}"
        ),
        holds_for: match verdict {
            Judgement::Holds => "every n that was tried".to_owned(),
            Judgement::HoldsForIntegers => format!("every integer n; not n = {at_fraction:.3}"),
            _ => format!("not n = {at_integer}"),
        },
        fails_from: None,
        verdict,
        command: command("negative-zone"),
        evidence: vec![
            minimum(format!("{what}, lowest of the integer exponents"), at_integer, integer, Some(0.0)),
            minimum(what.to_owned(), greatest, last, Some(0.0)),
            minimum(format!("{what}, lowest between 2 and 3"), at_fraction, fraction, Some(0.0)),
        ],
    })
}

/// The greatest k with which G = 1/k leaves no negative zone, by bisection.
fn greatest_k() -> Result<u32, ClaimsError> {
    let (mut good, mut bad) = (3, 1000);
    while bad - good > 1 {
        let middle = good + (bad - good) / 2;
        if never_negative(middle)? {
            good = middle;
        } else {
            bad = middle;
        }
    }
    Ok(good)
}

fn optimal() -> Result<Claim, ClaimsError> {
    let (k, n) = (greatest_k()?, GREATEST as f64);
    let value = |k| percent(Method::ThreePoint, one_over(k)?, n);
    let (good, bad) = (value(k)?, value(k + 1)?);
    let what = |k| format!("value at the minimum of the three-point cubic with G = 1/{k}");
    Ok(Claim {
        id: "optimal-level",
        claim: "G = 1/18 is the best choice: the lowest level that needs no correction",
        source: "the paragraph after the 15th formula",
        computed: format!(
            "1/{k} is the least 1/k that leaves no negative zone for integer n >= 3: {good:+.3} % at n = 10^9, with \
             1/{} {bad:+.3} %",
            k + 1
        ),
        holds_for: "integer n >= 3".to_owned(),
        fails_from: None,
        verdict: if one_over(k)? == Levels::default() { Judgement::Holds } else { Judgement::Fails },
        command: command("optimal-level"),
        evidence: vec![minimum(what(k), n, good, Some(0.0)), minimum(what(k + 1), n, bad, Some(0.0))],
    })
}

/// The second maximum of a cubic strictly inside (0, 1), as (x, value): the other root of its slope. The
/// product of the roots is k1/(3·k3).
fn second_maximum(cubic: &Cubic) -> Option<(f64, f64)> {
    let k = &cubic.centred;
    let s = k.k1 / (3.0 * k.k3 * k.first_minimum()?);
    (0.0 < s && s < 1.0).then(|| (1.0 - s, cubic.power.value(1.0 - s)))
}

fn extrema() -> Result<Claim, ClaimsError> {
    let found: Vec<(u64, (f64, f64))> = examined()
        .into_iter()
        .map(|n| Ok((n, fit(Method::Hermite, n as f64, Levels::default())?)))
        .collect::<Result<Vec<_>, ClaimsError>>()?
        .into_iter()
        .filter_map(|(n, fit)| Some((n, second_maximum(fit.cubic()?)?)))
        .collect();
    let shown = [4, 64, GREATEST];
    let evidence: Vec<Evidence> = found
        .iter()
        .filter(|(n, _)| shown.contains(n))
        .flat_map(|&(n, (x, value))| {
            [("x of a second maximum", x), ("value there", value)].map(|(what, value)| Evidence {
                what: what.to_owned(),
                n: Some(n as f64),
                value,
                limit: None,
                unit: "",
            })
        })
        .collect();
    let times_square = |&(n, (_, value)): &(u64, (f64, f64))| value / (n as f64 * n as f64);
    let computed = match (found.first(), found.iter().find(|(n, _)| *n == 64), found.last()) {
        (Some((first, _)), Some(shown @ (n, (x, value))), Some(last)) => format!(
            "from n = {first} on there is a second maximum below the minimum: {value:.1} at x = {x:.3} for \
             n = {n}, which is {:.4} n^2, and {:.4} n^2 at n = 10^9; so the hardware needs a cut",
            times_square(shown),
            times_square(last)
        ),
        _ => "there is no second maximum".to_owned(),
    };
    Ok(Claim {
        id: "two-extrema",
        claim: "The cubic has two extrema, a maximum at 0 degrees and a minimum",
        source: "the paragraph on the fourth equation",
        computed,
        holds_for: "-".to_owned(),
        fails_from: None,
        verdict: if found.is_empty() { Judgement::Holds } else { Judgement::Fails },
        command: command("two-extrema"),
        evidence,
    })
}

fn negative() -> Result<Claim, ClaimsError> {
    let levels = Levels::default();
    let (at_integer, integer) = lowest(integers(), Method::Hermite, levels)?;
    let intervals: Vec<(u32, (f64, f64))> = (1..=8)
        .map(|below| Ok((below, lowest(between(below), Method::Hermite, levels)?)))
        .collect::<Result<_, ClaimsError>>()?;
    let negative: Vec<&(u32, (f64, f64))> = intervals.iter().filter(|(_, (_, value))| *value < 0.0).collect();
    let places: Vec<String> = negative
        .iter()
        .map(|(below, (n, value))| format!("between {below} and {} down to {value:.3} % at n = {n:.3}", below + 1))
        .collect();
    let what = "value at the minimum of the cubic";
    let mut evidence =
        vec![minimum(format!("{what}, lowest of the integer exponents"), at_integer, integer, Some(0.0))];
    evidence.extend(intervals.iter().map(|(below, (n, value))| {
        minimum(format!("{what}, lowest between {below} and {}", below + 1), *n, *value, Some(0.0))
    }));
    let holds = !negative.is_empty() || integer < 0.0;
    let integers = if integer >= 0.0 { "for no integer n" } else { "also for integer n" };
    Ok(Claim {
        id: "negative-cubic",
        claim: "The cubic is sometimes negative and must then be cut off",
        source: "the paragraph on the fourth equation",
        computed: format!("the first cubic (hermite): {integers}; {}", places.join("; ")),
        holds_for: negative
            .iter()
            .map(|(below, _)| format!("{below} < n < {}", below + 1))
            .collect::<Vec<_>>()
            .join(", "),
        fails_from: None,
        verdict: if holds { Judgement::Holds } else { Judgement::Fails },
        command: command("negative-cubic"),
        evidence,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_least_level_is_that_of_the_paper() {
        assert_eq!(greatest_k(), Ok(18));
    }

    proptest! {
        /// Nothing on [0, 1] lies below the minimum and the value at 0, and nothing beside a second
        /// maximum above it.
        #[test]
        fn nothing_is_less(n in 1.0_f64..200.0, x in 0.0_f64..=1.0, k in 3_u32..40) {
            let (hermite, three_point) = (one_over(18).unwrap(), one_over(k).unwrap());
            for (method, levels) in [(Method::Hermite, hermite), (Method::ThreePoint, three_point)] {
                let fit = fit(method, n, levels).unwrap();
                let cubic = fit.cubic().unwrap();
                let low = lowest_value(cubic).min(cubic.power.d);
                prop_assert!(cubic.power.value(x) >= low - 1e-8);
                if let Some((summit, value)) = second_maximum(cubic) {
                    prop_assert!(cubic.power.value(summit * 0.99) <= value + 1e-8);
                    prop_assert!(cubic.power.value(summit * 1.01) <= value + 1e-8);
                }
            }
        }
    }
}
