//! The reference of many (n, x) at once: the bits of [`phong`](super::phong()), sooner.
//!
//! For a whole n, x^n is reached by squaring and multiplying, from the highest bit of n down, in two f64 h + l:
//!
//! ```text
//! (h + l)² = h² + 2hl + l²    h′ = h² rounded, e = h² − h′ exactly (fused)    l′ = 2h·l + e, rounded once
//! (h + l)·x                   h′ = h·x rounded, e = h·x − h′ exactly          l′ = l·x + e, rounded once
//! ```
//!
//! **Error.** Relative to the power, |l| grows to 2c + 1 units of 2⁻⁵³ when squared and to c + 1 when multiplied, where
//! it was c: after all of n, c < 2n. What is left out (l², c²·2⁻¹⁰⁶) and rounded (l′, c·2⁻¹⁰⁶) is doubled by every
//! squaring that follows; together it is less than 2n²·2⁻¹⁰⁶ ≤ 2⁻⁸¹ for n up to [`GREATEST`], and `DOUBT` is 2⁻⁷⁶.
//! Where h + l less and more than that rounds to the same f64, x^n does too: that is the correctly rounded power. About
//! one in four million does not, and is asked of [`phong`](super::phong()), like an n that is not whole and a power so
//! small that e may be no f64.

use multiversion::multiversion;

use super::phong::phong;

/// The greatest exponent that is reached by multiplying.
pub const GREATEST: f64 = 4096.0;

/// The relative error that h + l is trusted to keep: 2⁻⁷⁶.
const DOUBT: f64 = f64::from_bits((1023 - 76) << 52);
/// Powers from here up have an exact e: 2⁻⁹⁰⁰.
const LEAST: f64 = f64::from_bits((1023 - 900) << 52);

/// Powers that are computed side by side: so many that the compiler keeps them in memory, and loops over them in
/// vectors.
const LANES: usize = 32;

/// Writes x^n, correctly rounded, for each exponent (≥ 1) and x (in [0, 1]): as many as the shortest of the lists has.
pub fn phong_of_all(exponents: &[f64], xs: &[f64], powers: &mut [f64]) {
    powers.fill(f64::NAN);
    multiply(exponents, xs, powers);
    for ((&exponent, &x), power) in exponents.iter().zip(xs).zip(powers) {
        if power.is_nan() {
            *power = phong(exponent, x);
        }
    }
}

/// The powers that are certain; the others, and those that do not fill the lanes, are left alone.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn multiply(exponents: &[f64], xs: &[f64], powers: &mut [f64]) {
    let lanes = exponents.as_chunks().0.iter().zip(xs.as_chunks().0);
    for ((exponents, xs), powers) in lanes.zip(powers.as_chunks_mut().0) {
        raise(exponents, xs, powers);
    }
}

/// The power of each lane where it is certain.
#[inline(always)]
fn raise(exponents: &[f64; LANES], xs: &[f64; LANES], powers: &mut [f64; LANES]) {
    let whole = exponents.map(|exponent| exponent.clamp(0.0, GREATEST) as u32);
    let greatest = whole.iter().fold(0, |all, whole| all | whole);
    let (mut high, mut low) = ([1.0_f64; LANES], [0.0_f64; LANES]);
    for bit in (0..u32::BITS - greatest.leading_zeros()).rev() {
        for lane in 0..LANES {
            let (h, l) = (high[lane], low[lane]);
            let square = h * h;
            let rest = (h + h).mul_add(l, h.mul_add(h, -square));
            let factor = if whole[lane] >> bit & 1 == 1 { xs[lane] } else { 1.0 };
            let product = square * factor;
            low[lane] = rest.mul_add(factor, square.mul_add(factor, -product));
            high[lane] = product;
        }
    }
    for lane in 0..LANES {
        let (h, l) = (high[lane], low[lane]);
        let (down, up) = (h + (l - h * DOUBT), h + (l + h * DOUBT));
        let certain = down == up && h >= LEAST && f64::from(whole[lane]) == exponents[lane];
        powers[lane] = if certain { down } else { powers[lane] };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn check(exponents: &[f64], xs: &[f64]) -> usize {
        let mut powers = vec![f64::NAN; xs.len()];
        multiply(exponents, xs, &mut powers);
        let certain = powers.iter().filter(|power| !power.is_nan()).count();
        phong_of_all(exponents, xs, &mut powers);
        for ((&n, &x), power) in exponents.iter().zip(xs).zip(powers) {
            assert_eq!(power.to_bits(), phong(n, x).to_bits(), "{x:e}^{n}");
        }
        certain
    }

    /// The x of a 23-bit input and of every f64, the n of a ROM and every other.
    fn questions() -> impl Strategy<Value = Vec<(f64, f64)>> {
        let n =
            prop_oneof![(1_u32..=256).prop_map(f64::from), (1_u32..=5000).prop_map(f64::from), 1.0..300.0, 1.0..1e15,];
        let x = prop_oneof![
            (0_u32..=1 << 23).prop_map(|bits| f64::from(bits) / f64::from(1 << 23)),
            0.0..=1.0,
            (0.0..=1e-3).prop_map(|s| 1.0 - s),
            (0.0..=1.0_f64).prop_map(|x| x * 1e-300),
        ];
        prop::collection::vec((n, x), 0..40)
    }

    proptest! {
        #[test]
        fn the_bits_are_those_of_one_at_a_time(questions in questions()) {
            let (exponents, xs): (Vec<f64>, Vec<f64>) = questions.into_iter().unzip();
            check(&exponents, &xs);
        }
    }

    #[test]
    fn few_are_asked_again() {
        let xs: Vec<f64> = (0..=1 << 14).map(|i| 0.5 + f64::from(i) / f64::from(1 << 15)).collect();
        for n in [1.0, 2.0, 3.0, 64.0, 255.0, 256.0] {
            assert_eq!(check(&vec![n; xs.len()], &xs), xs.len() / LANES * LANES, "n = {n}");
        }
        for n in [1.5, 4097.0, 1e15] {
            assert_eq!(check(&vec![n; xs.len()], &xs), 0, "n = {n}");
        }
    }
}
