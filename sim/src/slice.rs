//! A register slice of two entries: what comes in waits until it is taken, and ready is a register.
//! Twin of `blysk_ready_slice.sv`.

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
