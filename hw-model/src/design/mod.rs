//! From a configuration to hardware: real rows, widths, ROM, data path.
//!
//! [`Design::preset`] and [`Design::highlight`] are the front door; this is the way behind it:
//!
//! ```text
//! Config → real rows (fit) → fraction bits (budget) → ROM integers (quantise) → ranges → formats → Datapath
//! ```

mod doubt;
mod highlight;
mod polynomial;
mod real_row;
mod revision;
mod rom_row;
mod shares;
mod tail;

use thiserror::Error;

use crate::budget::{Bound, BudgetError};
use crate::config::{Config, ConfigError, Form};
use crate::datapath::Datapath;
use crate::datapath::formats::Formats;
use crate::datapath::front_end::FrontEnd;
use crate::datapath::stage::Stages;
use crate::domain;
use crate::fit::FitError;
use crate::format::QFormat;
use crate::presets;
use crate::quantise::QuantiseError;
use crate::registers::Register;
use crate::rom::{Rom, Row};

pub use highlight::HighlightError;
pub use real_row::{RealRow, RealSegment};
pub use revision::Revision;
pub use rom_row::RomRow;
pub use shares::Share;

/// Why a configuration gives no hardware.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DesignError {
    /// A preset that is none.
    #[error("there is no preset {name:?}; there are {}", presets::ALL.map(|preset| preset.name).join(", "))]
    NoPreset {
        /// The name.
        name: String,
    },
    /// The configuration contradicts itself.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A method has no fit for one of the exponents.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// No widths keep the budget, or a stated width is too small.
    #[error(transparent)]
    Budget(#[from] BudgetError),
    /// A ROM field does not hold the value of a row.
    #[error("ROM field {field} at n = {exponent}: {source}")]
    Quantise {
        /// The field's name, as in the ROM's layout.
        field: &'static str,
        /// The row's exponent.
        exponent: f64,
        /// What is wrong with the value or the format.
        source: QuantiseError,
    },
}

/// A configuration with everything that follows from it.
#[derive(Debug, Clone)]
pub struct Design {
    config: Config,
    /// As they were fitted: before their ends were rounded to stated formats, and the domain cut them off.
    fitted: Vec<RealRow>,
    rows: Vec<RealRow>,
    bounds: Vec<Bound>,
    datapath: Datapath,
}

impl Design {
    /// Derives rows, widths, ROM and data path.
    ///
    /// # Errors
    /// When the configuration is inconsistent, a register could overflow or would need more than 63
    /// bits, or the error budget cannot be kept.
    pub fn new(config: Config) -> Result<Self, DesignError> {
        config.check()?;
        let levels = config.levels()?;
        let fitted = config
            .exponents
            .iter()
            .map(|exponent| RealRow::new(&config, levels, exponent))
            .collect::<Result<_, _>>()?;
        Self::of_rows(config, fitted)
    }

    /// The rest, from rows as they were fitted.
    fn of_rows(config: Config, fitted: Vec<RealRow>) -> Result<Self, DesignError> {
        let mut rows: Vec<RealRow> = fitted.iter().map(|row| row.in_places(&config)).collect();
        for row in &mut rows {
            row.cut = domain::least_bits(&config, row.exponent, row.cut)?.unwrap_or(row.cut);
        }
        let mut parts = Parts::new(&config, &rows);
        let polynomial = polynomial::derive(&config, &rows, &mut parts)?;
        let divider = tail::derive(&config, &rows, &mut parts)?;
        let narrow = parts.lane_bits.iter().all(|&(_, bits)| bits <= 63);
        if let Some(&(line, bits)) = parts.lane_bits.iter().find(|(_, bits)| *bits > 127) {
            return Err(BudgetError::LineTooWide { line, bits }.into());
        }
        let input = config.input.fraction_bits();
        let places = |end: Option<QFormat>| end.map_or(0, |end| input - end.fraction_bits());
        let datapath = Datapath {
            rom: Rom::new(config.exponents.clone(), parts.rom_rows, &parts.fields),
            formats: parts.formats,
            front_end: FrontEnd {
                greatest: config.input.max_bits().min(config.input.one()),
                one: config.input.one(),
                variable: polynomial.as_ref().map(|(variable, _)| *variable),
                tail: divider.is_some(),
                guarded: !config.domain.is_empty(),
                cut_up: places(parts.formats.cut),
                hand_over_up: places(parts.formats.hand_over),
                segments: config.segments,
            },
            stages: polynomial.map_or(Stages::NONE, |(_, stages)| stages),
            divider,
            output_one: config.output.max_bits().min(config.output.one()),
            narrow,
        };
        doubt::settle(parts.doubts, &datapath)?;
        Ok(Self { config, fitted, rows, bounds: parts.bounds, datapath })
    }

    /// The configuration from which this design follows.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// The real functions behind each ROM row, in the order of the addresses.
    #[must_use]
    pub fn rows(&self) -> &[RealRow] {
        &self.rows
    }

    /// The proved error bound of each row, in output ulp. (An output format that does not reach 1 shows
    /// its greatest value there: that ulp is the format's, and not in the bound.)
    #[must_use]
    pub fn bounds(&self) -> &[Bound] {
        &self.bounds
    }

    /// The data path: integers in, integers out, without a clock.
    #[must_use]
    pub const fn datapath(&self) -> &Datapath {
        &self.datapath
    }

    /// The ROM that the data path reads, row by row.
    #[must_use]
    pub const fn rom(&self) -> &Rom {
        self.datapath.rom()
    }

    /// True where the polynomial is evaluated in u = (1 − x)·2^e.
    #[must_use]
    pub fn is_centred(&self) -> bool {
        self.config.form == Form::Centred
    }
}

/// What the derivation of the polynomial and of the tail add to.
struct Parts {
    rom_rows: Vec<Row>,
    fields: Vec<(Register, QFormat)>,
    formats: Formats,
    bounds: Vec<Bound>,
    /// Every line with the bits it needs.
    lane_bits: Vec<(&'static str, u32)>,
    /// Stated formats that the ranges refuse.
    doubts: Vec<doubt::Doubt>,
}

impl Parts {
    fn new(config: &Config, rows: &[RealRow]) -> Self {
        Self {
            rom_rows: vec![Row::default(); rows.len()],
            fields: Vec::new(),
            formats: Formats {
                input: config.input,
                output: config.output,
                polynomial: None,
                tail: None,
                cut: None,
                hand_over: None,
            },
            bounds: vec![Bound::default(); rows.len()],
            lane_bits: Vec::new(),
            doubts: Vec::new(),
        }
    }

    /// Adds a field whose bits are given for each row.
    fn add_field(&mut self, name: Register, format: QFormat, bits: impl Iterator<Item = i64>) {
        self.fields.push((name, format));
        for (row, bits) in self.rom_rows.iter_mut().zip(bits) {
            row.set(name, bits);
        }
    }
}
