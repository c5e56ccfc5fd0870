//! Which signals there are, and their names.
//!
//! A register has two names for the same bits. One is in the scope of its rank, as in traces: `stage1.t1_q`. The
//! other is where the RTL has it, `polynomial.stage[1].multiply_add.t_q`: below its top scope the file is laid out as a
//! simulator's dump is below `blysk_tb.dut`, and what replays a dump into the RTL finds every register. (Of rank 0's
//! status the RTL has no register but one bit, and the wire around it has no x where the rank is unknown.)

use hw_model::datapath::Datapath;
use vectors::rtl::probes::{FETCH_STATUS, Port, Probe, VALID_FLAGS, valid_wave};

/// Signals and scopes below one name.
pub(super) struct Scope {
    pub(super) name: String,
    /// Names, each with the number of its signal.
    pub(super) signals: Vec<(String, usize)>,
    pub(super) scopes: Vec<Scope>,
}

/// All signals. Their numbers count from 0: the ports, the clock first; for each rank its valid flag and its
/// registers; then all valid flags side by side.
pub(super) struct Hierarchy {
    /// The scope around all others.
    pub(super) top: Scope,
    /// The bits of each signal.
    pub(super) widths: Vec<u32>,
}

/// The name of the scope around all others. A hyphen has no place in an identifier.
pub(super) fn top(name: &str) -> String {
    name.replace('-', "_")
}

impl Hierarchy {
    /// The signals of a pipeline below a scope of this name.
    pub(super) fn new(name: &str, datapath: &Datapath, ports: &[Port], probes: &[Probe]) -> Self {
        let mut hierarchy = Self { top: Scope::new(&top(name)), widths: Vec::new() };
        let mut in_rtl: Vec<(String, usize)> = Vec::new();
        for port in ports {
            hierarchy.add(port.name, port.format.width());
        }
        for rank in 0..datapath.rank_count() {
            hierarchy.add(&valid_wave(datapath, rank), 1);
            for probe in probes.iter().filter(|probe| probe.rank == rank) {
                let number = hierarchy.add(&probe.wave, probe.register.format.width());
                if probe.path != FETCH_STATUS {
                    in_rtl.push((probe.path.clone(), number));
                }
            }
        }
        for (path, number) in in_rtl {
            hierarchy.top.place(&path, number);
        }
        hierarchy.add(VALID_FLAGS, datapath.rank_count() as u32);
        hierarchy
    }

    fn add(&mut self, path: &str, width: u32) -> usize {
        let number = self.widths.len();
        self.widths.push(width);
        self.top.place(path, number);
        number
    }
}

impl Scope {
    fn new(name: &str) -> Self {
        Self { name: name.to_owned(), signals: Vec::new(), scopes: Vec::new() }
    }

    /// Gives a signal a name, with dots between scopes and name.
    fn place(&mut self, path: &str, number: usize) {
        match path.split_once('.') {
            Some((scope, rest)) => self.scope(scope).place(rest, number),
            // Where the RTL has a scope of the rank's name, both names may be one.
            None if self.signals.iter().any(|(name, _)| name == path) => {
                debug_assert!(self.signals.contains(&(path.to_owned(), number)));
            }
            None => self.signals.push((path.to_owned(), number)),
        }
    }

    fn scope(&mut self, name: &str) -> &mut Self {
        let place = self.scopes.iter().position(|scope| scope.name == name).unwrap_or_else(|| {
            self.scopes.push(Self::new(name));
            self.scopes.len() - 1
        });
        &mut self.scopes[place]
    }
}
