//! The clock that frames a second follow from.

use hw_model::clock::{Delays, longest, paths};
use hw_model::design::Design;

/// A clock of the hardware.
#[derive(Debug, Clone, PartialEq)]
pub enum FrameClock {
    /// A frequency that somebody knows, in MHz: the same for every pipeline.
    Stated(f64),
    /// What each pipeline's own ranks of registers reach on a device, by the estimate of `blysk clock`.
    Estimated {
        /// The device's name, or that of the file with its delays.
        device: String,
        /// What its parts take.
        delays: Delays,
    },
}

impl FrameClock {
    /// The clock of one pipeline, in MHz, above 0.
    #[must_use]
    pub fn mhz(&self, design: &Design) -> f64 {
        match self {
            Self::Stated(mhz) => *mhz,
            // Every pipeline has a path: there is more than one rank.
            Self::Estimated { delays, .. } => longest(paths(design.datapath(), delays)).map_or(0.0, |path| path.mhz()),
        }
    }

    /// The device of an estimate; none where the clock is stated.
    #[must_use]
    pub fn device(&self) -> Option<&str> {
        match self {
            Self::Stated(_) => None,
            Self::Estimated { device, .. } => Some(device),
        }
    }
}
