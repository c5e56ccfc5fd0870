//! The bound of a configuration as bits, found by the exhaustive sweep.
//!
//! Not by the sum of approximation, coefficient and data-path error, which is above the truth by what
//! these three cancel. The reference is x^n correctly rounded, off by half an ulp of a number that is at
//! most 1: 2⁻⁵⁴. The difference of two f64 is rounded to the nearest as well, by at most 2⁻⁵⁴ again. So
//! the greatest of all differences that the sweep computes, and 2⁻⁵³, is not less than the greatest error.
//! (Where the sweep spares the reference, it does so for points that cannot exceed what was seen; it is not
//! believed: the checker in `bounds` looks at every x again, in another way.)

use bounds::certify::hardware::{HardwareClaim, HardwareError, HardwareRow, Worst, least_error, overall, points};
use hw_model::design::Design;
use vectors::progress::Progress;

use super::error_report::{ErrorReport, ErrorRow, Options, error_report};

/// More than what the sweep's errors can be short of the truth, 2⁻⁵³, by as much again: the checker's
/// enclosures of a power reach to both its neighbours.
const SWEEP_ERROR: f64 = f64::EPSILON;

/// The report that a claim is made of. The bound decides about nothing in it.
pub const OPTIONS: Options = Options { bound: 1.0, exhaustive: true };

/// Sweeps the whole configuration.
///
/// # Errors
/// When there can be no certificate.
pub fn certify_hardware(design: &Design, progress: &dyn Progress) -> Result<HardwareClaim, HardwareError> {
    points(design)?;
    claim_of(design, &error_report(design, OPTIONS, progress)?)
}

/// The claim of a configuration whose exhaustive report was made already, with [`OPTIONS`].
///
/// # Errors
/// As [`certify_hardware`].
pub fn claim_of(design: &Design, report: &ErrorReport) -> Result<HardwareClaim, HardwareError> {
    let points = points(design)?;
    let rows: Vec<HardwareRow> =
        (0..).zip(&report.rows).map(|(address, row)| hardware_row(design, address, row)).collect();
    Ok(HardwareClaim {
        configuration: design.config().clone(),
        points,
        epicentre: overall(&rows, |row| row.epicentre).ok_or(HardwareError::NoRow)?,
        full_range: overall(&rows, |row| row.full_range).ok_or(HardwareError::NoRow)?,
        rows,
    })
}

fn hardware_row(design: &Design, address: u32, row: &ErrorRow) -> HardwareRow {
    let ulp = design.config().input.ulp();
    let worst = |error: f64, x: f64| {
        // x is bits·ulp, and ulp a power of two.
        let x = (x / ulp) as i64;
        let output = design.datapath().evaluate(address, x).intensity;
        let lower = least_error(design, row.n, x, output);
        Worst { lower, upper: (error + SWEEP_ERROR).next_up().max(lower), x, output }
    };
    HardwareRow {
        n: row.n,
        epicentre_from: design.rows()[address as usize].first_of_epicentre(design.config()),
        epicentre: worst(row.total_abs, row.total_x),
        full_range: worst(row.full_range_abs, row.full_range_x),
    }
}
