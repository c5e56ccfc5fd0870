//! The exact oracle, and the reference x^n, against big integers of our own.
//!
//! Nothing here rounds: an f64 is judged by its exact value and those of its two neighbours.

use std::cmp::Ordering;

use hw_model::highlight::exact::{ExactError, ExactPower};
use hw_model::highlight::{phong, phong_at_s};
use naive::Exact;
use naive::configurations::Random;
use num_bigint::{BigInt, BigUint};

const SEED: u64 = 0x000f_ac1e;
const POINTS: u32 = 3000;

/// x^n by multiplying n times.
fn power(x: &Exact, exponent: u32) -> Exact {
    (0..exponent).fold(Exact::of_bits(1, 0), |product, _| product * x.clone())
}

/// True when no other f64 is nearer, and a tie went to the even one.
fn is_nearest(value: f64, exact: &Exact) -> bool {
    let distance = |candidate: f64| Exact::of_f64(candidate).distance(exact);
    let own = distance(value);
    [value.next_up(), value.next_down()].into_iter().all(|neighbour| match own.compare(&distance(neighbour)) {
        Ordering::Less => true,
        Ordering::Equal => value.to_bits().is_multiple_of(2),
        Ordering::Greater => false,
    })
}

/// Half the distance to the next f64 above, exactly; `value` is not negative.
fn half_step(value: f64) -> Exact {
    Exact::of_f64(value.next_up()).distance(&Exact::of_f64(value)) * Exact::of_bits(1, 1)
}

/// The ulp the oracle states its errors in: that of an f64 at the exact power.
fn ulp_at(exact: &Exact) -> Exact {
    // The greatest power of two not above x^n; 2^−1022 at least.
    let mut power_of_two = Exact::of_bits(1, 0);
    let mut exponent = 0;
    while exponent < 1022 && power_of_two.compare(exact) == Ordering::Greater {
        exponent += 1;
        power_of_two = Exact::of_bits(1, exponent);
    }
    Exact::of_bits(1, exponent + 52)
}

struct Point {
    k: u64,
    fraction: u32,
    exponent: u32,
}

/// Points of every kind: short and long x, near 0, near 1, exponents up to where x^n underflows.
fn point(random: &mut Random, greatest_fraction: i64) -> Point {
    let fraction = random.integer(1, greatest_fraction) as u32;
    let one = 1_u64 << fraction;
    let reach = random.integer(0, i64::from(fraction).min(61));
    let near = random.integer(0, 1 << reach) as u64;
    let k = match random.integer(0, 3) {
        0 => near.min(one),
        1 => one - near.min(one),
        _ => one - (random.integer(0, i64::MAX) as u64) % (one + 1),
    };
    let exponent = match random.integer(0, 5) {
        0 => random.integer(1, 4),
        1 => random.integer(100, 400),
        _ => random.integer(1, 64),
    };
    Point { k, fraction, exponent: exponent as u32 }
}

#[test]
fn the_oracle_is_the_power() {
    let mut random = Random::new(SEED, 0);
    let mut compared = 0;
    for _ in 0..POINTS {
        let Point { k, fraction, exponent } = point(&mut random, 63);
        let place = format!("k = {k}, fraction = {fraction}, n = {exponent}");
        let oracle = ExactPower::new(k, fraction, exponent).expect("a point of the unit interval");
        let wanted = power(&Exact::of_bits(k, fraction), exponent);

        let numerator = BigUint::from_bytes_le(&oracle.numerator().to_le_bytes());
        assert_eq!(numerator, BigUint::from(k).pow(exponent), "{place}");
        assert_eq!(oracle.log2_denominator(), u64::from(fraction * exponent), "{place}");

        let value = oracle.to_f64();
        assert!(is_nearest(value, &wanted), "{place}: {value:e}");

        let others = [value, value.next_up(), value.next_down(), random.real(0.0, 1.0), -0.5, 1.5];
        for other in others {
            let exact = Exact::of_f64(other);
            assert_eq!(oracle.compare(other), Some(exact.compare(&wanted)), "{place}: {other:e}");
            let error = (exact - wanted.clone()).divided_by(&ulp_at(&wanted));
            let got = oracle.error_in_ulp(other);
            // An error beyond the range of f64 comes back as an infinity.
            if got.is_finite() && got.abs() < f64::MAX {
                assert!(is_nearest(got, &error), "{place}: {other:e} is {got:e} ulp off");
                compared += 1;
            }
        }
        let output = random.integer(1, 40) as u32;
        let bits = random.integer(-2, 1 << output);
        let error = Exact::of_bits(bits, output) - wanted;
        let got = oracle.error_of_bits(bits, output);
        assert!(is_nearest(got, &error), "{place}: {bits} of {output} fraction bits, {got:e}");
    }
    println!("seed {SEED:#x}: {POINTS} powers, {compared} errors");
    assert!(compared > 5 * POINTS, "{compared}");
}

#[test]
fn the_oracle_refuses_what_it_cannot_hold() {
    for (k, fraction, exponent) in [(2, 0, 1), (5, 2, 1), (u64::MAX, 63, 1), (0, 64, 1)] {
        let refusal = ExactPower::new(k, fraction, exponent).expect_err("outside the unit interval");
        assert!(matches!(refusal, ExactError::Input { .. }), "{refusal}");
    }
    let refusal = ExactPower::new(1, 63, u32::MAX).expect_err("too many bits");
    assert!(matches!(refusal, ExactError::TooLarge { .. }), "{refusal}");
}

#[test]
fn the_reference_is_the_nearest_f64() {
    let mut random = Random::new(SEED, 1);
    for _ in 0..POINTS {
        let Point { k, fraction, exponent } = point(&mut random, 53);
        let x = k as f64 * (-f64::from(fraction)).exp2();
        let reference = phong(exponent.into(), x);
        let wanted = power(&Exact::of_bits(k, fraction), exponent);
        assert!(is_nearest(reference, &wanted), "x = {x:e}, n = {exponent}: {reference:e}");
    }
}

/// n = m/2: the reference v is right when (v − ½ ulp)² ≤ x^m ≤ (v + ½ ulp)².
#[test]
fn the_reference_is_the_nearest_f64_at_half_exponents() {
    let mut random = Random::new(SEED, 2);
    for _ in 0..POINTS {
        let Point { k, fraction, exponent } = point(&mut random, 53);
        let x = k as f64 * (-f64::from(fraction)).exp2();
        let m = exponent | 1;
        let m = m.max(3);
        let reference = phong(f64::from(m) / 2.0, x);
        if reference < 1e-300 {
            // Half a step below a subnormal is still right, but below zero it has no square to compare.
            continue;
        }
        let wanted = power(&Exact::of_bits(k, fraction), m);
        let value = Exact::of_f64(reference);
        let above = value.clone() + half_step(reference);
        let below = value - half_step(reference.next_down());
        assert_ne!((below.clone() * below).compare(&wanted), Ordering::Greater, "{x:e}^{m}/2");
        assert_ne!((above.clone() * above).compare(&wanted), Ordering::Less, "{x:e}^{m}/2");
    }
}

/// (1 − s)^n at an s whose 1 − s is no f64, with the relative error that is documented.
#[test]
fn the_reference_at_s_keeps_its_error() {
    let mut random = Random::new(SEED, 3);
    let one = || Exact::of_bits(1, 0);
    let mut worst = BigInt::ZERO;
    for _ in 0..POINTS {
        let s = random.real(0.5, 1.0) * random.real(-70.0, 0.0).floor().exp2();
        let exponent = random.integer(1, 120) as u32;
        let got = phong_at_s(exponent.into(), s);
        let wanted = power(&(one() - Exact::of_f64(s)), exponent);
        if got < 1e-290 {
            continue;
        }
        // In thousandths of 2^−53.
        let error = Exact::of_f64(got).distance(&wanted).divided_by(&wanted);
        let scaled = error * Exact::of_bits(1000, 0) * Exact::of_bits(BigInt::from(1) << 53, 0);
        worst = worst.max(scaled.rounded(hw_model::rounding::Rounding::Floor));
        assert!(worst < BigInt::from(4000), "s = {s:e}, n = {exponent}: {worst}/1000 of 2^-53");
    }
    println!("worst relative error: {worst}/1000 of 2^-53");
    assert!(worst > BigInt::ZERO);
}
