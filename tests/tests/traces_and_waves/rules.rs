//! The handshake rules, once from a model of a dozen lines and once from the trace alone.

use std::collections::VecDeque;

use hw_model::datapath::Signals;
use hw_model::design::Design;

use super::stimulus::Stimulus;
use super::trace::Trace;

pub fn check(trace: &Trace, design: &Design, stimulus: &Stimulus, place: &str) {
    columns(trace, design);
    against_a_model(trace, design, stimulus, place);
    results_in_order(trace, design, place);
    registers_hold(trace, design, place);
}

fn rank_names(design: &Design) -> Vec<String> {
    let datapath = design.datapath();
    (0..datapath.rank_count()).map(|rank| datapath.rank_name(rank)).collect()
}

/// The ports, then every register of every rank.
fn columns(trace: &Trace, design: &Design) {
    let mut wanted: Vec<String> = "cycle rst in_valid in_ready address x out_valid out_ready \
                                   intensity status"
        .split_whitespace()
        .map(str::to_owned)
        .collect();
    for (rank, name) in rank_names(design).iter().enumerate() {
        wanted.push(format!("{name}.valid"));
        let registers = design.datapath().registers(rank);
        wanted.extend(registers.iter().map(|register| design.datapath().register_name(rank, register)));
    }
    assert_eq!(trace.header, wanted);
}

/// A rank: whether it is valid, and what was loaded last.
#[derive(Clone, Default)]
struct Rank {
    valid: bool,
    held: Option<(u32, i64)>,
}

/// Every column of every cycle, from the rules and the golden model's passage of each request.
fn against_a_model(trace: &Trace, design: &Design, stimulus: &Stimulus, place: &str) {
    let datapath = design.datapath();
    let names = rank_names(design);
    let mut ranks = vec![Rank::default(); names.len()];
    let mut waiting = VecDeque::new();
    let mut cycle = 0;
    loop {
        let line = stimulus.lines.get(cycle);
        waiting.extend(line.filter(|line| line.valid).map(|line| (design.rom().address_of(line.n), line.x)));
        if line.is_none() && waiting.is_empty() && ranks.iter().all(|rank| !rank.valid) {
            break;
        }
        let at = |column: &str| format!("{place}, cycle {cycle}: {column}");
        let reset = line.is_some_and(|line| line.reset);
        let out_ready = line.is_none_or(|line| line.ready);
        assert_eq!(trace.value(cycle, "cycle"), cycle as i64);
        assert_eq!(trace.flag(cycle, "rst"), reset, "{}", at("rst"));
        assert_eq!(trace.flag(cycle, "out_ready"), out_ready, "{}", at("out_ready"));
        assert_eq!(trace.flag(cycle, "in_valid"), !waiting.is_empty(), "{}", at("in_valid"));
        if let Some(&(address, x)) = waiting.front() {
            assert_eq!(trace.value(cycle, "address"), i64::from(address), "{}", at("address"));
            assert_eq!(trace.value(cycle, "x"), x, "{}", at("x"));
        }

        // A rank advances when it, or one after it, is empty, or the result is taken.
        let free = |rank: usize| out_ready || ranks[rank..].iter().any(|rank| !rank.valid);
        let in_ready = free(0) && !reset;
        assert_eq!(trace.flag(cycle, "in_ready"), in_ready, "{}", at("in_ready"));
        for (index, (rank, name)) in ranks.iter().zip(&names).enumerate() {
            assert_eq!(trace.flag(cycle, &format!("{name}.valid")), rank.valid, "{}", at(name));
            let held = rank.held.map(|(address, x)| datapath.passage(address, x)[index]);
            for register in datapath.registers(index) {
                let column = datapath.register_name(index, &register);
                let wanted = held.as_ref().map(|held: &Signals| register.bits(held));
                assert_eq!(trace.get(cycle, &column), wanted, "{}", at(&column));
            }
        }
        let last = ranks.last().unwrap();
        assert_eq!(trace.flag(cycle, "out_valid"), last.valid, "{}", at("out_valid"));
        let shown = last.held.map(|(address, x)| datapath.evaluate(address, x));
        let intensity = shown.map(|shown| shown.intensity);
        let status = shown.map(|shown| shown.status.bits().into());
        assert_eq!(trace.get(cycle, "intensity"), intensity, "{}", at("intensity"));
        assert_eq!(trace.get(cycle, "status"), status, "{}", at("status"));

        let mut next = ranks.clone();
        for index in 0..ranks.len() {
            if !free(index) {
                continue;
            }
            let offered = match index {
                0 => waiting.front().copied().filter(|_| !reset),
                _ => ranks[index - 1].held.filter(|_| ranks[index - 1].valid),
            };
            next[index].valid = offered.is_some();
            next[index].held = offered.or(ranks[index].held);
        }
        if in_ready {
            waiting.pop_front();
        }
        if reset {
            next.iter_mut().for_each(|rank| rank.valid = false);
        }
        ranks = next;
        cycle += 1;
    }
    assert_eq!(trace.len(), cycle, "{place}: cycles");
}

/// From the ports alone: what goes in comes out, in order, right, and once; unless a reset took it.
fn results_in_order(trace: &Trace, design: &Design, place: &str) {
    let mut in_flight = VecDeque::new();
    let mut results = 0;
    for cycle in 0..trace.len() {
        if trace.flag(cycle, "rst") {
            in_flight.clear();
            continue;
        }
        if trace.flag(cycle, "out_valid") {
            let &(address, x) = in_flight.front().expect("a result has a request");
            let wanted = design.datapath().evaluate(address, x);
            let found = (trace.value(cycle, "intensity"), trace.value(cycle, "status"));
            let wanted = (wanted.intensity, wanted.status.bits().into());
            assert_eq!(found, wanted, "{place}, cycle {cycle}: address {address}, x {x}");
            if trace.flag(cycle, "out_ready") {
                in_flight.pop_front();
                results += 1;
            }
        }
        if trace.flag(cycle, "in_valid") && trace.flag(cycle, "in_ready") {
            in_flight.push_back((trace.value(cycle, "address") as u32, trace.value(cycle, "x")));
        }
    }
    assert!(in_flight.is_empty(), "{place}: {in_flight:?} never came out");
    assert!(results > 10, "{place}: {results} results");
}

/// From the trace alone: a rank that cannot advance, and one that is offered nothing, keeps every
/// bit; before its first load it is unknown, and never after; a reset empties every rank.
fn registers_hold(trace: &Trace, design: &Design, place: &str) {
    let names = rank_names(design);
    let datapath = design.datapath();
    let columns: Vec<Vec<String>> = (0..names.len())
        .map(|rank| {
            let registers = datapath.registers(rank);
            registers.iter().map(|register| datapath.register_name(rank, register)).collect()
        })
        .collect();
    let valid = |cycle: usize, rank: usize| trace.flag(cycle, &format!("{}.valid", names[rank]));
    let (mut kept, mut loads) = (0, 0);
    for cycle in 0..trace.len() - 1 {
        let reset = trace.flag(cycle, "rst");
        let mut advances = trace.flag(cycle, "out_ready");
        for rank in (0..names.len()).rev() {
            advances |= !valid(cycle, rank);
            let offered = match rank {
                0 => trace.flag(cycle, "in_valid") && !reset,
                _ => valid(cycle, rank - 1),
            };
            assert!(!(reset && valid(cycle + 1, rank)), "{place}, cycle {cycle}: reset");
            for register in &columns[rank] {
                let (now, next) = (trace.get(cycle, register), trace.get(cycle + 1, register));
                if advances && offered {
                    assert!(next.is_some(), "{place}, cycle {cycle}: {register} is unknown");
                    loads += 1;
                } else {
                    assert_eq!(now, next, "{place}, cycle {cycle}: {register} changed");
                    kept += 1;
                }
            }
        }
    }
    for register in columns.iter().flatten() {
        assert_eq!(trace.get(0, register), None, "{place}: {register} is known too early");
    }
    assert!(kept > 0 && loads > 0, "{place}: {kept} registers kept, {loads} loaded");
}
