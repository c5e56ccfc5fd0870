//! Every register of every cycle of an RTL simulation against the clocked pipeline.

use std::io::BufRead;

use hw_model::datapath::Datapath;
use thiserror::Error;
use vectors::rtl::probes::Probe;
use vectors::rtl::register_log::{RegisterLine, RegisterLog, RegisterLogError};

use crate::pipeline::{Inputs, Pipeline, Ranks};

/// What was compared, and agreed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Agreement {
    /// Clock cycles that were compared.
    pub cycles: u64,
    /// Registers compared, over all cycles. One that was never loaded is not.
    pub registers: u64,
    /// Results that were taken, valid and ready both high.
    pub results: u64,
    /// Cycles in which a result waited.
    pub stalls: u64,
    /// Cycles in which a request could have been taken and there was none.
    pub bubbles: u64,
    /// Cycles in which reset was high.
    pub resets: u64,
}

/// Why a log does not agree.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Disagreement {
    /// It is not a log of this configuration.
    #[error(transparent)]
    Log(#[from] RegisterLogError),
    /// There is no cycle in it.
    #[error("the log has no cycle in it: nothing was compared")]
    Nothing,
    /// No result was taken in it.
    #[error("no result was taken in the {cycles} cycles of the log: it shows little")]
    NoResult {
        /// The number of cycles compared.
        cycles: u64,
    },
    /// A register, flag or port differs.
    #[error("cycle {cycle}, line {line}: {name} is {got}, and {wanted} in the model")]
    Differs {
        /// The cycle, counted from 0.
        cycle: u64,
        /// Line of the log, counted from 1.
        line: u64,
        /// The name of the register, flag or port, as in traces.
        name: String,
        /// Its bits in hex, or x.
        got: String,
        /// The model's bits in hex.
        wanted: String,
    },
}

/// Runs the clocked pipeline with the inputs of the log and compares all it shows.
///
/// # Errors
/// The first difference, in the order of cycles and then of ranks.
pub fn compare(datapath: &Datapath, log: impl BufRead) -> Result<Agreement, Disagreement> {
    let mut log = RegisterLog::new(datapath, log);
    let probes = log.probes().to_vec();
    let mut pipeline = Pipeline::new(datapath);
    let mut agreement = Agreement::default();
    // What an RTL simulator shows before the first edge of a reset is not specified.
    let mut was_reset = false;
    while let Some(line) = log.next_cycle()? {
        let inputs = Inputs {
            reset: line.reset,
            in_valid: line.in_valid,
            address: line.address,
            x: line.x,
            out_ready: line.out_ready,
        };
        let outputs = pipeline.combinational(&inputs);
        if was_reset {
            let cycle = Compared { cycle: agreement.cycles, line };
            cycle.port("in_ready_o", line.in_ready, outputs.in_ready)?;
            cycle.port("out_valid_o", line.out_valid, outputs.out_valid)?;
            agreement.registers += cycle.ranks(datapath, pipeline.ranks(), &probes)?;
        }
        agreement.cycles += 1;
        agreement.resets += u64::from(inputs.reset);
        agreement.bubbles += u64::from(outputs.in_ready && !inputs.in_valid);
        if outputs.out_valid && !inputs.reset {
            let taken = datapath.control().takes(inputs.out_ready);
            agreement.results += u64::from(taken);
            agreement.stalls += u64::from(!taken);
        }
        was_reset |= inputs.reset;
        pipeline.clock();
    }
    if agreement.registers == 0 {
        return Err(Disagreement::Nothing);
    }
    if agreement.results == 0 {
        return Err(Disagreement::NoResult { cycles: agreement.cycles });
    }
    Ok(agreement)
}

struct Compared<'a> {
    cycle: u64,
    line: &'a RegisterLine,
}

impl Compared<'_> {
    fn ranks(&self, datapath: &Datapath, ranks: Ranks<'_>, probes: &[Probe]) -> Result<u64, Disagreement> {
        let mut words = self.line.words.iter();
        let mut probes = probes.iter().peekable();
        let mut compared = 0;
        for (index, rank) in ranks.iter().enumerate() {
            let valid = words.next().copied().flatten();
            if valid != Some(u64::from(rank.valid)) {
                let name = format!("{}.valid", datapath.rank_name(index));
                return Err(self.differs(name, valid, u64::from(rank.valid)));
            }
            compared += 1;
            while let Some(probe) = probes.next_if(|probe| probe.rank == index) {
                let got = words.next().copied().flatten();
                let wanted = probe.register.format.to_word(probe.register.bits(&rank.signals));
                if rank.loaded && got != Some(wanted) {
                    return Err(self.differs(probe.name.clone(), got, wanted));
                }
                compared += u64::from(rank.loaded);
            }
        }
        Ok(compared)
    }

    fn port(&self, name: &str, got: Option<u64>, wanted: bool) -> Result<(), Disagreement> {
        if got == Some(u64::from(wanted)) {
            return Ok(());
        }
        Err(self.differs(name.to_owned(), got, u64::from(wanted)))
    }

    fn differs(&self, name: String, got: Option<u64>, wanted: u64) -> Disagreement {
        let hex = |word: u64| format!("0x{word:x}");
        let got = got.map_or_else(|| "x".to_owned(), hex);
        Disagreement::Differs { cycle: self.cycle, line: self.line.line, name, got, wanted: hex(wanted) }
    }
}
