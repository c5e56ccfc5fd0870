//! What stands around the ranks of one configuration, in words: where it is not as the common page says.

use hw_model::datapath::Datapath;
use hw_model::handshake::{Handshake, ReadySlice, Reset};

/// The sentences of the page, one for each thing that is not as usual; none where all is.
pub(super) fn differences(datapath: &Datapath) -> Vec<String> {
    let control = datapath.control();
    handshake(control.handshake).into_iter().chain(slice(datapath)).chain(reset(&control.reset)).collect()
}

fn handshake(handshake: Handshake) -> Option<String> {
    match handshake {
        Handshake::ValidReady => None,
        Handshake::Enable => Some(
            "In place of rule 2, `out_ready_i` is an enable: every rank advances where it is high, and none where it \
             is low, so that a bubble stays between its neighbours. advance[k] = `out_ready_i` for every k, and \
             `in_ready_o` says the same."
                .to_owned(),
        ),
        Handshake::None => Some(
            "In place of rule 2, every rank advances in every cycle: `in_ready_o` is always high, `out_ready_i` is not \
             looked at, and a result that is not taken in the cycle in which it comes is lost. advance[k] = 1 for \
             every k."
                .to_owned(),
        ),
    }
}

fn slice(datapath: &Datapath) -> Option<String> {
    let capacity = datapath.capacity();
    Some(match datapath.control().slice? {
        ReadySlice::Input => format!(
            "A register slice of two entries stands before rank 0 (`input_slice`): a request waits in its head for \
             rank 0, and one more in its spare entry. `in_ready_o` is low where the spare entry is full, whatever \
             `out_ready_i` is. The slice adds a cycle to the latency, and {capacity} requests are in flight at most."
        ),
        ReadySlice::Output => format!(
            "A register slice of two entries stands behind the last rank (`output_slice`), and the ports are its head: \
             where that waits, one more result goes to its spare entry, and the ranks see ready fall a cycle later. In \
             the rules of the ranks ready is \"the spare entry is empty\" in place of `out_ready_i`, and each \
             advance[k] is a register, worked out a cycle ahead. The slice adds a cycle to the latency, and {capacity} \
             requests are in flight at most."
        ),
    })
}

fn reset(reset: &Reset) -> Vec<String> {
    let mut words = Vec::new();
    if reset.is_active_low() {
        words.push(
            "The reset is active low and its port is `rst_ni`; where a rule says \"high\", it is low.".to_owned(),
        );
    }
    if reset.is_asynchronous() {
        words.push(
            "The reset is asynchronous: the valid flags are 0 as soon as it is there, and it has to end well before a \
             rising edge of the clock."
                .to_owned(),
        );
    }
    if reset.ready {
        words.push(
            "`in_ready_o` does not look at the reset, and may be high during one. Nothing is taken then all the same."
                .to_owned(),
        );
    }
    words
}
