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
use serde::{Deserialize, Serialize};

/// Samples that go through the pipeline together: their arrays stay in the first-level cache.
const BLOCK: usize = 1024;

/// A greatest error and the x (bits in the input format) where it occurs first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Peak {
    /// As a fraction of full intensity.
    pub error: f64,
    /// The x where, as bits in the input format.
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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
    /// The number of samples seen.
    pub samples: u64,
}

impl RowErrors {
    /// The errors of no sample at all.
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

/// The x of a sweep, in rising order, each in [0, 1].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Xs<'a> {
    /// Every one from `first` to `last`.
    Run {
        /// The least x of the run.
        first: i64,
        /// The greatest x of the run.
        last: i64,
    },
    /// The x of this list and no others.
    List(&'a [i64]),
}

impl Xs<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Run { first, last } => usize::try_from(last - first + 1).unwrap_or(0),
            Self::List(xs) => xs.len(),
        }
    }

    fn blocks(&self) -> usize {
        self.len().div_ceil(BLOCK)
    }

    /// Puts the x of one block into `xs`.
    fn fill(&self, block: usize, xs: &mut Vec<i64>) {
        let places = block * BLOCK..self.len().min((block + 1) * BLOCK);
        xs.clear();
        match self {
            Self::Run { first, .. } => {
                xs.extend(places.map(|place| first + place as i64));
            }
            Self::List(list) => xs.extend_from_slice(&list[places]),
        }
    }
}

/// Sweeps one row over these x.
///
/// Every block is seen with an estimate of x^n. Then those blocks that may hold the greatest total error are
/// seen again, with the reference itself at each x that may be the place.
#[must_use]
pub fn sweep_row(design: &Design, address: u32, xs: Xs<'_>) -> RowErrors {
    let mut sweep = Sweep::new(design, address);
    let mut errors = RowErrors { samples: xs.len() as u64, ..RowErrors::NONE };
    let mut block = Vec::with_capacity(BLOCK);
    let totals: Vec<Totals> = (0..xs.blocks())
        .map(|index| {
            xs.fill(index, &mut block);
            see(&mut sweep, &block, &mut errors)
        })
        .collect();
    let floors = Totals::floors(&totals);
    for (index, total) in totals.iter().enumerate() {
        if total.reach(floors) {
            xs.fill(index, &mut block);
            settle(&mut sweep, &block, floors, &mut errors);
        }
    }
    errors
}

/// The greatest of some errors, none of them negative; 0 for none. Eight at a time, because a compiler
/// may not reorder a maximum of floating-point numbers by itself.
#[inline(always)]
fn greatest(errors: &[f64]) -> f64 {
    let more = |a: f64, b: f64| if a > b { a } else { b };
    let (eights, rest) = errors.as_chunks::<8>();
    let lanes = eights
        .iter()
        .fold([0.0; 8], |greatest: [f64; 8], errors| std::array::from_fn(|lane| more(greatest[lane], errors[lane])));
    lanes.into_iter().chain(rest.iter().copied()).fold(0.0, more)
}

/// Compiled for the vector widths named here; the first that the machine has is chosen at run time. Rust never fuses or
/// reorders floating-point operations, so the results are the same in all of them.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn see(sweep: &mut Sweep<'_>, xs: &[i64], errors: &mut RowErrors) -> Totals {
    sweep.see(xs, errors)
}

/// Looks at a block again where its greatest errors can be, after [`see`] has estimated them.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn settle(sweep: &mut Sweep<'_>, xs: &[i64], floors: [f64; 2], errors: &mut RowErrors) {
    sweep.settle(xs, floors, errors);
}

/// What is known of the total errors of a block: on all of it, and on the part of it on the epicentre.
#[derive(Debug, Clone, Copy)]
struct Totals {
    /// The greatest estimates, on the whole block and on its part in the epicentre.
    greatest: [f64; 2],
    /// How far an estimate may be off.
    slack: f64,
}

/// Errors below this are none: x^n may be taken as 0 where it is less. No output has such an ulp, and the peak of
/// a row is the error at some x where either the hardware or x^n shows something.
const NEGLIGIBLE: f64 = 1e-60;

/// Stands for the greatest error of no samples.
const NOWHERE: f64 = -1.0;

impl Totals {
    /// What the greatest exact errors of all blocks reach at least.
    fn floors(totals: &[Self]) -> [f64; 2] {
        [0, 1].map(|part| {
            let floors = totals.iter().map(|total| total.greatest[part] - total.slack);
            floors.fold(NEGLIGIBLE, f64::max)
        })
    }

    fn reach(&self, floors: [f64; 2]) -> bool {
        self.greatest.iter().zip(floors).any(|(greatest, floor)| greatest + self.slack >= floor)
    }
}

/// The arrays of a block; a constant length, and each in a place of its own.
struct Sweep<'a> {
    design: &'a Design,
    address: u32,
    epicentre: i64,
    block: Block,
    intensities: [i64; BLOCK],
    hardware: [f64; BLOCK],
    rom: [f64; BLOCK],
    ideal: [f64; BLOCK],
    powers: [f64; BLOCK],
    errors: [f64; BLOCK],
}

impl<'a> Sweep<'a> {
    fn new(design: &'a Design, address: u32) -> Self {
        Self {
            design,
            address,
            epicentre: design.rows()[address as usize].first_of_epicentre(design.config()),
            block: Block::default(),
            intensities: [0; BLOCK],
            hardware: [0.0; BLOCK],
            rom: [0.0; BLOCK],
            ideal: [0.0; BLOCK],
            powers: [0.0; BLOCK],
            errors: [0.0; BLOCK],
        }
    }

    #[inline(always)]
    fn see(&mut self, xs: &[i64], errors: &mut RowErrors) -> Totals {
        let len = xs.len();
        self.evaluate(xs);
        self.real_rows(xs);
        let Self { hardware, rom, ideal, errors: differences, .. } = self;
        let (hardware, rom, ideal) = (&hardware[..len], &rom[..len], &ideal[..len]);
        let differences = &mut differences[..len];
        difference(rom, ideal, differences);
        errors.coefficient.see(differences, xs);
        difference(hardware, rom, differences);
        errors.datapath.see(differences, xs);
        difference(hardware, ideal, differences);
        errors.implementation.see(differences, xs);
        self.totals(xs)
    }

    /// The pipeline at every x. Bits have at most 53 bits in every format of use, and then become an f64
    /// exactly; wider ones round in the 53rd bit.
    #[inline(always)]
    fn evaluate(&mut self, xs: &[i64]) {
        let Some((&first, &last)) = xs.first().zip(xs.last()) else {
            return;
        };
        let output_ulp = self.design.config().output.ulp();
        let intensities = if last - first == xs.len() as i64 - 1 {
            let run = &mut self.intensities[..xs.len()];
            self.design.datapath().evaluate_run(self.address, first, run);
            &*run
        } else {
            self.design.datapath().evaluate_block(self.address, xs, &mut self.block);
            self.block.intensities.as_slice()
        };
        for (hardware, &bits) in self.hardware.iter_mut().zip(intensities.iter()) {
            *hardware = bits as f64 * output_ulp;
        }
    }

    /// Both real functions at every x. x rises, so that each part of the block lies on one side of the cut.
    #[inline(always)]
    fn real_rows(&mut self, xs: &[i64]) {
        let config = self.design.config();
        let row = &self.design.rows()[self.address as usize];
        let rom_row = self.design.rom_row(self.address);
        let (one, ulp) = (config.input.one(), config.input.ulp());
        let mut done = xs.partition_point(|&x| x < row.cut);
        let places = xs[..done].iter().zip(self.rom.iter_mut().zip(&mut self.ideal));
        for (&x, (rom, ideal)) in places {
            let s = (one - x) as f64 * ulp;
            *rom = rom_row.value_at_s(s, false);
            *ideal = row.value_at_s(s, false);
        }
        // Of each segment, the furthest first, what lies below its start: one polynomial in a loop without a choice.
        for (index, real) in row.segments.iter().enumerate().rev() {
            let below = xs.partition_point(|&x| index == 0 || x < real.start);
            let (Some(rom_segment), true) = (rom_row.segment(index), below > done) else {
                continue;
            };
            let (rom, ideal) = (&mut self.rom[done..below], &mut self.ideal[done..below]);
            for (&x, (rom, ideal)) in xs[done..below].iter().zip(rom.iter_mut().zip(ideal)) {
                let s = (one - x) as f64 * ulp;
                *rom = rom_segment.value_at_s(s).clamp(0.0, 1.0);
                *ideal = real.polynomial.value_at_s(s).clamp(0.0, 1.0);
            }
            done = below;
        }
        // What has no polynomial, above its cut.
        let places = xs[done..].iter().zip(self.rom[done..].iter_mut().zip(&mut self.ideal[done..]));
        for (&x, (rom, ideal)) in places {
            let s = (one - x) as f64 * ulp;
            *rom = rom_row.value_at_s(s, true);
            *ideal = row.value_at_s(s, true);
        }
    }

    /// Estimates of the errors against x^n.
    #[inline(always)]
    fn totals(&mut self, xs: &[i64]) -> Totals {
        let config = self.design.config();
        let exponent = self.design.rows()[self.address as usize].exponent;
        let powers = &mut self.powers[..xs.len()];
        let relative = estimate(exponent, xs, config.input.ulp(), powers);
        let top = powers.last().copied().unwrap_or(0.0);
        let errors = &mut self.errors[..xs.len()];
        difference(&self.hardware[..xs.len()], powers, errors);
        let first = xs.partition_point(|&x| x < self.epicentre);
        let on_epicentre = if first < xs.len() { greatest(&errors[first..]) } else { NOWHERE };
        let greatest = [greatest(errors), on_epicentre];
        let slack = slack(relative, top, greatest[0], config.output.ulp());
        Totals { greatest, slack }
    }

    /// The exact errors wherever one could be the greatest.
    #[inline(always)]
    fn settle(&mut self, xs: &[i64], floors: [f64; 2], errors: &mut RowErrors) {
        self.evaluate(xs);
        let totals = self.totals(xs);
        let ulp = self.design.config().input.ulp();
        let exponent = self.design.rows()[self.address as usize].exponent;
        let first = xs.partition_point(|&x| x < self.epicentre);
        let peaks = [&mut errors.full_range, &mut errors.epicentre];
        for (range, (floor, peak)) in [0..xs.len(), first..xs.len()].into_iter().zip(floors.into_iter().zip(peaks)) {
            for index in range {
                if self.errors[index] + totals.slack >= floor {
                    let error = match totals.slack {
                        0.0 => self.errors[index],
                        _ => (self.hardware[index] - phong(exponent, xs[index] as f64 * ulp)).abs(),
                    };
                    *peak = peak.or(Peak { error, x: xs[index] });
                }
            }
        }
    }
}

/// How far the estimate of an error of a block may be off its exact value, both rounded to f64: x^n by its
/// relative error, at most what it is of the last and greatest; and the two differences by half of an ulp each.
///
/// Where x^n is so small that the hardware's multiple of `output_ulp` swallows it, the differences are that
/// multiple itself, however x^n is off: they are exact, unless the hardware shows 0 in all of the block.
fn slack(relative: f64, top: f64, greatest: f64, output_ulp: f64) -> f64 {
    if top < output_ulp * (-56_f64).exp2() && greatest >= output_ulp {
        return 0.0;
    }
    top * relative + greatest * f64::EPSILON
}

#[inline(always)]
fn difference(left: &[f64], right: &[f64], errors: &mut [f64]) {
    for ((error, left), right) in errors.iter_mut().zip(left).zip(right) {
        *error = (left - right).abs();
    }
}

/// Puts estimates of x^n into `powers`, and returns their greatest relative error; those below [`NEGLIGIBLE`] may
/// be 0.
///
/// Integer n: by squaring, all samples together. k multiplications in a row have a relative error
/// of k·2^−53, and squaring doubles what is there, so x^n is off by at most n·2^−52 of itself.
/// Other n: the reference itself, exact.
#[inline(always)]
pub(super) fn estimate(exponent: f64, xs: &[i64], ulp: f64, powers: &mut [f64]) -> f64 {
    const GREATEST: f64 = 65_536.0;
    // x rises: the last power is the greatest. The factor is far more than an error of powi.
    let last = xs.last().map_or(0.0, |&x| x as f64 * ulp);
    if last.powf(exponent) < NEGLIGIBLE / 1e3 {
        powers.fill(0.0);
        return 0.0;
    }
    if exponent.fract() != 0.0 || exponent > GREATEST {
        for (power, &x) in powers.iter_mut().zip(xs) {
            *power = phong(exponent, x as f64 * ulp);
        }
        return 0.0;
    }
    let exponent = exponent as u32;
    for (powers, xs) in powers.chunks_mut(POWERS).zip(xs.chunks(POWERS)) {
        let mut squares = [0.0; POWERS];
        for (square, &x) in squares.iter_mut().zip(xs) {
            *square = x as f64 * ulp;
        }
        powers.copy_from_slice(&by_squaring(exponent, squares)[..powers.len()]);
    }
    f64::from(exponent) * f64::EPSILON
}

/// Powers computed together: as many as stay in registers.
const POWERS: usize = 64;

#[inline(always)]
fn by_squaring(exponent: u32, mut squares: [f64; POWERS]) -> [f64; POWERS] {
    let mut powers = [1.0; POWERS];
    let mut remaining = exponent;
    loop {
        if remaining & 1 == 1 {
            for (power, square) in powers.iter_mut().zip(&squares) {
                *power *= square;
            }
        }
        remaining >>= 1;
        if remaining == 0 {
            return powers;
        }
        for square in &mut squares {
            // Far below NEGLIGIBLE, and a subnormal factor would take a hundred cycles.
            *square = if *square < 1e-100 { 0.0 } else { *square * *square };
        }
    }
}

/// The error of rounding a real x to the input format, at its worst: x^n is steepest at x = 1, where
/// half an ulp h costs 1 − (1 − h)^n. It is conditioning, not a fault of the pipeline.
#[must_use]
pub(crate) fn input_quantisation(design: &Design, exponent: f64) -> f64 {
    let half_ulp = 0.5 * design.config().input.ulp();
    1.0 - phong_at_s(exponent, half_ulp)
}
