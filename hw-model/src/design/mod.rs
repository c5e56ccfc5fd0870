//! From a configuration to hardware: real rows, widths, ROM, data path.
//!
//! [`Design::preset`] and [`Design::highlight`] are the front door; this is the way behind it:
//!
//! ```text
//! Config → real rows (fit) → fraction bits (budget) → ROM integers (quantise) → ranges → formats → Datapath
//! ```

mod doubt;
mod error;
mod highlight;
mod parts;
mod polynomial;
mod real_row;
mod revision;
mod rom_row;
mod shares;
mod tail;
mod whole;

use crate::budget::BudgetError;
use crate::config::{Config, ConfigError};
use crate::datapath::Datapath;
use crate::datapath::front_end::FrontEnd;
use crate::datapath::stage::Stages;
use crate::domain;
use crate::format::QFormat;
use crate::rom::Rom;
use parts::Parts;

pub use error::DesignError;
pub use highlight::HighlightError;
pub use real_row::{RealRow, RealSegment};
pub use revision::Revision;
pub use rom_row::RomRow;
pub use shares::Share;
pub use whole::Design;

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
            let least = domain::least_bits(&config.domain, config.input, row.exponent, row.cut);
            let least = least.map_err(|problem| ConfigError::Field { field: "domain", problem })?;
            row.cut = least.unwrap_or(row.cut);
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
        let mut datapath = Datapath {
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
            pipelining: config.pipelining,
            control: config.control(),
            narrow,
        };
        let refused = |problem| ConfigError::Field { field: "pipelining", problem };
        datapath.check_pipelining().map_err(refused)?;
        if let Some(clock) = &config.clock {
            clock.reach(&mut datapath, config.quotient_bits_per_stage)?;
        }
        doubt::settle(parts.doubts, &datapath)?;
        Ok(Self { config, fitted, rows, bounds: parts.bounds, datapath })
    }
}
