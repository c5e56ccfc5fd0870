//! What hardware a configuration gives, and which the page can begin with.

use hw_model::presets;
use hw_model::stated;
use serde::{Deserialize, Serialize};

use crate::configuration::Configuration;
use crate::figures::Figures;
use crate::known::Known;
use crate::refusal::Refusal;
use crate::words::Format;

/// What the page begins with.
#[derive(Debug, Serialize)]
pub(crate) struct Beginning {
    presets: Vec<Preset>,
    configuration: Configuration,
}

#[derive(Debug, Serialize)]
struct Preset {
    name: &'static str,
    /// Its text.
    json: &'static str,
}

impl Beginning {
    /// With the configuration that the server was started with.
    pub(crate) fn new(configuration: &Configuration) -> Self {
        let presets = presets::ALL.map(|preset| Preset { name: preset.name, json: preset.json });
        Self { presets: presets.into(), configuration: configuration.clone() }
    }
}

/// Which hardware.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HardwareAsk {
    /// Of which configuration.
    pub(crate) configuration: Configuration,
}

/// The hardware of a configuration that was checked.
#[derive(Debug, Serialize)]
pub(crate) struct Hardware {
    name: String,
    description: String,
    /// The configuration as JSON.
    text: String,
    /// The ROM's exponents, in the order of their addresses.
    exponents: Vec<f64>,
    /// The same as configurations state them.
    stated_exponents: String,
    input: Format,
    output: Format,
    /// The bits of the greatest x in [0, 1].
    greatest_x: String,
    /// Registers whose formats can be altered.
    registers: Vec<Alterable>,
    figures: Figures,
}

/// A register whose format can be altered.
#[derive(Debug, Serialize)]
struct Alterable {
    name: &'static str,
    format: Format,
    /// Its format with a fraction bit less, where there is one.
    fewer: Option<String>,
    /// The same with one more.
    more: Option<String>,
}

impl Hardware {
    /// The hardware of a design.
    ///
    /// # Errors
    /// When it cannot be measured.
    pub(crate) fn of(known: &Known) -> Result<Self, Refusal> {
        let (config, datapath) = (known.design.config(), known.datapath());
        let registers = known.design.widths();
        let registers = registers.iter().map(|(register, format)| Alterable {
            name: stated::name(register),
            format: format.into(),
            fewer: stated::with_fraction(format, -1).map(|format| format.to_string()),
            more: stated::with_fraction(format, 1).map(|format| format.to_string()),
        });
        Ok(Self {
            name: config.name.clone(),
            description: config.description.clone(),
            text: known.configuration.text()?.to_owned(),
            exponents: config.exponents.as_slice().to_vec(),
            stated_exponents: config.exponents.to_string(),
            input: config.input.into(),
            output: config.output.into(),
            greatest_x: datapath.front_end().greatest.to_string(),
            registers: registers.collect(),
            figures: known.figures()?.clone(),
        })
    }
}
