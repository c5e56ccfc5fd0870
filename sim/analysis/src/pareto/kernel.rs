//! What a processor computes: for each exponent a function of x (`functions.rs`), its constants in a table. A
//! loop runs over a block of one exponent, or over samples that each have their own.

use hw_model::fit::minimax::Fitted;
use hw_model::fit::{Curve, Fit};
use multiversion::multiversion;

use super::functions::{
    CompositeRow, ContenderRow, CubicRow, LinearRow, PowfRow, RationalRow, Real, SchlickRow, SegmentsRow,
};

/// Samples that go through the lines together.
const LANES: usize = 64;

/// x^n at the ends of equal intervals, exponent after exponent.
#[derive(Debug, Clone)]
pub struct LinearTable<T> {
    intervals: usize,
    values: Vec<T>,
}

impl<T> LinearTable<T> {
    #[inline(always)]
    fn row(&self, address: usize) -> LinearRow<'_, T> {
        let values = self.intervals + 1;
        LinearRow(&self.values[address * values..][..values])
    }
}

/// One way to compute x^n, with its table.
#[derive(Debug, Clone)]
pub enum Kernel<T> {
    /// A cubic in s, zero below.
    Cubic(Vec<CubicRow<T>>),
    /// A cubic in s, a ratio below.
    Composite(Vec<CompositeRow<T>>),
    /// Two cubics in s, zero below.
    Segments(Vec<SegmentsRow<T>>),
    /// x/(A − B·x) on all of [0, 1].
    Rational(Vec<RationalRow<T>>),
    /// Schlick's formula x/(n − (n − 1)·x), without a table.
    Schlick(Vec<SchlickRow<T>>),
    /// The platform's `powf`, with the exponent as its table.
    Powf(Vec<PowfRow<T>>),
    /// Repeated squaring: multiplications alone, for integer exponents.
    Powers(Vec<u32>),
    /// Straight lines between values of a table.
    Linear(LinearTable<T>),
}

impl<T: Real> Kernel<T> {
    /// What a fit says for each exponent. The fits are all of one method.
    pub(super) fn of_fits(fits: &[Fit]) -> Self {
        let cubic = |fit: &Fit| match &fit.curve {
            Curve::Cubic(cubic) => Some(CubicRow::to_its_minimum(cubic, fit.epicentre.s)),
            _ => None,
        };
        let rational = |fit: &Fit| match &fit.curve {
            Curve::Rational(rational) => Some(RationalRow::new(rational)),
            _ => None,
        };
        let composite = |fit: &Fit| match &fit.curve {
            Curve::Composite { epicentre, tail } => Some(CompositeRow {
                epicentre: CubicRow::new(epicentre, fit.epicentre.s),
                tail: RationalRow::new(tail),
            }),
            _ => None,
        };
        match fits.first().map(|fit| &fit.curve) {
            Some(Curve::Rational(_)) => Self::Rational(fits.iter().filter_map(rational).collect()),
            Some(Curve::Composite { .. }) => Self::Composite(fits.iter().filter_map(composite).collect()),
            _ => Self::Cubic(fits.iter().filter_map(cubic).collect()),
        }
    }

    /// Two segments for each exponent.
    pub(super) fn segments(fits: &[Fitted]) -> Self {
        Self::Segments(fits.iter().map(SegmentsRow::new).collect())
    }

    /// Schlick's formula for these exponents.
    pub(super) fn schlick(exponents: &[f64]) -> Self {
        Self::Schlick(exponents.iter().map(|&n| SchlickRow(T::nearest(n))).collect())
    }

    /// `powf` for these exponents.
    pub(super) fn powf(exponents: &[f64]) -> Self {
        Self::Powf(exponents.iter().map(|&n| PowfRow(T::nearest(n))).collect())
    }

    /// Repeated squaring for these exponents, which are integers of at most 32 bits.
    pub(super) fn powers(exponents: &[f64]) -> Self {
        Self::Powers(exponents.iter().map(|&n| n as u32).collect())
    }

    /// A table of `intervals` straight lines for each of these exponents; `power` gives x^n.
    pub(super) fn linear(exponents: &[f64], intervals: usize, power: impl Fn(f64, f64) -> f64) -> Self {
        let value = |n: f64, i: usize| T::nearest(power(n, i as f64 / intervals as f64));
        let row = |&n: &f64| (0..=intervals).map(move |i| (n, i));
        let values = exponents.iter().flat_map(row).map(|(n, i)| value(n, i)).collect();
        Self::Linear(LinearTable { intervals, values })
    }

    /// Bits of the table, all exponents together.
    pub(super) fn table_bits(&self) -> u64 {
        let words = match self {
            Self::Cubic(rows) => 4 * rows.len(),
            Self::Composite(rows) => 6 * rows.len(),
            Self::Segments(rows) => 10 * rows.len(),
            Self::Rational(rows) => 2 * rows.len(),
            Self::Schlick(_) | Self::Powf(_) | Self::Powers(_) => 0,
            Self::Linear(table) => table.values.len(),
        };
        words as u64 * u64::from(T::BITS)
    }

    #[inline(always)]
    fn over_block(&self, row: usize, xs: &[T], out: &mut [T]) {
        match self {
            Self::Cubic(rows) => one(&rows[row], xs, out),
            Self::Composite(rows) => one(&rows[row], xs, out),
            Self::Segments(rows) => one(&rows[row], xs, out),
            Self::Rational(rows) => one(&rows[row], xs, out),
            Self::Schlick(rows) => one(&rows[row], xs, out),
            Self::Powf(rows) => one(&rows[row], xs, out),
            Self::Powers(exponents) => powers_of_block(exponents[row], xs, out),
            Self::Linear(table) => one(&table.row(row), xs, out),
        }
    }

    #[inline(always)]
    fn over_mixture(&self, addresses: &[u32], xs: &[T], out: &mut [T]) {
        match self {
            Self::Cubic(rows) => many(rows, addresses, xs, out),
            Self::Composite(rows) => many(rows, addresses, xs, out),
            Self::Segments(rows) => many(rows, addresses, xs, out),
            Self::Rational(rows) => many(rows, addresses, xs, out),
            Self::Schlick(rows) => many(rows, addresses, xs, out),
            Self::Powf(rows) => many(rows, addresses, xs, out),
            Self::Powers(exponents) => powers_of_mixture(exponents, addresses, xs, out),
            Self::Linear(table) => {
                for ((&address, &x), out) in addresses.iter().zip(xs).zip(out) {
                    *out = table.row(address as usize).at(x);
                }
            }
        }
    }
}

#[inline(always)]
fn one<T: Real>(row: &impl ContenderRow<T>, xs: &[T], out: &mut [T]) {
    for (&x, out) in xs.iter().zip(out) {
        *out = row.at(x);
    }
}

/// The rows are fetched first, some at a time, so that what follows is a plain loop.
#[inline(always)]
fn many<T: Real, R: ContenderRow<T> + Copy>(rows: &[R], addresses: &[u32], xs: &[T], out: &mut [T]) {
    let chunks = addresses.chunks(LANES).zip(xs.chunks(LANES)).zip(out.chunks_mut(LANES));
    for ((addresses, xs), out) in chunks {
        let mut fetched = [rows[0]; LANES];
        for (fetched, &address) in fetched.iter_mut().zip(addresses) {
            *fetched = rows[address as usize];
        }
        for ((row, &x), out) in fetched.iter().zip(xs).zip(out) {
            *out = row.at(x);
        }
    }
}

/// The loop over the bits of n outside and that over samples inside, so that a compiler can put several
/// samples in one instruction. The same multiplications as one by one, so the same bits.
#[inline(always)]
fn powers_of_block<T: Real>(exponent: u32, xs: &[T], out: &mut [T]) {
    for (xs, out) in xs.chunks(LANES).zip(out.chunks_mut(LANES)) {
        let mut squares = [T::zero(); LANES];
        squares[..xs.len()].copy_from_slice(xs);
        out.fill(T::one());
        let mut remaining = exponent;
        loop {
            if remaining & 1 == 1 {
                for (power, &square) in out.iter_mut().zip(&squares) {
                    *power = *power * square;
                }
            }
            remaining >>= 1;
            if remaining == 0 {
                break;
            }
            squares = squares.map(|square| square * square);
        }
    }
}

/// The same where each sample has its own exponent: as many squarings as the greatest of some samples needs,
/// and a choice instead of a branch for each bit. The multiplications that count are the same.
#[inline(always)]
fn powers_of_mixture<T: Real>(exponents: &[u32], addresses: &[u32], xs: &[T], out: &mut [T]) {
    let chunks = addresses.chunks(LANES).zip(xs.chunks(LANES)).zip(out.chunks_mut(LANES));
    for ((addresses, xs), out) in chunks {
        let mut squares = [T::zero(); LANES];
        squares[..xs.len()].copy_from_slice(xs);
        let mut remaining = [0_u32; LANES];
        for (remaining, &address) in remaining.iter_mut().zip(addresses) {
            *remaining = exponents[address as usize];
        }
        out.fill(T::one());
        let mut any = remaining.iter().fold(0, |any, n| any | n);
        while any > 0 {
            for ((power, &square), remaining) in out.iter_mut().zip(&squares).zip(&mut remaining) {
                let next = *power * square;
                *power = if *remaining & 1 == 1 { next } else { *power };
                *remaining >>= 1;
            }
            squares = squares.map(|square| square * square);
            any >>= 1;
        }
    }
}

/// A kernel and its loops, compiled for the vector widths named here; the machine's own is chosen at run
/// time.
pub(super) trait Loops: Sized {
    /// One exponent for all.
    fn block(kernel: &Kernel<Self>, row: usize, xs: &[Self], out: &mut [Self]);
    /// An exponent for each.
    fn mixture(kernel: &Kernel<Self>, addresses: &[u32], xs: &[Self], out: &mut [Self]);
}

macro_rules! loops {
    ($real:ty) => {
        impl Loops for $real {
            fn block(kernel: &Kernel<Self>, row: usize, xs: &[Self], out: &mut [Self]) {
                #[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512dq+avx512vl"))]
                fn run(kernel: &Kernel<$real>, row: usize, xs: &[$real], out: &mut [$real]) {
                    kernel.over_block(row, xs, out);
                }
                run(kernel, row, xs, out);
            }
            fn mixture(kernel: &Kernel<Self>, addresses: &[u32], xs: &[Self], out: &mut [Self]) {
                #[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512dq+avx512vl"))]
                fn run(kernel: &Kernel<$real>, addresses: &[u32], xs: &[$real], out: &mut [$real]) {
                    kernel.over_mixture(addresses, xs, out);
                }
                run(kernel, addresses, xs, out);
            }
        }
    };
}
loops!(f32);
loops!(f64);
