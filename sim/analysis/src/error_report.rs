//! The error of every exponent, its parts apart, and the verdict against a bound.
//!
//! **Samples.** Exhaustive: every representable x in [0, 1]. Otherwise, for each exponent: the corners
//! of the vectors (0, 1, one ulp beside 0, q, cut and 1, worst-error points, ties, register extremes),
//! [`SPREAD`] points spread evenly over the epicentre, as many over [0, 1], and the last
//! [`NEAREST`] x below 1.

use hw_model::config::{Config, Cut};
use hw_model::design::{Design, RealRow};
use hw_model::fit::{FitError, fit};
use rayon::prelude::*;
use serde::Serialize;
use vectors::progress::Progress;
use vectors::stimulus::corners::Corners;

use super::approximation::{ApproximationError, Extent, approximation};
use super::pieces::{Piece, Pieces};
use super::sweep::{RowErrors, Xs, input_quantisation, sweep_row};

/// Points spread evenly over the epicentre, and again over [0, 1].
pub const SPREAD: i64 = 2048;
/// x just below 1, every one of them.
pub const NEAREST: i64 = 64;
/// x of an exhaustive sweep that make one piece of work for a thread.
const PIECE: i64 = 1 << 18;

/// What an error report measures, and against which bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// The total error on the epicentre must not exceed this fraction of full intensity.
    pub bound: f64,
    /// True for every representable x, false for corners and an even spread.
    pub exhaustive: bool,
}

/// The errors of one exponent, as fractions of full intensity (not per cent).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ErrorRow {
    /// The exponent of the row, 1 or more.
    pub n: f64,
    /// max |f − x^n| on the epicentre, the method alone, over the continuous x.
    pub approximation_abs: f64,
    /// max |f/x^n − 1| on the epicentre.
    pub approximation_rel: f64,
    /// Where the absolute one is.
    pub approximation_x: f64,
    /// Quantised coefficients against real ones, on all of [0, 1].
    pub coefficient_abs: f64,
    /// The x at which `coefficient_abs` is reached, 0 to 1; for people, and in no file.
    #[serde(skip)]
    pub coefficient_x: f64,
    /// The integer pipeline against the ROM's function, on all of [0, 1].
    pub datapath_abs: f64,
    /// The x at which `datapath_abs` is reached, 0 to 1; for people, and in no file.
    #[serde(skip)]
    pub datapath_x: f64,
    /// Rounding a real x to the input format, at its worst.
    pub input_abs: f64,
    /// The pipeline against x^n at representable x, on the epicentre.
    pub total_abs: f64,
    /// The x at which `total_abs` is reached, 0 to 1.
    pub total_x: f64,
    /// The same on all of [0, 1].
    pub full_range_abs: f64,
    /// The x at which `full_range_abs` is reached, 0 to 1.
    pub full_range_x: f64,
    /// total_abs is within the bound.
    pub holds: bool,
    /// full_range_abs is within the bound.
    pub full_range_holds: bool,
}

/// The errors of every exponent.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ErrorReport {
    /// The name of the configuration.
    pub configuration: String,
    /// The bound that the verdict is against.
    pub bound: f64,
    /// Every representable x was seen.
    pub exhaustive: bool,
    /// Samples seen, all exponents together.
    pub samples: u64,
    /// Coefficients and data path together, the worst of all samples, in output ulp.
    pub implementation_ulp: f64,
    /// What they may reach, in output ulp.
    pub budget_ulp: f64,
    /// One for each exponent.
    pub rows: Vec<ErrorRow>,
}

/// Measures every exponent. Rows and pieces go to all threads; the result does not depend on their number.
///
/// # Errors
/// When an exponent is out of range, which a design does not have.
pub fn error_report(design: &Design, options: Options, progress: &dyn Progress) -> Result<ErrorReport, FitError> {
    let errors = if options.exhaustive { sweep_everything(design, progress) } else { sweep_samples(design, progress) };
    report_of(design, options, &errors)
}

/// The report of errors that were measured already, a [`RowErrors`] for each row of the design.
///
/// # Errors
/// As [`error_report`].
pub fn report_of(design: &Design, options: Options, errors: &[RowErrors]) -> Result<ErrorReport, FitError> {
    let rows = design
        .rows()
        .par_iter()
        .zip(errors)
        .map(|(row, errors)| error_row(design, row.exponent, errors, options.bound))
        .collect::<Result<Vec<_>, _>>()?;
    let worst = errors.iter().map(|row| row.implementation.error).fold(0.0, f64::max);
    Ok(ErrorReport {
        configuration: design.config().name.clone(),
        bound: options.bound,
        exhaustive: options.exhaustive,
        samples: errors.iter().map(|row| row.samples).sum(),
        implementation_ulp: worst / design.config().output.ulp(),
        budget_ulp: design.config().error_budget_ulp,
        rows,
    })
}

impl ErrorReport {
    /// The row with the greatest total error on the epicentre.
    #[must_use]
    pub fn worst(&self) -> Option<&ErrorRow> {
        self.rows.iter().reduce(|worst, row| if row.total_abs > worst.total_abs { row } else { worst })
    }

    /// The row with the greatest error on all of [0, 1].
    #[must_use]
    pub fn worst_full_range(&self) -> Option<&ErrorRow> {
        let greater = |row: &ErrorRow, worst: &ErrorRow| row.full_range_abs > worst.full_range_abs;
        self.rows.iter().reduce(|worst, row| if greater(row, worst) { row } else { worst })
    }

    /// The bound holds for every exponent.
    #[must_use]
    pub fn holds(&self) -> bool {
        !self.rows.is_empty() && self.rows.iter().all(|row| row.holds)
    }
}

/// The pieces of an exhaustive report. Errors of the pieces of a row, put together in their order by
/// [`RowErrors::and`], are the errors of the row.
#[must_use]
pub fn pieces(design: &Design) -> Pieces {
    Pieces::new(design, PIECE)
}

/// The errors of one of [`pieces`].
#[must_use]
pub fn sweep_piece(design: &Design, piece: Piece) -> RowErrors {
    sweep_row(design, piece.address, Xs::Run { first: piece.first, last: piece.last })
}

fn sweep_everything(design: &Design, progress: &dyn Progress) -> Vec<RowErrors> {
    let pieces = pieces(design);
    let swept: Vec<RowErrors> = (0..pieces.count())
        .into_par_iter()
        .map(|index| {
            let errors = sweep_piece(design, pieces.at(index));
            progress.advance(errors.samples);
            errors
        })
        .collect();
    swept
        .chunks(pieces.per_row() as usize)
        .map(|pieces| pieces.iter().fold(RowErrors::NONE, |sum, piece| sum.and(*piece)))
        .collect()
}

fn sweep_samples(design: &Design, progress: &dyn Progress) -> Vec<RowErrors> {
    corners(design)
        .into_par_iter()
        .enumerate()
        .map(|(address, corners)| {
            let xs = samples(design, &design.rows()[address], corners);
            let errors = sweep_row(design, address as u32, Xs::List(&xs));
            progress.advance(errors.samples);
            errors
        })
        .collect()
}

/// The x of the corners of every row. The rest of the samples is some thousands for each row, and is made row by row.
fn corners(design: &Design) -> Vec<Vec<i64>> {
    let greatest = design.datapath().front_end().greatest;
    let mut rows = vec![Vec::new(); design.rows().len()];
    for sample in Corners::new(design, u64::MAX).samples() {
        if let Some(xs) = rows.get_mut(sample.case.address as usize)
            && (0..=greatest).contains(&sample.case.x)
        {
            xs.push(sample.case.x);
        }
    }
    rows
}

/// The samples of a row, in rising order, with the corners that it has.
fn samples(design: &Design, row: &RealRow, corners: Vec<i64>) -> Vec<i64> {
    let greatest = design.datapath().front_end().greatest;
    let spread = |from: i64, count: i64| {
        let span = i128::from(greatest - from);
        (0..=count).map(move |i| from + (span * i128::from(i) / i128::from(count)) as i64)
    };
    let epicentre = row.first_of_epicentre(design.config()).min(greatest);
    let nearest = (greatest - NEAREST).max(0)..=greatest;
    let mut xs = corners;
    xs.extend(spread(0, SPREAD).chain(spread(epicentre, SPREAD)).chain(nearest));
    xs.sort_unstable();
    xs.dedup();
    xs
}

/// The epicentre's error where the ends of the segments are part of the fit: each segment by itself, as
/// they meet in a kink. None for a row of one segment of a given range.
fn of_segments(config: &Config, row: &RealRow) -> Option<ApproximationError> {
    let (first, further) = row.segments.split_first()?;
    if config.segments == 1 && config.cut != Cut::Balanced {
        return None;
    }
    let end = row.epicentre;
    // Where each ends, from x = 1 downwards; the last ends with the epicentre.
    let ends = further.iter().map(|segment| segment.polynomial.start.min(end)).chain([end]);
    let mut start = 0.0;
    let mut found: Option<ApproximationError> = None;
    for (segment, stop) in std::iter::once(first).chain(further).zip(ends) {
        if start < stop || found.is_none() {
            let region = Extent { s_low: start, s_high: stop };
            let of_segment = approximation(&segment.polynomial, row.exponent, region);
            found = Some(found.map_or(of_segment, |found| found.or(of_segment)));
        }
        start = stop;
    }
    found
}

fn error_row(design: &Design, exponent: f64, errors: &RowErrors, bound: f64) -> Result<ErrorRow, FitError> {
    let config = design.config();
    // A design's levels were checked when it was made.
    let fit = fit(config.method, exponent, config.levels().unwrap_or_default())?;
    let fitted = design.rows().iter().find(|row| row.exponent == exponent).and_then(|row| of_segments(config, row));
    let method = fitted.unwrap_or_else(|| approximation(&fit, exponent, Extent::epicentre(&fit)));
    let x = |bits: i64| hw_model::quantise::real(bits, config.input);
    Ok(ErrorRow {
        n: exponent,
        approximation_abs: method.absolute.error,
        approximation_rel: method.relative.map_or(f64::NAN, |peak| peak.error),
        approximation_x: method.absolute.x(),
        coefficient_abs: errors.coefficient.error,
        coefficient_x: x(errors.coefficient.x),
        datapath_abs: errors.datapath.error,
        datapath_x: x(errors.datapath.x),
        input_abs: input_quantisation(design, exponent),
        total_abs: errors.epicentre.error,
        total_x: x(errors.epicentre.x),
        full_range_abs: errors.full_range.error,
        full_range_x: x(errors.full_range.x),
        holds: errors.epicentre.error <= bound,
        full_range_holds: errors.full_range.error <= bound,
    })
}
