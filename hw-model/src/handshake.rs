//! What stands around the data path: the rule by which ranks advance, the reset, and a register slice at one end.
//!
//! None of it computes anything. What a configuration leaves out is as the rules of `blysk_handshake.sv` have it: valid
//! and ready at both ends, bubbles that collapse, a synchronous reset that is active high, no slice.

use serde::{Deserialize, Serialize};

/// The rule by which ranks advance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Handshake {
    /// A rank advances when it is empty or the one after it advances: bubbles collapse behind a result that waits.
    #[default]
    ValidReady,
    /// Every rank advances where `out_ready_i` is high, and none where it is low: an enable for a pipeline inside
    /// another one. `in_ready_o` is the enable.
    Enable,
    /// Every rank advances in every cycle, and `out_ready_i` is not looked at: a result that is not taken is lost.
    None,
}

impl Handshake {
    /// All of them, in the order of their numbers in the RTL.
    pub const ALL: [Self; 3] = [Self::ValidReady, Self::Enable, Self::None];

    /// The name in configurations.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ValidReady => "valid_ready",
            Self::Enable => "enable",
            Self::None => "none",
        }
    }

    /// True of the rule that a configuration has which states none.
    #[must_use]
    // serde hands over references.
    #[allow(clippy::trivially_copy_pass_by_ref)]
    pub fn is_usual(&self) -> bool {
        *self == Self::default()
    }
}

/// The end of the pipeline at which a register slice of two entries stands, from which ready comes a register earlier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ReadySlice {
    /// Before the first rank: no path leads from `out_ready_i` to `in_ready_o`.
    Input,
    /// Behind the last rank: no path leads from `out_ready_i` to any rank, and what each rank does in a cycle is known
    /// a cycle ahead.
    Output,
}

impl ReadySlice {
    /// The name in configurations.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Output => "output",
        }
    }
}

/// How a reset comes, and what it does to `in_ready_o`. It clears valid flags, and no data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Reset {
    /// Whether it waits for the clock.
    pub kind: ResetKind,
    /// The level at which it resets.
    pub active: Level,
    /// Whether `in_ready_o` may be high during a reset, which spares a gate behind it. Nothing is taken then all the
    /// same.
    pub ready: bool,
}

/// Whether a reset waits for the clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ResetKind {
    /// It takes effect at a rising edge.
    #[default]
    Synchronous,
    /// It takes effect at once, and ends at a rising edge.
    Asynchronous,
}

/// The level of a signal that means yes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// 1.
    #[default]
    High,
    /// 0.
    Low,
}

impl Reset {
    /// True of the reset that a configuration has which states none.
    #[must_use]
    pub fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    /// True where it takes effect at once.
    #[must_use]
    pub const fn is_asynchronous(&self) -> bool {
        matches!(self.kind, ResetKind::Asynchronous)
    }

    /// True where the port resets at 0.
    #[must_use]
    pub const fn is_active_low(&self) -> bool {
        matches!(self.active, Level::Low)
    }
}

/// All that a configuration says of what stands around the data path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Control {
    /// The rule by which ranks advance.
    pub handshake: Handshake,
    /// How a reset comes.
    pub reset: Reset,
    /// A register slice at one end.
    pub slice: Option<ReadySlice>,
}

impl Control {
    /// What can be checked without a data path.
    ///
    /// # Errors
    /// Says what would be right.
    pub fn check(&self) -> Result<(), String> {
        match (self.slice, self.handshake) {
            (Some(_), Handshake::Enable | Handshake::None) => {
                Err("\"ready_slice\" takes ready off a path, and this handshake has none: leave it out, or say \
                 \"handshake\": \"valid_ready\""
                    .to_owned())
            }
            _ => Ok(()),
        }
    }

    /// Whether a result that the ports show leaves at the edge.
    #[must_use]
    pub const fn takes(&self, out_ready: bool) -> bool {
        out_ready || matches!(self.handshake, Handshake::None)
    }

    /// What decides `in_ready_o` outside of a reset, for messages.
    #[must_use]
    pub const fn ready_rule(&self) -> &'static str {
        match (self.slice, self.handshake) {
            (Some(ReadySlice::Input), _) => "the slice takes one more until its spare entry is full",
            (_, Handshake::ValidReady) => "a rank advances when it is empty or the next one advances",
            (_, Handshake::Enable) => "every rank advances where out_ready_i is high",
            (_, Handshake::None) => "every rank advances in every cycle",
        }
    }

    /// Clock cycles that slices add to the latency, 0 or 1.
    #[must_use]
    pub const fn slice_latency(&self) -> usize {
        self.slice.is_some() as usize
    }

    /// Requests that can wait in slices.
    #[must_use]
    pub const fn slice_entries(&self) -> usize {
        2 * self.slice_latency()
    }
}
