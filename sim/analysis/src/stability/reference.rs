//! How far x^n in f64 is from x^n: the reference itself, against the exact oracle.
//!
//! x = k/2^W and integer n give x^n as a ratio of integers. So do n = m/2 and n = m/4, where x is a
//! square or a fourth power of such a number and still an f64. Beside the reference stand what a
//! program would take instead of it, std's `powf` and `powi`: they are the platform's, and other
//! machines may show other errors of them.

use hw_model::highlight::exact::{ExactError, ExactPower};
use hw_model::highlight::{phong, phong_at_s};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use serde::Serialize;

/// A function that computes x^n in f64.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Function {
    /// The reference of every report: correctly rounded, it says.
    Phong,
    /// The reference at s = 1 − x, also where x is no f64: within 4·2⁻⁵³ of x^n, it says.
    PhongAtS,
    /// `f64::powf` of the platform's library.
    StdPowf,
    /// `f64::powi`, for integer n.
    StdPowi,
}

impl Function {
    /// Every function, in the order above.
    pub const ALL: [Self; 4] = [Self::Phong, Self::PhongAtS, Self::StdPowf, Self::StdPowi];

    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Phong => "phong",
            Self::PhongAtS => "phong_at_s",
            Self::StdPowf => "std_powf",
            Self::StdPowi => "std_powi",
        }
    }

    /// The most its documentation allows, in ulp of x^n; none where nothing is promised. The relative
    /// error of 4·2⁻⁵³ is up to 4 ulp, as an ulp is between 2⁻⁵³ and 2⁻⁵² of the value.
    #[must_use]
    pub const fn promised_ulp(self) -> Option<f64> {
        match self {
            Self::Phong => Some(0.5),
            Self::PhongAtS => Some(4.0),
            Self::StdPowf | Self::StdPowi => None,
        }
    }
}

/// One function over the exponents from `n_from` to below `n_to`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ReferenceRow {
    /// The function that was asked.
    pub function: Function,
    /// The least exponent of the row.
    pub n_from: f64,
    /// The least exponent beyond it.
    pub n_to: f64,
    /// The number of powers computed.
    pub samples: u64,
    /// Those that are not the f64 nearest to x^n.
    pub not_nearest: u64,
    /// The greatest error, in ulp of x^n.
    pub worst_ulp: f64,
    /// The x of the greatest error.
    pub worst_x: f64,
    /// The exponent of the greatest error.
    pub worst_n: f64,
}

/// The errors of every function over all octaves of n.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReferenceReport {
    /// What the random samples were drawn from.
    pub seed: u64,
    /// Random samples, beside the structured ones.
    pub random_samples: u64,
    /// Each function over all exponents.
    pub totals: Vec<ReferenceRow>,
    /// Each function by powers of two of n.
    pub rows: Vec<ReferenceRow>,
}

impl ReferenceReport {
    /// Every function keeps what it promises.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.totals.iter().all(|row| row.function.promised_ulp().is_none_or(|promised| row.worst_ulp <= promised))
    }
}

/// ((k/2^fraction)^root)^(m/root), with x = (k/2^fraction)^root exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Sample {
    k: u64,
    fraction: u32,
    /// 1, 2 or 4.
    root: u32,
    m: u32,
}

/// The widest x whose power stays an f64: a root has 53 bits, or 53 divided by `root`.
const fn widest(root: u32) -> u32 {
    match root {
        1 => 53,
        2 => 26,
        _ => 13,
    }
}

impl Sample {
    fn n(self) -> f64 {
        f64::from(self.m) / f64::from(self.root)
    }

    /// x, where it is an f64.
    fn x(self) -> Option<f64> {
        let of_root = self.k as f64 * (-f64::from(self.fraction)).exp2();
        let exact = self.fraction <= widest(self.root);
        exact.then(|| (1..self.root).fold(of_root, |x, _| x * of_root))
    }

    /// 1 − x, where it is an f64: of the first power.
    fn s(self) -> Option<f64> {
        let s = (1_u64 << self.fraction) - self.k;
        let exact = self.root == 1 && 64 - s.leading_zeros() <= 53;
        exact.then(|| s as f64 * (-f64::from(self.fraction)).exp2())
    }

    fn computed(self, function: Function) -> Option<f64> {
        match function {
            Function::Phong => self.x().map(|x| phong(self.n(), x)),
            Function::PhongAtS => self.s().map(|s| phong_at_s(self.n(), s)),
            Function::StdPowf => self.x().map(|x| x.powf(self.n())),
            Function::StdPowi if self.root == 1 => self.x().map(|x| x.powi(self.m as i32)),
            Function::StdPowi => None,
        }
    }
}

/// Powers of two of n that have rows: n up to 65 536.
const BINS: usize = 17;

/// Compares every function with the exact oracle: structured cases, and `count` drawn from `seed`.
///
/// # Errors
/// When the oracle refuses a case, which it does for none of these.
pub fn reference_report(seed: u64, count: u64) -> Result<ReferenceReport, ExactError> {
    let mut samples = structured();
    samples.extend(random(seed, count));
    let bins = samples
        .par_chunks(64)
        .map(|samples| {
            let mut bins = Bins::new();
            samples.iter().try_for_each(|&sample| bins.see(sample)).map(|()| bins)
        })
        .collect::<Result<Vec<Bins>, ExactError>>()?
        .into_iter()
        .fold(Bins::new(), Bins::and);
    let (mut rows, mut totals) = (Vec::new(), Vec::new());
    for (function, bins) in Function::ALL.into_iter().zip(bins.0) {
        let seen: Vec<ReferenceRow> = bins.into_iter().filter(|row| row.samples > 0).collect();
        totals.extend(seen.iter().copied().reduce(ReferenceRow::and));
        debug_assert!(seen.iter().all(|row| row.function == function));
        rows.extend(seen);
    }
    Ok(ReferenceReport { seed, random_samples: count, totals, rows })
}

/// The rows of each function, one for each power of two.
struct Bins([[ReferenceRow; BINS]; Function::ALL.len()]);

impl Bins {
    fn new() -> Self {
        Self(Function::ALL.map(|function| {
            std::array::from_fn(|bin| ReferenceRow {
                function,
                n_from: (bin as f64).exp2(),
                n_to: (bin as f64 + 1.0).exp2(),
                samples: 0,
                not_nearest: 0,
                worst_ulp: 0.0,
                worst_x: f64::NAN,
                worst_n: f64::NAN,
            })
        }))
    }

    fn see(&mut self, sample: Sample) -> Result<(), ExactError> {
        let exact = ExactPower::new(sample.k, sample.fraction, sample.m)?;
        let nearest = exact.to_f64();
        let bin = (sample.n().log2().floor() as usize).min(BINS - 1);
        for (bins, function) in self.0.iter_mut().zip(Function::ALL) {
            let Some(computed) = sample.computed(function) else { continue };
            let row = &mut bins[bin];
            row.samples += 1;
            row.not_nearest += u64::from(computed.to_bits() != nearest.to_bits());
            let error = exact.error_in_ulp(computed).abs();
            if error > row.worst_ulp || row.worst_n.is_nan() {
                row.worst_ulp = error;
                row.worst_n = sample.n();
                row.worst_x = sample.x().or(sample.s().map(|s| 1.0 - s)).unwrap_or(f64::NAN);
            }
        }
        Ok(())
    }

    fn and(mut self, later: Self) -> Self {
        for (rows, later) in self.0.iter_mut().zip(later.0) {
            for (row, later) in rows.iter_mut().zip(later) {
                *row = row.and(later);
            }
        }
        self
    }
}

impl ReferenceRow {
    fn and(self, later: Self) -> Self {
        let worst = match self.worst_n.is_nan() || later.worst_ulp > self.worst_ulp {
            true => later,
            false => self,
        };
        Self {
            n_from: self.n_from.min(later.n_from),
            n_to: self.n_to.max(later.n_to),
            samples: self.samples + later.samples,
            not_nearest: self.not_nearest + later.not_nearest,
            ..worst
        }
    }
}

/// Ends, halves, neighbours of 1 and of q, short and long x, at exponents short and long.
fn structured() -> Vec<Sample> {
    let mut samples = Vec::new();
    for m in [1_u32, 2, 3, 4, 5, 7, 8, 16, 31, 64, 100, 128, 255, 256, 1024, 4096, 16_384, 65_536] {
        for fraction in [1, 8, 15, 23, 26, 52, 53, 61] {
            let one = 1_u64 << fraction;
            let q = (-f64::from(m).recip()).exp2();
            let at_q = (q * one as f64) as u64;
            let ks = [0, 1, 2, one / 2, one / 3, at_q, at_q + 1, one - one / 16, one - 2, one - 1, one];
            let ks = ks.into_iter().filter(|&k| k <= one);
            samples.extend(ks.map(|k| Sample { k, fraction, root: 1, m }));
        }
        for root in [2, 4] {
            let fraction = widest(root);
            let one = 1_u64 << fraction;
            let ks = [1, one / 3, one / 2, one - one / 16, one - 2, one - 1];
            // n = m/root is at least 1.
            samples.extend(ks.map(|k| Sample { k, fraction, root, m: root * m.min(4096) + 1 }));
        }
    }
    // With 61 bits x is no f64, and s only where it is small.
    samples.retain(|sample| sample.x().is_some() || sample.s().is_some());
    samples
}

/// Half of the x anywhere, half next to 1; most n up to 4096, with every length of n as likely.
fn random(seed: u64, count: u64) -> impl Iterator<Item = Sample> {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    let mut dice = ChaCha8Rng::from_seed(key);
    // Of a power of two, the low bits are as likely as any.
    let mut bits = move |count: u32| dice.next_u64() & ((1 << count) - 1);
    (0..count).map(move |_| {
        let root = [1, 1, 1, 1, 1, 1, 2, 4][bits(3) as usize];
        // x of up to 53 bits; in one case of four of the first power, an s of as many below 2^-8.
        let long = root == 1 && bits(2) == 0;
        let fraction = match long {
            true => 61,
            false => 1 + ((bits(16) * u64::from(widest(root))) >> 16) as u32,
        };
        let one = 1_u64 << fraction;
        let near = bits(1) == 1 || long;
        let reach = if long { 53 } else { ((bits(16) * u64::from(fraction + 1)) >> 16) as u32 };
        let k = if near { one - bits(reach) } else { bits(fraction) };
        let length = 1 + ((bits(16) * 12) >> 16) as u32;
        let m = (1 << (length - 1)) | bits(length - 1) as u32;
        Sample { k, fraction, root, m: if root == 1 { m } else { root * m + 1 } }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_is_what_it_says() {
        let square = Sample { k: 3, fraction: 2, root: 2, m: 3 };
        assert_eq!((square.x(), square.n(), square.s()), (Some(0.5625), 1.5, None));
        assert_eq!(square.computed(Function::Phong), Some(0.421_875));
        assert_eq!(square.computed(Function::StdPowi), None);
        let long = Sample { k: (1 << 61) - 1, fraction: 61, root: 1, m: 3 };
        assert_eq!((long.x(), long.s()), (None, Some((-61_f64).exp2())));
    }

    #[test]
    fn every_sample_can_be_judged() {
        let all: Vec<Sample> = structured().into_iter().chain(random(7, 4000)).collect();
        for sample in &all {
            assert!(sample.n() >= 1.0 && sample.k <= 1 << sample.fraction, "{sample:?}");
            assert!(sample.x().is_some() || sample.s().is_some(), "{sample:?}");
        }
        for root in [1, 2, 4] {
            assert!(all.iter().filter(|sample| sample.root == root).count() > 300);
        }
        assert!(all.iter().filter(|sample| sample.x().is_none()).count() > 300);
    }

    #[test]
    fn the_reference_keeps_its_promise_and_a_wrong_one_does_not() {
        let report = reference_report(1, 1500).unwrap();
        assert!(report.holds());
        let total =
            |report: &ReferenceReport, function| *report.totals.iter().find(|row| row.function == function).unwrap();
        let phong = total(&report, Function::Phong);
        assert!(phong.not_nearest == 0 && phong.samples > 1500 && phong.worst_ulp > 0.49);
        // Repeated multiplication cannot be correctly rounded: the count does count.
        assert!(total(&report, Function::StdPowi).not_nearest > 50);
        let mut wrong = report.clone();
        wrong.totals[0].worst_ulp = 0.51;
        assert!(!wrong.holds());
        assert_eq!(reference_report(1, 1500).unwrap(), report);
        let other = reference_report(2, 1500).unwrap();
        assert_ne!(other.rows, report.rows);
    }
}
