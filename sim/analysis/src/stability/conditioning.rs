//! How ill-conditioned the two forms of a cubic are, and the widths that costs.
//!
//! The condition of a sum is Σ|term| / |sum|: how much a relative change of one coefficient can show
//! in the value, and 2^condition-bits what the coefficients need beyond the result. It is taken at
//! x = 1 and at its worst over the epicentre, where f is at least Q. The power form's a, b, c are of size
//! n² and cancel to 1; the centred form adds terms of size 1 or less.
//!
//! Beside them the condition of k1 = 3a + 2b + c, for programs that convert one form into the other, and
//! the condition of x^n against a relative change of x, which is n whatever computes it.
//!
//! **Widths.** For a faithful result (less than 1 ulp from the polynomial with real coefficients) of 8, 12,
//! 16 and 20 bits: the project's own width derivation, for a ROM of exponents 1 to n, at least three in each
//! octave. x has so many bits that its own rounding shows less than half an ulp at n. What cannot be had
//! is there with the reason.

use hw_model::config::{Config, Cut, Form, Tail};
use hw_model::design::Design;
use hw_model::exponents::{Exponents, ExponentsError};
use hw_model::fit::{FitError, Levels, Method, fit};
use hw_model::format::{FormatError, QFormat};
use hw_model::highlight::Cubic;
use hw_model::registers::{CUBIC, Register};
use hw_model::rounding::Rounding;
use rayon::prelude::*;
use serde::Serialize;
use thiserror::Error;

/// The methods that give a polynomial by a formula.
fn methods() -> impl Iterator<Item = Method> {
    Method::ALL.into_iter().filter(|method| method.has_polynomial() && method.capabilities().closed_form)
}

/// The bits of the results.
pub const OUTPUT_BITS: [u32; 4] = [8, 12, 16, 20];
/// The error budget of a faithful result, in ulp: less than 1.
const FAITHFUL_ULP: f64 = 0.999;
/// Exponents in a decade.
const STEPS_PER_DECADE: u32 = 8;
/// Points of the epicentre.
const POINTS: u32 = 128;
/// log2 of the greatest exponents of the width table; the last is the largest below 10⁹.
const OCTAVES: [u32; 11] = [0, 2, 4, 6, 8, 10, 12, 14, 17, 20, 29];

/// Why there is no table.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ConditioningError {
    /// A method has no fit for an exponent.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A list of exponents.
    #[error(transparent)]
    Exponents(#[from] ExponentsError),
    /// A format of x or of the result that cannot be.
    #[error(transparent)]
    Format(#[from] FormatError),
}

/// The conditions of one cubic.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Condition {
    /// The method that gives the cubic.
    pub method: Method,
    /// The exponent, 1 or more.
    pub n: f64,
    /// Σ|term|/f of the power form at x = 1.
    pub power_at_one: f64,
    /// The same at its worst over the epicentre.
    pub power_epicentre: f64,
    /// Σ|term|/f of the centred form at its worst over the epicentre (at x = 1 it is 1).
    pub centred_epicentre: f64,
    /// Of k1 = 3a + 2b + c.
    pub conversion: f64,
    /// Of x^n in x.
    pub reference: f64,
}

/// The widths of one pipeline, or why there is none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Widths {
    /// The method that gives the cubics.
    pub method: Method,
    /// Fraction bits of the result.
    pub output_bits: u32,
    /// The greatest exponent of the ROM.
    pub greatest_n: f64,
    /// The form in which the polynomial is evaluated.
    pub form: Form,
    /// The format of x.
    pub input: String,
    /// Bits of c0 to c3, without those that are the same in every row.
    pub coefficient_bits: Option<u32>,
    /// Bits of the widest of them.
    pub widest_coefficient: Option<u32>,
    /// The multiplier with the most partial products, as bits by bits.
    pub widest_multiplier: Option<String>,
    /// Partial products of all three multipliers: the sum of their areas.
    pub multiplier_area: Option<u32>,
    /// Bits of a ROM word.
    pub rom_word: Option<u32>,
    /// The proved bound, in ulp of the result.
    pub bound_ulp: Option<f64>,
    /// The bound is below 1 ulp.
    pub faithful: bool,
    /// Why there is no such pipeline.
    pub refused: Option<String>,
}

/// The table of conditions and the table of the widths that they cost.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Conditioning {
    /// The level Q of the epicentre.
    pub q: f64,
    /// The lower level G of `three_point`.
    pub g: f64,
    /// The conditions of each method against n.
    pub conditions: Vec<Condition>,
    /// The widths of pipelines for 8 to 20 bits.
    pub widths: Vec<Widths>,
}

/// Conditions of every method up to n = 10⁹, and the widths of `hermite` and `three_point`.
///
/// # Errors
/// When a fit or a list of exponents is refused, which none of these is.
pub fn conditioning(levels: Levels) -> Result<Conditioning, ConditioningError> {
    let step = |i: u32| 10_f64.powf(f64::from(i) / f64::from(STEPS_PER_DECADE));
    let mut conditions = Vec::new();
    for method in methods() {
        for n in (0..=9 * STEPS_PER_DECADE).map(step) {
            if let Some(cubic) = fit(method, n, levels)?.cubic() {
                conditions.push(condition(method, n, cubic, levels)?);
            }
        }
    }
    let mut wanted = Vec::new();
    for method in [Method::Hermite, Method::ThreePoint] {
        for output_bits in OUTPUT_BITS {
            for octave in OCTAVES {
                for form in [Form::Power, Form::Centred] {
                    wanted.push((method, output_bits, octave, form));
                }
            }
        }
    }
    let widths = wanted
        .into_par_iter()
        .map(|(method, bits, octave, form)| widths(method, bits, octave, form, levels))
        .collect::<Result<_, _>>()?;
    Ok(Conditioning { q: levels.q(), g: levels.g(), conditions, widths })
}

fn condition(method: Method, n: f64, cubic: &Cubic, levels: Levels) -> Result<Condition, FitError> {
    let (power, k) = (&cubic.power, &cubic.centred);
    let at_s = |s: f64| {
        let x = 1.0 - s;
        let value = k.value_at_s(s).abs();
        let terms = power.a.abs() * x * x * x + power.b.abs() * x * x + power.c.abs() * x;
        let centred = 1.0 + s * (k.k1.abs() + s * (k.k2.abs() + s * k.k3.abs()));
        ((terms + power.d.abs()) / value, centred / value)
    };
    let p = hw_model::fit::crossing(n, levels.q())?.s;
    let points = (0..=POINTS).map(|i| at_s(p * f64::from(i) / f64::from(POINTS)));
    let (power_epicentre, centred_epicentre) =
        points.fold((0.0_f64, 0.0_f64), |(power, centred), at| (power.max(at.0), centred.max(at.1)));
    let conversion = (3.0 * power.a).abs() + (2.0 * power.b).abs() + power.c.abs();
    Ok(Condition {
        method,
        n,
        power_at_one: at_s(0.0).0,
        power_epicentre,
        centred_epicentre,
        conversion: conversion / k.k1.abs(),
        reference: n,
    })
}

/// 1 to 2^octave, three in each octave: where u = s·2^⌊log2 n⌋ is least, in between, and greatest.
fn exponents(octave: u32) -> Result<Exponents, ExponentsError> {
    let mut list: Vec<f64> = (0..octave)
        .flat_map(|e| {
            let power = f64::from(e).exp2();
            [power, 1.5 * power, 2.0 * power - 1.0]
        })
        .chain([f64::from(octave).exp2()])
        .collect();
    list.sort_unstable_by(f64::total_cmp);
    list.dedup();
    Exponents::new(list)
}

fn widths(
    method: Method,
    output_bits: u32,
    octave: u32,
    form: Form,
    levels: Levels,
) -> Result<Widths, ConditioningError> {
    // Half an ulp of x times the slope n is half an ulp of the result.
    let input = QFormat::unsigned(1, output_bits + octave)?;
    let config = Config {
        name: "widths".to_owned(),
        method,
        exponents: exponents(octave)?,
        input,
        output: QFormat::unsigned(1, output_bits)?,
        description: String::new(),
        q: levels.q(),
        g: levels.g(),
        form,
        tail: Tail::Zero,
        cut: Cut::Epicentre,
        rounding: Rounding::NearestUp,
        quotient_bits_per_stage: 1,
        multiplier_operand_bits: None,
        error_budget_ulp: FAITHFUL_ULP,
        degree: CUBIC,
        segments: 1,
        widths: Default::default(),
        coefficient_steps: Vec::new(),
        domain: Vec::new(),
        pipelining: Default::default(),
        clock: None,
        handshake: Default::default(),
        reset: Default::default(),
    };
    let mut row = Widths {
        method,
        output_bits,
        greatest_n: f64::from(octave).exp2(),
        form,
        input: input.to_string(),
        coefficient_bits: None,
        widest_coefficient: None,
        widest_multiplier: None,
        multiplier_area: None,
        rom_word: None,
        bound_ulp: None,
        faithful: false,
        refused: None,
    };
    match Design::new(config) {
        Ok(design) => measure(&design, &mut row),
        Err(refusal) => row.refused = Some(refusal.to_string()),
    }
    Ok(row)
}

fn measure(design: &Design, row: &mut Widths) {
    let layout = design.rom().layout();
    let stored = (0..=CUBIC)
        .map(|power| Register::C(0, power))
        .filter_map(|name| layout.field(name))
        .filter(|field| matches!(field.place, hw_model::rom::Place::Stored { .. }));
    let coefficients: Vec<u32> = stored.map(|field| field.format.width()).collect();
    row.coefficient_bits = Some(coefficients.iter().sum());
    row.widest_coefficient = coefficients.iter().copied().max();
    row.rom_word = Some(layout.word_width());
    if let Some(formats) = &design.datapath().formats().polynomial {
        let v = formats.v.width();
        let operands: Vec<u32> = (1..=formats.degree()).map(|stage| formats.multiplicand(stage).width()).collect();
        row.multiplier_area = Some(operands.iter().map(|width| width * v).sum());
        let widest = operands.into_iter().max();
        row.widest_multiplier = widest.map(|width| format!("{width}x{v}"));
    }
    let bound = design.bounds().iter().map(|bound| bound.total()).fold(0.0, f64::max);
    row.bound_ulp = Some(bound);
    row.faithful = bound < 1.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_forms_are_conditioned_as_their_algebra_says() {
        // x³: one term in the power form, 1 + 3s + 3s² + s³ over (1 − s)³ in the centred one.
        let cubic = *fit(Method::Hermite, 3.0, Levels::default()).unwrap().cubic().unwrap();
        let found = condition(Method::Hermite, 3.0, &cubic, Levels::default()).unwrap();
        assert_eq!((found.power_at_one, found.conversion), (1.0, 1.0));
        assert!((found.power_epicentre - 1.0).abs() < 1e-12);
        let p = 1.0 - 0.5_f64.powf(1.0 / 3.0);
        let wanted = (1.0 + p).powi(3) / 0.5;
        assert!((found.centred_epicentre / wanted - 1.0).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn the_power_form_grows_as_n_squared_and_the_centred_does_not() {
        let table = conditioning(Levels::default()).unwrap();
        for method in methods() {
            let at = |n: f64| {
                let near = |row: &&Condition| row.method == method && row.n >= n * 0.999;
                *table.conditions.iter().find(near).unwrap()
            };
            let (low, high) = (at(1e4), at(1e6));
            let growth = high.power_at_one / low.power_at_one;
            assert!((growth / 1e4 - 1.0).abs() < 0.01, "{method}: {growth}");
            assert!(high.centred_epicentre < 7.0, "{method}: {high:?}");
            assert!((high.centred_epicentre / low.centred_epicentre - 1.0).abs() < 0.01);
            let growth = high.conversion / low.conversion;
            assert!((growth / 100.0 - 1.0).abs() < 0.01, "{method}: {growth}");
        }
        for row in &table.widths {
            assert_eq!(row.faithful, row.refused.is_none(), "{row:?}");
            assert_eq!(row.bound_ulp.is_some(), row.refused.is_none(), "{row:?}");
        }
        let bits = |form, octave: f64, output| {
            let row = table.widths.iter().find(|row| {
                (row.method, row.form, row.greatest_n, row.output_bits) == (Method::Hermite, form, octave, output)
            });
            row.unwrap().widest_coefficient
        };
        // Two bits for each octave of n in the power form, none in the centred one.
        let (low, high) = (bits(Form::Power, 64.0, 8).unwrap(), bits(Form::Power, 1024.0, 8).unwrap());
        assert!((7..=9).contains(&(high - low)), "{low}, {high}");
        let (low, high) = (bits(Form::Centred, 64.0, 8).unwrap(), bits(Form::Centred, 1024.0, 8).unwrap());
        assert!(high <= low + 1, "{low}, {high}");
    }
}
