//! Reads waves back, whatever program wrote them and in whichever format: by `wellen`, which has no code in
//! common with our writers.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use wellen::{Signal as Changes, SignalRef, Time, TimescaleUnit, simple};

/// A file of waves, looked at where a flip-flop looks: at the rising edges of a clock.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Waves {
    /// The unit of time as a power of ten in seconds, −9 for ns.
    pub timescale: i8,
    /// The times of the rising edges.
    pub edges: Vec<Time>,
    /// The last time at which anything changes.
    pub end: Time,
    /// Every signal that has bits, by its full name: scopes and name with dots between them.
    pub signals: BTreeMap<String, Signal>,
}

/// A signal of the waves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signal {
    /// The width of the signal, in bits.
    pub width: u32,
    /// What it holds just before each rising edge, which is what a register takes in there: its digits
    /// from the highest bit down, `0`, `1`, `x` or `z`; empty before the first value.
    pub values: Vec<String>,
    /// What it holds at the end of the file: what the last edge brought.
    pub last: String,
}

impl Signal {
    /// The value before a rising edge as a number; `None` where a bit is unknown.
    ///
    /// # Panics
    /// When there is no such edge, or no value yet, or more than 64 bits.
    #[must_use]
    pub fn word(&self, edge: usize) -> Option<u64> {
        word(&self.values[edge])
    }

    /// The value at the end as a number; `None` where a bit is unknown.
    ///
    /// # Panics
    /// When there is no value, or more than 64 bits.
    #[must_use]
    pub fn last_word(&self) -> Option<u64> {
        word(&self.last)
    }
}

fn word(digits: &str) -> Option<u64> {
    assert!((1..=64).contains(&digits.len()), "{digits:?} is no word");
    u64::from_str_radix(digits, 2).ok()
}

impl Waves {
    /// Reads a file; `clock` is the full name of the clock.
    ///
    /// # Panics
    /// When the file is no waves, or there is no such clock.
    #[must_use]
    pub fn read(path: &Path, clock: &str) -> Self {
        let at = path.display();
        let mut file = simple::read(path).unwrap_or_else(|error| panic!("{at}: {error}"));
        let hierarchy = file.hierarchy();
        let timescale = hierarchy.timescale().unwrap_or_else(|| panic!("{at}: no timescale"));
        let timescale = exponent(timescale.factor, timescale.unit);
        let named: BTreeMap<String, (SignalRef, u32)> = hierarchy
            .all_vars()
            .map(|var| &hierarchy[var])
            .filter_map(|var| {
                let width = var.length(hierarchy).filter(|&width| width > 0)?;
                Some((var.full_name(hierarchy), (var.signal_ref(), width)))
            })
            .collect();
        // Names may share a signal.
        let mut wanted: Vec<SignalRef> = named.values().map(|(signal, _)| *signal).collect();
        wanted.sort_unstable_by_key(|signal| signal.index());
        wanted.dedup();
        file.load_signals(&wanted);
        let changes: HashMap<SignalRef, &Changes> =
            wanted.iter().filter_map(|&id| Some((id, file.get_signal(id)?))).collect();

        let (clock, _) = named.get(clock).unwrap_or_else(|| panic!("{at}: there is no {clock}"));
        let edges = rising(changes[clock]);
        let times = file.time_table();
        let signal = |(name, (id, width))| {
            let (values, last) = before(changes[&id], &edges);
            (name, Signal { width, values, last })
        };
        Self {
            timescale,
            edges: edges.iter().map(|&index| times[index as usize]).collect(),
            end: times.last().copied().unwrap_or_default(),
            signals: named.into_iter().map(signal).collect(),
        }
    }

    /// A signal by its full name.
    ///
    /// # Panics
    /// When there is none.
    #[must_use]
    pub fn get(&self, name: &str) -> &Signal {
        self.signals.get(name).unwrap_or_else(|| panic!("there is no signal {name}"))
    }
}

fn exponent(factor: u32, unit: TimescaleUnit) -> i8 {
    let unit = unit.to_exponent().expect("a unit of time");
    unit + i8::try_from(factor.ilog10()).expect("1, 10 or 100")
}

/// The instants, as places in the table of times, at which a signal goes from 0 to 1.
fn rising(clock: &Changes) -> Vec<u32> {
    let levels: Vec<(u32, String)> = clock.iter_changes().map(|(index, value)| (index, value.to_string())).collect();
    let rises = |pair: &&[(u32, String)]| pair[0].1 == "0" && pair[1].1 == "1";
    levels.windows(2).filter(rises).map(|pair| pair[1].0).collect()
}

/// What a signal holds before each of these instants, and at the end.
fn before(signal: &Changes, instants: &[u32]) -> (Vec<String>, String) {
    let mut changes = signal.iter_changes().peekable();
    let mut held = String::new();
    let values = instants
        .iter()
        .map(|instant| {
            while let Some((_, value)) = changes.next_if(|(index, _)| index < instant) {
                held = value.to_string();
            }
            held.clone()
        })
        .collect();
    (values, changes.last().map_or(held, |(_, value)| value.to_string()))
}
