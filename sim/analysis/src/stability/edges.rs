//! What the pipeline answers at the edges: of x, of the list of exponents, of the formats and of the ROM.
//!
//! **Variants.** The configuration as it is; with each other rounding mode; with a signed input, where its own
//! has no negative x; with 1-bit and with 63-bit formats of input, output and both, and with the finest output
//! that can be had. Variants keep the first and the last exponent and the powers of two between. A mode that rounds one
//! way needs a larger error budget: it is doubled until the widths can be had, and said. What cannot be had is there
//! with the reason.
//!
//! **x.** 0, 1, q, the cut, one ulp beside each, the least and the greatest of the format, where the format has
//! them. An answer holds when it has the flags it should have, and lies no further from the method
//! (real coefficients, the same part) than the proved bound of its row.
//!
//! The ROM's own words are in `words.rs`.

use hw_model::config::Config;
use hw_model::datapath::{Signals, Status};
use hw_model::design::{Design, DesignError};
use hw_model::exponents::Exponents;
use hw_model::format::QFormat;
use hw_model::highlight::exact::ExactPower;
use hw_model::highlight::phong;
use hw_model::quantise::real;
use hw_model::rounding::Rounding;
use rayon::prelude::*;
use serde::Serialize;

use super::cases::cases;
use super::words::{Word, words};

/// The most an error budget is raised to, in ulp.
const MOST_BUDGET: f64 = 64.0;

/// A configuration that was tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Variant {
    /// What is other than in the configuration.
    pub name: String,
    /// The format of x.
    pub input: String,
    /// The format of the intensity.
    pub output: String,
    /// The rounding mode of every line.
    pub rounding: Rounding,
    /// The error budget it was built with, in ulp; the configuration's own or a multiple of it.
    pub budget_ulp: f64,
    /// The greatest proved bound, in ulp.
    pub bound_ulp: Option<f64>,
    /// The number of answers looked at.
    pub answers: usize,
    /// Those that do not hold.
    pub failures: usize,
    /// The greatest error against the method, in ulp.
    pub worst_method_ulp: Option<f64>,
    /// Why there is no such pipeline.
    pub refused: Option<String>,
}

/// The answer to one input at an edge of x, n or a format.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Edge {
    /// The name of the variant that answers.
    pub variant: String,
    /// The exponent; none for an address without a word.
    pub n: Option<f64>,
    /// The ROM address of the input.
    pub address: u32,
    /// Which edge of x it is, in words.
    pub case: &'static str,
    /// x as bits in the input format.
    pub x_bits: i64,
    /// x as a real number.
    pub x: f64,
    /// The bits of the answer.
    pub intensity_bits: i64,
    /// The answer as a real number.
    pub intensity: f64,
    /// The names of the flags that are set.
    pub status: String,
    /// x^n, x taken into [0, 1]; none without an exponent.
    pub reference: Option<f64>,
    /// The answer less x^n, in ulp: exact where the oracle can be asked.
    pub error_ulp: Option<f64>,
    /// The answer less what the method has there, in ulp.
    pub method_ulp: Option<f64>,
    /// What was proved of that, in ulp.
    pub bound_ulp: Option<f64>,
    /// The answer is as it should be.
    pub holds: bool,
}

/// The answers of all variants, and the ROM words at the edges of their formats.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EdgeReport {
    /// The name of the configuration.
    pub configuration: String,
    /// The configurations that were tried.
    pub variants: Vec<Variant>,
    /// The ROM's fields at the edges of their formats.
    pub words: Vec<Word>,
    /// Every answer, one row each.
    pub rows: Vec<Edge>,
}

impl EdgeReport {
    /// Every answer and every refusal is as it should be.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.rows.iter().all(|row| row.holds) && self.words.iter().all(|word| word.holds)
    }
}

/// Looks at the edges of a design, at these addresses of it.
#[must_use]
pub fn edge_report(design: &Design, addresses: &[u32]) -> EdgeReport {
    let own = variant_of(design, "as configured".to_owned(), addresses);
    let mut tried: Vec<(Variant, Vec<Edge>)> = vec![own];
    let others: Vec<(Variant, Vec<Edge>)> = variants(design.config())
        .into_par_iter()
        .map(|(name, config)| {
            let built = within_budget(config.clone());
            match &built {
                Ok(built) => {
                    let addresses: Vec<u32> = (0..built.rom().depth() as u32).collect();
                    variant_of(built, name, &addresses)
                }
                Err(refusal) => refused(&config, name, refusal),
            }
        })
        .collect();
    tried.extend(others);
    let (variants, rows): (Vec<_>, Vec<_>) = tried.into_iter().unzip();
    EdgeReport {
        configuration: design.config().name.clone(),
        variants,
        words: words(design, addresses),
        rows: rows.concat(),
    }
}

/// Every variant but the configuration itself, unchecked.
fn variants(config: &Config) -> Vec<(String, Config)> {
    let exponents = few(&config.exponents);
    let base = Config { exponents, ..config.clone() };
    let mut all = Vec::new();
    for rounding in Rounding::ALL.into_iter().filter(|&mode| mode != config.rounding) {
        all.push((format!("rounding {rounding}"), Config { rounding, ..base.clone() }));
    }
    let fraction = config.input.fraction_bits();
    if !config.input.is_signed()
        && let Ok(input) = QFormat::signed(2, fraction)
    {
        all.push((format!("input {input}"), Config { input, ..base.clone() }));
    }
    let bit = QFormat::unsigned(0, 1);
    let wide = QFormat::unsigned(1, 62);
    for format in [bit, wide].into_iter().flatten() {
        let (input, output) = (format, format);
        let both = Config { input, output, ..base.clone() };
        all.push((format!("input {format}"), Config { input, ..base.clone() }));
        all.push((format!("output {format}"), Config { output, ..base.clone() }));
        all.push((format!("input and output {format}"), both));
    }
    if let Some(output) = widest_output(&base) {
        all.push((format!("output {output}, widest"), Config { output, ..base }));
    }
    all
}

/// The finest output that can be had within the configuration's own budget, if that is not the finest of all.
fn widest_output(base: &Config) -> Option<QFormat> {
    let accepted = |&output: &QFormat| Design::new(Config { output, ..base.clone() }).is_ok();
    let finest = (1..=62).rev().filter_map(|fraction| QFormat::unsigned(1, fraction).ok());
    finest.into_iter().find(accepted).filter(|format| format.fraction_bits() < 62)
}

/// The first, the last, and the powers of two.
fn few(exponents: &Exponents) -> Exponents {
    let kept = |&n: &f64| n == exponents.first() || n == exponents.last() || n.log2().fract() == 0.0;
    // A part of an increasing list is one.
    Exponents::new(exponents.iter().filter(kept).collect()).unwrap_or_else(|_| exponents.clone())
}

/// The design, its budget doubled until it can be kept; the last refusal where it never can.
fn within_budget(mut config: Config) -> Result<Design, DesignError> {
    loop {
        match Design::new(config.clone()) {
            Err(DesignError::Budget(hw_model::budget::BudgetError::NotKept { .. }))
                if config.error_budget_ulp < MOST_BUDGET =>
            {
                config.error_budget_ulp *= 2.0;
            }
            result => return result,
        }
    }
}

fn refused(config: &Config, name: String, refusal: &DesignError) -> (Variant, Vec<Edge>) {
    let variant = Variant {
        name,
        input: config.input.to_string(),
        output: config.output.to_string(),
        rounding: config.rounding,
        budget_ulp: config.error_budget_ulp,
        bound_ulp: None,
        answers: 0,
        failures: 0,
        worst_method_ulp: None,
        refused: Some(refusal.to_string()),
    };
    (variant, Vec::new())
}

fn variant_of(design: &Design, name: String, addresses: &[u32]) -> (Variant, Vec<Edge>) {
    let rows = answers(design, &name, addresses);
    let config = design.config();
    let bounds = design.bounds().iter().map(|bound| bound.total());
    let errors = rows.iter().filter_map(|row| row.method_ulp);
    let variant = Variant {
        name,
        input: config.input.to_string(),
        output: config.output.to_string(),
        rounding: config.rounding,
        budget_ulp: config.error_budget_ulp,
        bound_ulp: Some(bounds.fold(0.0, f64::max)),
        answers: rows.len(),
        failures: rows.iter().filter(|row| !row.holds).count(),
        worst_method_ulp: errors.map(f64::abs).reduce(f64::max),
        refused: None,
    };
    (variant, rows)
}

fn answers(design: &Design, variant: &str, addresses: &[u32]) -> Vec<Edge> {
    let rom = design.rom();
    // The first address without a word, and the last of the port.
    let outside = [rom.depth() as u32, ((1_u64 << rom.address_width()) - 1) as u32];
    let mut rows = Vec::new();
    for &address in addresses.iter().chain(&outside) {
        for (case, x) in cases(design, address) {
            let got = design.datapath().evaluate(address, x);
            rows.push(answer(design, variant, (case, x), &got));
        }
    }
    rows
}

/// What is to be said of `got`, the answer to an x.
fn answer(design: &Design, variant: &str, (case, x): (&'static str, i64), got: &Signals) -> Edge {
    let (config, address) = (design.config(), got.address);
    let ulp = config.output.ulp();
    let intensity = real(got.intensity, config.output);
    let clamped = x.clamp(0, config.input.one());
    let n = design.rom().exponents().as_slice().get(address as usize).copied();
    let against = n.map(|n| against_power(n, clamped, got, config));
    let (wanted_flags, wanted_zero) = flags(design, address, x);
    let flags = got.status.without(Status::CLAMPED);
    let mut holds = flags == wanted_flags
        && (0..=design.datapath().output_one()).contains(&got.intensity)
        && (!wanted_zero || got.intensity == 0);
    let (mut method_ulp, mut bound_ulp) = (None, None);
    if !wanted_zero {
        let bound = design.bounds()[address as usize].total();
        let error = (intensity - method_value(design, address, clamped)) / ulp;
        // f64 itself, where the output is finer than that.
        let noise = 16.0 * f64::EPSILON / ulp;
        holds &= error.abs() <= bound + noise;
        (method_ulp, bound_ulp) = (Some(error), Some(bound));
    }
    Edge {
        variant: variant.to_owned(),
        n,
        address,
        case,
        x_bits: x,
        x: real(x, config.input),
        intensity_bits: got.intensity,
        intensity,
        status: got.status.to_string(),
        reference: against.map(|(reference, _)| reference),
        error_ulp: against.map(|(_, error)| error),
        method_ulp,
        bound_ulp,
        holds,
    }
}

/// The flags an input must raise, and whether its answer must be 0 by them.
fn flags(design: &Design, address: u32, x: i64) -> (Status, bool) {
    let no_word = address as usize >= design.rom().depth();
    let facing_away = x < 0;
    let status = Status::default()
        .with(Status::NO_WORD, no_word)
        .with(Status::ABOVE_ONE, x > design.config().input.one())
        .with(Status::FACING_AWAY, facing_away);
    (status, no_word || facing_away)
}

/// What the method has at x in [0, 1], no more than the output's greatest value.
fn method_value(design: &Design, address: u32, x: i64) -> f64 {
    let config = design.config();
    let row = &design.rows()[address as usize];
    let s = real(config.input.one() - x, config.input);
    let greatest = real(design.datapath().output_one(), config.output);
    row.value_at_s(s, x >= row.cut).min(greatest)
}

/// x^n and the answer's error against it in ulp: by the oracle for integer n that is not too large, else
/// by the reference.
fn against_power(n: f64, x: i64, got: &Signals, config: &Config) -> (f64, f64) {
    let (input, output) = (config.input.fraction_bits(), config.output);
    let integer = n.fract() == 0.0 && n <= f64::from(u32::MAX);
    let exact = integer.then(|| ExactPower::new(x as u64, input, n as u32));
    if let Some(Ok(exact)) = exact {
        let error = exact.error_of_bits(got.intensity, output.fraction_bits());
        return (exact.to_f64(), error / output.ulp());
    }
    let reference = phong(n, real(x, config.input));
    (reference, (real(got.intensity, output) - reference) / output.ulp())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn design(rest: &str) -> Design {
        let head = r#""name": "s", "exponents": "1..=9", "output": "UQ1.9""#;
        Design::new(Config::from_json(&format!("{{{head}, {rest}}}")).unwrap()).unwrap()
    }

    fn addresses(design: &Design) -> Vec<u32> {
        (0..design.rom().depth() as u32).collect()
    }

    const CONFIGURATIONS: [&str; 4] = [
        r#""input": "Q2.10", "method": "hermite", "form": "power", "tail": "rational""#,
        r#""input": "UQ1.11", "method": "three_point", "cut": "minimum""#,
        r#""input": "UQ0.9", "method": "tangent", "cut": "minimum""#,
        r#""input": "UQ1.9", "method": "schlick", "tail": "rational""#,
    ];

    #[test]
    fn every_edge_holds_and_every_case_is_met() {
        for rest in CONFIGURATIONS {
            let design = design(rest);
            let report = edge_report(&design, &addresses(&design));
            let wrong: Vec<&Edge> = report.rows.iter().filter(|row| !row.holds).collect();
            assert!(report.holds(), "{rest}: {wrong:#?} {:#?}", report.words);
            let met = |flag: &str| report.rows.iter().any(|row| row.status.contains(flag));
            assert!(met("no_word") && met("facing_away") && met("above_one"), "{rest}");
            for mode in Rounding::ALL {
                let of = |variant: &&Variant| variant.rounding == mode;
                assert!(report.variants.iter().find(of).unwrap().answers > 20, "{rest}, {mode}");
            }
            for format in ["UQ0.1", "UQ1.62"] {
                let of = |v: &&Variant| v.input == format || v.output == format;
                assert_eq!(report.variants.iter().filter(of).count(), 3, "{rest}");
            }
            for variant in &report.variants {
                assert_eq!(variant.answers == 0, variant.refused.is_some(), "{variant:?}");
            }
        }
    }

    /// An answer that is off by more than its bound, or has a flag too many or too few, is told.
    #[test]
    fn a_wrong_answer_does_not_hold() {
        for rest in CONFIGURATIONS {
            let design = design(rest);
            let one = design.config().input.one();
            let mut wrong = 0;
            for (case, x) in cases(&design, 4) {
                let right = design.datapath().evaluate(4, x);
                assert!(answer(&design, "s", (case, x), &right).holds, "{rest}: {case}");
                let further = if right.intensity > 3 { -3 } else { 3 };
                for damaged in [
                    Signals { intensity: right.intensity + further, ..right },
                    Signals { intensity: -1, ..right },
                    Signals { status: right.status.with(Status::NO_WORD, true), ..right },
                    Signals {
                        status: right.status.with(Status::ABOVE_ONE, true),
                        intensity: if x > one { -1 } else { right.intensity },
                        ..right
                    },
                ] {
                    let told = answer(&design, "s", (case, x), &damaged);
                    assert!(!told.holds, "{rest}: {case}: {told:?}");
                    wrong += 1;
                }
            }
            assert!(wrong >= 4 * 8, "{wrong}");
        }
    }

    /// A ROM word at an edge of its format leaves the proved ranges; a format with a bit less is refused.
    #[test]
    fn a_coefficient_at_its_edge_is_seen_in_a_register() {
        let design = design(CONFIGURATIONS[0]);
        let words = words(&design, &addresses(&design));
        assert!(words.iter().any(|word| word.overflowing > 0), "{words:#?}");
        let refused = words.iter().filter(|word| word.edge == "a bit less");
        assert!(refused.clone().count() >= 4);
        for word in refused {
            assert!(word.holds && word.outcome.starts_with("refused: "), "{word:?}");
        }
    }

    #[test]
    fn flags_are_those_of_the_input() {
        let design = design(CONFIGURATIONS[0]);
        let of = |address, x| flags(&design, address, x).0.to_string();
        assert_eq!(of(0, 1024), "-");
        assert_eq!(of(0, 1025), "above_one");
        assert_eq!(of(9, -1), "no_word+facing_away");
    }
}
