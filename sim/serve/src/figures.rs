//! What a design errs, and what it costs.

use analysis::error_report::{ErrorReport, Options, error_report};
use analysis::hardware_cost::HardwareCost;
use hw_model::design::Design;
use hw_model::stated;
use serde::Serialize;
use std::sync::atomic::AtomicU64;

use crate::refusal::Refusal;
use crate::words::Real;

/// What a design errs, and what it costs.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Figures {
    /// The budget of coefficients and data path, in output ulp.
    budget_ulp: Real,
    /// What they are proved to stay within.
    proved_ulp: Real,
    /// The most they were measured to be.
    measured_ulp: Real,
    /// The total error on the epicentre, where it is greatest.
    epicentre: Peak,
    /// The total error on all of [0, 1], where it is greatest.
    everywhere: Peak,
    /// The x of all exponents that were measured.
    samples: u64,
    /// Clock cycles from a request to its result.
    latency: u64,
    /// Partial-product bits of all multipliers.
    multiplier_bits: u64,
    /// Bits of the ROM.
    rom_bits: u64,
    /// The widths of the registers whose formats can be stated, summed.
    register_bits: u64,
    /// What each register adds to the bound.
    shares: Vec<Share>,
}

/// A greatest error.
#[derive(Debug, Clone, Serialize)]
struct Peak {
    /// In per cent of full intensity.
    per_cent: Real,
    /// The exponent of the row where it is.
    n: Real,
    /// The x where it is.
    x: Real,
}

/// What a register adds to the bound.
#[derive(Debug, Clone, Serialize)]
struct Share {
    register: &'static str,
    /// In output ulp, in the row where it is most.
    ulp: Real,
}

impl Peak {
    fn new(error: f64, n: f64, x: f64) -> Self {
        Self { per_cent: Real::new(error * 100.0, 4), n: Real::new(n, 17), x: Real::new(x, 12) }
    }
}

impl Figures {
    /// Measures a design on the samples of `blysk report`.
    ///
    /// # Errors
    /// When the report has no row, which no design brings about.
    pub(crate) fn of(design: &Design) -> Result<Self, Refusal> {
        // The figures are shown whatever they are: no bound is asked about.
        let options = Options { bound: 1.0, exhaustive: false };
        let report = error_report(design, options, &AtomicU64::new(0)).map_err(Refusal::own)?;
        let (epicentre, everywhere) = peaks(&report).ok_or_else(|| Refusal::own("the report has no row"))?;
        let proved = design.bounds().iter().map(|bound| bound.total()).fold(0.0, f64::max);
        let cost = HardwareCost::of(design);
        let hardware = stated::Hardware::of(design, &stated::of_design(design));
        let share = |share: &hw_model::design::Share| Share { register: share.register, ulp: Real::new(share.ulp, 4) };
        Ok(Self {
            budget_ulp: Real::new(report.budget_ulp, 4),
            proved_ulp: Real::new(proved, 4),
            measured_ulp: Real::new(report.implementation_ulp, 4),
            epicentre,
            everywhere,
            samples: report.samples,
            latency: cost.latency,
            multiplier_bits: cost.multiplier_bits(),
            rom_bits: cost.rom_bits,
            register_bits: hardware.register_bits,
            shares: design.error_shares().iter().map(share).collect(),
        })
    }
}

fn peaks(report: &ErrorReport) -> Option<(Peak, Peak)> {
    let (worst, full) = (report.worst()?, report.worst_full_range()?);
    Some((
        Peak::new(worst.total_abs, worst.n, worst.total_x),
        Peak::new(full.full_range_abs, full.n, full.full_range_x),
    ))
}
