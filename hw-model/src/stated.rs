//! The registers that a configuration can state: their formats, what they take, and the hardware they make.

use crate::datapath::reach::{Extreme, Reach};
use crate::datapath::{Datapath, Signals};
use crate::design::Design;
use crate::format::QFormat;
use crate::registers::{MAX_SEGMENTS, Register, Table};
use crate::rom::Place;
use crate::widths::{STATED, StatedWidths};
use serde::Serialize;

/// These registers, in the order in which a search tries them and a table lists them.
pub const ORDER: [Register; STATED.len()] = [
    Register::V,
    Register::C(0, 4),
    Register::C(0, 3),
    Register::C(0, 2),
    Register::C(0, 1),
    Register::C(0, 0),
    Register::T(1),
    Register::T(2),
    Register::T(3),
    Register::TailA,
    Register::TailB,
    Register::Divisor,
    Register::Cut,
    Register::HandOver(1),
];

/// A value for each of them that the configuration has.
pub type Each<T> = Table<Option<T>>;

/// Integer bits that a search adds first, more than any rounding does; and those for an end that moved so far that the
/// shift changed, by which c3 moves three places. Wide registers are slow, and so they are tried last.
pub const ROOMS: [i32; 2] = [4, 20];

/// The name in configurations.
#[must_use]
pub fn name(register: Register) -> &'static str {
    STATED.iter().find(|(known, _)| *known == register).map_or(register.name(), |(_, name)| name)
}

/// True for what is compared with x: between 0 and 1.
const fn is_end(register: Register) -> bool {
    matches!(register, Register::Cut | Register::HandOver(_))
}

/// The formats that widths state.
#[must_use]
pub fn of_stated(widths: &StatedWidths) -> Each<QFormat> {
    each(|register| widths[register])
}

/// The formats of a design as it is: with a domain the cut holds its least x, whatever is stated.
#[must_use]
pub fn of_design(design: &Design) -> Each<QFormat> {
    let mut formats = of_stated(&design.widths());
    formats[Register::Cut] = design.datapath().formats().cut;
    formats
}

/// The widths that state these formats.
#[must_use]
pub fn stated(formats: &Each<QFormat>) -> StatedWidths {
    ORDER.into_iter().fold(StatedWidths::default(), |widths, register| widths.with(register, formats[register]))
}

fn each<T: Copy>(value: impl Fn(Register) -> Option<T>) -> Each<T> {
    let mut all = Each::default();
    for register in ORDER {
        all[register] = value(register);
    }
    all
}

/// The same fraction bits with so much room; an end is at most 1.
#[must_use]
pub fn loosened(formats: &Each<QFormat>, room: i32) -> Each<QFormat> {
    each(|register| {
        let format = formats[register]?;
        let (integer, fraction) = (format.integer_bits(), format.fraction_bits());
        let loose = match is_end(register) {
            false => QFormat::signed(integer + room, fraction),
            true => QFormat::unsigned(1, fraction),
        };
        loose.ok().or(Some(format))
    })
}

/// A format with a fraction bit more or less; none where there is none.
#[must_use]
pub fn with_fraction(format: QFormat, more: i32) -> Option<QFormat> {
    let fraction = format.fraction_bits().checked_add_signed(more)?;
    let make = if format.is_signed() { QFormat::signed } else { QFormat::unsigned };
    make(format.integer_bits(), fraction).ok()
}

/// A format with an integer bit less; none where nothing would be left.
#[must_use]
pub fn with_integer_less(format: QFormat) -> Option<QFormat> {
    let make = if format.is_signed() { QFormat::signed } else { QFormat::unsigned };
    make(format.integer_bits() - 1, format.fraction_bits()).ok()
}

/// What every register takes, exactly, in its own unit.
#[must_use]
pub fn taken(design: &Design) -> Each<Reach> {
    let (polynomial, tail) = (design.datapath().polynomial_reach(), design.datapath().tail_reach());
    let greatest = design.datapath().front_end().greatest;
    let degree = design.datapath().degree();
    each(|register| match register {
        Register::V => polynomial.as_ref().filter(|_| design.is_centred()).map(|reach| reach.v),
        // The last stage's format is the output's.
        Register::T(stage) if stage < degree => polynomial.as_ref()?.lines.get(stage - 1).copied(),
        Register::T(_) => None,
        Register::C(_, power) => {
            polynomial.as_ref().filter(|_| power <= degree)?;
            coefficient(design, power)
        }
        // With a domain its least x is in the place of the cut, and has the bits of x.
        Register::Cut => {
            polynomial.as_ref().filter(|_| design.config().domain.is_empty())?;
            field(design, Register::Cut, greatest)
        }
        Register::HandOver(_) => {
            polynomial.as_ref()?;
            let segments = 1..design.datapath().segment_count();
            segments.filter_map(|segment| field(design, Register::HandOver(segment), greatest)).reduce(with)
        }
        Register::Divisor => tail.as_ref().map(|reach| reach.divisor),
        Register::TailA | Register::TailB => {
            tail.as_ref()?;
            field(design, register, 0)
        }
        _ => None,
    })
}

/// All segments' coefficients of one power, each said of the greatest x of its segment.
fn coefficient(design: &Design, power: usize) -> Option<Reach> {
    let front_end = design.datapath().front_end();
    let of_segment = |segment| {
        let mut reach = field(design, Register::C(segment, power), front_end.greatest)?;
        for extreme in [&mut reach.least, &mut reach.greatest] {
            let row = design.datapath().row(extreme.address);
            let last = front_end.start(&row, segment) - i64::from(segment > 0);
            extreme.x = Some(last.min(front_end.greatest));
        }
        Some(reach)
    };
    (0..design.datapath().segment_count()).filter_map(of_segment).reduce(with)
}

/// Both together, the first's of equal ones.
fn with(first: Reach, other: Reach) -> Reach {
    let less = other.least.bits < first.least.bits;
    let more = other.greatest.bits > first.greatest.bits;
    Reach {
        least: if less { other.least } else { first.least },
        greatest: if more { other.greatest } else { first.greatest },
    }
}

/// One field over all rows, said of this x.
#[must_use]
pub fn field(design: &Design, name: Register, x: i64) -> Option<Reach> {
    let all =
        design.rom().rows().iter().zip(0..).map(|(row, address)| Extreme { bits: row.get(name), address, x: Some(x) });
    let least = all.clone().min_by_key(|extreme| extreme.bits)?;
    let greatest = all.max_by_key(|extreme| (extreme.bits, std::cmp::Reverse(extreme.address)))?;
    Some(Reach { least, greatest })
}

/// The narrowest formats for what is taken, with the fraction bits of these; where nothing is known to be, these.
#[must_use]
pub fn tight(formats: &Each<QFormat>, taken: &Each<Reach>) -> Each<QFormat> {
    each(|register| {
        let format = formats[register]?;
        let Some(reach) = taken[register] else { return Some(format) };
        let (low, high) = (reach.least.bits.min(0).into(), reach.greatest.bits.max(0).into());
        QFormat::for_range(low, high, format.fraction_bits()).ok()
    })
}

/// True where a register holds this on the way of one x. A coefficient or an end of a segment that never answers is
/// held by the fetched word alone.
#[must_use]
pub fn holds(datapath: &Datapath, register: Register, passage: &[Signals], bits: i64) -> bool {
    let word = passage.first();
    let fetched = |of_segment: fn(usize, usize) -> Register, power: usize| {
        let names = (0..MAX_SEGMENTS).map(|segment| of_segment(segment, power));
        word.is_some_and(|fetch| names.into_iter().any(|name| fetch.row.get(name) == bits))
    };
    let shown = |rank: usize| passage.get(rank).map(|held| held.get(register)) == Some(bits);
    let front_end = datapath.rank_of(Register::V);
    match register {
        Register::C(_, power) => shown(front_end) || fetched(Register::C, power),
        Register::HandOver(_) => fetched(|segment, _| Register::HandOver(segment.max(1)), 0),
        Register::T(_) | Register::Divisor => shown(datapath.rank_of(register)),
        _ => shown(front_end),
    }
}

/// What is to be least: in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Hardware {
    /// The widths of both operands of every multiplier, multiplied, summed.
    pub multiplier_bits: u64,
    /// Depth times width of the ROM.
    pub rom_bits: u64,
    /// Ranks of registers.
    pub latency: u64,
    /// The widths of the stated registers, summed.
    pub register_bits: u64,
}

impl Hardware {
    /// Of a design whose stated registers have these formats instead of its own.
    #[must_use]
    pub fn of(design: &Design, formats: &Each<QFormat>) -> Self {
        let width = |format: Option<QFormat>| u64::from(format.map_or(0, QFormat::width));
        let input = u64::from(design.config().input.width());
        let u = formats[Register::V];
        let v = if u.is_some() { width(u) } else { input };
        let degree = design.datapath().degree();
        let highest = if degree > 0 { width(formats[Register::C(0, degree)]) } else { 0 };
        let stages = (1..degree).map(|stage| width(formats[Register::T(stage)]));
        let multiplicands = highest + stages.sum::<u64>();
        // The word, with each stored coefficient in its new format.
        let mut word = 0;
        for field in design.rom().layout().fields() {
            let own = field.name.of_any_segment();
            let format = if ORDER.contains(&own) { formats[own] } else { Some(field.format) };
            if matches!(field.place, Place::Stored { .. }) {
                word += width(format);
            }
        }
        Self {
            multiplier_bits: v * multiplicands + width(formats[Register::TailB]) * input,
            rom_bits: word * design.rom().depth() as u64,
            latency: design.datapath().latency() as u64,
            register_bits: ORDER.into_iter().map(|register| width(formats[register])).sum(),
        }
    }
}
