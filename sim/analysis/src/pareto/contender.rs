//! What is compared: methods as a processor computes them, what a processor has beside them, and the
//! presets bit for bit.

use hw_model::config::{Config, ConfigError};
use hw_model::datapath::Block;
use hw_model::design::{Design, DesignError};
use hw_model::fit::minimax::{Fitted, Range, segments};
use hw_model::fit::{Fit, FitError, Levels, Method, fit};
use hw_model::highlight::phong;
use hw_model::presets::{self, Preset};
use hw_model::registers::CUBIC;
use thiserror::Error;

use super::functions::Real;
use super::inputs::{Inputs, Samples};
use super::kernel::{Kernel, Loops};
use crate::hardware_cost::HardwareCost;

/// Intervals of the two tables of straight lines.
const INTERVALS: [usize; 2] = [256, 4096];

/// The greatest exponent of repeated squaring.
const GREATEST_POWER: f64 = u32::MAX as f64;

/// Why there is nothing to compare.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ContenderError {
    /// An exponent that no method takes.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A preset that does not parse.
    #[error("{name}: {source}")]
    Config {
        /// The preset, such as `preset paper`.
        name: String,
        /// What is wrong with the preset's JSON.
        source: ConfigError,
    },
    /// Two configurations of one name, which no table could tell apart.
    #[error("two configurations have the name {0}; give each a \"name\" of its own")]
    Twice(String),
    /// A preset or configuration that gives no hardware for these inputs.
    #[error("{name} with the input {input} and the exponents {exponents}: {source}")]
    Design {
        /// The contender, such as `preset paper` or `config mine`.
        name: String,
        /// The format of x.
        input: String,
        /// The list of exponents.
        exponents: String,
        /// Why no hardware follows.
        source: Box<DesignError>,
    },
}

/// One of those that are compared.
#[derive(Debug)]
pub struct Contender {
    /// Its name in tables, such as `hermite f32` or `preset paper`.
    pub name: String,
    /// The method or function, without the precision: what f32 and f64 have in common.
    pub family: String,
    /// What it computes, in a sentence.
    pub what: String,
    /// The processor's formula or the golden model, which gives its values.
    pub engine: Engine,
}

/// What gives the values of a contender: a processor's formula in f32 or f64, or hardware.
#[derive(Debug)]
pub enum Engine {
    /// A processor, in f32.
    Single(Kernel<f32>),
    /// A processor, in f64.
    Double(Kernel<f64>),
    /// The golden model, block by block.
    Hardware(Box<Design>),
}

impl Engine {
    /// `f32`, `f64` or `hardware`.
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Single(_) => "f32",
            Self::Double(_) => "f64",
            Self::Hardware(_) => "hardware",
        }
    }

    /// Bits of table or ROM.
    #[must_use]
    pub fn storage_bits(&self) -> u64 {
        match self {
            Self::Single(kernel) => kernel.table_bits(),
            Self::Double(kernel) => kernel.table_bits(),
            Self::Hardware(design) => design.rom().bits(),
        }
    }

    /// What it costs as hardware, where it is hardware.
    #[must_use]
    pub fn cost(&self) -> Option<HardwareCost> {
        match self {
            Self::Hardware(design) => Some(HardwareCost::of(design)),
            _ => None,
        }
    }

    /// The values at these samples for the exponent at this place.
    pub(super) fn values(&self, row: usize, samples: &Samples, work: &mut Work) {
        let count = samples.bits.len();
        work.wide.resize(count, 0.0);
        match self {
            Self::Single(kernel) => {
                work.single.resize(count, 0.0);
                f32::block(kernel, row, &samples.single, &mut work.single);
                for (wide, single) in work.wide.iter_mut().zip(&work.single) {
                    *wide = single.wide();
                }
            }
            Self::Double(kernel) => f64::block(kernel, row, &samples.double, &mut work.wide),
            Self::Hardware(design) => {
                design.datapath().evaluate_block(row as u32, &samples.bits, &mut work.block);
                let ulp = design.config().output.ulp();
                for (wide, &bits) in work.wide.iter_mut().zip(&work.block.intensities) {
                    *wide = bits as f64 * ulp;
                }
            }
        }
    }
}

/// Memory that is used again.
#[derive(Debug, Default)]
pub(super) struct Work {
    /// The values as f64, one for each sample.
    pub wide: Vec<f64>,
    /// The same before they are f64, where timing leaves them.
    pub single: Vec<f32>,
    pub bits: Vec<i64>,
    pub block: Block,
}

/// Everything that is compared, and what is left out with the reason for it.
#[derive(Debug)]
pub struct Contenders {
    /// Software first, in the order of the methods; then the presets; then the configurations of the user.
    pub list: Vec<Contender>,
    /// Contenders that cannot take part, each with the reason in a sentence.
    pub left_out: Vec<String>,
}

impl Contenders {
    /// All of them for these inputs; `own` are configurations beside the presets, with the input and the exponents of
    /// all.
    ///
    /// # Errors
    /// When an exponent is out of range, a preset or configuration gives no hardware for these inputs, or two
    /// configurations have one name.
    pub fn new(inputs: &Inputs, own: &[Config]) -> Result<Self, ContenderError> {
        let exponents = inputs.exponents.as_slice();
        let mut list = Vec::new();
        for method in Method::ALL {
            methods(method, exponents, &mut list)?;
        }
        two_segments(exponents, &mut list)?;
        functions(exponents, &mut list);
        let mut left_out = Vec::new();
        let whole = |n: &f64| n.fract() == 0.0 && *n <= GREATEST_POWER;
        if exponents.iter().all(whole) {
            both("powers", POWERS, Kernel::powers(exponents), Kernel::powers(exponents), &mut list);
        } else {
            left_out.push(format!("powers: repeated squaring needs integers up to {}", u32::MAX));
        }
        for preset in presets::ALL {
            list.push(hardware_of_preset(preset, inputs)?);
        }
        for config in own {
            let contender = hardware(format!("config {}", config.name), config.clone(), inputs)?;
            if list.iter().any(|other| other.name == contender.name) {
                return Err(ContenderError::Twice(config.name.clone()));
            }
            list.push(contender);
        }
        Ok(Self { list, left_out })
    }
}

const POWERS: &str = "repeated squaring, one multiplication a bit of n and one more for each that is set";

fn methods(method: Method, exponents: &[f64], list: &mut Vec<Contender>) -> Result<(), ContenderError> {
    let (name, what) = (method.name(), method.capabilities().evaluation);
    if method == Method::Schlick {
        both(name, what, Kernel::schlick(exponents), Kernel::schlick(exponents), list);
        return Ok(());
    }
    let levels = Levels::default();
    let fits: Vec<Fit> = exponents.iter().map(|&n| fit(method, n, levels)).collect::<Result<_, _>>()?;
    both(name, what, Kernel::of_fits(&fits), Kernel::of_fits(&fits), list);
    Ok(())
}

/// Beside the methods, as the preset `precise` has it: what a second row of coefficients buys.
fn two_segments(exponents: &[f64], list: &mut Vec<Contender>) -> Result<(), ContenderError> {
    let fits: Vec<Fitted> =
        exponents.iter().map(|&n| segments(n, CUBIC, 2, Range::Balanced)).collect::<Result<_, _>>()?;
    let what = "two minimax cubics, each not less than 0; 0 where x^n is their greatest error";
    both("minimax_2", what, Kernel::segments(&fits), Kernel::segments(&fits), list);
    Ok(())
}

fn functions(exponents: &[f64], list: &mut Vec<Contender>) {
    let what = "powf of the platform";
    both("powf", what, Kernel::powf(exponents), Kernel::powf(exponents), list);
    for intervals in INTERVALS {
        let what = format!("straight lines over {intervals} equal intervals of x");
        let kernel = Kernel::<f32>::linear(exponents, intervals, phong);
        list.push(software(&format!("linear_{intervals}"), &what, Engine::Single(kernel)));
    }
}

fn both(family: &str, what: &str, single: Kernel<f32>, double: Kernel<f64>, list: &mut Vec<Contender>) {
    list.push(software(family, what, Engine::Double(double)));
    list.push(software(family, what, Engine::Single(single)));
}

fn software(family: &str, what: &str, engine: Engine) -> Contender {
    Contender {
        name: format!("{family} {}", engine.kind()),
        family: family.to_owned(),
        what: format!("{what}, in {}", engine.kind()),
        engine,
    }
}

fn hardware_of_preset(preset: Preset, inputs: &Inputs) -> Result<Contender, ContenderError> {
    let name = format!("preset {}", preset.name);
    match preset.config() {
        Ok(config) => hardware(name, config, inputs),
        Err(source) => Err(ContenderError::Config { name, source }),
    }
}

/// The contender of this name, with the exponents and the input of all.
fn hardware(name: String, config: Config, inputs: &Inputs) -> Result<Contender, ContenderError> {
    let config = config.with_inputs(inputs.format, inputs.exponents.clone());
    let (what, family) = (config.description.clone(), config.name.clone());
    let design = Design::new(config).map_err(|source| ContenderError::Design {
        name: name.clone(),
        input: inputs.format.to_string(),
        exponents: inputs.exponents.to_string(),
        source: Box::new(source),
    })?;
    Ok(Contender { name, family, what, engine: Engine::Hardware(Box::new(design)) })
}
