//! What a directory of hardware is asked to be.

use super::dut_ports::DutPorts;
use super::modules::Modules;

/// What a directory of hardware is asked to be, beside its design and its vectors.
#[derive(Debug, Clone, PartialEq)]
pub struct Emission {
    /// What modules and files are called, and which module is under test.
    pub modules: Modules,
    /// The ROM's words stand in the source, and no image is read.
    pub rom_in_source: bool,
    /// How the module under test differs from the pipeline; none where it has the same ports and latency.
    pub dut: Option<Dut>,
    /// The clock that synthesis aims at, in MHz.
    pub clock_mhz: f64,
}

impl Default for Emission {
    /// The project's names and [`CLOCK_MHZ`].
    fn default() -> Self {
        Self { modules: Modules::default(), rom_in_source: false, dut: None, clock_mhz: CLOCK_MHZ }
    }
}

/// The clock that synthesis aims at where nothing is said, in MHz: the tools report the slack, from which the fastest
/// clock follows.
pub const CLOCK_MHZ: f64 = 100.0;

/// A module under test that is not as the pipeline is.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Dut {
    /// Clock cycles from an accepted request to its answer; none where they are the pipeline's.
    pub latency: Option<u32>,
    /// Its ports.
    pub ports: DutPorts,
}

impl From<Modules> for Emission {
    /// With these names, and otherwise as usual.
    fn from(modules: Modules) -> Self {
        Self { modules, ..Self::default() }
    }
}
