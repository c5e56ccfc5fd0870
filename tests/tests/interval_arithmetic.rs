//! Interval arithmetic against exact numbers: m·2^e for the four operations, sums of 400 binary places with
//! a bounded rest for the functions. None of it rounds as f64 does.

use bounds::interval::Interval;
use num_bigint::BigInt;
use proptest::prelude::*;

/// Binary places of a fixed-point number; the sums below are off by less than 2^−300.
const PLACES: i64 = 400;

/// m·2^e.
#[derive(Clone, Debug)]
struct Dyadic {
    m: BigInt,
    e: i64,
}

impl Dyadic {
    fn new(value: f64) -> Self {
        assert!(value.is_finite());
        let bits = value.to_bits();
        let (biased, fraction) = ((bits >> 52 & 0x7ff) as i64, (bits & ((1 << 52) - 1)) as i64);
        let (m, e) = if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
        Self { m: BigInt::from(if value < 0.0 { -m } else { m }), e }
    }

    fn times(&self, other: &Self) -> Self {
        Self { m: &self.m * &other.m, e: self.e + other.e }
    }

    fn plus(&self, other: &Self) -> Self {
        let e = self.e.min(other.e);
        Self { m: self.at(e) + other.at(e), e }
    }

    /// The value in units of 2^e, where e is at most its own.
    fn at(&self, e: i64) -> BigInt {
        &self.m << (self.e - e) as u64
    }

    fn at_most(&self, other: &Self) -> bool {
        let e = self.e.min(other.e);
        self.at(e) <= other.at(e)
    }

    /// In units of 2^−PLACES, exactly.
    fn fixed(&self) -> BigInt {
        let shift = self.e + PLACES;
        if shift >= 0 {
            &self.m << shift as u64
        } else {
            let (whole, rest) = (&self.m >> (-shift) as u64, (-shift) as u64);
            assert_eq!(&whole << rest, self.m, "it has no more than {PLACES} places");
            whole
        }
    }
}

/// The interval holds the exact value (an infinite end holds everything).
fn holds(interval: Interval, value: &Dyadic) -> bool {
    (interval.low().is_infinite() || Dyadic::new(interval.low()).at_most(value))
        && (interval.high().is_infinite() || value.at_most(&Dyadic::new(interval.high())))
}

/// The interval holds every number that is `value`·2^−PLACES to 2^−300.
fn holds_fixed(interval: Interval, value: &BigInt) -> bool {
    let rest = BigInt::from(1) << (PLACES - 300) as u64;
    holds_between(interval, &(value - &rest), &(value + &rest))
}

fn holds_between(interval: Interval, low: &BigInt, high: &BigInt) -> bool {
    let fixed = |m: &BigInt| Dyadic { m: m.clone(), e: -PLACES };
    Dyadic::new(interval.low()).at_most(&fixed(low)) && fixed(high).at_most(&Dyadic::new(interval.high()))
}

/// Σ a_k·t^k, k up to 500, in units of 2^−PLACES; `next` turns the term t^k·c_k into t^(k+1)·c_(k+1) by a
/// factor t·numerator/denominator. For |t| ≤ 40 the rounding of 500 terms, each magnified by later ones at
/// most e^40-fold, stays below 2^80 units.
fn series(t: f64, first: &BigInt, next: impl Fn(i64) -> (i64, i64)) -> BigInt {
    let t = Dyadic::new(t).fixed();
    let mut term = first << PLACES as u64;
    let mut sum = term.clone();
    for k in 0..500 {
        let (numerator, denominator) = next(k);
        term = ((term * &t) >> PLACES as u64) * numerator / denominator;
        sum += &term;
    }
    assert!(term.magnitude().bits() <= 80, "the rest of the series is not small");
    sum
}

fn exp(t: f64) -> BigInt {
    series(t, &BigInt::from(1), |k| (1, k + 1))
}

/// Σ (−t)^k/(k + 1)!
fn phi(t: f64) -> BigInt {
    series(t, &BigInt::from(1), |k| (-1, k + 2))
}

/// Σ (−t)^k/(k!·(k + 2)), as half of Σ 2·(−t)^k/(k!·(k + 2)).
fn psi(t: f64) -> BigInt {
    series(t, &BigInt::from(1), |k| (-(k + 2), (k + 1) * (k + 3))) / 2
}

/// Any f64 of moderate size, zeros and subnormal numbers included.
fn moderate() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => (-1.0_f64..1.0, -150_i32..150).prop_map(|(m, e)| m * f64::from(e).exp2()),
        1 => prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, 0.5, 5e-324, -5e-324, f64::MIN_POSITIVE]),
        1 => (-4_i32..=4).prop_map(f64::from),
    ]
}

/// An interval, and a point of it: often an end.
fn chosen() -> impl Strategy<Value = (Interval, f64)> {
    (moderate(), moderate(), 0_u8..4, 0.0_f64..1.0).prop_map(|(a, b, which, part)| {
        let (low, high) = if a <= b { (a, b) } else { (b, a) };
        let point = match which {
            0 => low,
            1 => high,
            _ => (low + part * (high - low)).clamp(low, high),
        };
        (Interval::new(low, high), point)
    })
}

/// Arguments of φ, ψ, e^t with at most 400 places.
fn argument() -> impl Strategy<Value = f64> {
    prop_oneof![
        (0.0_f64..40.0),
        (0.0_f64..1.2),
        (0.5_f64..1.0, -300_i32..0).prop_map(|(m, e)| m * f64::from(e).exp2()),
        prop::sample::select(vec![0.0, 1.0, 1.0_f64.next_up(), 1.0 / 134_217_728.0]),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4096))]

    #[test]
    fn four_operations((a, x) in chosen(), (b, y) in chosen()) {
        let (dx, dy) = (Dyadic::new(x), Dyadic::new(y));
        prop_assert!(holds(a + b, &dx.plus(&dy)));
        prop_assert!(holds(a - b, &dx.plus(&Dyadic::new(-y))));
        prop_assert!(holds(-a, &Dyadic::new(-x)));
        prop_assert!(holds(a * b, &dx.times(&dy)));
        let quotient = a / b;
        if b.holds(0.0) {
            prop_assert_eq!(quotient, Interval::UNKNOWN);
        } else {
            // low ≤ x/y ≤ high, times |y|.
            let (x, y) = if y < 0.0 { (Dyadic::new(-x), Dyadic::new(-y)) } else { (dx, dy) };
            for (end, below) in [(quotient.low(), true), (quotient.high(), false)] {
                if end.is_finite() {
                    let product = Dyadic::new(end).times(&y);
                    let bounds = if below { product.at_most(&x) } else { x.at_most(&product) };
                    prop_assert!(bounds);
                }
            }
        }
    }

    /// Of single numbers, no more than the neighbours of the nearest f64.
    #[test]
    fn operations_are_tight(x in moderate(), y in moderate()) {
        let (a, b) = (Interval::exactly(x), Interval::exactly(y));
        for (interval, nearest) in [(a + b, x + y), (a - b, x - y), (a * b, x * y)] {
            prop_assert!(interval.low() >= nearest.next_down() && interval.high() <= nearest.next_up());
        }
        if y != 0.0 && (x / y).is_finite() {
            prop_assert!((a / b).low() >= (x / y).next_down() && (a / b).high() <= (x / y).next_up());
        }
    }

    #[test]
    fn functions((t, width) in (argument(), 0.0_f64..0.5), part in 0.0_f64..1.0) {
        let around = Interval::new((t - part * width).max(0.0), t + (1.0 - part) * width);
        for interval in [Interval::exactly(t), around] {
            // At t = 0 both end exactly where the function does, where 2^−300 more are too much.
            let (phi_at, psi_at) = if t > 1e-60 {
                (holds_fixed(interval.phi(), &phi(t)), holds_fixed(interval.psi(), &psi(t)))
            } else {
                (interval.phi().holds(1.0), interval.psi().holds(0.5))
            };
            prop_assert!(phi_at, "phi {t:e} {:?}", interval.phi());
            prop_assert!(psi_at, "psi {t:e} {:?}", interval.psi());
            prop_assert!(holds_fixed(interval.exp(), &exp(t)), "exp {t:e}");
            let one = BigInt::from(1) << PLACES as u64;
            if t > 1e-60 {
                prop_assert!(holds_fixed((-interval).exp(), &exp(-t)), "exp {:e}", -t);
                prop_assert!(holds_fixed(interval.expm1(), &(exp(t) - &one)), "expm1 {t:e}");
                prop_assert!(holds_fixed((-interval).expm1(), &(exp(-t) - &one)), "expm1 {:e}", -t);
            }
        }
        let (phi, psi) = (Interval::exactly(t).phi(), Interval::exactly(t).psi());
        prop_assert!(phi.high() - phi.low() <= 1e-15 * phi.low(), "phi is wide: {phi:?}");
        prop_assert!(psi.high() - psi.low() <= 1e-14 * psi.low(), "psi is wide: {psi:?}");
    }

    /// e^low ≤ x ≤ e^high.
    #[test]
    fn logarithm(decades in -15.0_f64..15.0, factor in 1.0_f64..3.0) {
        let x = 10.0_f64.powf(decades);
        for interval in [Interval::exactly(x), Interval::new(x / factor, x * factor)] {
            let ln = interval.ln();
            let value = Dyadic::new(x).fixed();
            prop_assert!(exp(ln.low()) <= value && value <= exp(ln.high()));
        }
    }
}

#[test]
fn what_is_not_known_is_said() {
    let unknown = Interval::UNKNOWN;
    let (zero, one) = (Interval::ZERO, Interval::ONE);
    for divisor in [zero, Interval::new(-1.0, 1.0), Interval::new(0.0, 1.0), Interval::new(-1.0, 0.0)] {
        assert_eq!(one / divisor, unknown);
        assert_eq!(zero / divisor, unknown);
    }
    for (low, high) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::NAN)] {
        assert_eq!(Interval::new(low, high), unknown);
    }
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(Interval::exactly(value), unknown);
    }
    assert_eq!(unknown * zero, unknown);
    assert_eq!(unknown + one, unknown);
    assert_eq!(zero.ln(), unknown);
    assert_eq!(Interval::new(-1.0, 1.0).ln(), unknown);
    assert_eq!(Interval::new(-1e-300, 1.0).phi(), unknown);
    assert_eq!(Interval::new(-1e-300, 1.0).psi(), unknown);
    assert_eq!(unknown.greatest_magnitude(), f64::INFINITY);
    assert_eq!(unknown.least_magnitude(), 0.0);
    // An overflow leaves the greatest f64 as the lower end.
    let square = Interval::exactly(1e300) * Interval::exactly(1e300);
    assert_eq!((square.low(), square.high()), (f64::MAX, f64::INFINITY));
    assert_eq!((Interval::ZERO.phi(), Interval::ZERO.exp().holds(1.0)), (Interval::ONE, true));
}
