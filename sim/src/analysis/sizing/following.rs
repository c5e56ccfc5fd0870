//! Registers whose width follows from others: t3, which has the output's fraction bits, and the shifts, which are
//! counts. Their integer bits follow from the values that they take.

use hw_model::datapath::Signals;
use hw_model::datapath::reach::Reach;
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::rom::FieldName;

use super::SizingError;
use super::registers::field;
use super::witness::{Breaks, Fewer, Witness, a_bit_less, seen_at};

/// A register whose width follows from others, with the values that it takes.
struct Following {
    register: &'static str,
    format: Option<QFormat>,
    taken: Option<Reach>,
    last_place: Breaks,
    held: fn(&[Signals]) -> Option<i64>,
}

macro_rules! of_rom {
    ($design:ident, $register:literal, $format:expr, $field:ident, $last_place:expr) => {
        Following {
            register: $register,
            format: $format,
            taken: field($design, FieldName::$field, $design.datapath().front_end().greatest),
            last_place: $last_place,
            held: |passage| Some(passage.first()?.row.get(FieldName::$field)),
        }
    };
}

/// Two witnesses for each such register. The one for the last fraction bit names what settles that bit: the output, or
/// nothing where there is no fraction bit.
///
/// # Errors
/// When a register does not hold what it should.
pub fn witnesses(design: &Design) -> Result<Vec<Witness>, SizingError> {
    let datapath = design.datapath();
    let formats = datapath.formats();
    let t3 = Following {
        register: "t3",
        format: formats.polynomial.as_ref().map(|polynomial| polynomial.t3),
        taken: datapath.polynomial_reach().map(|reach| reach.lines[2]),
        last_place: Breaks::OutputHasIt,
        held: |passage| Some(passage.get(4)?.t3),
    };
    let all = [
        t3,
        of_rom!(design, "shift", formats.shift, Shift, Breaks::NoSuchBit),
        of_rom!(design, "shift_outer", formats.shift_outer, ShiftOuter, Breaks::NoSuchBit),
    ];
    let mut found = Vec::new();
    for Following { register, format, taken, last_place, held } in all {
        let (Some(format), Some(taken)) = (format, taken) else { continue };
        let last =
            Witness { register, format, fewer: Fewer::Fraction, n: None, x: 0, breaks: last_place };
        let first = Witness { fewer: Fewer::Integer, breaks: Breaks::Unproved, ..last };
        let Some((less, extreme)) = a_bit_less(format, &taken) else {
            found.extend([last, first]);
            continue;
        };
        let (n, x) =
            seen_at(design, register, &extreme, |passage| held(passage) == Some(extreme.bits))?;
        let breaks = Breaks::Overflow { register, bits: extreme.bits, format: less };
        found.extend([last, Witness { n, x, breaks, ..first }]);
    }
    Ok(found)
}
