//! What can be built at all: methods, forms, segments, cuts and tails, and how near each comes to x^n in real
//! numbers.

use hw_model::config::{Config, Cut, Form, Tail};
use hw_model::design::{DesignError, RealRow};
use hw_model::fit::{FitError, Levels, Method, crossing};
use hw_model::highlight::phong;
use hw_model::registers::{CUBIC, MAX_DEGREE, MAX_SEGMENTS};
use hw_model::rounding::Rounding;
use hw_model::widths::StatedWidths;
use rayon::prelude::*;

use super::request::{Over, Request};

/// Points of each segment at which the real functions are looked at.
const POINTS: i64 = 256;
/// The part of the error that a range fitted to it leaves to what lies below.
const LEVEL: f64 = 0.995;

/// The configurations worth a look with their real errors over x from the least of each row; their widths are still to
/// be derived.
///
/// # Errors
/// When a row cannot be fitted.
pub(super) fn candidates(request: &Request, least: &[i64]) -> Result<Vec<(Config, RealError)>, DesignError> {
    let mut series: Vec<Vec<Config>> = Vec::new();
    for form in [Form::Centred, Form::Power] {
        for (method, degree) in methods() {
            let own = Config { method, form, degree, ..plain(request) };
            series.extend(of_method(request, &own).into_iter().map(|config| vec![config]));
        }
    }
    series.extend((1..=MAX_DEGREE).flat_map(|degree| of_segments(request, degree)));
    let schlick = Config { method: Method::Schlick, tail: Tail::Rational, ..plain(request) };
    series.push(vec![schlick]);
    let judged = series.par_iter().map(|series| enough(series, request.error, least)).collect::<Result<Vec<_>, _>>()?;
    Ok(judged.into_iter().flatten().collect())
}

/// The methods that are tried, with their degrees: those that are searched for first, as they are the best of theirs.
fn methods() -> Vec<(Method, usize)> {
    let degree = |method: Method| method.capabilities().candidate.map(|degree| (method, degree));
    let mut methods: Vec<_> = Method::ALL.into_iter().filter_map(degree).collect();
    methods.sort_by_key(|(method, _)| method.capabilities().closed_form);
    methods
}

/// Of configurations with more and more segments those that are too far, up to two segments, the first that keeps the
/// error, and the next: one segment more costs a row of ROM and may spare bits everywhere.
fn enough(series: &[Config], error: f64, least: &[i64]) -> Result<Vec<(Config, RealError)>, DesignError> {
    let mut judged = Vec::new();
    let mut kept = 0;
    for config in series.iter().filter(|config| config.check().is_ok()) {
        let real = real_error(config, least)?;
        let keeps = real.whole <= error;
        kept += u32::from(keeps);
        if keeps || config.segments <= 2 {
            judged.push((config.clone(), real));
        }
        if kept == 2 {
            break;
        }
    }
    Ok(judged)
}

/// Minimax segments of one degree, fewer of them first: down to where the range ends, and to where they are balanced.
fn of_segments(request: &Request, degree: usize) -> Vec<Vec<Config>> {
    let own = Config { method: Method::Minimax, degree, ..plain(request) };
    let level = request.over.level().unwrap_or(LEVEL * request.error);
    // One cubic is among the methods.
    let segments = if degree == CUBIC { 2..=MAX_SEGMENTS } else { 1..=MAX_SEGMENTS };
    let of = |make: &dyn Fn(usize) -> Config| segments.clone().map(make).collect::<Vec<_>>();
    let mut series = vec![of(&|segments| Config { segments, ..to_level(&own, level) })];
    if request.over.level().is_none() {
        series.push(of(&|segments| Config { segments, cut: Cut::Balanced, ..own.clone() }));
    }
    series
}

fn of_method(request: &Request, own: &Config) -> Vec<Config> {
    let mut all = Vec::new();
    let minimax = own.method == Method::Minimax;
    // Where the polynomial ends with the range, or where zero is no worse than the error.
    let level = request.over.level().unwrap_or(LEVEL * request.error);
    all.push(to_level(own, level));
    if request.over.level().is_none() && minimax {
        all.push(Config { cut: Cut::Balanced, ..own.clone() });
    }
    if request.over.level().is_none_or(|level| level < own.q) {
        if !minimax {
            all.push(Config { cut: Cut::Minimum, ..own.clone() });
        }
        all.push(Config { tail: Tail::Rational, ..own.clone() });
    }
    all
}

/// Down to where x^n has this value.
fn to_level(own: &Config, level: f64) -> Config {
    let g = if own.g < level { own.g } else { level / 9.0 };
    Config { cut: Cut::Epicentre, q: level, g, ..own.clone() }
}

fn plain(request: &Request) -> Config {
    Config {
        name: request.name(),
        method: Method::Hermite,
        exponents: request.exponents.clone(),
        input: request.input,
        output: request.output,
        description: String::new(),
        q: Levels::default().q(),
        g: Levels::default().g(),
        form: Form::Centred,
        tail: Tail::Zero,
        cut: Cut::Epicentre,
        degree: CUBIC,
        segments: 1,
        rounding: Rounding::NearestUp,
        quotient_bits_per_stage: 2,
        multiplier_operand_bits: None,
        error_budget_ulp: 1.0,
        widths: StatedWidths::default(),
        coefficient_steps: Vec::new(),
        domain: Vec::new(),
        pipelining: Default::default(),
        clock: request.clock.clone(),
        handshake: Default::default(),
        reset: Default::default(),
    }
}

/// The least x of the range in each row.
///
/// # Errors
/// When a level is out of range.
pub(super) fn least_xs(request: &Request) -> Result<Vec<i64>, FitError> {
    let input = request.input;
    request
        .exponents
        .iter()
        .map(|exponent| {
            let Over::Level(level) = request.over else { return Ok(0) };
            let s = crossing(exponent, level)?.s;
            Ok((input.one() - (s / input.ulp()).floor() as i64).max(0))
        })
        .collect()
}

/// What a configuration errs by in real numbers. Over points of each part: it may be a little more in between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RealError {
    /// The greatest error on all of [0, 1], as a fraction of full intensity.
    pub whole: f64,
    /// The exponent where that is.
    pub n: f64,
    /// Where a polynomial or the divider answers: what is put to zero below errs by x^n and by nothing else,
    /// whatever the widths are.
    pub answered: f64,
}

/// The real error of a configuration over x from the least of each row.
///
///
/// # Errors
/// When a row cannot be fitted.
fn real_error(config: &Config, least: &[i64]) -> Result<RealError, DesignError> {
    let levels = config.levels()?;
    let mut worst = RealError { whole: 0.0, n: config.exponents.first(), answered: 0.0 };
    for (exponent, &least) in config.exponents.iter().zip(least) {
        let row = RealRow::new(config, levels, exponent)?;
        let (below, answered) = row_error(config, &row, least);
        worst.answered = worst.answered.max(answered);
        if below.max(answered) > worst.whole {
            (worst.whole, worst.n) = (below.max(answered), exponent);
        }
    }
    Ok(worst)
}

/// Where zero answers, and where anything else does.
fn row_error(config: &Config, row: &RealRow, least: i64) -> (f64, f64) {
    let (input, ulp) = (config.input, config.input.ulp());
    let greatest = input.max_bits().min(input.one());
    // Schlick's cut means nothing.
    let cut = if row.segments.is_empty() { greatest + 1 } else { row.cut };
    // What lies below the cut, then the segments as x rises.
    let mut parts = vec![(least, cut - 1)];
    for (index, segment) in row.segments.iter().enumerate().rev() {
        let last = if index == 0 { greatest } else { segment.start - 1 };
        parts.push((row.least_of_segment(index).max(least), last));
    }
    let mut worst = [0.0_f64; 2];
    for (index, (first, last)) in parts.into_iter().enumerate() {
        let answered = usize::from(index > 0 || row.tail.is_some());
        let last = last.min(greatest);
        if first > last {
            continue;
        }
        for i in 0..=POINTS {
            let part = 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / POINTS as f64).cos();
            let x = first + (part * (last - first) as f64).round() as i64;
            let s = (input.one() - x) as f64 * ulp;
            let shown = row.value_at_s(s, x >= cut).min(1.0);
            let error = (shown - phong(row.exponent, x as f64 * ulp)).abs();
            worst[answered] = worst[answered].max(error);
        }
    }
    (worst[0], worst[1])
}
