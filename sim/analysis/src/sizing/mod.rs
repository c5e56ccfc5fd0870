//! The least hardware that keeps an error: form, method, segments, widths and rounding.
//!
//! What can be built is first held against x^n in real numbers (`candidates`). What remains gets widths that
//! are proved to keep the error, in every rounding mode, and the designs are ranked by their hardware: multiplier
//! bits, then ROM bits, then latency, then register bits. The first few are narrowed as far as the measured
//! error allows (`narrow`), and the result is the one with the least hardware. Every register then has a witness: one
//! (n, x) at which a bit less breaks the error or overflows (`witness`).
//!
//! The error of the result is not proved register by register but measured at every x of the range.

mod candidates;
mod error;
mod following;
mod judge;
mod narrow;
mod request;
mod witness;

use std::sync::atomic::{AtomicU64, Ordering};

use hw_model::budget::BudgetError;
use hw_model::config::Config;
use hw_model::design::{Design, DesignError, Revision};
use hw_model::rounding::Rounding;
use rayon::prelude::*;

use crate::budget::{NO_BUDGET, within_its_bound};
pub use candidates::RealError;
pub use error::SizingError;
use hw_model::stated::{Hardware, ORDER, name, of_design, stated};
pub use judge::Place;
use judge::{Judge, greatest};
use narrow::State;
pub use request::{Over, Request};
use vectors::progress::Progress;
pub use witness::{Breaks, Fewer, Witness};

/// What became of a candidate.
#[derive(Debug, Clone, PartialEq)]
pub enum CandidateFate {
    /// Its real error is too great.
    TooFar,
    /// No widths keep the error, for this reason.
    Refused(String),
    /// Its proved widths make this hardware, which others undercut.
    Proved(Hardware),
    /// The same after narrowing.
    Narrowed(Hardware),
    /// The least of those: the result.
    Chosen(Hardware),
}

/// A candidate with what became of it.
#[derive(Debug, Clone)]
pub struct Considered {
    /// The configuration of the candidate.
    pub config: Config,
    /// The rounding mode; none where the real error decided.
    pub rounding: Option<Rounding>,
    /// Its error in real numbers.
    pub real: RealError,
    /// What became of it.
    pub verdict: CandidateFate,
}

/// The least hardware that was found, and what was considered on the way.
#[derive(Debug, Clone)]
pub struct Sized {
    /// The design, its widths stated.
    pub design: Design,
    /// The hardware of the design, by the measures that rank it.
    pub hardware: Hardware,
    /// Its greatest error over every x of the range.
    pub worst: Place,
    /// Everything that was considered, the best first.
    pub ranking: Vec<Considered>,
    /// Two witnesses for every register: one for its last fraction bit, one for its first integer bit.
    pub witnesses: Vec<Witness>,
}

/// The part of the error that the proved widths may use: real errors are seen at points only.
const PROVED: f64 = 0.98;
/// Full measurements of a finalist that the progress bar counts on.
const MEASUREMENTS: u64 = 4;

/// The samples that a progress bar may count on.
#[must_use]
pub fn samples(request: &Request) -> u128 {
    per_finalist(request) * request.finalists as u128
}

fn per_finalist(request: &Request) -> u128 {
    let per_row = request.input.one() as u128;
    per_row * request.exponents.len() as u128 / 8 * u128::from(MEASUREMENTS)
}

/// Searches. Candidates go to all threads; the result does not depend on their number.
///
/// # Errors
/// When nothing keeps the error.
pub fn size(request: &Request, progress: &dyn Progress) -> Result<Sized, SizingError> {
    let least = candidates::least_xs(request)?;
    let input = request.input;
    if least.iter().all(|&least| least > input.max_bits().min(input.one())) {
        return Err(SizingError::Empty { input });
    }
    let mut built: Vec<(Considered, Option<Design>)> = candidates::candidates(request, &least)?
        .into_iter()
        .flat_map(|(config, real)| prove(request, &config, real))
        .collect();
    built.sort_by_key(|(considered, _)| match &considered.verdict {
        CandidateFate::Proved(hardware) => (0, Some(*hardware)),
        CandidateFate::Refused(_) => (1, None),
        _ => (2, None),
    });
    let finals = finals(request, &built, &least, progress)?;
    let mut best: Option<(usize, State)> = None;
    for (index, (_, found)) in finals.iter().enumerate() {
        let Some((state, _)) = found else { continue };
        built[index].0.verdict = CandidateFate::Narrowed(state.hardware);
        if best.is_none_or(|(_, best)| state.hardware < best.hardware) {
            best = Some((index, *state));
        }
    }
    let Some((index, state)) = best else { return Err(nothing(request, built)) };
    let (Some(base), judge) = (built[index].1.clone(), &finals[index].0) else {
        return Err(nothing(request, built));
    };
    built[index].0.verdict = CandidateFate::Chosen(state.hardware);
    let design = settled(&base, &state)?;
    let worst = greatest(&judge.measured(&design, &AtomicU64::new(0)));
    let Some(worst) = worst.filter(|worst| worst.error <= request.error) else {
        return Err(nothing(request, built));
    };
    let mut witnesses = witness::witnesses(&base, judge, &state, &AtomicU64::new(0))?;
    witnesses.extend(following::witnesses(&design)?);
    Ok(Sized { design, hardware: state.hardware, worst, ranking: ranked(built), witnesses })
}

/// What a candidate was judged by, and its narrowest state with the error; none where it has none.
type Final = (Judge, Option<(State, Place)>);

/// Narrows the first candidates, each with a judge of its own.
fn finals(
    request: &Request,
    built: &[(Considered, Option<Design>)],
    least: &[i64],
    progress: &dyn Progress,
) -> Result<Vec<Final>, DesignError> {
    let limit = u64::try_from(per_finalist(request)).unwrap_or(u64::MAX);
    built
        .par_iter()
        .with_max_len(1)
        .take(request.finalists)
        .filter_map(|(_, design)| design.as_ref())
        .map(|design| {
            let mut judge = Judge::new(design, least, request.error);
            let capped = Capped { progress, left: AtomicU64::new(limit) };
            narrow::narrow(design, &mut judge, &capped).map(|found| (judge, found))
        })
        .collect()
}

/// The widths of a candidate that are proved to keep the error, in every rounding mode.
fn prove(request: &Request, config: &Config, real: RealError) -> Vec<(Considered, Option<Design>)> {
    let considered = |rounding, verdict| Considered { config: config.clone(), rounding, real, verdict };
    let left = request.error - real.answered;
    if real.whole > request.error || left <= 0.0 {
        return vec![(considered(None, CandidateFate::TooFar), None)];
    }
    let error_budget_ulp = (PROVED * left / request.output.ulp()).min(NO_BUDGET);
    let mut first: Option<Design> = None;
    let mut all = Vec::new();
    for rounding in Rounding::ALL {
        let made = match &first {
            // The rows are the same in every mode.
            Some(first) => first.revised(Revision { rounding, error_budget_ulp, ..first.revision() }),
            None => Design::new(Config { rounding, error_budget_ulp, ..config.clone() }),
        };
        match made {
            Ok(design) => {
                let formats = of_design(&design);
                let hardware = Hardware::of(&design, &formats);
                first.get_or_insert_with(|| design.clone());
                all.push((considered(Some(rounding), CandidateFate::Proved(hardware)), Some(design)));
            }
            Err(refusal) => {
                let verdict = CandidateFate::Refused(refusal.to_string());
                all.push((considered(Some(rounding), verdict), None));
            }
        }
    }
    all
}

/// The design with these formats. Where the analysis of the divider's widths, which is not exact, asks for more,
/// it gets more.
fn settled(base: &Design, state: &State) -> Result<Design, DesignError> {
    let mut formats = state.formats;
    loop {
        let revision = Revision { widths: stated(&formats), error_budget_ulp: 0.001, ..base.revision() };
        let refusal = match within_its_bound(base, revision) {
            Err(DesignError::Budget(refusal)) => refusal,
            other => return other,
        };
        let wider = match &refusal {
            BudgetError::Overflow { register, stated, needed, .. } => {
                let known = ORDER.into_iter().find(|known| name(*known) == *register);
                known.filter(|_| needed.width() > stated.width()).zip(Some(*needed))
            }
            _ => None,
        };
        let Some((register, needed)) = wider else { return Err(refusal.into()) };
        formats[register] = Some(needed);
    }
}

/// Why there is nothing.
fn nothing(request: &Request, built: Vec<(Considered, Option<Design>)>) -> SizingError {
    let nearest = built.into_iter().map(|(considered, _)| considered);
    let nearest = nearest.min_by(|a, b| a.real.whole.total_cmp(&b.real.whole));
    let (name, real, why) = nearest.map_or((String::new(), (0.0, 1.0), String::new()), |nearest| {
        let why = match nearest.verdict {
            CandidateFate::Refused(why) => format!("in real numbers, and {why}"),
            _ => "in real numbers".to_owned(),
        };
        (nearest.config.method.to_string(), (nearest.real.whole, nearest.real.n), why)
    });
    SizingError::Nothing { error: request.error, nearest: name, real: real.0, n: real.1, why }
}

/// The chosen one, the narrowed ones by their hardware, then the proved ones, then by their real error.
fn ranked(built: Vec<(Considered, Option<Design>)>) -> Vec<Considered> {
    let mut all: Vec<Considered> = built.into_iter().map(|(considered, _)| considered).collect();
    all.sort_by(|a, b| {
        let key = |considered: &Considered| match &considered.verdict {
            CandidateFate::Chosen(hardware) => (0, Some(*hardware)),
            CandidateFate::Narrowed(hardware) => (1, Some(*hardware)),
            CandidateFate::Proved(hardware) => (2, Some(*hardware)),
            CandidateFate::Refused(_) => (3, None),
            CandidateFate::TooFar => (4, None),
        };
        key(a).cmp(&key(b)).then_with(|| a.real.whole.total_cmp(&b.real.whole))
    });
    all
}

/// No more than a bar counts on.
struct Capped<'a> {
    progress: &'a dyn Progress,
    left: AtomicU64,
}

impl Progress for Capped<'_> {
    fn advance(&self, samples: u64) {
        let update = |left: u64| Some(left.saturating_sub(samples));
        let before = self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, update);
        self.progress.advance(samples.min(before.unwrap_or(0)));
    }
}
