//! A model that owns its design, and answers one request at a time.

use std::path::Path;
use std::sync::Arc;

use hw_model::config::Config;
use hw_model::datapath::{Datapath, Logic, Status};
use hw_model::design::{Design, DesignError, HighlightError};
use hw_model::format::Overflow;
use hw_model::presets;
use hw_model::quantise::{QuantiseError, real, x_bits};
use vectors::configuration_file;
use vectors::rtl::probes::{Port, Probe, ports, probes};

use crate::error::Error;

/// The golden model of one configuration. A clone shares the design with it; threads may ask one model at a time or
/// together.
#[derive(Debug, Clone)]
pub struct Model {
    design: Arc<Design>,
    probes: Arc<[Probe]>,
    logic: Logic,
}

/// What the hardware answers to a request.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Answer {
    /// Bits in the output format.
    pub intensity: i64,
    /// The flags of the result.
    pub status: Status,
}

impl Model {
    /// The model of a preset.
    ///
    /// # Errors
    /// When there is no preset of this name.
    pub fn preset(name: &str) -> Result<Self, Error> {
        let none = || Error::NoPreset(DesignError::NoPreset { name: name.to_owned() });
        let preset = presets::find(name).ok_or_else(none)?;
        let origin = format!("preset {name}");
        Self::of(configuration_file::parse(preset.json, &origin)?, &origin)
    }

    /// The model of a configuration as JSON.
    ///
    /// # Errors
    /// When the text is no configuration, or gives no hardware.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let origin = "configuration";
        Self::of(configuration_file::parse(text, origin)?, origin)
    }

    /// The model of a configuration in a file.
    ///
    /// # Errors
    /// As [`Model::from_json`], and when the file cannot be read.
    pub fn from_file(path: &Path) -> Result<Self, Error> {
        Self::of(configuration_file::read(path)?, &path.display().to_string())
    }

    fn of(config: Config, origin: &str) -> Result<Self, Error> {
        let design = Design::new(config).map_err(|error| Error::Design { origin: origin.to_owned(), error })?;
        Ok(Self::new(design))
    }

    /// The model of a design.
    #[must_use]
    pub fn new(design: Design) -> Self {
        let probes = probes(design.datapath()).into();
        Self { logic: design.datapath().logic(), design: Arc::new(design), probes }
    }

    /// The design: configuration, formats, ROM, real rows.
    #[must_use]
    pub fn design(&self) -> &Design {
        &self.design
    }

    pub(crate) const fn shared_design(&self) -> &Arc<Design> {
        &self.design
    }

    /// The data path that answers.
    #[must_use]
    pub fn datapath(&self) -> &Datapath {
        self.design.datapath()
    }

    pub(crate) const fn logic(&self) -> &Logic {
        &self.logic
    }

    /// Clock cycles from a request to its result, which is the number of ranks.
    #[must_use]
    pub fn latency(&self) -> usize {
        self.datapath().latency()
    }

    /// The ports, as the RTL names them, the clock first.
    #[must_use]
    pub fn ports(&self) -> [Port; 10] {
        ports(self.datapath())
    }

    /// Every register of every rank, with its name, its format and its path in the RTL below the top module.
    #[must_use]
    pub fn probes(&self) -> &[Probe] {
        &self.probes
    }

    /// The ROM address of the exponent n.
    ///
    /// # Errors
    /// When the ROM has no word for n.
    pub fn address(&self, n: f64) -> Result<u32, Error> {
        let exponents = self.design.rom().exponents();
        let position = exponents.position(n).map(|position| position as u32);
        position
            .ok_or_else(|| Error::Exponent(HighlightError::Exponent { exponent: n, available: exponents.to_string() }))
    }

    /// The bits of a real x in the input format: the nearest, a tie to even; the format's end for an x beyond it.
    ///
    /// # Errors
    /// When x is not finite.
    pub fn x_bits(&self, x: f64) -> Result<i64, Error> {
        x_bits(x, self.datapath().formats().input, Overflow::Saturate).map_err(Error::X)
    }

    /// The same bits, where the input format holds them.
    ///
    /// # Errors
    /// When it does not.
    pub(crate) fn held(&self, x_bits: i64) -> Result<i64, Error> {
        self.datapath().formats().input.fit(x_bits.into(), Overflow::Refuse).map_err(Error::Bits)
    }

    /// The real value of bits in the output format.
    #[must_use]
    pub fn intensity(&self, bits: i64) -> f64 {
        real(bits, self.datapath().formats().output)
    }

    /// The intensity, in [0, 1], that the hardware answers to the exponent n and x = cos γ.
    ///
    /// # Errors
    /// When the ROM has no word for n, or x is not finite.
    pub fn highlight(&self, n: f64, x: f64) -> Result<f64, Error> {
        self.design.highlight(n, x).map_err(|error| match error {
            HighlightError::X(error) => Error::X(error),
            error => Error::Exponent(error),
        })
    }

    /// The words on the ports `intensity` and `status` for those on the ports `address` and `x`. An address without a
    /// ROM word gives 0 and a flag.
    ///
    /// # Errors
    /// When the input format does not hold the bits of x.
    pub fn evaluate(&self, address: u32, x_bits: i64) -> Result<Answer, Error> {
        let held = self.datapath().evaluate(address, self.held(x_bits)?);
        Ok(Answer { intensity: held.intensity, status: held.status })
    }

    /// The bits that every register holds of a request on its way through the ranks, in the order of
    /// [`probes`](Self::probes).
    ///
    /// # Errors
    /// When the input format does not hold the bits of x.
    pub fn registers(&self, address: u32, x_bits: i64) -> Result<Vec<i64>, Error> {
        let passage = self.datapath().passage(address, self.held(x_bits)?);
        Ok(self.probes.iter().map(|probe| probe.register.bits(&passage[probe.rank])).collect())
    }
}

/// What was not finite, for callers that read real numbers themselves.
impl From<QuantiseError> for Error {
    fn from(error: QuantiseError) -> Self {
        Self::X(error)
    }
}
