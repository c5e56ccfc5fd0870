//! From what is asked to the smaller configuration.
//!
//! What stays is computed as the source computes it: every format keeps its place of the point, so that every line
//! rounds at the same place, and loses only bits that no row and no x needs. What may go besides, where answers need
//! not be the same bits but only the same display codes, is tried by the certificate: see [`super::codes`].

use hw_model::config::{Config, Tail};
use hw_model::design::{Design, DesignError};
use hw_model::domain::Presented;
use hw_model::exponents::{Exponents, ExponentsError};
use hw_model::format::QFormat;
use hw_model::quantise::round_scaled;
use hw_model::registers::Register;
use hw_model::rounding::Rounding;
use thiserror::Error;

use super::demand::Demand;
use hw_model::stated::{of_stated, stated, taken, tight};
use hw_model::widths::StatedWidths;

/// Why a scene has no hardware of its own.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SpecialiseError {
    /// Nothing is lit and seen.
    #[error("the scene asks for no highlight: no surface is both lit and seen")]
    NothingAsked,
    /// An exponent that the source has not.
    #[error(
        "the ROM of {configuration} has no word for n = {exponent}; it has {available}; --nearest shares rows among \
         exponents"
    )]
    MissingExponent {
        /// The name of the source configuration.
        configuration: String,
        /// The scene's exponent that has no word.
        exponent: f64,
        /// The exponents of its ROM.
        available: String,
    },
    /// A list of exponents that cannot be one.
    #[error("the scene's exponents: {0}")]
    Exponents(#[from] ExponentsError),
    /// The smaller configuration is refused.
    #[error("the smaller configuration is refused: {0}")]
    Design(#[from] DesignError),
}

/// The part of the domain that one exponent has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AskedRow {
    /// The x that the scene presents with this exponent.
    pub demand: Demand,
    /// The exponent whose row answers: its own, or one that is near it ([`serve`](fn@super::serve)).
    pub serving: f64,
    /// Where the source has the demand's own exponent.
    pub address: u32,
    /// The source's cut of the row that answers, in the input's unit.
    pub cut: i64,
    /// The least x that is asked, in the input's unit, rounded down.
    pub least: i64,
}

/// The rows that are asked for, each by its own exponent.
///
/// # Errors
/// When nothing is asked, or an exponent has no word.
pub fn rows(source: &Design, demands: &[Demand]) -> Result<Vec<AskedRow>, SpecialiseError> {
    let own: Vec<f64> = demands.iter().map(|demand| demand.exponent).collect();
    served_rows(source, demands, &own)
}

/// The rows that are asked for, where each demand is served by the row of the exponent at its place in `serving`.
///
/// # Errors
/// When nothing is asked, or an exponent of either has no word.
pub fn served_rows(source: &Design, demands: &[Demand], serving: &[f64]) -> Result<Vec<AskedRow>, SpecialiseError> {
    if demands.is_empty() {
        return Err(SpecialiseError::NothingAsked);
    }
    let rom = source.rom();
    let input = source.config().input;
    let place_of = |exponent: f64| {
        rom.exponents().position(exponent).ok_or_else(|| SpecialiseError::MissingExponent {
            configuration: source.config().name.clone(),
            exponent,
            available: rom.exponents().to_string(),
        })
    };
    let row = |(demand, &serving): (&Demand, &f64)| {
        let scaled = round_scaled(demand.least, input.fraction_bits(), Rounding::Floor);
        Ok(AskedRow {
            demand: *demand,
            serving,
            address: place_of(demand.exponent)? as u32,
            cut: source.datapath().front_end().cut(&rom.rows()[place_of(serving)?]),
            least: scaled.unwrap_or(0) as i64,
        })
    };
    demands.iter().zip(serving).map(row).collect()
}

/// The exponents whose rows answer, each once, rising.
#[must_use]
pub fn serving(rows: &[AskedRow]) -> Vec<f64> {
    let mut list: Vec<f64> = rows.iter().map(|row| row.serving).collect();
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}

/// True where no row needs what lies below its cut.
#[must_use]
pub fn is_guarded(source: &Design, rows: &[AskedRow]) -> bool {
    source.datapath().degree() > 0 && rows.iter().all(|row| row.least >= row.cut)
}

/// The smaller hardware, bit for bit the source over the rows.
///
/// # Errors
/// When the smaller configuration is refused.
pub fn derive(source: &Design, rows: &[AskedRow], name: &str) -> Result<Design, SpecialiseError> {
    let mut config = kept(source, rows, name)?;
    config.widths = source.widths();
    if config.tail == Tail::Zero {
        for register in [Register::TailA, Register::TailB, Register::Divisor] {
            config.widths.set(register, None);
        }
    }
    let loose = Design::new(config)?;
    // Coefficients without their common zeros first; a bound that does not know them keeps the zeros.
    let mut refused = None;
    for zeros in [true, false] {
        let mut config = loose.config().clone();
        config.widths = tightened(&loose, zeros);
        match Design::new(config) {
            Ok(design) => return Ok(design),
            Err(error) => refused = Some(error),
        }
    }
    match refused {
        Some(error) => Err(error.into()),
        None => Ok(loose),
    }
}

/// The configuration with the rows and parts that are needed; its widths are not settled.
///
/// # Errors
/// When the exponents are no list.
pub(super) fn kept(source: &Design, rows: &[AskedRow], name: &str) -> Result<Config, SpecialiseError> {
    let mut config = source.config().clone();
    config.name = format!("{name}_{}", config.name);
    config.description = format!("{} for what the scene {name} asks", source.config().name);
    config.exponents = Exponents::new(serving(rows))?;
    config.coefficient_steps.retain(|steps| config.exponents.position(steps.n).is_some());
    config.domain = Vec::new();
    if is_guarded(source, rows) {
        config.tail = Tail::Zero;
        let least = |n: f64| {
            let of_it = rows.iter().filter(|row| row.serving == n);
            Presented { n, least: of_it.map(|row| row.demand.least).fold(1.0, f64::min) }
        };
        config.domain = config.exponents.iter().map(least).collect();
    }
    Ok(config)
}

/// The narrowest formats for what every register takes, their points where they are; without the zeros that
/// all rows of a coefficient end with, where `zeros` go.
fn tightened(design: &Design, zeros: bool) -> StatedWidths {
    let mut formats = tight(&of_stated(&design.widths()), &taken(design));
    // Steps are counted in last places.
    if zeros && design.config().coefficient_steps.is_empty() {
        // A and B of the tail meet the quotient at a place of the point that both share with the divisor, and keep it.
        for power in 0..=design.datapath().degree() {
            let register = Register::C(0, power);
            formats[register] = formats[register].map(|format| without_zeros(design, power, format));
        }
    }
    stated(&formats)
}

/// The same numbers with fewer fraction bits. The product is as exact as before, so that the line's one rounding
/// gives the same.
fn without_zeros(design: &Design, power: usize, format: QFormat) -> QFormat {
    let segments = design.datapath().segment_count();
    let bits =
        |row: &hw_model::rom::Row| (0..segments).fold(0, |all, segment| all | row.get(Register::C(segment, power)));
    let all = design.rom().rows().iter().fold(0, |all, row| all | bits(row));
    let most = if all == 0 { format.fraction_bits() } else { all.trailing_zeros() };
    let fewer = most.min(format.fraction_bits());
    let make = if format.is_signed() { QFormat::signed } else { QFormat::unsigned };
    // A field of zeros alone keeps one bit.
    let integer = format.integer_bits().max(i32::from(all == 0));
    make(integer, format.fraction_bits() - fewer).unwrap_or(format)
}

#[cfg(test)]
mod tests {
    use hw_model::design::RealRow;

    use super::*;

    /// Ends with fewer bits than x: of two segments, and above a divider.
    const SOURCES: [&str; 2] = [
        r#"{"name": "ends", "method": "minimax", "segments": 2, "cut": "balanced",
            "exponents": "2,5,40", "input": "UQ1.12", "output": "UQ1.10",
            "widths": {"cut": "UQ1.6", "hand_over": "UQ1.4"}}"#,
        r#"{"name": "tail", "method": "hermite", "tail": "rational", "exponents": "2,64",
            "input": "UQ1.12", "output": "UQ1.10", "widths": {"cut": "UQ1.5"}}"#,
    ];

    #[test]
    fn narrow_ends_stay_where_they_are() {
        for json in SOURCES {
            let source = Design::new(Config::from_json(json).unwrap()).unwrap();
            for place in 0..5 {
                same_from(&source, place);
            }
        }
    }

    /// Of each row: 0, its cut, a little above it, its hand-over, and the greatest x.
    fn same_from(source: &Design, place: usize) {
        let greatest = source.datapath().front_end().greatest;
        let demand = |row: &RealRow| {
            let ends = [0, row.cut, row.cut + 3, row.least_of_segment(0), greatest];
            let least = ends[place] as f64 * source.config().input.ulp();
            Demand { exponent: row.exponent, least, greatest: 1.0 }
        };
        let demands: Vec<Demand> = source.rows().iter().map(demand).collect();
        let rows = rows(source, &demands).unwrap();
        let small = derive(source, &rows, "small").unwrap();
        assert_eq!(small.config().domain.is_empty(), place == 0, "{:?}", small.config().domain);
        for (address, row) in (0..).zip(&rows) {
            for x in row.least..=greatest {
                let [was, is] = [source, &small].map(|d| d.datapath().evaluate(address, x).intensity);
                assert_eq!(was, is, "n = {}, x {x}", row.demand.exponent);
            }
        }
        let cut = small.datapath().formats().cut.unwrap().fraction_bits();
        let stated = source.datapath().formats().cut.unwrap().fraction_bits();
        assert_eq!(cut, if place == 0 { stated } else { 12 });
    }
}
