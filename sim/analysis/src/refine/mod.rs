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
use hw_model::design::{Design, DesignError};
use hw_model::steps::{CoefficientSteps, Steps};
use rayon::prelude::*;
use vectors::limits::{Sweep, TooManyInputs};

use crate::budget::within_its_bound;
pub use descent::Found;
use piece::Piece;
pub use piece::Range;
use vectors::progress::Progress;

/// How far to search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Over which x the error is least.
    pub range: Range,
    /// No coefficient moves farther than this from where it is, in units of its last place.
    pub reach: i32,
}

/// The whole search.
#[derive(Debug, Clone)]
pub struct Refined {
    /// The configuration with the steps, its widths stated.
    pub design: Design,
    /// One for each segment that answers, in the order of the exponents.
    pub found: Vec<Found>,
}

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
        let mut all = Steps::default();
        all[..piece.steps.len()].copy_from_slice(&piece.steps);
        steps[at] = steps[at].with(piece.segment as usize - 1, all);
    }
    steps.retain(|row| !row.is_none());
    steps.sort_by(|a, b| a.n.total_cmp(&b.n));
}

impl Refined {
    /// The configuration that carries the result.
    #[must_use]
    pub const fn config(&self) -> &Config {
        self.design.config()
    }
}
