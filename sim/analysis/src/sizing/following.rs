//! Registers whose width nobody states: the last stage's result, whose last place is the output's, and the shifts,
//! which are counts. Their integer bits follow from what they take.

use hw_model::datapath::reach::Reach;
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::registers::Register;

use super::error::SizingError;
use super::witness::{Breaks, Fewer, Witness, a_bit_less, seen_at};
use hw_model::stated::field;

/// One of them.
struct Following {
    register: Register,
    /// The rank that shows it.
    rank: usize,
    format: Option<QFormat>,
    taken: Option<Reach>,
    last_place: Breaks,
}

/// Two witnesses for each register: one for its last place, one for its first.
///
/// # Errors
/// When a register does not hold what it should.
pub(super) fn witnesses(design: &Design) -> Result<Vec<Witness>, SizingError> {
    let datapath = design.datapath();
    let degree = datapath.degree();
    let last = Following {
        register: Register::T(degree),
        rank: datapath.rank_of(Register::T(degree)),
        format: datapath.formats().polynomial.as_ref().map(|polynomial| polynomial.last()),
        taken: datapath.polynomial_reach().map(|reach| *reach.last()),
        last_place: Breaks::OutputHasIt,
    };
    let shifts = (0..datapath.segment_count()).map(|segment| {
        let register = Register::Shift(segment);
        Following {
            register,
            rank: 0,
            format: datapath.rom().layout().field(register).map(|field| field.format),
            taken: field(design, register, datapath.front_end().greatest),
            last_place: Breaks::NoSuchBit,
        }
    });
    let mut found = Vec::new();
    for Following { register, rank, format, taken, last_place } in std::iter::once(last).chain(shifts) {
        let (Some(format), Some(taken)) = (format, taken) else { continue };
        let name = register.name();
        let last = Witness { register: name, format, fewer: Fewer::Fraction, n: None, x: 0, breaks: last_place };
        let first = Witness { fewer: Fewer::Integer, breaks: Breaks::Unproved, ..last };
        let Some((less, extreme)) = a_bit_less(format, &taken) else {
            found.extend([last, first]);
            continue;
        };
        let (n, x) = seen_at(design, name, &extreme, |passage| {
            passage.get(rank).is_some_and(|held| held.get(register) == extreme.bits)
        })?;
        let breaks = Breaks::Overflow { register: name, bits: extreme.bits, format: less };
        found.extend([last, Witness { n, x, breaks, ..first }]);
    }
    Ok(found)
}
