//! The waves as VCD, read back, against the trace: the same value of every signal at every rising edge.

use std::collections::{HashMap, HashSet};

use hw_model::design::Design;
use vcd::{Command, Header, IdCode, Parser, Scope, ScopeItem, TimescaleUnit, Value, VarType};
use vectors::rtl::probes::probes;

use super::trace::Trace;

/// Nanoseconds.
const PERIOD: u64 = 10;

/// A signal of the waves: its scopes and name below the top, with dots between; the trace's column, width.
pub struct Signal {
    name: String,
    pub column: String,
    pub width: u32,
}

impl Signal {
    /// Scopes and name, in a file whose top scope is `top`.
    pub fn path<'a>(&'a self, top: &'a str) -> Vec<&'a str> {
        std::iter::once(top).chain(self.name.split('.')).collect()
    }

    /// A value of the trace as the signal's word: two's complement in its width.
    pub fn to_word(&self, bits: i64) -> u64 {
        bits as u64 & (u64::MAX >> (64 - self.width))
    }
}

/// What an RTL simulator would show, in a scope for each rank, and with the names of the RTL; but the clock and the
/// valid flags side by side, which no column has.
pub fn signals(design: &Design) -> Vec<Signal> {
    let datapath = design.datapath();
    let formats = datapath.formats();
    let ports = [
        ("rst_i", "rst", 1),
        ("in_valid_i", "in_valid", 1),
        ("in_ready_o", "in_ready", 1),
        ("address_i", "address", datapath.rom().address_width()),
        ("x_i", "x", formats.input.width()),
        ("out_valid_o", "out_valid", 1),
        ("out_ready_i", "out_ready", 1),
        ("intensity_o", "intensity", formats.output.width()),
        ("status_o", "status", datapath.status_width()),
    ];
    let mut signals = Vec::new();
    let mut add = |name: String, column: &str, width| {
        if !signals.iter().any(|signal: &Signal| signal.name == name) {
            signals.push(Signal { name, column: column.to_owned(), width });
        }
    };
    for (name, column, width) in ports {
        add(name.to_owned(), column, width);
    }
    for rank in 0..datapath.rank_count() {
        let scope = datapath.rank_name(rank);
        add(format!("{scope}.valid_q"), &format!("{scope}.valid"), 1);
        for register in datapath.registers(rank) {
            let column = datapath.register_name(rank, &register);
            add(format!("{scope}.{}_q", register.name()), &column, register.format.width());
        }
    }
    // A wire in the RTL, most of whose bits are never unknown.
    for probe in probes(datapath).into_iter().filter(|probe| probe.path != "fetch_status") {
        add(probe.path, &probe.name, probe.register.format.width());
    }
    signals
}

pub fn check(bytes: &[u8], trace: &Trace, design: &Design, place: &str) {
    let mut parser = Parser::new(bytes);
    let header = parser.parse_header().unwrap();
    assert_eq!(header.timescale, Some((1, TimescaleUnit::NS)));
    let top = &design.config().name;
    let signals = signals(design);
    let ids = ids(&header, top, &signals);
    let clock = header.find_var(&[top.as_str(), "clk_i"]).expect("the clock").code;

    let mut values: HashMap<IdCode, Vec<Value>> = HashMap::new();
    // What stood before the changes of this instant: what a register takes in at an edge.
    let mut before = values.clone();
    let (mut now, mut edges) = (None, 0);
    for command in parser {
        match command.unwrap() {
            Command::Timestamp(time) => {
                assert!(now < Some(time), "{place}: time stands still at {time}");
                now = Some(time);
                before.clone_from(&values);
            }
            Command::ChangeScalar(id, value) => {
                if id == clock {
                    let time = now.expect("a time");
                    let rises = value == Value::V1;
                    let phase = if rises { PERIOD / 2 } else { 0 };
                    assert_eq!(time % PERIOD, phase, "{place}: the clock at {time} ns");
                    if rises {
                        assert_eq!(time / PERIOD, edges as u64, "{place}: an edge is missing");
                        at_edge(edges, &before, &signals, &ids, trace, place);
                        edges += 1;
                    }
                }
                assert!(id == clock || with_the_edge(now), "{place}: a change at {now:?} ns");
                values.insert(id, vec![value]);
            }
            Command::ChangeVector(id, vector) => {
                assert!(with_the_edge(now), "{place}: a change at {now:?} ns");
                values.insert(id, vector.iter().collect());
            }
            other => panic!("{place}: {other:?}"),
        }
    }
    assert_eq!(edges, trace.len(), "{place}: rising edges");
    let end = PERIOD * edges as u64;
    assert_eq!(now, Some(end), "{place}: half a cycle behind the last edge");
}

/// Registers and inputs change with the rising edge, or are there from the start.
fn with_the_edge(now: Option<u64>) -> bool {
    now.is_some_and(|now| now == 0 || now % PERIOD == PERIOD / 2)
}

/// The identifier of each signal. Exactly these signals are there, in these scopes.
fn ids(header: &Header, top: &str, signals: &[Signal]) -> Vec<IdCode> {
    let [ScopeItem::Scope(scope)] = header.items.as_slice() else { panic!("one top scope") };
    assert_eq!(scope.identifier, top);
    assert_eq!(variables(scope), signals.len() + 2, "the signals, the clock and the flags");
    let ids: Vec<IdCode> = signals
        .iter()
        .map(|signal| {
            let path = signal.path(top);
            let found = header.find_var(&path).unwrap_or_else(|| panic!("there is no {path:?}"));
            assert_eq!((found.var_type, found.size), (VarType::Wire, signal.width), "{path:?}");
            found.code
        })
        .collect();
    // Names of one column share an identifier, and no others.
    let columns: HashSet<&str> = signals.iter().map(|signal| signal.column.as_str()).collect();
    let pairs: HashSet<(&str, IdCode)> =
        signals.iter().map(|signal| signal.column.as_str()).zip(ids.iter().copied()).collect();
    let unique: HashSet<IdCode> = ids.iter().copied().collect();
    assert_eq!((pairs.len(), unique.len()), (columns.len(), columns.len()), "identifiers");
    ids
}

fn variables(scope: &Scope) -> usize {
    let count = |item: &ScopeItem| match item {
        ScopeItem::Var(_) => 1,
        ScopeItem::Scope(inner) => variables(inner),
        other => panic!("{other:?}"),
    };
    scope.items.iter().map(count).sum()
}

fn at_edge(
    edge: usize,
    values: &HashMap<IdCode, Vec<Value>>,
    signals: &[Signal],
    ids: &[IdCode],
    trace: &Trace,
    place: &str,
) {
    for (signal, id) in signals.iter().zip(ids) {
        let at = format!("{place}, cycle {edge}: {}", signal.name);
        let value = values.get(id).unwrap_or_else(|| panic!("{at} has no value"));
        assert_eq!(value.len(), signal.width as usize, "{at}");
        match trace.get(edge, &signal.column) {
            None => assert!(value.iter().all(|&bit| bit == Value::X), "{at}: {value:?}"),
            Some(wanted) => {
                let found = value.iter().fold(0_u64, |word, bit| match bit {
                    Value::V0 => word << 1,
                    Value::V1 => word << 1 | 1,
                    other => panic!("{at}: a bit is {other}"),
                });
                assert_eq!(found, signal.to_word(wanted), "{at}");
            }
        }
    }
}
