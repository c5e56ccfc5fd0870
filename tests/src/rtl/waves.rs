//! A simulator's own dump of a run against the waves of the clocked pipeline for the same inputs.
//!
//! The inputs of every cycle are taken from that dump; the pipeline runs with them and writes VCD
//! and FST; all three files are read back by the same independent reader. The first cycles are replayed in Yosys too.

use std::fs::File;
use std::path::Path;

use hw_model::datapath::Datapath;
use sim::pipeline::{Inputs, Pipeline};
use sim::run::Cycle;
use sim::waves::{WaveFormat, WaveWriter};
use vectors::rtl::SAVE_FILE;
use vectors::rtl::probes::{FETCH_STATUS, probes};

use super::replay::replay;
use super::simulators::Simulator;
use super::workspace::Emitted;
use super::{Failure, failed};
use crate::save_file::SaveFile;
use crate::waves::{Signal, Waves};

/// Cycles that are replayed in Yosys too: blocks without trouble, with stalls, with bubbles and with both.
const REPLAYED: usize = 300;

/// How much of two dumps was compared.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Compared {
    /// The number of rising edges.
    pub edges: u64,
    /// Values of signals before an edge.
    pub values: u64,
}

/// Lets the testbench dump a run with stalls, bubbles and resets, and compares.
///
/// # Errors
/// The first difference; when a signal is missing, or no value of it was compared.
pub fn compare(emitted: &Emitted<'_>, simulator: &Simulator) -> Result<Compared, Failure> {
    let verdict = simulator.run(&emitted.directory, "+seed=3 +waves=simulator.vcd")?;
    if !verdict.passed() {
        return failed(verdict.last);
    }
    let dump = emitted.directory.join("simulator.vcd");
    let dumped = Dump::read(&dump)?;
    let datapath = emitted.design.datapath();
    let inputs = dumped.inputs(datapath)?;
    let save_file = std::fs::read_to_string(emitted.directory.join(SAVE_FILE));
    let save_file = save_file.map_err(|error| Failure(format!("{SAVE_FILE}: {error}")))?;
    if simulator.is_icarus() {
        SaveFile::read(&save_file).check(&dumped.waves);
        let replayed = emitted.directory.join("replayed.fst");
        write(&replayed, WaveFormat::Fst, datapath, &inputs[..inputs.len().min(REPLAYED)])?;
        replay(&emitted.directory, datapath, &replayed, "blysk")?;
    }
    let mut compared = Compared::default();
    for format in WaveFormat::ALL {
        let path = emitted.directory.join(format!("model.{}", format.extension()));
        write(&path, format, datapath, &inputs)?;
        let model = Waves::read(&path, "blysk.clk_i");
        compared.values += dumped.compare(datapath, &model)?;
        compared.edges += model.edges.len() as u64;
    }
    Ok(compared)
}

/// The waves of a pipeline with these inputs, a cycle each; the last one has no edge.
fn write(path: &Path, format: WaveFormat, datapath: &Datapath, inputs: &[Inputs]) -> Result<(), Failure> {
    let written = || -> std::io::Result<()> {
        let mut writer = WaveWriter::new(format, File::create(path)?, "blysk", datapath)?;
        let mut pipeline = Pipeline::new(datapath);
        let last = inputs.len() as u64 - 1;
        for (index, inputs) in (0..last).zip(inputs) {
            let outputs = pipeline.combinational(inputs);
            let ranks = pipeline.ranks();
            writer.cycle(&Cycle { index, inputs, outputs: &outputs, ranks })?;
            pipeline.clock();
        }
        let inputs = &inputs[last as usize];
        let outputs = pipeline.combinational(inputs);
        let ranks = pipeline.ranks();
        writer.finish(&Cycle { index: last, inputs, outputs: &outputs, ranks })
    };
    written().map_err(|error| Failure(format!("cannot write {}: {error}", path.display())))
}

/// A simulator's dump, and the scope of the module under test in it.
struct Dump {
    waves: Waves,
    scope: String,
}

impl Dump {
    fn read(path: &Path) -> Result<Self, Failure> {
        let text = std::fs::read_to_string(path).map_err(|error| Failure(error.to_string()))?;
        // Newer simulators put a scope of their own around the testbench.
        let around = if text.contains(" TOP ") { "TOP." } else { "" };
        let scope = format!("{around}blysk_tb.dut.");
        Ok(Self { waves: Waves::read(path, &format!("{scope}clk_i")), scope })
    }

    /// What a signal holds before an edge; behind the last one, at the end.
    fn word(&self, name: &str, edge: usize) -> Result<Option<u64>, Failure> {
        match self.waves.signals.get(&format!("{}{name}", self.scope)) {
            Some(signal) => Ok(word(signal, edge)),
            None => failed(format!("the dump has no {}{name}", self.scope)),
        }
    }

    fn inputs(&self, datapath: &Datapath) -> Result<Vec<Inputs>, Failure> {
        let x_format = datapath.formats().input;
        let known = |name: &str, edge| self.word(name, edge)?.ok_or_else(|| Failure(format!("{name} is unknown")));
        (0..=self.waves.edges.len())
            .map(|edge| {
                Ok(Inputs {
                    reset: known("rst_i", edge)? != 0,
                    in_valid: known("in_valid_i", edge)? != 0,
                    address: known("address_i", edge)? as u32,
                    x: x_format.from_word(known("x_i", edge)?),
                    out_ready: known("out_ready_i", edge)? != 0,
                })
            })
            .collect()
    }

    /// Every port and register at every edge after the first, which is the first of the reset, and at the end.
    fn compare(&self, datapath: &Datapath, model: &Waves) -> Result<u64, Failure> {
        if picoseconds(model) != picoseconds(&self.waves) {
            return failed("the edges of the two dumps are at different times");
        }
        let mut names: Vec<(String, String)> = ["in_ready_o", "out_valid_o", "intensity_o", "status_o"]
            .map(|port| (port.to_owned(), port.to_owned()))
            .to_vec();
        // Waves have a scope for each rank, whatever part of the pipeline a register belongs to, and the RTL's names.
        for probe in probes(datapath) {
            if probe.path != FETCH_STATUS {
                names.push((probe.path.clone(), probe.path.clone()));
            }
            names.push((probe.wave, probe.path));
        }
        let mut compared = 0;
        for (name, path) in names {
            let before = compared;
            let ours = model.get(&format!("blysk.{name}"));
            for edge in 1..=model.edges.len() {
                // Never loaded: the model promises nothing.
                let Some(wanted) = word(ours, edge) else { continue };
                if self.word(&path, edge)? != Some(wanted) {
                    let time = model.edges.get(edge).unwrap_or(&model.end);
                    return failed(format!("{path} differs from {name} before {time} ns"));
                }
                compared += 1;
            }
            if compared == before {
                return failed(format!("no value of {name} was compared"));
            }
        }
        compared += self.compare_valid(datapath, model)?;
        Ok(compared)
    }

    fn compare_valid(&self, datapath: &Datapath, model: &Waves) -> Result<u64, Failure> {
        let mut compared = 0;
        if model.edges.len() < 2 {
            return failed("no valid flag was compared");
        }
        for rank in 0..datapath.rank_count() {
            let ours = model.get(&format!("blysk.{}.valid_q", datapath.rank_name(rank)));
            for edge in 1..=model.edges.len() {
                let flags = self.word("handshake.valid_q", edge)?;
                let flag = flags.map(|flags| flags >> rank & 1);
                if flag != word(ours, edge) {
                    return failed(format!("the valid flag of rank {rank} differs at edge {edge}"));
                }
                compared += 1;
            }
        }
        Ok(compared)
    }
}

/// What a signal holds before an edge; behind the last one, at the end.
fn word(signal: &Signal, edge: usize) -> Option<u64> {
    if edge < signal.values.len() { signal.word(edge) } else { signal.last_word() }
}

/// The times of the edges, whatever the unit of the file.
fn picoseconds(waves: &Waves) -> Vec<u64> {
    let scale = 10_u64.pow(u32::try_from(waves.timescale + 12).unwrap_or(0));
    waves.edges.iter().map(|edge| edge * scale).collect()
}
