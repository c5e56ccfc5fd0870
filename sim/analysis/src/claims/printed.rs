//! The formulas of \[Rom\] as they are printed, and as they must be meant.
//!
//! A formula is put into the equation it has to satisfy, for each exponent of [`EXPONENTS`]. What is
//! left over is either what f64 leaves, below [`TOLERANCE`], or a misprint. None of these is a formula
//! to compute with: they cancel, and the fits in hw-model do not.

use std::ops::RangeInclusive;

use hw_model::fit::{Crossing, Levels, Method, crossing, fit};
use hw_model::highlight::Power;

use super::claim::{Claim, ClaimsError, Evidence, Judgement, command};

/// Where formulas are tried. From n = 4 on no cubic is x^n itself, and up to 64 the printed formulas keep
/// ten digits.
const EXPONENTS: RangeInclusive<u32> = 4..=64;

/// The greatest remainder that f64 leaves: coefficients of size 64² with 16 digits.
const TOLERANCE: f64 = 1e-9;

/// How far a formula is from satisfying its equation, over all of [`EXPONENTS`].
#[derive(Debug, Clone, Copy, PartialEq)]
struct Remainders {
    least: f64,
    greatest: f64,
}

impl Remainders {
    fn over(remainder: impl Fn(f64) -> Result<f64, ClaimsError>) -> Result<Self, ClaimsError> {
        let mut found = Self { least: f64::INFINITY, greatest: 0.0 };
        for n in EXPONENTS {
            let remainder = remainder(n.into())?.abs();
            found.least = found.least.min(remainder);
            found.greatest = found.greatest.max(remainder);
        }
        Ok(found)
    }

    fn vanishes(self) -> bool {
        self.greatest <= TOLERANCE
    }

    /// The greatest where it should vanish; where it should not, how far off it is at the least.
    fn evidence(self, what: &str) -> Evidence {
        Evidence {
            what: what.to_owned(),
            n: None,
            value: if self.vanishes() { self.greatest } else { self.least },
            limit: Some(TOLERANCE),
            unit: "",
        }
    }
}

/// A formula as printed, and readings of it that would satisfy its equation.
struct Formula<'a> {
    id: &'static str,
    claim: &'static str,
    source: &'static str,
    /// What it is put into, for the evidence.
    equation: &'static str,
    printed: Remainders,
    /// What has to be read, with what is left over then; the last is the one that is meant.
    meant: &'a [(&'static str, Remainders)],
}

impl Formula<'_> {
    fn judged(&self) -> Claim {
        let meant = self.meant.last();
        let verdict = match meant {
            _ if self.printed.vanishes() => Judgement::Holds,
            Some((_, remainders)) if remainders.vanishes() => Judgement::Misprint,
            _ => Judgement::Fails,
        };
        let exponents = format!("n = {} to {}", EXPONENTS.start(), EXPONENTS.end());
        let computed = match (verdict, meant) {
            (Judgement::Holds, _) => {
                format!("off by {:.0e} at most for {exponents}", self.printed.greatest)
            }
            (_, Some((reading, remainders))) => format!(
                "as printed off by {:.2} or more for {exponents}; {reading}: {:.0e} at most",
                self.printed.least, remainders.greatest
            ),
            _ => format!("off by {:.2} or more for {exponents}", self.printed.least),
        };
        let mut evidence = vec![self.printed.evidence(&format!("{}: as printed", self.equation))];
        evidence.extend(
            self.meant
                .iter()
                .map(|(reading, remainders)| remainders.evidence(&format!("{}: {reading}", self.equation))),
        );
        Claim {
            id: self.id,
            claim: self.claim,
            source: self.source,
            computed,
            holds_for: if verdict == Judgement::Holds { exponents } else { "-".to_owned() },
            fails_from: None,
            verdict,
            command: command(self.id),
            evidence,
        }
    }
}

/// The cubic of the fit, in power form, and where x^n = Q.
fn fitted(method: Method, n: f64) -> Result<(Power, Crossing), ClaimsError> {
    fitted_at(method, n, Levels::default())
}

fn fitted_at(method: Method, n: f64, levels: Levels) -> Result<(Power, Crossing), ClaimsError> {
    let fit = fit(method, n, levels)?;
    let none = Power { a: 0.0, b: 0.0, c: 0.0, d: 0.0 };
    Ok((fit.cubic().map_or(none, |cubic| cubic.power), fit.epicentre))
}

/// The 8th and 9th formula: a and b for any Q.
fn hermite_printed(n: f64, level: f64, q: f64) -> [f64; 2] {
    let below = q * q * (q - 1.0) * (q - 1.0);
    let power = level; // cos^n(t) = Q
    let a = n * power * (q - 1.0) - level * (2.0 * q - 1.0) + q * q;
    let b = n * power * (1.0 - q * q) + level * (3.0 * q * q - 1.0) - 2.0 * q * q * q;
    [a / below, b / below]
}

/// The 10th and 11th formula: a and b for Q = 1/2.
fn hermite_half_printed(n: f64, q: f64) -> [f64; 2] {
    let below = 2.0 * (q - 1.0) * (q - 1.0) * q * q;
    let a = (q - 1.0) * (2.0 * q + n) + 1.0;
    let b = -(q * q * (4.0 * q - 3.0) + n * (q * q - 1.0) + 1.0);
    [a / below, b / below]
}

/// The greater of the relative differences of a and b from those of the fit.
fn difference([a, b]: [f64; 2], power: Power) -> f64 {
    f64::max((a / power.a - 1.0).abs(), (b / power.b - 1.0).abs())
}

/// The formulas of the first cubic.
pub(super) fn hermite() -> Result<Vec<Claim>, ClaimsError> {
    let level = Levels::default().q();
    let value = Formula {
        id: "misprint-cosine",
        claim: "The second formula: a·cos³(t) + b·cos²(t) + c·(t) + d = Q",
        source: "2nd formula",
        equation: "left side - Q",
        printed: Remainders::over(|n| {
            let (Power { a, b, c, d }, at) = fitted(Method::Hermite, n)?;
            Ok(a * at.x.powi(3) + b * at.x * at.x + c * core_angle(at) + d - level)
        })?,
        meant: &[(
            "with c·cos(t)",
            Remainders::over(|n| {
                let (power, at) = fitted(Method::Hermite, n)?;
                Ok(power.value(at.x) - level)
            })?,
        )],
    };
    let any_level = Formula {
        id: "hermite-coefficients",
        claim: "a and b as printed solve the system, for any Q (tried: 0.3, 0.5, 0.8)",
        source: "8th and 9th formula",
        equation: "relative difference from the solution",
        // Any Q: three of them, and exponents half-way between the integers too.
        printed: Remainders::over(|n| {
            let mut greatest = 0.0_f64;
            for (level, n) in [(0.3, n), (0.5, n), (0.8, n), (0.3, n + 0.5), (0.8, n + 0.5)] {
                let levels = Levels::new(level, Levels::default().g())?;
                let (power, at) = fitted_at(Method::Hermite, n, levels)?;
                greatest = greatest.max(difference(hermite_printed(n, levels.q(), at.x), power));
            }
            Ok(greatest)
        })?,
        meant: &[],
    };
    let half = Formula {
        id: "hermite-half",
        claim: "a and b as printed solve the system, for Q = 0.5",
        source: "10th and 11th formula",
        equation: "relative difference from the solution",
        printed: Remainders::over(|n| {
            let (power, at) = fitted(Method::Hermite, n)?;
            Ok(difference(hermite_half_printed(n, at.x), power))
        })?,
        meant: &[],
    };
    Ok(vec![value.judged(), any_level.judged(), half.judged(), logarithm()])
}

/// t with cos t = q. From s = 1 − q, which keeps the digits: t = 2·asin(√(s/2)).
fn core_angle(at: Crossing) -> f64 {
    2.0 * (at.s / 2.0).sqrt().asin()
}

/// q = e^(−0.6931471/n) has q^n = e^(−0.6931471), whatever n.
fn logarithm() -> Claim {
    /// ln 2 in units of 10⁻⁷, as printed.
    const PRINTED: f64 = 6_931_471.0;
    /// A hundredth of the last bit of a 16-bit intensity.
    const LIMIT: f64 = 0.01 / 32_768.0;
    let off = ((-PRINTED / 1e7).exp() - Levels::default().q()).abs();
    Claim {
        id: "logarithm",
        claim: "q = e^(-0.6931471/n) is where cos^n = 0.5",
        source: "the line after the 11th formula",
        computed: format!("q^n is off by {off:.1e}, {:.4} of the last of 16 bits", off * 32_768.0),
        holds_for: "every n".to_owned(),
        fails_from: None,
        verdict: if off <= LIMIT { Judgement::Holds } else { Judgement::Fails },
        command: command("logarithm"),
        evidence: vec![Evidence { what: "|q^n - 0.5|".to_owned(), n: None, value: off, limit: Some(LIMIT), unit: "" }],
    }
}

/// The 13th to 15th formula, with r and l where x^n is Q and G. `power_of_l` is the l² printed in the
/// first term of c, or the l³ that belongs there.
fn three_point_printed(n: f64, r: f64, l: f64, power_of_l: i32) -> [f64; 3] {
    let (q, g) = (Levels::default().q(), Levels::default().g());
    let (r2, r3, l2, l3) = (r * r, r.powi(3), l * l, l.powi(3));
    let below = l3 * (1.0 - r2) + l2 * (r3 - 1.0) - r2 * (r - 1.0);
    let a = l2 * (q - 1.0) + g * (1.0 - r2) + r2 - q;
    let b = l3 * (q - 1.0) + g * (1.0 - r3) - q + r3;
    let c = l.powi(power_of_l) * (q - r2) + l2 * (r3 - r.powf(n)) + g * r2 * (1.0 - r);
    [a / below, b / below, c / below]
}

/// How far a cubic is from 1, Q and G at 1, r and l. `last` is the power of x that c stands at: 1 in the
/// printed system, 0 where c is a constant.
fn conditions([a, b, c]: [f64; 3], r: f64, l: f64, last: i32) -> f64 {
    let levels = Levels::default();
    [(1.0, 1.0), (r, levels.q()), (l, levels.g())]
        .into_iter()
        .map(|(x, value): (f64, f64)| (a * x.powi(3) + b * x * x + c * x.powi(last) - value).abs())
        .fold(0.0, f64::max)
}

/// The formulas of the cubic through three points.
pub(super) fn three_point() -> Result<[Claim; 1], ClaimsError> {
    let levels = Levels::default();
    let remainders = |sign: f64, power_of_l: i32, last: i32| {
        Remainders::over(|n| {
            let (r, l) = (crossing(n, levels.q())?.x, crossing(n, levels.g())?.x);
            let [a, b, c] = three_point_printed(n, r, l, power_of_l);
            Ok(conditions([a, sign * b, c], r, l, last))
        })
    };
    let formula = Formula {
        id: "three-point-coefficients",
        claim: "a, b and c as printed solve a + b + c = 1, f(r) = Q, f(l) = G with f = a·x³ + b·x² + c·x",
        source: "13th to 15th formula",
        equation: "greatest miss of the three points",
        printed: remainders(1.0, 2, 1)?,
        meant: &[
            ("-b for b and l³ for the first l² of c, in the same system", remainders(-1.0, 3, 1)?),
            ("-b for b and l³ for the first l² of c, in the system of a·x³ + b·x² + c", remainders(-1.0, 3, 0)?),
        ],
    };
    Ok([formula.judged()])
}

/// The formulas of the rational tail.
pub(super) fn rational() -> Result<[Claim; 2], ClaimsError> {
    let slope = |squared: fn(f64, f64, f64) -> f64| {
        Remainders::over(|n| {
            let q = crossing(n, Levels::default().q())?.x;
            let (a, b) = (2.0 * n * q, 2.0 * n - 2.0);
            let wanted = n * Levels::default().q() / q;
            let left = 1.0 / (a - b * q) + q * b / squared(a, b, q);
            Ok(left / wanted - 1.0)
        })
    };
    let derivative = Formula {
        id: "misprint-square",
        claim: "The derivative of the tail, with cos(t)·b / (a - b·cos²(t)) as its second term",
        source: "17th formula",
        equation: "slope over n·cos^(n-1)(t), less 1",
        printed: slope(|a, b, q| a - b * q * q)?,
        meant: &[("with (a - b·cos(t))²", slope(|a, b, q| (a - b * q) * (a - b * q))?)],
    };
    let coefficients = Formula {
        id: "tail-coefficients",
        claim: "a = 4n·cos^(n+1)(t) = 2n·0.5^(1/n) and b = 4n·cos^n(t) - 2 = 2n - 2 solve the system",
        source: "18th and 19th formula",
        equation: "relative difference from the solution",
        printed: Remainders::over(|n| {
            let fit = fit(Method::Rational, n, Levels::default())?;
            let q = fit.epicentre.x;
            let printed = [[4.0 * n * q.powf(n + 1.0), 4.0 * n * q.powf(n) - 2.0], [2.0 * n * q, 2.0 * n - 2.0]];
            Ok(fit.rational().map_or(f64::INFINITY, |solution| {
                let off = |[a, b]: [f64; 2]| f64::max((a / solution.a - 1.0).abs(), (b / solution.b - 1.0).abs());
                f64::max(off(printed[0]), off(printed[1]))
            }))
        })?,
        meant: &[],
    };
    Ok([derivative.judged(), coefficients.judged()])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdicts(claims: &[Claim]) -> Vec<(&str, Judgement)> {
        claims.iter().map(|claim| (claim.id, claim.verdict)).collect()
    }

    #[test]
    fn what_is_right_and_what_is_misprinted() {
        use Judgement::{Holds, Misprint};
        let expected = [
            ("misprint-cosine", Misprint),
            ("hermite-coefficients", Holds),
            ("hermite-half", Holds),
            ("logarithm", Holds),
        ];
        assert_eq!(verdicts(&hermite().unwrap()), expected);
        let three_point = three_point().unwrap();
        assert_eq!(verdicts(&three_point), [("three-point-coefficients", Misprint)]);
        let expected = [("misprint-square", Misprint), ("tail-coefficients", Holds)];
        assert_eq!(verdicts(&rational().unwrap()), expected);
    }

    /// Each of the three corrections is needed: without it the points are missed.
    #[test]
    fn the_three_point_formulas_are_wrong_in_just_this_way() {
        for n in EXPONENTS.map(f64::from) {
            let levels = Levels::default();
            let (r, l) = (crossing(n, levels.q()).unwrap().x, crossing(n, levels.g()).unwrap().x);
            for (sign, power_of_l, last) in
                [(1.0, 3, 0), (-1.0, 2, 0), (-1.0, 3, 1), (1.0, 2, 1), (1.0, 2, 0), (1.0, 3, 1), (-1.0, 2, 1)]
            {
                let [a, b, c] = three_point_printed(n, r, l, power_of_l);
                let off = conditions([a, sign * b, c], r, l, last);
                assert!(off > 0.01, "n = {n}, sign {sign}, l^{power_of_l}, x^{last}: {off}");
            }
            let [a, b, c] = three_point_printed(n, r, l, 3);
            assert!(conditions([a, -b, c], r, l, 0) < TOLERANCE);
            let (solution, _) = fitted(Method::ThreePoint, n).unwrap();
            assert!(conditions([solution.a, solution.b, solution.c], r, l, 1) < TOLERANCE);
        }
    }

    #[test]
    fn the_misprints_are_far_off_and_their_readings_are_not() {
        for claim in hermite().unwrap().into_iter().chain(three_point().unwrap()).chain(rational().unwrap()) {
            let off = claim.evidence[0].value;
            match claim.verdict {
                Judgement::Misprint => assert!(off > 0.01, "{}: {off}", claim.id),
                _ => assert!(off < 1e-6, "{}: {off}", claim.id),
            }
        }
    }
}
