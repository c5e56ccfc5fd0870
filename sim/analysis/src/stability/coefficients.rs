//! How many of the 16 digits of f64 each way of computing coefficients loses, for n from 1 to 10¹⁵.
//!
//! The exact coefficients are those of the conditions, in numbers of 384 bits; a test puts them back
//! into the conditions. They share no code with `hw_model::fit`, which is one of the ways that are
//! measured. A digit is lost where the relative error is ten times what one rounding costs, 2⁻⁵³.
//!
//! A coefficient that vanishes at an n has no relative error there: as n comes near, each way
//! loses digits of it that the polynomial does not miss. So the loss is stated twice, of the worst
//! coefficient against itself, and of all of them against the greatest.

use hw_model::exponents::MAX_EXPONENT;
use hw_model::fit::{Curve, Fit, FitError, Levels, Method, fit};
use rayon::prelude::*;
use serde::Serialize;

use super::expressions::{At, Forms, Way, forms};
use super::wide::{Real, Wide};

pub use super::expressions::Way as CoefficientWay;

/// The decimal digits of an f64, log10 2⁵³: what can be lost.
pub const ALL_DIGITS: f64 = 53.0 * std::f64::consts::LOG10_2;
/// Half of the decimal digits of an f64.
pub const HALF_DIGITS: f64 = 0.5 * ALL_DIGITS;

/// Exponents in a decade; n is found to one step of this, 12 %.
pub const STEPS_PER_DECADE: u32 = 20;
/// Distances from an n where a coefficient vanishes, in a decade.
const DISTANCES_PER_DECADE: i32 = 2;
/// From here on no coefficient vanishes any more.
const PAST_ZEROS: f64 = 4.0;

/// The methods whose coefficients `expressions.rs` writes out.
pub fn methods() -> impl Iterator<Item = Method> {
    let at = At::<f64>::new(2.0, Levels::default());
    Method::ALL.into_iter().filter(move |&method| forms(method, Way::Naive, &at).is_some())
}

/// The set of coefficients whose digits are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Set {
    /// a, b, c, d; of `rational` A and B.
    Power,
    /// k1, k2, k3; of `rational` A − B.
    Centred,
}

impl Set {
    /// The names of the coefficients.
    const fn names(self, method: Method) -> &'static [&'static str] {
        match (self, method) {
            (Self::Power, Method::Rational) => &["A", "B"],
            (Self::Centred, Method::Rational) => &["A-B"],
            (Self::Power, _) => &["a", "b", "c", "d"],
            (Self::Centred, _) => &["k1", "k2", "k3"],
        }
    }

    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Power => "power",
            Self::Centred => "centred",
        }
    }
}

/// What one way loses at one exponent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Loss {
    /// The method whose coefficients are computed.
    pub method: Method,
    /// The way in which they are computed.
    pub way: Way,
    /// The set of coefficients that is counted.
    pub form: Set,
    /// The exponent, 1 or more.
    pub n: f64,
    /// Digits lost by the worst coefficient, against itself: 0 to [`ALL_DIGITS`].
    pub digits_lost: f64,
    /// Which coefficient that is.
    pub worst: &'static str,
    /// Digits lost by the worst coefficient, against the greatest.
    pub digits_lost_of_greatest: f64,
}

/// Where a way loses half of its digits, and all of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Threshold {
    /// The method whose coefficients are computed.
    pub method: Method,
    /// The way in which they are computed.
    pub way: Way,
    /// The set of coefficients that is counted.
    pub form: Set,
    /// What n tends to: infinity (none), or an n at which coefficients vanish.
    pub toward: Option<f64>,
    /// The greatest loss up to n = 10⁹.
    pub most: f64,
    /// Where half are lost first: the least n, or the greatest distance.
    pub half: Option<f64>,
    /// Where all are lost first.
    pub all: Option<f64>,
}

/// Every loss, and where it becomes serious.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CoefficientLosses {
    /// The level Q of the epicentre.
    pub q: f64,
    /// The lower level G of `three_point`.
    pub g: f64,
    /// Bits of the exact values.
    pub exact_bits: usize,
    /// Exponents in a decade.
    pub steps_per_decade: u32,
    /// Where each way loses half of its digits, and all.
    pub thresholds: Vec<Threshold>,
    /// Every way at every exponent.
    pub rows: Vec<Loss>,
}

/// Measures every method in every way, for these levels (the printed formulas of hermite are for Q = 1/2,
/// and then left out).
///
/// # Errors
/// When a fit refuses an exponent, which it does not in this range.
pub fn coefficient_losses(levels: Levels) -> Result<CoefficientLosses, FitError> {
    let losses: Result<Vec<Vec<Loss>>, FitError> = exponents().par_iter().map(|&n| losses_at(n, levels)).collect();
    let mut rows = losses?.concat();
    // By method, and by exponent within it: the sort keeps the order of what is equal.
    rows.sort_by_key(|row| row.method as u8);
    Ok(CoefficientLosses {
        q: levels.q(),
        g: levels.g(),
        exact_bits: super::wide::PRECISION,
        steps_per_decade: STEPS_PER_DECADE,
        thresholds: thresholds(&rows),
        rows,
    })
}

/// From 1 to [`MAX_EXPONENT`], most of them fractional, and those beside 1, 2 and 3; rising.
fn exponents() -> Vec<f64> {
    let decades = MAX_EXPONENT.log10().round() as u32;
    let step = |i: u32| 10_f64.powf(f64::from(i) / f64::from(STEPS_PER_DECADE)).min(MAX_EXPONENT);
    let mut all: Vec<f64> = (0..=decades * STEPS_PER_DECADE).map(step).collect();
    for zero in [1.0, 2.0, 3.0] {
        all.push(zero);
        for i in 2..=15 * DISTANCES_PER_DECADE {
            let distance = 10_f64.powf(-f64::from(i) / f64::from(DISTANCES_PER_DECADE));
            all.extend([zero - distance, zero + distance].into_iter().filter(|&n| n >= 1.0));
        }
    }
    all.sort_unstable_by(f64::total_cmp);
    all.dedup();
    all
}

fn losses_at(n: f64, levels: Levels) -> Result<Vec<Loss>, FitError> {
    let (plain, wide) = (At::<f64>::new(n, levels), At::<Wide>::new(n, levels));
    let printed = levels.q() == 0.5;
    let mut losses = Vec::new();
    for method in methods() {
        let Some(exact) = forms(method, Way::Naive, &wide) else { continue };
        for way in Way::ALL {
            let computed = match way {
                Way::Fit => Some(fitted(&fit(method, n, levels)?)),
                Way::Printed | Way::PrintedConstant if !printed => None,
                _ => forms(method, way, &plain),
            };
            let Some(computed) = computed else { continue };
            // What [Rom] prints for three_point has values of its own.
            let own = match (method, way) {
                (Method::ThreePoint, Way::Printed) => forms(method, way, &wide),
                _ => None,
            };
            let exact = own.as_ref().unwrap_or(&exact);
            for (form, computed, exact) in
                [(Set::Power, computed.power, &exact.power), (Set::Centred, computed.centred, &exact.centred)]
            {
                if let Some((digits_lost, index, digits_lost_of_greatest)) = loss(&computed, exact) {
                    let worst = form.names(method)[index];
                    losses.push(Loss { method, way, form, n, digits_lost, worst, digits_lost_of_greatest });
                }
            }
        }
    }
    Ok(losses)
}

fn fitted(fit: &Fit) -> Forms<f64> {
    match &fit.curve {
        Curve::Rational(ratio) => Forms { power: vec![ratio.a, ratio.b], centred: vec![ratio.at_one] },
        Curve::Cubic(cubic) | Curve::Composite { epicentre: cubic, .. } => {
            let (power, k) = (&cubic.power, &cubic.centred);
            Forms { power: vec![power.a, power.b, power.c, power.d], centred: vec![k.k1, k.k2, k.k3] }
        }
    }
}

/// Digits lost by the worst coefficient, which that is, and the loss against the greatest; none
/// where there are no coefficients.
fn loss(computed: &[f64], exact: &[Wide]) -> Option<(f64, usize, f64)> {
    /// Of two numbers that cancel down to this, nothing but rounding is left.
    const ZERO_BITS: i32 = 250;
    let greatest = exact.iter().map(|exact| exact.to_f64().abs()).fold(0.0, f64::max);
    let scale = Wide::of(greatest);
    let mut worst: Option<(f64, usize)> = None;
    let mut of_greatest = 0.0_f64;
    for (index, (&computed, exact)) in computed.iter().zip(exact).enumerate() {
        let error = Wide::of(computed) - exact.clone();
        of_greatest = of_greatest.max(digits(&error, &scale));
        let lost = match exact.vanishes_beside(&scale, ZERO_BITS) {
            true if computed == 0.0 => 0.0,
            true => ALL_DIGITS,
            false => digits(&error, exact),
        };
        if worst.is_none_or(|(most, _)| lost > most) {
            worst = Some((lost, index));
        }
    }
    worst.map(|(lost, index)| (lost, index, of_greatest))
}

/// log10 of an error against one rounding of `value`.
fn digits(error: &Wide, value: &Wide) -> f64 {
    let relative = (error.clone() / value.clone()).to_f64().abs();
    let lost = (relative * 53_f64.exp2()).log10();
    // −∞ for no error; infinite and not a number where nothing is left.
    if lost.is_nan() { ALL_DIGITS } else { lost.clamp(0.0, ALL_DIGITS) }
}

fn thresholds(rows: &[Loss]) -> Vec<Threshold> {
    let mut found = Vec::new();
    for method in methods() {
        for way in Way::ALL {
            for form in [Set::Power, Set::Centred] {
                let of = |row: &&Loss| (row.method, row.way, row.form) == (method, way, form);
                let rows: Vec<Loss> = rows.iter().filter(of).copied().collect();
                if rows.is_empty() {
                    continue;
                }
                for toward in [None, Some(1.0), Some(2.0), Some(3.0)] {
                    found.push(threshold(&rows, toward));
                }
            }
        }
    }
    found
}

fn threshold(rows: &[Loss], toward: Option<f64>) -> Threshold {
    // As distances that grow more extreme: n itself, or how near it is.
    let near = |n: f64| match toward {
        None => (n >= PAST_ZEROS).then_some(n),
        Some(zero) => (n != zero && (n - zero).abs() <= 0.1).then(|| (n - zero).abs()),
    };
    let first = |limit: f64| {
        let lost = rows.iter().filter(|row| row.digits_lost >= limit);
        let places = lost.filter_map(|row| near(row.n));
        match toward {
            None => places.reduce(f64::min),
            Some(_) => places.reduce(f64::max),
        }
    };
    let counted = rows.iter().filter(|row| row.n <= 1e9 && near(row.n).is_some());
    let most = counted.map(|row| row.digits_lost).fold(0.0, f64::max);
    let Loss { method, way, form, .. } = rows[0];
    let all = first(ALL_DIGITS - 0.5);
    Threshold { method, way, form, toward, most, half: first(HALF_DIGITS), all }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDE_TOLERANCE: f64 = 1e-60;

    fn wide(value: f64) -> Wide {
        Wide::of(value)
    }

    fn small(value: &Wide, place: &str) {
        let size = value.to_f64().abs();
        assert!(size < WIDE_TOLERANCE, "{place}: {size:e}");
    }

    /// The exact coefficients are put back into the conditions they are defined by.
    #[test]
    fn the_exact_coefficients_satisfy_the_conditions() {
        let levels = Levels::default();
        for n in [1.0 + 1e-9, 1.1, 2.5, 3.0, 64.0, 1000.3, 1e9, 1e15] {
            let (n_wide, one) = (wide(n), wide(1.0));
            let root = |level| Wide::root_of(level, &wide(level).ln(), &n_wide);
            let (q, l) = (root(levels.q()), root(levels.g()));
            let slope = n_wide.clone() * wide(levels.q()) / q.clone();
            for method in methods() {
                let exact = forms(method, Way::Naive, &At::<Wide>::new(n, levels)).unwrap();
                let place = format!("{method}, n = {n}");
                if method == Method::Rational {
                    let [a, b]: [Wide; 2] = exact.power.try_into().unwrap();
                    let below = a.clone() - b * q.clone();
                    small(&(q.clone() / below.clone() - wide(levels.q())), &place);
                    small(&((a / (below.clone() * below) - slope.clone()) / slope.clone()), &place);
                    continue;
                }
                let [a, b, c, d]: [Wide; 4] = exact.power.try_into().unwrap();
                let [k1, k2, k3]: [Wide; 3] = exact.centred.try_into().unwrap();
                let power =
                    |x: &Wide| ((a.clone() * x.clone() + b.clone()) * x.clone() + c.clone()) * x.clone() + d.clone();
                for x in [one.clone(), q.clone(), wide(0.25)] {
                    let s = one.clone() - x.clone();
                    let inner = k2.clone() - s.clone() * k3.clone();
                    let centred = one.clone() - s.clone() * (k1.clone() - s * inner);
                    let size = wide(1.0) + wide(n) * wide(n);
                    small(&((power(&x) - centred) / size), &format!("{place}, forms"));
                }
                small(&(power(&one) - one.clone()), &place);
                small(&(power(&q) - wide(levels.q())), &place);
                if method != Method::Quadratic {
                    small(&d, &place);
                }
                if matches!(method, Method::Hermite | Method::Quadratic) {
                    let derived = (wide(3.0) * a.clone() * q.clone() + wide(2.0) * b.clone()) * q.clone() + c.clone();
                    small(&((derived - slope.clone()) / slope.clone()), &place);
                }
                if method == Method::ThreePoint {
                    small(&(power(&l) - wide(levels.g())), &place);
                }
                if method == Method::Tangent {
                    // A double zero: b² = 4ac.
                    let bend = b.clone() * b.clone();
                    let rest = bend.clone() - wide(4.0) * a.clone() * c.clone();
                    small(&(rest / (bend + one.clone())), &place);
                }
            }
        }
    }

    /// 256 bits more change nothing.
    #[test]
    fn the_precision_suffices() {
        const MORE: usize = super::super::wide::PRECISION + 256;
        for n in [1.0_f64.next_up(), 2.0_f64.next_up(), 3.0_f64.next_down(), 1e9, 1e15] {
            for method in methods() {
                let exact = forms(method, Way::Naive, &At::<Wide>::new(n, Levels::default())).unwrap();
                let finer = forms(method, Way::Naive, &At::<Wide<MORE>>::new(n, Levels::default())).unwrap();
                for (exact, finer) in
                    exact.power.iter().chain(&exact.centred).zip(finer.power.iter().chain(&finer.centred))
                {
                    let (exact, finer) = (exact.to_f64(), finer.to_f64());
                    let close = (exact - finer).abs() <= 1e-15 * finer.abs();
                    assert!(close || finer.abs() < 1e-70, "{method}, {n}: {exact:e}, {finer:e}");
                }
            }
        }
    }

    /// \[Rom\]'s hermite is what the conditions demand; its three_point is not.
    #[test]
    fn what_is_printed_for_hermite_and_rational_solves_the_system() {
        let levels = Levels::default();
        let differ = |method, n: f64| {
            let exact = forms(method, Way::Naive, &At::<Wide>::new(n, levels)).unwrap();
            let printed = forms(method, Way::Printed, &At::<Wide>::new(n, levels)).unwrap();
            let off = |(printed, exact): (&Wide, &Wide)| {
                let size = exact.to_f64().abs() + 1.0;
                (printed.clone() - exact.clone()).to_f64().abs() / size
            };
            printed.power.iter().zip(&exact.power).map(off).fold(0.0, f64::max)
        };
        for n in [1.5, 7.0, 300.0, 1e9] {
            assert!(differ(Method::Hermite, n) < WIDE_TOLERANCE, "{n}");
            assert!(differ(Method::Rational, n) < WIDE_TOLERANCE, "{n}");
            assert!(differ(Method::ThreePoint, n) > 0.1, "{n}");
        }
    }

    #[test]
    fn a_planted_error_is_seen_and_a_right_value_is_not() {
        let exact = [wide(3.0), wide(-1e6), wide(0.0)];
        let lost = |computed: [f64; 3]| loss(&computed, &exact).unwrap();
        assert_eq!(lost([3.0, -1e6, 0.0]), (0.0, 0, 0.0));
        let (digits, index, of_greatest) = lost([3.0 * (1.0 + 1e-8), -1e6, 0.0]);
        assert_eq!(index, 0);
        assert!((digits - (1e-8 * 53_f64.exp2()).log10()).abs() < 1e-6, "{digits}");
        assert!((digits - of_greatest - (1e6_f64 / 3.0).log10()).abs() < 1e-6, "{of_greatest}");
        let (digits, index, of_greatest) = lost([3.0, -1e6, 1e-30]);
        assert_eq!((digits, index, of_greatest), (ALL_DIGITS, 2, 0.0));
    }

    #[test]
    fn the_ways_fall_in_their_order() {
        let losses = coefficient_losses(Levels::default()).unwrap();
        let most = |way| {
            let of = losses.thresholds.iter().find(|threshold| {
                (threshold.method, threshold.way, threshold.form, threshold.toward)
                    == (Method::Hermite, way, Set::Centred, None)
            });
            of.unwrap().most
        };
        assert!(most(Way::Fit) < 0.5, "{}", most(Way::Fit));
        assert!(most(Way::Stable) < 2.0, "{}", most(Way::Stable));
        assert!(most(Way::Naive) > HALF_DIGITS - 1.0 && most(Way::Naive) < ALL_DIGITS - 1.0);
        assert!(most(Way::Printed) >= ALL_DIGITS - 0.5, "{}", most(Way::Printed));
        assert!(losses.rows.iter().all(|row| (0.0..=ALL_DIGITS).contains(&row.digits_lost)));
    }
}
