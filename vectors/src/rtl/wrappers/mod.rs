//! What lets the pipeline into designs that are not plain SystemVerilog, or into the tools of a vendor.

mod bender;
mod ip_xact;
mod parts;
mod recipes;
mod vhdl;

use super::emission::Emission;
pub use super::files::{BENDER, IP_XACT, QUARTUS, SDC, VHDL, VIVADO};
use super::sources::Sources;

pub use bender::bender;
pub use ip_xact::ip_xact;
pub use recipes::{quartus, sdc, vivado};
pub use vhdl::vhdl;

/// Each file of this kind under its name in the project, with its text.
#[must_use]
pub fn wrappers(sources: &Sources<'_>, emission: &Emission) -> Vec<(&'static str, String)> {
    vec![
        (IP_XACT, ip_xact(sources, emission)),
        (VHDL, vhdl(sources, emission)),
        (BENDER, bender(sources)),
        (SDC, sdc(sources, emission)),
        (VIVADO, vivado(sources)),
        (QUARTUS, quartus(sources)),
    ]
}
