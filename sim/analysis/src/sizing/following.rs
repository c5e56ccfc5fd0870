//! Registers whose width nobody states: t3, whose last place is the output's, and the shifts, which are counts. Their
//! integer bits follow from what they take.

use hw_model::datapath::Signals;
use hw_model::datapath::reach::Reach;
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::rom::FieldName;

use super::error::SizingError;
use super::witness::{Breaks, Fewer, Witness, a_bit_less, seen_at};
use hw_model::stated::field;

/// One of them.
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

/// Two witnesses for each: that of the last place is what has it too.
///
/// # Errors
/// When a register does not hold what it should.
pub(super) fn witnesses(design: &Design) -> Result<Vec<Witness>, SizingError> {
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
