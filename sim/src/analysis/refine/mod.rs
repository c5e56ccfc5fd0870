//! Better ROM integers: a search over the neighbours of the rounded coefficients, through the data path.
//!
//! Rounding each coefficient to the nearest is the best for none of them: errors of c1, c2 and c3 make up for
//! each other, and the lines round as well. So the integers are judged by the pipeline itself, at every
//! representable x of the range, against the correctly rounded x^n. One segment of one row at a time
//! (`piece`): good sets of integers are proposed by real arithmetic on a few points (`propose`), tried
//! through the data path, and from the best of them the search steps to better neighbours until there is
//! none (`descent`).
//!
//! The range is the one the method was fitted to, unless all that the polynomial answers is asked for:
//! below the epicentre a cubic with `"cut": "minimum"` is far from x^n, and would be bent towards it at the
//! cost of the highlight.

mod descent;
mod piece;
mod propose;

use hw_model::config::Config;
use hw_model::design::{Design, DesignError, Revision};
use hw_model::steps::CoefficientSteps;
use rayon::prelude::*;
use serde::Serialize;
use vectors::limits::{Sweep, TooManyInputs};

use super::error_report::Progress;
use piece::Piece;
pub use piece::Range;

/// How far to search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Over which x the error is least.
    pub range: Range,
    /// No coefficient moves farther than this from where it is, in units of its last place.
    pub reach: i32,
}

/// What was found for one segment of one row. Errors are fractions of full intensity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Found {
    /// The exponent of the row.
    pub n: f64,
    /// The number of the segment, 1 or 2.
    pub segment: u32,
    /// Representable x that were judged.
    pub samples: u64,
    /// The greatest error before.
    pub before: f64,
    /// The same with the integers that were found.
    pub after: f64,
    /// The x (bits in the input format) where.
    pub x: i64,
    /// The greatest error of the method with real coefficients at the same x: what no integers are better than
    /// where the method is `minimax`, but for what rounding happens to mend.
    pub method: f64,
    /// The steps of c0, c1, c2, c3 from the rounded coefficients.
    pub steps: [i32; 4],
}

/// What the search found for all rows, and the design that has it.
#[derive(Debug, Clone)]
pub struct Refined {
    /// The configuration with the steps, its widths stated.
    pub design: Design,
    /// One for each segment that answers, in the order of the exponents.
    pub found: Vec<Found>,
}

/// An error budget that refuses no configuration: the highest that one may have, in output ulp.
pub(crate) const NO_BUDGET: f64 = 1e6;

/// The number of x that all judging goes over, for a progress bar.
///
/// # Errors
/// When they are too many to go through, or those of one segment too many to keep what x^n is there.
pub fn samples(design: &Design, addresses: &[u32], options: Options) -> Result<u64, TooManyInputs> {
    let input = design.config().input;
    let spans = pieces(design, addresses, options);
    let samples = || spans.iter().map(|span| u128::from(span.samples()));
    Sweep::Refine.kept(samples().max().unwrap_or(0), input)?;
    Sweep::Refine.within(samples().sum(), input)
}

/// Searches these rows. Segments go to all threads; the result does not depend on their number.
///
/// # Errors
/// When the design cannot be made again with its own widths, which none is known to do.
pub fn refine(
    design: &Design,
    addresses: &[u32],
    options: Options,
    progress: &dyn Progress,
) -> Result<Refined, DesignError> {
    let spans = pieces(design, addresses, options);
    let found: Vec<Found> = spans
        .into_par_iter()
        .with_max_len(1)
        .map(|span| {
            let samples = span.samples();
            let found = descent::search(&Piece::new(design, span), options.reach);
            progress.advance(samples);
            found
        })
        .collect();
    let mut revision = design.revision();
    revision.widths = design.widths();
    put(&mut revision.coefficient_steps, &found);
    Ok(Refined { design: within_its_bound(design, revision)?, found })
}

fn pieces(design: &Design, addresses: &[u32], options: Options) -> Vec<piece::Span> {
    addresses.iter().flat_map(|&address| piece::spans(design, address, options.range)).collect()
}

/// Puts the steps of every segment in the place of those there, in the order of the exponents.
fn put(steps: &mut Vec<CoefficientSteps>, found: &[Found]) {
    for piece in found {
        let at = steps.iter().position(|row| row.n == piece.n).unwrap_or_else(|| {
            steps.push(CoefficientSteps::none(piece.n));
            steps.len() - 1
        });
        steps[at] = steps[at].with(piece.segment == 2, piece.steps);
    }
    steps.retain(|row| !row.is_none());
    steps.sort_by(|a, b| a.n.total_cmp(&b.n));
}

/// The revised design, its budget raised to what it proves where that is more than before.
///
/// # Errors
/// As [`Design::new`].
pub(crate) fn within_its_bound(design: &Design, revision: Revision) -> Result<Design, DesignError> {
    let unbound = design.revised(Revision { error_budget_ulp: NO_BUDGET, ..revision.clone() })?;
    let needed = unbound.bounds().iter().map(|bound| bound.total()).fold(0.0, f64::max);
    // A thousandth up: it is written in decimal.
    let needed = (needed * 1000.0 + 1e-6).ceil() / 1000.0;
    let error_budget_ulp = revision.error_budget_ulp.max(needed).min(NO_BUDGET);
    unbound.revised(Revision { error_budget_ulp, ..revision })
}

impl Refined {
    /// The configuration that carries the result.
    #[must_use]
    pub const fn config(&self) -> &Config {
        self.design.config()
    }
}
