//! A clock to aim at: the ranks of registers that follow from a frequency and a device.
//!
//! What lies between two ranks of registers takes its time, and how much of it depends on the device. A table of delays
//! ([`Delays`]) says what the parts take there, [`paths`] adds up what lies in each rank, and a design with a [`Clock`]
//! has the fewest ranks that reach it. It is an estimate: what a placement gives differs by some per cent
//! (`docs/SYNTHESIS.md` has both side by side).

mod choice;
mod delays;
mod paths;

use serde::{Deserialize, Serialize};

use crate::datapath::Datapath;

pub use choice::ClockError;
use choice::fewest;
pub use delays::{Delays, Device};
pub use paths::{Path, longest, paths};

/// The clock that a configuration aims at.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Clock {
    /// The frequency, in MHz.
    pub mhz: f64,
    /// The device: `ecp5`, `up5k`, or a table of delays.
    pub device: Device,
}

impl Clock {
    /// What can be checked without a data path.
    ///
    /// # Errors
    /// Says what would be right.
    pub fn check(&self) -> Result<(), String> {
        if !(self.mhz > 0.0 && self.mhz <= 10_000.0) {
            return Err(format!(
                "\"mhz\" is a frequency in MHz: use a number above 0, at most 10000, not {}",
                self.mhz
            ));
        }
        self.device.delays()?.check()
    }

    /// Gives a data path the fewest ranks that reach the clock, where a divider finds `most_quotient_bits` in a cycle
    /// at the most.
    ///
    /// # Errors
    /// When no ranks do: says the greatest clock that some reach, and what limits it.
    pub(crate) fn reach(&self, datapath: &mut Datapath, most_quotient_bits: u32) -> Result<(), ClockError> {
        let delays = self.device.delays().map_err(ClockError::Table)?;
        fewest(datapath, most_quotient_bits, &delays, self.mhz).map_err(|greatest| {
            let device = self.device.name().to_owned();
            ClockError::Unreached { wanted: self.mhz, device, greatest }
        })
    }
}
