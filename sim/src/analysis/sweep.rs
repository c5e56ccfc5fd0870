//! Hardware errors over many x: coefficients, data path and total, each with its greatest value and place.
//!
//! | error       | between                                      | over                              |
//! |-------------|----------------------------------------------|-----------------------------------|
//! | coefficient | ROM row and real row, as real functions      | all of \[0, 1\]                     |
//! | datapath    | integers of the pipeline and ROM row         | all of \[0, 1\]                     |
//! | total       | integers of the pipeline and x^n             | the epicentre, and all of \[0, 1\]  |
//!
//! x^n is taken at the representable x that the pipeline is given.

use hw_model::datapath::Block;
use hw_model::design::Design;
use hw_model::highlight::{phong, phong_at_s};
use multiversion::multiversion;

/// Samples that go through the pipeline together: their arrays stay in the first-level cache.
const BLOCK: usize = 1024;

/// A greatest error and the x (bits in the input format) where it occurs first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// As a fraction of full intensity.
    pub error: f64,
    /// Bits of x.
    pub x: i64,
}

impl Peak {
    const NONE: Self = Self { error: 0.0, x: 0 };

    /// Sees a block of errors. The place is only looked for when there is a new peak, which is rare.
    #[inline(always)]
    fn see(&mut self, errors: &[f64], xs: &[i64]) {
        let greatest = greatest(errors);
        if greatest > self.error
            && let Some(index) = errors.iter().position(|&error| error == greatest)
        {
            *self = Self { error: greatest, x: xs[index] };
        }
    }

    /// The greater of two peaks, the earlier one when they are equal.
    #[must_use]
    pub fn or(self, later: Self) -> Self {
        if later.error > self.error { later } else { self }
    }
}

/// The greatest errors of one row over the samples seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowErrors {
    /// ROM row against real row.
    pub coefficient: Peak,
    /// Pipeline against ROM row.
    pub datapath: Peak,
    /// Pipeline against real row: both of the above together, what the budget bounds.
    pub implementation: Peak,
    /// Pipeline against x^n on the epicentre.
    pub epicentre: Peak,
    /// Pipeline against x^n on all of [0, 1].
    pub full_range: Peak,
    /// Samples seen.
    pub samples: u64,
}

impl RowErrors {
    /// Nothing seen yet.
    pub const NONE: Self = Self {
        coefficient: Peak::NONE,
        datapath: Peak::NONE,
        implementation: Peak::NONE,
        epicentre: Peak::NONE,
        full_range: Peak::NONE,
        samples: 0,
    };

    /// Errors over the samples of both; `later` has the greater x.
    #[must_use]
    pub fn and(self, later: Self) -> Self {
        Self {
            coefficient: self.coefficient.or(later.coefficient),
            datapath: self.datapath.or(later.datapath),
            implementation: self.implementation.or(later.implementation),
            epicentre: self.epicentre.or(later.epicentre),
            full_range: self.full_range.or(later.full_range),
            samples: self.samples + later.samples,
        }
    }
}

/// Sweeps one row over these x, in rising order, each in [0, 1].
#[must_use]
pub fn sweep_row(design: &Design, address: u32, xs: impl Iterator<Item = i64>) -> RowErrors {
    let mut sweep = Sweep::new(design, address);
    let mut errors = RowErrors::NONE;
    let mut block = Vec::with_capacity(BLOCK);
    let mut xs = xs.peekable();
    while xs.peek().is_some() {
        block.clear();
        block.extend(xs.by_ref().take(BLOCK));
        see(&mut sweep, &block, &mut errors);
    }
    errors
}

/// The greatest of some errors, none of them negative; 0 for none. Eight at a time, because a compiler
/// may not reorder a maximum of floating-point numbers by itself.
#[inline(always)]
fn greatest(errors: &[f64]) -> f64 {
    let more = |a: f64, b: f64| if a > b { a } else { b };
    let (eights, rest) = errors.as_chunks::<8>();
    let lanes = eights.iter().fold([0.0; 8], |greatest: [f64; 8], errors| {
        std::array::from_fn(|lane| more(greatest[lane], errors[lane]))
    });
    lanes.into_iter().chain(rest.iter().copied()).fold(0.0, more)
}

/// Compiled for the vector widths named here, the machine's own chosen at run time. Rust never fuses or
/// reorders floating-point operations, so the results are the same in all of them.
#[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512dq+avx512vl"))]
fn see(sweep: &mut Sweep<'_>, xs: &[i64], errors: &mut RowErrors) {
    sweep.see(xs, errors);
}

struct Sweep<'a> {
    design: &'a Design,
    address: u32,
    epicentre: i64,
    block: Block,
    powers: Powers,
    hardware: Vec<f64>,
    rom: Vec<f64>,
    ideal: Vec<f64>,
    errors: Vec<f64>,
}

impl<'a> Sweep<'a> {
    fn new(design: &'a Design, address: u32) -> Self {
        Self {
            design,
            address,
            epicentre: design.rows()[address as usize].first_of_epicentre(design.config()),
            block: Block::default(),
            powers: Powers::default(),
            hardware: Vec::new(),
            rom: Vec::new(),
            ideal: Vec::new(),
            errors: Vec::new(),
        }
    }

    #[inline(always)]
    fn see(&mut self, xs: &[i64], errors: &mut RowErrors) {
        self.evaluate(xs);
        difference(&self.rom, &self.ideal, &mut self.errors);
        errors.coefficient.see(&self.errors, xs);
        difference(&self.hardware, &self.rom, &mut self.errors);
        errors.datapath.see(&self.errors, xs);
        difference(&self.hardware, &self.ideal, &mut self.errors);
        errors.implementation.see(&self.errors, xs);
        self.see_total(xs, errors);
        errors.samples += xs.len() as u64;
    }

    /// Evaluates the pipeline and both real functions at every x. x rises, so that each part of the
    /// block lies on one side of the cut. Bits and x have at most 53 bits in every format of use, and
    /// then become an f64 exactly; wider ones round in the 53rd bit.
    #[inline(always)]
    fn evaluate(&mut self, xs: &[i64]) {
        let config = self.design.config();
        let row = &self.design.rows()[self.address as usize];
        let rom_row = self.design.rom_row(self.address);
        self.design.datapath().evaluate_block(self.address, xs, &mut self.block);
        let output_ulp = config.output.ulp();
        self.hardware.clear();
        self.hardware.extend(self.block.intensities.iter().map(|&bits| bits as f64 * output_ulp));

        let (one, ulp) = (config.input.one(), config.input.ulp());
        let s = |&x: &i64| (one - x) as f64 * ulp;
        self.rom.clear();
        self.ideal.clear();
        let (below, above) = xs.split_at(xs.partition_point(|&x| x < row.cut));
        for (xs, above_cut) in [(below, false), (above, true)] {
            self.rom.extend(xs.iter().map(|x| rom_row.value_at_s(s(x), above_cut)));
            self.ideal.extend(xs.iter().map(|x| row.value_at_s(s(x), above_cut)));
        }
    }

    /// Against x^n. The estimates spare the reference wherever it could not make a new peak.
    #[inline(always)]
    fn see_total(&mut self, xs: &[i64], errors: &mut RowErrors) {
        let ulp = self.design.config().input.ulp();
        let exponent = self.design.rows()[self.address as usize].exponent;
        let slack = self.powers.estimate(exponent, xs, ulp);
        difference(&self.hardware, &self.powers.estimates, &mut self.errors);
        let first = xs.partition_point(|&x| x < self.epicentre);
        for (range, peak) in
            [(0..xs.len(), &mut errors.full_range), (first..xs.len(), &mut errors.epicentre)]
        {
            let greatest = greatest(&self.errors[range.clone()]);
            if greatest + slack <= peak.error {
                continue;
            }
            // The greatest exact error is among those whose estimates come within twice the slack.
            for index in range {
                if self.errors[index] + slack >= greatest - slack {
                    let exact = phong(exponent, xs[index] as f64 * ulp);
                    let error = (self.hardware[index] - exact).abs();
                    *peak = peak.or(Peak { error, x: xs[index] });
                }
            }
        }
    }
}

#[inline(always)]
fn difference(left: &[f64], right: &[f64], errors: &mut Vec<f64>) {
    errors.clear();
    errors.extend(left.iter().zip(right).map(|(left, right)| (left - right).abs()));
}

/// Quick estimates of x^n for a block of samples, to see which of them need the reference.
#[derive(Default)]
pub(super) struct Powers {
    pub estimates: Vec<f64>,
    squares: Vec<f64>,
}

impl Powers {
    /// Fills `estimates` with x^n and returns how far each may be off.
    ///
    /// Integer n: by squaring, all samples together. k multiplications in a row have a relative error
    /// of k·2^−53, and squaring doubles what is there, so x^n is off by at most n·2^−52 (x^n ≤ 1).
    /// Other n: the reference itself, exact.
    #[inline(always)]
    pub fn estimate(&mut self, exponent: f64, xs: &[i64], ulp: f64) -> f64 {
        const GREATEST: f64 = 65_536.0;
        self.squares.clear();
        self.squares.extend(xs.iter().map(|&x| x as f64 * ulp));
        self.estimates.clear();
        if exponent.fract() != 0.0 || exponent > GREATEST {
            self.estimates.extend(self.squares.iter().map(|&x| phong(exponent, x)));
            return 0.0;
        }
        self.estimates.resize(xs.len(), 1.0);
        let mut remaining = exponent as u32;
        loop {
            if remaining & 1 == 1 {
                for (power, square) in self.estimates.iter_mut().zip(&self.squares) {
                    *power *= square;
                }
            }
            remaining >>= 1;
            if remaining == 0 {
                return exponent * f64::EPSILON;
            }
            for square in &mut self.squares {
                // Far below any slack, and a subnormal factor would take a hundred cycles.
                let negligible = *square < 1e-100;
                *square = if negligible { 0.0 } else { *square * *square };
            }
        }
    }
}

/// The error of rounding a real x to the input format, at its worst: x^n is steepest at x = 1, where
/// half an ulp h costs 1 − (1 − h)^n. It is conditioning, not a fault of the pipeline.
#[must_use]
pub fn input_quantisation(design: &Design, exponent: f64) -> f64 {
    let half_ulp = 0.5 * design.config().input.ulp();
    1.0 - phong_at_s(exponent, half_ulp)
}
