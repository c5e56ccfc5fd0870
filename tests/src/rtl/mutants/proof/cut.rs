//! The netlist without registers: each is either *cut* (what it holds becomes an input, what it is about to
//! load an output) or *open* (it shows what it is about to load, so that ranks become one piece of logic).

use serde_json::{Value, json};

use super::graph::{Graph, Holds, Module, part};
use crate::rtl::{Failure, failed};

/// What is to be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Question {
    /// The handshake and the next state, from any state: of a rank's data only what will be valid.
    /// Every register is cut.
    Control,
    /// One request on its way, without stalls: rank 0 and these ranks are open, the others cut. With all
    /// of them open it is the answer as a function of address and x.
    Data {
        /// The first rank of the open ones.
        from: usize,
        /// The rank after the last of them.
        to: usize,
    },
}

/// Every rank after the first cut.
pub const RANK_BY_RANK: Question = Question::Data { from: 1, to: 1 };

impl Question {
    /// Whether a register is cut. The valid flags always are: a request on its way is valid everywhere.
    #[must_use]
    pub fn cuts(self, holds: Holds) -> bool {
        match (self, holds) {
            (Self::Data { from, to }, Holds::Data(rank)) => rank > 0 && !(from..to).contains(&rank),
            _ => true,
        }
    }
}

/// A netlist, the one of the graph or a mutant of it, with its registers cut or open.
///
/// # Errors
/// When it does not have the registers.
pub fn cut(graph: &Graph, module: &Module, question: Question) -> Result<Value, Failure> {
    let (mut ports, mut cells) = (part(module, "ports")?.clone(), part(module, "cells")?.clone());
    for (index, register) in graph.registers.iter().enumerate() {
        let Some(cell) = cells.remove(&register.cell) else {
            return failed(format!("the netlist has no register {}", register.cell));
        };
        if !question.cuts(register.holds) {
            cells.insert(format!("open_{index}"), open(&cell));
            continue;
        }
        let mut add = |name: &str, direction: &str, port: &str| {
            let bits = &cell["connections"][port];
            ports.insert(format!("{name}_{index}"), json!({"direction": direction, "bits": bits}));
        };
        add("state", "input", "Q");
        add("data", "output", "D");
        add("clock", "output", "CLK");
        if register.holds != Holds::Valid {
            add("load", "output", "EN");
        }
    }
    let mut core = module.clone();
    core.insert("ports".to_owned(), Value::Object(ports));
    core.insert("cells".to_owned(), Value::Object(cells));
    // The names are not needed any more, and Yosys would keep every one of them.
    core.insert("netnames".to_owned(), json!({}));
    Ok(Value::Object(core))
}

/// A buffer where a register was.
fn open(cell: &Value) -> Value {
    let bits = &cell["connections"]["Q"];
    let width = format!("{:032b}", bits.as_array().map_or(0, Vec::len));
    json!({
        "type": "$pos", "attributes": {},
        "parameters": {"A_SIGNED": format!("{:032b}", 0), "A_WIDTH": width, "Y_WIDTH": width},
        "port_directions": {"A": "input", "Y": "output"},
        "connections": {"A": cell["connections"]["D"], "Y": bits},
    })
}
