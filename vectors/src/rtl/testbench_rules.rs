//! What the testbench says of what stands around the ranks, in Verilog: the rule by which they advance, the reset, and
//! a register slice. Where a configuration states none of it, these are the usual words.

use hw_model::datapath::Datapath;
use hw_model::handshake::{Handshake, ReadySlice};

use super::reset_port;

/// Pieces of the testbench's text.
pub(super) struct Rules {
    pub(super) slice: Option<ReadySlice>,
    pub(super) handshake: Handshake,
    pub(super) asynchronous: bool,
    /// The port of the reset, and what drives it.
    pub(super) reset_port: &'static str,
    pub(super) reset: &'static str,
    /// Whether the result of the last rank is taken.
    pub(super) taken: &'static str,
    /// Whether a request has to wait where there is no reset, and `in_ready_o`.
    pub(super) refuses: &'static str,
    pub(super) ready: String,
    /// The reason for `in_ready_o`.
    pub(super) rule: &'static str,
    /// Whether the ports show a result, the number of its vector, and whether the last edge loaded it.
    pub(super) shown: &'static str,
    pub(super) shown_vector: &'static str,
    pub(super) shown_loads: &'static str,
    /// The slice in messages, and below the module under test.
    pub(super) name: &'static str,
    pub(super) path: String,
    /// Bits of what it holds.
    pub(super) width: u32,
}

impl Rules {
    pub(super) fn of(datapath: &Datapath) -> Self {
        let control = datapath.control();
        let (input, output) = (control.slice == Some(ReadySlice::Input), control.slice == Some(ReadySlice::Output));
        let name = if input { "input_slice" } else { "output_slice" };
        let takes = if input { "!spare_held" } else { "advance[0]" };
        let formats = datapath.formats();
        Self {
            slice: control.slice,
            handshake: control.handshake,
            asynchronous: control.reset.is_asynchronous(),
            reset_port: reset_port::name(&control.reset),
            reset: if control.reset.is_active_low() { "!rst" } else { "rst" },
            taken: if output { "!spare_held" } else { "out_ready" },
            refuses: if input { "spare_held" } else { "!advance[0]" },
            ready: format!("{takes}{}", if control.reset.ready { "" } else { " && !rst" }),
            rule: control.ready_rule(),
            shown: if output { "head_held" } else { "held[RANKS-1]" },
            shown_vector: if output { "head_of" } else { "vector_of[RANKS-1]" },
            shown_loads: if output { "1'b1" } else { "loads[RANKS-1]" },
            name,
            path: format!("{name}.stored"),
            width: if input {
                datapath.rom().address_width() + formats.input.width()
            } else {
                datapath.status_width() + formats.output.width()
            },
        }
    }

    /// The word that the slice holds for a vector.
    pub(super) fn word(&self, vector: &str) -> String {
        match self.slice {
            Some(ReadySlice::Input) => format!("stimulus[{vector}][ADDRESS+INPUT-1:0]"),
            _ => format!("expected[{vector}][STATUS+OUTPUT-1:0]"),
        }
    }
}
