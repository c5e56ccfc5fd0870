//! Every value of the input ports: each address, those without a ROM word included, with each x.

use hw_model::design::Design;

use crate::case::{Case, Sample};
use crate::kind::Kind;

/// How many cases there are: 2^(address bits + x bits).
#[must_use]
pub fn len(design: &Design) -> u128 {
    1 << (design.rom().address_width() + design.config().input.width())
}

/// The cases, address by address, x increasing. Nothing is stored.
pub fn samples(design: &Design) -> impl Iterator<Item = Sample> + '_ {
    let rom = design.rom();
    let input = design.config().input;
    (0..1_u32 << rom.address_width()).flat_map(move |address| {
        (input.min_bits()..=input.max_bits())
            .map(move |x| Sample { case: Case::at(rom, address, x), kind: Kind::Exhaustive })
    })
}
