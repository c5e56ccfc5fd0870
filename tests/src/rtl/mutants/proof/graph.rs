//! The netlist as a graph: its registers by rank, and what a cell is for.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde_json::{Map, Value};

use crate::rtl::{Failure, failed};

/// The module in Yosys's JSON, below its name.
pub type Module = Map<String, Value>;

/// A bit of a signal: the number of its net, or a constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Bit {
    /// The net of this number.
    Net(u64),
    /// A constant 0 or 1.
    Constant(bool),
}

/// What a register holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// The valid flags, rank 0 first.
    Valid,
    /// Data of a rank.
    Data(usize),
}

/// A register: one flip-flop cell of the netlist.
#[derive(Debug, Clone)]
pub struct Register {
    /// The name of the cell in the netlist.
    pub cell: String,
    /// The signal of the pipeline that the register holds.
    pub holds: Holds,
    /// The nets it drives.
    pub output: Vec<Bit>,
}

/// What a mutation acts on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// What decides when a register loads, or a port of the handshake.
    Control,
    /// Data on its way into these ranks; the number after the last rank stands for the output ports.
    Data(BTreeSet<usize>),
}

/// The netlist without mutations.
#[derive(Debug)]
pub struct Graph {
    /// Its registers, in the order of their cells' names.
    pub registers: Vec<Register>,
    /// The number of ranks.
    pub ranks: usize,
    /// The module as Yosys wrote it.
    module: Module,
    /// The cell that drives a net.
    drivers: BTreeMap<u64, String>,
    /// What control is worked out from.
    control: BTreeSet<String>,
    /// What each rank's data is worked out from, and then what the output ports show.
    feeders: Vec<BTreeSet<String>>,
}

/// The top module of a netlist that Yosys wrote as JSON.
///
/// # Errors
/// When it is not there.
pub fn read(path: &Path) -> Result<Module, Failure> {
    let unreadable = |error: String| Failure(format!("{}: {error}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|error| unreadable(error.to_string()))?;
    let mut json: Value = serde_json::from_str(&text).map_err(|error| unreadable(error.to_string()))?;
    match json["modules"][hw_model::rtl::TOP].take() {
        Value::Object(module) => Ok(module),
        _ => Err(unreadable("it has no top module".to_owned())),
    }
}

/// The cells of a module, or its ports.
pub fn part<'a>(module: &'a Module, name: &str) -> Result<&'a Map<String, Value>, Failure> {
    module.get(name).and_then(Value::as_object).ok_or_else(|| Failure(format!("the netlist has no {name}")))
}

/// The bits of a port of a cell; none where it has no such port.
pub fn connection(cell: &Value, port: &str) -> Vec<Bit> {
    bits(&cell["connections"][port])
}

fn bits(value: &Value) -> Vec<Bit> {
    let bit = |value: &Value| match value.as_u64() {
        Some(net) => Bit::Net(net),
        None => Bit::Constant(value.as_str() == Some("1")),
    };
    value.as_array().map_or(Vec::new(), |list| list.iter().map(bit).collect())
}

impl Graph {
    /// Reads the netlist, in which no flip-flop has a synchronous reset any more.
    ///
    /// # Errors
    /// When it is not the pipeline: a register that no rank loads.
    pub fn new(module: Module) -> Result<Self, Failure> {
        let mut graph = Self {
            registers: Vec::new(),
            ranks: 0,
            drivers: drivers(part(&module, "cells")?),
            module,
            control: BTreeSet::new(),
            feeders: Vec::new(),
        };
        let loads = graph.named("handshake.load_o");
        graph.ranks = loads.len();
        graph.registers = graph.find_registers(&loads)?;
        graph.control = graph.control();
        graph.feeders = graph.feeders();
        Ok(graph)
    }

    /// The bits of a signal by its name in the RTL; none where the netlist does not have it.
    #[must_use]
    pub fn named(&self, name: &str) -> Vec<Bit> {
        bits(&self.module["netnames"][name]["bits"])
    }

    /// The nets of all signals whose names begin like this.
    #[must_use]
    pub fn below(&self, prefix: &str) -> BTreeSet<Bit> {
        let names = self.module["netnames"].as_object().into_iter().flatten();
        let below = names.filter(|(name, _)| name.starts_with(prefix));
        below.flat_map(|(_, net)| bits(&net["bits"])).collect()
    }

    /// Where a bit is in the registers: the register's place in the list, and the bit's in it.
    #[must_use]
    pub fn locate(&self, bit: Bit) -> Option<(usize, usize)> {
        self.registers.iter().enumerate().find_map(|(index, register)| {
            let place = register.output.iter().position(|&output| output == bit)?;
            Some((index, place))
        })
    }

    fn cell(&self, name: &str) -> &Value {
        &self.module["cells"][name]
    }

    /// The bits of a port of the module.
    #[must_use]
    pub fn port(&self, name: &str) -> Vec<Bit> {
        bits(&self.module["ports"][name]["bits"])
    }

    fn find_registers(&self, loads: &[Bit]) -> Result<Vec<Register>, Failure> {
        let valid = self.named("handshake.valid_q");
        let mut registers = Vec::new();
        for (name, cell) in part(&self.module, "cells")? {
            let kind = cell["type"].as_str().unwrap_or_default();
            if !is_flip_flop(kind) {
                continue;
            }
            let output = connection(cell, "Q");
            let rank = connection(cell, "EN").first().and_then(|enable| loads.iter().position(|load| load == enable));
            let holds = match (kind, rank) {
                ("$dff", _) if output == valid => Holds::Valid,
                ("$dffe", Some(rank)) => Holds::Data(rank),
                _ => return failed(format!("{name} ({kind}) is loaded by no rank")),
            };
            registers.push(Register { cell: name.clone(), holds, output });
        }
        Ok(registers)
    }

    /// Cells and registers that these bits are worked out from, up to the registers.
    fn cone(&self, bits: impl IntoIterator<Item = Bit>) -> BTreeSet<String> {
        let mut found = BTreeSet::new();
        let mut open: Vec<Bit> = bits.into_iter().collect();
        while let Some(bit) = open.pop() {
            let Bit::Net(net) = bit else { continue };
            let Some(driver) = self.drivers.get(&net) else { continue };
            let cell = self.cell(driver);
            if found.insert(driver.clone()) && !is_flip_flop(cell["type"].as_str().unwrap_or("")) {
                open.extend(ports_of(cell, "input").flat_map(|port| connection(cell, port)));
            }
        }
        found
    }

    fn control(&self) -> BTreeSet<String> {
        let of_registers = self.registers.iter().flat_map(|register| {
            let cell = self.cell(&register.cell);
            let ports: &[&str] = match register.holds {
                Holds::Valid => &["CLK", "D"],
                Holds::Data(_) => &["CLK", "EN"],
            };
            ports.iter().flat_map(|port| connection(cell, port))
        });
        let ports = ["in_ready_o", "out_valid_o"].iter().flat_map(|port| self.port(port));
        self.cone(of_registers.chain(ports))
    }

    fn feeders(&self) -> Vec<BTreeSet<String>> {
        let of_rank = |rank| {
            let registers = self.registers.iter().filter(|r| r.holds == Holds::Data(rank));
            self.cone(registers.flat_map(|register| connection(self.cell(&register.cell), "D")))
        };
        let outputs = ["intensity_o", "status_o"].iter().flat_map(|port| self.port(port));
        (0..self.ranks).map(of_rank).chain([self.cone(outputs)]).collect()
    }

    /// Checks that the data of a rank is worked out from that of the rank before it alone, what the ports
    /// show from the last rank's, and control from the valid flags.
    ///
    /// # Errors
    /// With what is not so.
    pub fn check_order(&self) -> Result<(), Failure> {
        for register in &self.registers {
            let reads = |from: &BTreeSet<String>| from.contains(&register.cell);
            let read_by: Vec<usize> = (0..=self.ranks).filter(|&rank| reads(&self.feeders[rank])).collect();
            let right = match register.holds {
                Holds::Valid => read_by.is_empty(),
                Holds::Data(rank) => read_by == [rank + 1] && !reads(&self.control),
            };
            if !right {
                return failed(format!("{} is read out of order", register.cell));
            }
        }
        Ok(())
    }

    /// What a port of a cell is for.
    #[must_use]
    pub fn place(&self, cell: &str, port: &str) -> Place {
        let register = self.registers.iter().find(|register| register.cell == cell);
        match (register.map(|register| register.holds), port) {
            (Some(Holds::Valid), _) | (Some(Holds::Data(_)), "CLK" | "EN") => Place::Control,
            _ if self.control.contains(cell) => Place::Control,
            (Some(Holds::Data(rank)), "D" | "SRST") => Place::Data([rank].into()),
            _ => {
                let fed = self.feeders.iter().enumerate().filter(|(_, from)| from.contains(cell));
                Place::Data(fed.map(|(rank, _)| rank).collect())
            }
        }
    }
}

fn is_flip_flop(kind: &str) -> bool {
    kind.contains("dff")
}

/// The ports of a cell that point this way.
fn ports_of<'a>(cell: &'a Value, direction: &'a str) -> impl Iterator<Item = &'a str> {
    let all = cell["port_directions"].as_object().into_iter().flatten();
    all.filter(move |(_, way)| way.as_str() == Some(direction)).map(|(port, _)| port.as_str())
}

fn drivers(cells: &Map<String, Value>) -> BTreeMap<u64, String> {
    let driven = cells.iter().flat_map(|(name, cell)| {
        let outputs = ports_of(cell, "output").flat_map(|port| connection(cell, port));
        outputs.map(move |bit| (bit, name))
    });
    driven
        .filter_map(|(bit, name)| match bit {
            Bit::Net(net) => Some((net, name.clone())),
            Bit::Constant(_) => None,
        })
        .collect()
}
