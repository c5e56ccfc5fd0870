//! The registers that a configuration can state: their formats, what they take, and the hardware they make.

use hw_model::config::StatedWidths;
use hw_model::datapath::Signals;
use hw_model::datapath::reach::{Extreme, Reach};
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::rom::{FieldName, Place};
use serde::Serialize;

/// Their names, in the order of everything here.
pub const NAMES: [&str; 12] =
    ["u", "c3", "c2", "c1", "c0", "t1", "t2", "tail_a", "tail_b", "divisor", "cut", "hand_over"];

/// The first of those that are compared with x: between 0 and 1.
const CUT: usize = 10;
const HAND_OVER: usize = 11;

/// A value for each register that the configuration has.
pub type Each<T> = [Option<T>; NAMES.len()];

/// Integer bits that a search adds first, more than any rounding does; and those for an end that moved so far that the
/// shift changed, by which c3 moves three places. Wide registers are slow, and so they are tried last.
pub const ROOMS: [i32; 2] = [4, 20];

pub fn of_stated(widths: &StatedWidths) -> Each<QFormat> {
    let StatedWidths { u, c3, c2, c1, c0, t1, t2, cut, hand_over, tail_a, tail_b, divisor } =
        *widths;
    [u, c3, c2, c1, c0, t1, t2, tail_a, tail_b, divisor, cut, hand_over]
}

/// Of a design as it is: with a domain the cut holds its least x, whatever is stated.
pub fn of_design(design: &Design) -> Each<QFormat> {
    let mut formats = of_stated(&design.widths());
    formats[CUT] = design.datapath().formats().cut;
    formats
}

pub const fn stated(formats: &Each<QFormat>) -> StatedWidths {
    let [u, c3, c2, c1, c0, t1, t2, tail_a, tail_b, divisor, cut, hand_over] = *formats;
    StatedWidths { u, c3, c2, c1, c0, t1, t2, cut, hand_over, tail_a, tail_b, divisor }
}

/// The same fraction bits with so much room; an end is at most 1.
pub fn loosened(formats: &Each<QFormat>, room: i32) -> Each<QFormat> {
    std::array::from_fn(|index| {
        let format = formats[index]?;
        let (integer, fraction) = (format.integer_bits(), format.fraction_bits());
        let loose = match index < CUT {
            true => QFormat::signed(integer + room, fraction),
            false => QFormat::unsigned(1, fraction),
        };
        loose.ok().or(Some(format))
    })
}

/// A format with a fraction bit more or less; none where there is none.
pub fn with_fraction(format: QFormat, more: i32) -> Option<QFormat> {
    let fraction = format.fraction_bits().checked_add_signed(more)?;
    let make = if format.is_signed() { QFormat::signed } else { QFormat::unsigned };
    make(format.integer_bits(), fraction).ok()
}

/// A format with an integer bit less; none where nothing would be left.
pub fn with_integer_less(format: QFormat) -> Option<QFormat> {
    let make = if format.is_signed() { QFormat::signed } else { QFormat::unsigned };
    make(format.integer_bits() - 1, format.fraction_bits()).ok()
}

/// What every register takes, exactly, in its own unit.
pub fn taken(design: &Design) -> Each<Reach> {
    let datapath = design.datapath();
    let mut taken: Each<Reach> = [None; NAMES.len()];
    if let Some(reach) = datapath.polynomial_reach() {
        let [t1, t2, _] = reach.lines;
        taken[0] = design.is_centred().then_some(reach.v);
        (taken[5], taken[6]) = (Some(t1), Some(t2));
        for (index, power) in [(1, 3), (2, 2), (3, 1), (4, 0)] {
            taken[index] = coefficient(design, power);
        }
        let greatest = datapath.front_end().greatest;
        // With a domain its least x is in the place of the cut, and has the bits of x.
        if design.config().domain.is_empty() {
            taken[CUT] = field(design, FieldName::Cut, greatest);
        }
        let hand_over = datapath.formats().hand_over;
        taken[HAND_OVER] = hand_over.and_then(|_| field(design, FieldName::HandOver, greatest));
    }
    if let Some(reach) = datapath.tail_reach() {
        taken[7] = field(design, FieldName::TailA, 0);
        taken[8] = field(design, FieldName::TailB, 0);
        taken[9] = Some(reach.divisor);
    }
    taken
}

/// Both segments' coefficients of one power.
fn coefficient(design: &Design, power: usize) -> Option<Reach> {
    let greatest = design.datapath().front_end().greatest;
    let first = field(design, FieldName::COEFFICIENTS[power], greatest)?;
    if design.datapath().formats().hand_over.is_none() {
        return Some(first);
    }
    let mut outer = field(design, FieldName::OUTER_COEFFICIENTS[power], 0)?;
    for extreme in [&mut outer.least, &mut outer.greatest] {
        let row = design.datapath().row(extreme.address);
        extreme.x = Some((design.datapath().front_end().hand_over(&row) - 1).min(greatest));
    }
    Some(Reach {
        least: if outer.least.bits < first.least.bits { outer.least } else { first.least },
        greatest: if outer.greatest.bits > first.greatest.bits {
            outer.greatest
        } else {
            first.greatest
        },
    })
}

/// One field over all rows, said of this x.
pub fn field(design: &Design, name: FieldName, x: i64) -> Option<Reach> {
    let all = design.rom().rows().iter().zip(0..).map(|(row, address)| Extreme {
        bits: row.get(name),
        address,
        x: Some(x),
    });
    let least = all.clone().min_by_key(|extreme| extreme.bits)?;
    let greatest = all.max_by_key(|extreme| (extreme.bits, std::cmp::Reverse(extreme.address)))?;
    Some(Reach { least, greatest })
}

/// The narrowest formats for what is taken, with the fraction bits of these; where nothing is known to be, these.
pub fn tight(formats: &Each<QFormat>, taken: &Each<Reach>) -> Each<QFormat> {
    std::array::from_fn(|index| {
        let format = formats[index]?;
        let Some(reach) = taken[index] else { return Some(format) };
        let (low, high) = (reach.least.bits.min(0).into(), reach.greatest.bits.max(0).into());
        QFormat::for_range(low, high, format.fraction_bits()).ok()
    })
}

/// True where a register holds this on the way of one x, by its place in [`NAMES`]. A coefficient of a segment that
/// never answers is held by the fetched word alone.
pub fn holds(index: usize, passage: &[Signals], bits: i64) -> bool {
    let fetched = || {
        let power = FieldName::COEFFICIENTS.len().checked_sub(index).filter(|_| index > 0);
        let (Some(power), Some(fetch)) = (power, passage.first()) else { return false };
        let names = [FieldName::COEFFICIENTS[power], FieldName::OUTER_COEFFICIENTS[power]];
        names.into_iter().any(|name| fetch.row.get(name) == bits)
    };
    value(index, passage) == Some(bits) || fetched()
}

/// What a register holds on the way of one x, by its place in [`NAMES`].
fn value(index: usize, passage: &[Signals]) -> Option<i64> {
    let (front_end, stage1, stage2) = (passage.get(1)?, passage.get(2)?, passage.get(3)?);
    let row = |name| front_end.row.get(name);
    Some(match index {
        0 => front_end.v,
        1 => row(FieldName::C3),
        2 => row(FieldName::C2),
        3 => row(FieldName::C1),
        4 => row(FieldName::C0),
        5 => stage1.t1,
        6 => stage2.t2,
        7 => row(FieldName::TailA),
        8 => row(FieldName::TailB),
        9 => stage1.division.divisor,
        CUT => row(FieldName::Cut),
        _ => row(FieldName::HandOver),
    })
}

/// What is to be least: in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Hardware {
    /// The widths of both operands of every multiplier, multiplied, summed.
    pub multiplier_bits: u64,
    /// Depth times width of the ROM.
    pub rom_bits: u64,
    /// The number of ranks: clock cycles from a request to its result.
    pub latency: u64,
    /// The widths of the stated registers, summed.
    pub register_bits: u64,
}

impl Hardware {
    /// Of a design whose stated registers have these formats instead of its own.
    pub fn of(design: &Design, formats: &Each<QFormat>) -> Self {
        let width = |format: Option<QFormat>| u64::from(format.map_or(0, QFormat::width));
        let [u, c3, c2, c1, c0, t1, t2, a, b, _, cut, hand_over] = *formats;
        let input = u64::from(design.config().input.width());
        let v = if u.is_some() { width(u) } else { input };
        let multiplicands = width(c3) + width(t1) + width(t2);
        // The word, with each stored coefficient in its new format.
        let mut word = 0;
        for field in design.rom().layout().fields() {
            let format = match field.name {
                FieldName::C3 | FieldName::C3Outer => c3,
                FieldName::C2 | FieldName::C2Outer => c2,
                FieldName::C1 | FieldName::C1Outer => c1,
                FieldName::C0 | FieldName::C0Outer => c0,
                FieldName::TailA => a,
                FieldName::TailB => b,
                FieldName::Cut => cut,
                FieldName::HandOver => hand_over,
                _ => Some(field.format),
            };
            if matches!(field.place, Place::Stored { .. }) {
                word += width(format);
            }
        }
        Self {
            multiplier_bits: v * multiplicands + width(b) * input,
            rom_bits: word * design.rom().depth() as u64,
            latency: design.datapath().rank_count() as u64,
            register_bits: formats.iter().copied().map(width).sum(),
        }
    }
}
