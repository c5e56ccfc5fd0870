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
mod following;
mod judge;
mod narrow;
mod registers;
mod witness;

use std::sync::atomic::{AtomicU64, Ordering};

use hw_model::budget::BudgetError;
use hw_model::config::Config;
use hw_model::design::{Design, DesignError, Revision};
use hw_model::exponents::Exponents;
use hw_model::fit::FitError;
use hw_model::format::QFormat;
use hw_model::rounding::Rounding;
use rayon::prelude::*;
use thiserror::Error;

use super::error_report::Progress;
use super::refine::within_its_bound;
pub use candidates::RealError;
pub use judge::Place;
use judge::{Judge, greatest};
use narrow::State;
pub use registers::Hardware;
pub(crate) use registers::{NAMES, of_design, of_stated, stated, taken, tight};
pub use witness::{Breaks, Fewer, Witness};

/// Over which x the error is to be kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Over {
    /// All of [0, 1].
    All,
    /// Where x^n is at least this, above 0 and below 1.
    Level(f64),
}

impl Over {
    const fn level(self) -> Option<f64> {
        match self {
            Self::All => None,
            Self::Level(level) => Some(level),
        }
    }
}

/// What is to be built.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The exponents of the ROM.
    pub exponents: Exponents,
    /// The format of x.
    pub input: QFormat,
    /// Format of the intensity.
    pub output: QFormat,
    /// The greatest error allowed, as a fraction of full intensity.
    pub error: f64,
    /// The x over which the error is to be kept.
    pub over: Over,
    /// How many designs are narrowed.
    pub finalists: usize,
}

/// What became of a candidate.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Its real error is too great.
    TooFar,
    /// No widths keep the error, for this reason.
    Refused(String),
    /// Its proved widths make this hardware, which others undercut.
    Proved(Hardware),
    /// The same after narrowing.
    Narrowed(Hardware),
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
    pub verdict: Verdict,
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

/// Why there is no result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SizingError {
    /// A method has no fit for one of the exponents.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A configuration that should give hardware gives none.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// Nothing is near enough.
    #[error(
        "nothing keeps an error of {error}: the nearest, {nearest}, has {real:.6} at n = {n} {why}; allow more, a \
         smaller range, or a wider output"
    )]
    Nothing {
        /// What was asked for.
        error: f64,
        /// The name of the candidate with the least error.
        nearest: String,
        /// Its error in real numbers, as a fraction of full intensity.
        real: f64,
        /// The exponent at which it has that error.
        n: f64,
        /// What kept it from being built.
        why: String,
    },
    /// The range has no x for any exponent.
    #[error(
        "no exponent has an x in the range: where x^n is that much, x is beyond {input}; ask for a larger range, or an \
         input with more bits"
    )]
    Empty {
        /// The format of x.
        input: QFormat,
    },
    /// A register could lose a bit.
    #[error("register {register} could have a bit less; please report the command")]
    Spare {
        /// The name of the register.
        register: &'static str,
    },
    /// A witness that does not say what it was called for.
    #[error("the witness of register {register} at n = {n} fails; please report the command")]
    Silent {
        /// The name of the register.
        register: &'static str,
        /// The exponent of the witness.
        n: f64,
    },
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
    let considered = candidates::candidates(request);
    let reals = considered
        .par_iter()
        .map(|config| candidates::real_error(config, &least))
        .collect::<Result<Vec<_>, _>>()?;
    let mut built: Vec<(Considered, Option<Design>)> = considered
        .into_iter()
        .zip(reals)
        .flat_map(|(config, real)| prove(request, &config, real))
        .collect();
    built.sort_by_key(|(considered, _)| match &considered.verdict {
        Verdict::Proved(hardware) => (0, Some(*hardware)),
        Verdict::Refused(_) => (1, None),
        _ => (2, None),
    });
    let finals = finals(request, &built, &least, progress)?;
    let mut best: Option<(usize, State)> = None;
    for (index, (_, found)) in finals.iter().enumerate() {
        let Some((state, _)) = found else { continue };
        built[index].0.verdict = Verdict::Narrowed(state.hardware);
        if best.is_none_or(|(_, best)| state.hardware < best.hardware) {
            best = Some((index, *state));
        }
    }
    let Some((index, state)) = best else { return Err(nothing(request, built)) };
    let (Some(base), judge) = (built[index].1.clone(), &finals[index].0) else {
        return Err(nothing(request, built));
    };
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
    let considered =
        |rounding, verdict| Considered { config: config.clone(), rounding, real, verdict };
    let left = request.error - real.answered;
    if real.whole > request.error || left <= 0.0 {
        return vec![(considered(None, Verdict::TooFar), None)];
    }
    let error_budget_ulp = (PROVED * left / request.output.ulp()).min(super::refine::NO_BUDGET);
    let mut first: Option<Design> = None;
    let mut all = Vec::new();
    for rounding in Rounding::ALL {
        let made = match &first {
            // The rows are the same in every mode.
            Some(first) => {
                first.revised(Revision { rounding, error_budget_ulp, ..first.revision() })
            }
            None => Design::new(Config { rounding, error_budget_ulp, ..config.clone() }),
        };
        match made {
            Ok(design) => {
                let formats = registers::of_design(&design);
                let hardware = Hardware::of(&design, &formats);
                first.get_or_insert_with(|| design.clone());
                all.push((considered(Some(rounding), Verdict::Proved(hardware)), Some(design)));
            }
            Err(refusal) => {
                let verdict = Verdict::Refused(refusal.to_string());
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
        let revision =
            Revision { widths: stated(&formats), error_budget_ulp: 0.001, ..base.revision() };
        let refusal = match within_its_bound(base, revision) {
            Err(DesignError::Budget(refusal)) => refusal,
            other => return other,
        };
        let wider = match &refusal {
            BudgetError::Overflow { register, stated, needed, .. } => {
                let index = NAMES.iter().position(|name| name == register);
                index.filter(|_| needed.width() > stated.width()).zip(Some(*needed))
            }
            _ => None,
        };
        let Some((index, needed)) = wider else { return Err(refusal.into()) };
        formats[index] = Some(needed);
    }
}

/// Why there is nothing.
fn nothing(request: &Request, built: Vec<(Considered, Option<Design>)>) -> SizingError {
    let nearest = built.into_iter().map(|(considered, _)| considered);
    let nearest = nearest.min_by(|a, b| a.real.whole.total_cmp(&b.real.whole));
    let (name, real, why) = nearest.map_or((String::new(), (0.0, 1.0), String::new()), |nearest| {
        let why = match nearest.verdict {
            Verdict::Refused(why) => format!("in real numbers, and {why}"),
            _ => "in real numbers".to_owned(),
        };
        (nearest.config.method.to_string(), (nearest.real.whole, nearest.real.n), why)
    });
    SizingError::Nothing { error: request.error, nearest: name, real: real.0, n: real.1, why }
}

/// The narrowed ones by their hardware, then the proved ones, then by their real error.
fn ranked(built: Vec<(Considered, Option<Design>)>) -> Vec<Considered> {
    let mut all: Vec<Considered> = built.into_iter().map(|(considered, _)| considered).collect();
    all.sort_by(|a, b| {
        let key = |considered: &Considered| match &considered.verdict {
            Verdict::Narrowed(hardware) => (0, Some(*hardware)),
            Verdict::Proved(hardware) => (1, Some(*hardware)),
            Verdict::Refused(_) => (2, None),
            Verdict::TooFar => (3, None),
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
