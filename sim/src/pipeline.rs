//! Registers, clock and handshake around the model's data path. Nothing is computed here.
//!
//! A cycle has two phases. *Combinational*: from the registers (`_q`) and the inputs follow the
//! outputs and what every register will take in (`_d`). *Clock*: `_d` becomes `_q`.
//!
//! Handshake rules:
//!
//! 1. A transfer takes place at a rising edge where valid and ready are both high and reset is low.
//! 2. A rank advances when it is empty or the rank after it advances; the last one when it is empty or
//!    `out_ready` is high. So bubbles collapse, and a stall holds every bit.
//! 3. `out_valid` depends on registers only, never on `out_ready` or `in_valid`.
//! 4. Reset is synchronous and clears the valid flags; `in_ready` is low while it is high. What was
//!    in flight is lost.
//! 5. A rank's data registers are loaded when it advances and a request is offered to it; a bubble does
//!    not change them. Reset does not gate that in ranks from 1 up; only their flags become 0.

use hw_model::datapath::{Datapath, Signals, Status};

/// What drives the pipeline during one cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inputs {
    /// Clears every valid flag at the edge.
    pub reset: bool,
    /// Address and x are a request.
    pub in_valid: bool,
    /// ROM address.
    pub address: u32,
    /// x, bits in the input format.
    pub x: i64,
    /// Whoever takes the results can take one.
    pub out_ready: bool,
}

/// What the pipeline shows at the edge that ends the cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Outputs {
    /// The request is taken if it is valid.
    pub in_ready: bool,
    /// Intensity and status are a result.
    pub out_valid: bool,
    /// Bits in the output format.
    pub intensity: i64,
    /// Flags of the result.
    pub status: Status,
}

/// One rank of registers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rank {
    /// The valid flag.
    pub valid: bool,
    /// False until data is loaded for the first time: hardware shows unknown values there.
    pub loaded: bool,
    /// The data registers.
    pub signals: Signals,
}

/// The clocked pipeline of one configuration.
#[derive(Debug, Clone)]
pub struct Pipeline<'a> {
    datapath: &'a Datapath,
    ranks_q: Vec<Rank>,
    ranks_d: Vec<Rank>,
}

impl<'a> Pipeline<'a> {
    /// An empty pipeline, as after reset.
    #[must_use]
    pub fn new(datapath: &'a Datapath) -> Self {
        let empty = vec![Rank::default(); datapath.rank_count()];
        Self { datapath, ranks_q: empty.clone(), ranks_d: empty }
    }

    /// The data path.
    #[must_use]
    pub const fn datapath(&self) -> &'a Datapath {
        self.datapath
    }

    /// The registers as they are before the next edge, first rank first.
    #[must_use]
    pub fn ranks(&self) -> &[Rank] {
        &self.ranks_q
    }

    /// True when no rank holds a request.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ranks_q.iter().all(|rank| !rank.valid)
    }

    /// One clock cycle: what an RTL simulator shows at the rising edge, and then the edge.
    pub fn tick(&mut self, inputs: &Inputs) -> Outputs {
        let outputs = self.combinational(inputs);
        self.clock();
        outputs
    }

    /// The outputs of a cycle with these inputs, and `_d` of every register. Settles from the last
    /// rank to the first, the way ready travels.
    pub fn combinational(&mut self, inputs: &Inputs) -> Outputs {
        let mut ready = inputs.out_ready;
        for index in (0..self.ranks_q.len()).rev() {
            let advances = !self.ranks_q[index].valid || ready;
            self.ranks_d[index] = self.next(index, advances, inputs);
            ready = advances;
        }
        let last = self.ranks_q.last().copied().unwrap_or_default();
        Outputs {
            in_ready: ready && !inputs.reset,
            out_valid: last.valid,
            intensity: last.signals.intensity,
            status: last.signals.status,
        }
    }

    /// The rising edge.
    pub fn clock(&mut self) {
        std::mem::swap(&mut self.ranks_q, &mut self.ranks_d);
    }

    fn next(&self, index: usize, advances: bool, inputs: &Inputs) -> Rank {
        let held = self.ranks_q[index];
        let before = index.checked_sub(1).map(|before| &self.ranks_q[before]);
        let offered = before.map_or(inputs.in_valid && !inputs.reset, |before| before.valid);
        let loads = advances && offered;
        let signals = match before {
            _ if !loads => held.signals,
            None => self.datapath.fetch(inputs.address, inputs.x),
            Some(before) => self.datapath.advance(index, &before.signals),
        };
        let valid = if advances { offered } else { held.valid };
        Rank { valid: valid && !inputs.reset, loaded: held.loaded || loads, signals }
    }
}
