//! Why no register is narrower: for each of its ends one (n, x) at which a bit less fails.

use hw_model::datapath::Signals;
use hw_model::datapath::reach::{Extreme, Reach};
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::highlight::phong;

use super::error::SizingError;
use super::judge::{Judge, greatest};
use super::narrow::{State, loose};
use hw_model::registers::Register;
use hw_model::stated::{Each, Hardware, ORDER, holds, name, taken, with_fraction, with_integer_less};
use vectors::progress::Progress;

/// At which end the bit is missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fewer {
    /// The last fraction bit.
    Fraction,
    /// The first integer bit.
    Integer,
}

/// What fails when a register has a bit less.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Breaks {
    /// The error is this, more than allowed.
    Error(f64),
    /// A register takes these bits, more than its format holds.
    Overflow {
        /// Which: its own, or another one.
        register: &'static str,
        /// The bits that it takes, as an integer.
        bits: i64,
        /// The format it has then.
        format: QFormat,
    },
    /// Nothing fails, but a field that is the same in every row is no longer so, and the ROM takes this many bits.
    MoreRom(u64),
    /// There is no bit at this end.
    NoSuchBit,
    /// There is no such hardware: the divider's dividend would be no integer, or a register too wide.
    NoHardware,
    /// This place was asked for: it is the output's last.
    OutputHasIt,
    /// No value takes the bit; that none does in the ranges that were proved is another matter.
    Unproved,
}

/// One register, one end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Witness {
    /// The name of the register.
    pub register: &'static str,
    /// The format that it has.
    pub format: QFormat,
    /// Where it gets a bit less.
    pub fewer: Fewer,
    /// The exponent; none where nothing need be tried.
    pub n: Option<f64>,
    /// The bits of x.
    pub x: i64,
    /// What fails at this n and x.
    pub breaks: Breaks,
}

/// Two witnesses for every stated register, each looked at again rank by rank before it is given.
///
/// # Errors
/// When a register could be narrower after all, or a witness does not testify.
pub(super) fn witnesses(
    base: &Design,
    judge: &Judge,
    state: &State,
    progress: &dyn Progress,
) -> Result<Vec<Witness>, SizingError> {
    let court = Court { base, judge, state, progress };
    let own = loose(base, &state.formats)?;
    let reach = taken(&own);
    let mut all = Vec::new();
    for register in ORDER {
        let (Some(format), Some(reach)) = (state.formats[register], reach[register]) else {
            continue;
        };
        all.push(court.fraction(register, format)?);
        all.push(court.integer(&own, register, format, &reach)?);
    }
    Ok(all)
}

struct Court<'a> {
    base: &'a Design,
    judge: &'a Judge,
    state: &'a State,
    progress: &'a dyn Progress,
}

impl Court<'_> {
    fn fraction(&self, which: Register, format: QFormat) -> Result<Witness, SizingError> {
        let (register, fewer) = (name(which), Fewer::Fraction);
        let silent = Witness { register, format, fewer, n: None, x: 0, breaks: Breaks::NoSuchBit };
        let Some(less) = with_fraction(format, -1) else { return Ok(silent) };
        let mut formats = self.state.formats;
        formats[which] = Some(less);
        let Ok(design) = loose(self.base, &formats) else {
            return Ok(Witness { breaks: Breaks::NoHardware, ..silent });
        };
        let worst = greatest(&self.judge.measured(&design, self.progress));
        if let Some(worst) = worst.filter(|worst| worst.error > self.judge.error) {
            let breaks = Breaks::Error(worst.error);
            let n = design.rows()[worst.address as usize].exponent;
            let witness = Witness { n: Some(n), x: worst.x, breaks, ..silent };
            return self.checked(&design, witness);
        }
        let Some((beyond, extreme)) = overflow(&formats, &taken(&design)) else {
            let hardware = Hardware::of(&design, &formats);
            if hardware < self.state.hardware {
                return Err(SizingError::Spare { register });
            }
            return Ok(Witness { breaks: Breaks::MoreRom(hardware.rom_bits), ..silent });
        };
        self.overflowing(&design, silent, beyond, formats[beyond], extreme)
    }

    fn integer(&self, own: &Design, which: Register, format: QFormat, reach: &Reach) -> Result<Witness, SizingError> {
        let (register, fewer) = (name(which), Fewer::Integer);
        let silent = Witness { register, format, fewer, n: None, x: 0, breaks: Breaks::NoSuchBit };
        match a_bit_less(format, reach) {
            Some((less, extreme)) => self.overflowing(own, silent, which, Some(less), extreme),
            None if with_integer_less(format).is_none() => Ok(silent),
            None => Err(SizingError::Spare { register }),
        }
    }

    fn overflowing(
        &self,
        design: &Design,
        silent: Witness,
        which: Register,
        format: Option<QFormat>,
        extreme: Extreme,
    ) -> Result<Witness, SizingError> {
        let Some(format) = format else { return Ok(silent) };
        let register = name(which);
        let (n, x) =
            seen_at(design, register, &extreme, |passage| holds(design.datapath(), which, passage, extreme.bits))?;
        let breaks = Breaks::Overflow { register, bits: extreme.bits, format };
        Ok(Witness { n, x, breaks, ..silent })
    }

    /// An error once more, rank by rank.
    fn checked(&self, design: &Design, witness: Witness) -> Result<Witness, SizingError> {
        let n = witness.n.unwrap_or_default();
        let (input, output) = (design.config().input.ulp(), design.config().output.ulp());
        let address = design.rom().address_of(n);
        let passage = design.datapath().passage(address, witness.x);
        let shown = passage.last().map_or(0, |signals| signals.intensity) as f64 * output;
        let error = (shown - phong(n, witness.x as f64 * input)).abs();
        if error > self.judge.error && witness.breaks == Breaks::Error(error) {
            Ok(witness)
        } else {
            Err(SizingError::Silent { register: witness.register, n })
        }
    }
}

/// The format with an integer bit less, and the value that it does not hold. Where nothing is left of it, that is any
/// but 0.
pub(super) fn a_bit_less(format: QFormat, taken: &Reach) -> Option<(QFormat, Extreme)> {
    let less = with_integer_less(format);
    let beyond = |extreme: &Extreme| match less {
        Some(less) => !less.holds(extreme.bits.into()),
        None => extreme.bits != 0,
    };
    let extreme = [taken.greatest, taken.least].into_iter().find(beyond)?;
    Some((less.unwrap_or(format), extreme))
}

/// The n and x at which a register is seen to hold the value; no n where that is an address without a word, which reads
/// the first row and is no x of it.
///
/// # Errors
/// When it is not seen.
pub(super) fn seen_at(
    design: &Design,
    register: &'static str,
    extreme: &Extreme,
    holds: impl Fn(&[Signals]) -> bool,
) -> Result<(Option<f64>, i64), SizingError> {
    let (datapath, row) = (design.datapath(), &design.rows()[extreme.address as usize]);
    let greatest = datapath.front_end().greatest;
    // A value that a part shows while it does not answer is had at some x all the same.
    let idle = || vec![greatest, 0, (row.cut - 1).max(0), datapath.formats().input.min_bits()];
    let xs = extreme.x.map_or_else(idle, |x| vec![x]);
    let seen = xs.into_iter().find(|&x| holds(&datapath.passage(extreme.address, x)));
    let beyond = datapath.rom().depth() as u32;
    match seen {
        Some(x) => Ok((Some(row.exponent), x)),
        None if extreme.address == 0 && holds(&datapath.passage(beyond, 0)) => Ok((None, 0)),
        None => Err(SizingError::Silent { register, n: row.exponent }),
    }
}

/// The first register that takes more than its format holds.
fn overflow(formats: &Each<QFormat>, taken: &Each<Reach>) -> Option<(Register, Extreme)> {
    ORDER.into_iter().find_map(|register| {
        let (format, reach) = (formats[register]?, taken[register]?);
        let beyond = |extreme: &Extreme| !format.holds(extreme.bits.into());
        [reach.greatest, reach.least].into_iter().find(beyond).map(|extreme| (register, extreme))
    })
}
