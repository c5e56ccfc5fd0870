//! The error budget of a design whose integers or widths were searched: raised to what it proves.

use hw_model::design::{Design, DesignError, Revision};

/// A budget that keeps nobody from anything: the highest a configuration may have.
pub const NO_BUDGET: f64 = 1e6;

/// The revised design, its budget raised to what it proves where that is more than before.
///
/// # Errors
/// As [`Design::new`].
pub fn within_its_bound(design: &Design, revision: Revision) -> Result<Design, DesignError> {
    let unbound = design.revised(Revision { error_budget_ulp: NO_BUDGET, ..revision.clone() })?;
    let needed = unbound.bounds().iter().map(|bound| bound.total()).fold(0.0, f64::max);
    // A thousandth up: it is written in decimal.
    let needed = (needed * 1000.0 + 1e-6).ceil() / 1000.0;
    let error_budget_ulp = revision.error_budget_ulp.max(needed).min(NO_BUDGET);
    unbound.revised(Revision { error_budget_ulp, ..revision })
}
