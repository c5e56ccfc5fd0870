//! ROM words at the edges of their formats.
//!
//! The widths are proved for the words the ROM has. Here each coefficient in turn takes its
//! format's least and greatest value, in every row: what a register cannot hold then is named. And a
//! format stated with an integer bit less than was derived must be refused.

use hw_model::datapath::{Datapath, Signals};
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::registers::{MAX_DEGREE, Register};
use hw_model::rom::Place;
use serde::Serialize;

use super::cases::cases;

/// A ROM field at an edge of its format.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Word {
    /// The name of the ROM field.
    pub field: &'static str,
    /// The format of the field.
    pub format: String,
    /// `least`, `greatest`, or `a bit less`.
    pub edge: &'static str,
    /// The number of passages looked at.
    pub passages: usize,
    /// Those in which a register cannot hold its value.
    pub overflowing: usize,
    /// What happens: every register holds its value, the first that does not, or the refusal.
    pub outcome: String,
    /// False where a stated format that is too narrow is not refused.
    pub holds: bool,
}

/// The coefficients in the order of the table: the first segment's, A and B, then those of the further segments.
fn coefficients(design: &Design) -> impl Iterator<Item = Register> {
    let of_segment = |segment| (0..=MAX_DEGREE).rev().map(move |power| Register::C(segment, power));
    let further = (1..design.datapath().segment_count()).flat_map(of_segment);
    of_segment(0).chain([Register::TailA, Register::TailB]).chain(further)
}

/// Every coefficient of the ROM at the edges of its format, at these addresses.
#[must_use]
pub(super) fn words(design: &Design, addresses: &[u32]) -> Vec<Word> {
    let mut all = Vec::new();
    for name in coefficients(design) {
        let Some(field) = design.rom().layout().field(name) else { continue };
        // A constant is no word of the ROM: there is no other to be written.
        if matches!(field.place, Place::Stored { .. }) {
            let (least, greatest) = (field.format.min_bits(), field.format.max_bits());
            all.push(altered(design, addresses, name, field.format, "least", least));
            all.push(altered(design, addresses, name, field.format, "greatest", greatest));
        }
        all.extend(narrowed(design, name, field.format));
    }
    all
}

fn altered(design: &Design, addresses: &[u32], name: Register, format: QFormat, edge: &'static str, bits: i64) -> Word {
    let (mut passages, mut overflowing, mut first) = (0, 0, None);
    for &address in addresses {
        for (case, x) in cases(design, address) {
            let mut held = design.datapath().fetch(address, x);
            held.row.set(name, bits);
            passages += 1;
            if let Some(register) = overflow(design.datapath(), held) {
                overflowing += 1;
                let n = design.rows()[address as usize].exponent;
                first.get_or_insert_with(|| format!("{register} at n = {n}, x: {case}"));
            }
        }
    }
    Word {
        field: name.name(),
        format: format.to_string(),
        edge,
        passages,
        overflowing,
        outcome: first
            .map_or_else(|| "every register holds its value".to_owned(), |first| format!("wraps, first in {first}")),
        holds: true,
    }
}

/// The first register, in the order of the ranks, that cannot hold what it is given.
fn overflow(datapath: &Datapath, fetched: Signals) -> Option<String> {
    let mut held = fetched;
    for rank in 1..datapath.rank_count() {
        held = datapath.advance(rank, &held);
        let registers = datapath.registers(rank);
        let wrong =
            registers.iter().find(|register| register.computed && !register.format.holds(register.bits(&held).into()));
        if let Some(register) = wrong {
            return Some(datapath.register_name(rank, register));
        }
    }
    None
}

/// The field's format stated with an integer bit less.
fn narrowed(design: &Design, name: Register, format: QFormat) -> Option<Word> {
    let (integer, fraction) = (format.integer_bits() - 1, format.fraction_bits());
    let narrower = match format.is_signed() {
        true => QFormat::signed(integer, fraction),
        false => QFormat::unsigned(integer, fraction),
    }
    .ok()?;
    // Further segments share the first's formats.
    if name.of_any_segment() != name {
        return None;
    }
    let mut config = design.config().clone();
    config.widths.set(name, Some(narrower));
    let refusal = Design::new(config).err();
    Some(Word {
        field: name.name(),
        format: narrower.to_string(),
        edge: "a bit less",
        passages: 0,
        overflowing: 0,
        holds: refusal.is_some(),
        outcome: refusal.map_or_else(|| "NOT REFUSED".to_owned(), |refusal| format!("refused: {refusal}")),
    })
}
