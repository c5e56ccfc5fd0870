//! A register slice of two entries: what comes in waits until it is taken, and ready is a register.
//! Twin of `blysk_ready_slice.sv`.

use hw_model::datapath::Status;
use hw_model::handshake::{Control, ReadySlice};

/// The registers of a slice of values `T`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Slice<T> {
    /// True when the output shows a value.
    pub head_valid: bool,
    /// True when a second value waits behind it; ready is the opposite.
    pub spare_valid: bool,
    /// What the head's data registers hold; none before a value is loaded for the first time.
    pub head: Option<T>,
    /// The same of the spare entry.
    pub spare: Option<T>,
}

impl<T: Copy> Slice<T> {
    /// The registers behind an edge at which `offered` is at the input, and the output is taken or not.
    #[must_use]
    pub fn next(&self, offered: Option<T>, taken: bool) -> Self {
        let comes = offered.filter(|_| !self.spare_valid);
        let moves = taken || !self.head_valid;
        let waits = self.spare_valid || comes.is_some();
        let follows = if self.spare_valid { self.spare } else { comes };
        Self {
            head_valid: !moves || waits,
            spare_valid: !moves && waits,
            head: if moves && waits { follows } else { self.head },
            spare: if moves { self.spare } else { comes.or(self.spare) },
        }
    }

    /// The registers behind a reset, which clears flags but no data.
    #[must_use]
    pub const fn cleared(&self) -> Self {
        Self { head_valid: false, spare_valid: false, ..*self }
    }

    /// The number of values that wait.
    #[must_use]
    pub const fn in_flight(&self) -> u32 {
        self.head_valid as u32 + self.spare_valid as u32
    }
}

/// The register slices that a configuration has: at most one of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Slices {
    /// Address and x, before the first rank.
    pub input: Option<Slice<(u32, i64)>>,
    /// Intensity and status, behind the last rank.
    pub output: Option<Slice<(i64, Status)>>,
}

impl Slices {
    pub(crate) fn of(control: &Control) -> Self {
        Self {
            input: (control.slice == Some(ReadySlice::Input)).then(Slice::default),
            output: (control.slice == Some(ReadySlice::Output)).then(Slice::default),
        }
    }

    pub(crate) fn cleared(&self) -> Self {
        Self { input: self.input.map(|slice| slice.cleared()), output: self.output.map(|slice| slice.cleared()) }
    }

    /// The number of requests and results that wait in them.
    #[must_use]
    pub fn in_flight(&self) -> u32 {
        self.input.map_or(0, |slice| slice.in_flight()) + self.output.map_or(0, |slice| slice.in_flight())
    }
}
