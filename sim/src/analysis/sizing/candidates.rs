//! What can be built at all: methods, forms, segments, cuts and tails, and how near each comes to x^n in real
//! numbers.

use hw_model::config::{Config, Cut, Form, StatedWidths, Tail};
use hw_model::design::{DesignError, RealRow};
use hw_model::fit::{FitError, Levels, Method, crossing};
use hw_model::highlight::phong;
use hw_model::rounding::Rounding;

use super::{Over, Request};

/// Points of each segment at which the real functions are looked at.
const POINTS: i64 = 256;
/// The part of the error that a range fitted to it leaves to what lies below.
const LEVEL: f64 = 0.995;

/// The configurations worth a look, their widths still to be derived.
pub fn candidates(request: &Request) -> Vec<Config> {
    let mut all = Vec::new();
    for form in [Form::Centred, Form::Power] {
        for method in [
            Method::Minimax,
            Method::Hermite,
            Method::ThreePoint,
            Method::Tangent,
            Method::Quadratic,
        ] {
            let own = Config { method, form, ..plain(request) };
            all.extend(of_method(request, &own));
        }
    }
    all.push(Config { method: Method::Schlick, tail: Tail::Rational, ..plain(request) });
    all.retain(|config| config.check().is_ok());
    all
}

fn of_method(request: &Request, own: &Config) -> Vec<Config> {
    let mut all = Vec::new();
    let minimax = own.method == Method::Minimax;
    let most_segments = if minimax && own.form == Form::Centred { 2 } else { 1 };
    // Where the polynomial ends with the range, or where zero is no worse than the error.
    let level = request.over.level().unwrap_or(LEVEL * request.error);
    for segments in 1..=most_segments {
        all.push(Config { segments, ..to_level(own, level) });
        if request.over.level().is_none() && minimax {
            all.push(Config { segments, cut: Cut::Balanced, ..own.clone() });
        }
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
        name: "designed".to_owned(),
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
        segments: 1,
        rounding: Rounding::NearestUp,
        quotient_bits_per_stage: 2,
        multiplier_operand_bits: None,
        error_budget_ulp: 1.0,
        widths: StatedWidths::default(),
        coefficient_steps: Vec::new(),
        domain: Vec::new(),
    }
}

/// The least x of the range in each row.
///
/// # Errors
/// When a level is out of range.
pub fn least_xs(request: &Request) -> Result<Vec<i64>, FitError> {
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
pub fn real_error(config: &Config, least: &[i64]) -> Result<RealError, DesignError> {
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
    let cut = if row.polynomial.is_some() { row.cut } else { greatest + 1 };
    let parts = [
        (least, cut - 1),
        (cut.max(least), row.hand_over - 1),
        (cut.max(row.hand_over).max(least), greatest),
    ];
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
