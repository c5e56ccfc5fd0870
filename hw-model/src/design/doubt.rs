//! Stated formats that the range analysis refuses, judged by the values themselves.
//!
//! The analysis widens every range by the rounding errors that may reach it, and by what a polynomial's
//! extremes have that no representable x takes. So a format with a bit less than it asks for may hold
//! everything; a configuration that states such a format gets it if it does.

use crate::budget::BudgetError;
use crate::datapath::Datapath;
use crate::format::QFormat;

/// A stated format in doubt.
pub(super) struct Doubt {
    /// 0 for the variable, j for the result of stage j.
    pub line: usize,
    /// The format that the configuration states for it.
    pub stated: QFormat,
    /// What the analysis says.
    pub refusal: BudgetError,
}

/// The widest line of which the exact values are looked at: a few bits of room for values that do not fit.
const WIDEST: u32 = 110;

/// Refuses the first format that does not hold what its register takes.
pub(super) fn settle(doubts: Vec<Doubt>, datapath: &Datapath) -> Result<(), BudgetError> {
    if doubts.is_empty() {
        return Ok(());
    }
    let formats = datapath.formats().polynomial.as_ref();
    let of_v = formats.map_or(0, |f| f.v.width());
    // All but the last: it is no multiplicand.
    let of_t = formats.map_or(&[][..], |f| &f.t()[..f.degree() - 1]);
    let wide = of_v + of_t.iter().map(|t| t.width()).max().unwrap_or(0) > WIDEST;
    // Values that do not fit their registers have room in the wide lane.
    let reach = if wide { None } else { datapath.clone().in_wide_lane().polynomial_reach() };
    for Doubt { line, stated, refusal } in doubts {
        let reach = reach.as_ref().and_then(|reach| match line.checked_sub(1) {
            None => Some(&reach.v),
            Some(stage) => reach.lines.get(stage),
        });
        let Some(reach) = reach else { return Err(refusal) };
        let holds = |bits: i64| stated.holds(bits.into());
        if !holds(reach.least.bits) || !holds(reach.greatest.bits) {
            return Err(refusal);
        }
    }
    Ok(())
}
