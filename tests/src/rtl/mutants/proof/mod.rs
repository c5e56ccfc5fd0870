//! Decides by proof whether any input shows a mutation of the netlist.
//!
//! Where it sits decides what is asked ([`graph::Place`]).
//!
//! *Control*: what decides when a register loads, the valid flags, the ports of the handshake. From any
//! state and inputs the mutant and the right netlist, both with the same state, must give the same
//! handshake and the same next state. Of a rank's data only what will be valid is compared; that what is
//! not valid never comes to matter is proved of the right netlist. So after the first reset, whose edge
//! makes every flag 0 from any state, the two show the same for ever, whatever their registers began with.
//!
//! *Data*: everything else. When registers load is as it was, and each result is a function of its own
//! request (`make formal`, property pipeline), so it is enough that this function is the same, and the
//! registers need not be looked at: they are opened, and what is left is logic with the ROM's words in it,
//! from address and x to intensity and status. No state has to be assumed then. For some mutants that is
//! too much at once, and weaker knowledge of what comes before is enough: some ranks stay cut, their
//! registers within the values that the model's range analysis finds over every row and every x
//! ([`facts`]), and what each is about to load is compared.
//!
//! What is about to be loaded for a part that does not answer in its region is not compared. That it does
//! not matter is proved of the right netlist ([`Prover::new`]).

pub mod cut;
pub mod facts;
pub mod frame;
pub mod graph;
pub mod tools;

use std::path::{Path, PathBuf};

use hw_model::datapath::Datapath;
use hw_model::datapath::front_end::Region;
use rayon::prelude::*;
use serde_json::json;
use vectors::rtl::probes;

use crate::rtl::{Failure, failed};
use cut::{Question, RANK_BY_RANK, cut};
use frame::Frames;
use graph::{Bit, Graph, Module, Place, read};
use tools::{Comparison, compare, value, yosys};

/// What is known of a mutant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Judgement {
    /// No input and no pattern of stalls shows it, and why.
    Equivalent(&'static str),
    /// An input that shows it.
    Visible {
        /// The address of the input that shows it.
        address: u64,
        /// The bits of x.
        x: u64,
    },
    /// Neither a proof nor an input that shows it was found.
    Open,
}

/// Why a mutant of the control is equivalent.
pub const SAME_STATE: &str = "the same handshake and next state from every state (proved)";
/// Why a mutant of the data is equivalent.
pub const SAME_ANSWER: &str = "the same answer to every input (proved)";
/// The same, shown at the rank after it.
pub const SAME_LOAD: &str = "the same in the rank it feeds, for every input (proved)";

/// Proves mutations of one netlist equivalent.
#[derive(Debug)]
pub struct Prover {
    directory: PathBuf,
    netlist: String,
    right: Module,
    frames: Frames,
    seconds: u32,
}

impl Prover {
    /// A prover for the netlist in a file of this directory. A comparison gets this number of seconds.
    ///
    /// # Errors
    /// When the netlist is not that of the pipeline, or something in it matters that must not.
    pub fn new(directory: &Path, netlist: &str, datapath: &Datapath, seconds: u32) -> Result<Self, Failure> {
        let work = directory.join("proof");
        std::fs::create_dir_all(&work).map_err(|error| Failure(error.to_string()))?;
        let script = "dffunmap -srst-only; write_json graph.json; memory_map -rom-only; write_json";
        yosys(&work, &format!("read_rtlil ../{netlist}; {script} right.json"))?;
        let graph = Graph::new(read(&work.join("graph.json"))?)?;
        let regions = regions(&graph, datapath)?;
        let prover = Self {
            right: read(&work.join("right.json"))?,
            frames: Frames::new(graph, facts::facts(datapath), regions),
            directory: work,
            netlist: netlist.to_owned(),
            seconds,
        };
        prover.check_right()?;
        Ok(prover)
    }

    /// The netlist as a graph.
    #[must_use]
    pub const fn graph(&self) -> &Graph {
        self.frames.graph()
    }

    /// What the proofs take for granted: that in the right netlist data of a rank that is not valid does not
    /// get into valid ones, and what a part holds that does not answer does not get into the answer.
    fn check_right(&self) -> Result<(), Failure> {
        self.graph().check_order()?;
        let regions = [Region::Zero, Region::Polynomial, Region::Tail];
        let silence = regions.map(|region| (RANK_BY_RANK, self.frames.silence(region)));
        let loads = (Question::Control, self.frames.loads());
        let premises: Vec<(Question, String)> = [loads].into_iter().chain(silence).collect();
        premises.par_iter().enumerate().try_for_each(|(number, (question, frame))| {
            let name = format!("premise-{number}");
            match self.compare(&self.right, *question, frame, &name)? {
                Comparison::Same => Ok(()),
                _ => failed(format!("{name} does not hold of the right netlist")),
            }
        })
    }

    /// Compares a netlist with the right one in a frame. Files are named `<name>.…`.
    fn compare(&self, wrong: &Module, question: Question, frame: &str, name: &str) -> Result<Comparison, Failure> {
        let graph = self.graph();
        let [right, wrong] = [&self.right, wrong].map(|module| cut(graph, module, question));
        let cores = json!({"creator": "blysk", "modules": {"right": right?, "wrong": wrong?}});
        for (kind, text) in [("json", cores.to_string()), ("v", frame.to_owned())] {
            std::fs::write(self.directory.join(format!("{name}.{kind}")), text)
                .map_err(|error| Failure(error.to_string()))?;
        }
        // What both have alike is merged while it is words: afterwards it cannot be recognised.
        let script = format!(
            "read_json {name}.json; read_verilog -sv {name}.v; \
             hierarchy -top frame; flatten; opt_expr; opt_merge -share_all; opt_clean; \
             techmap; opt -fast; aigmap; opt_clean; write_aiger -symbols {name}.aig"
        );
        let nothing = format!("read_verilog {name}.v; hierarchy -top nothing; write_aiger -symbols");
        yosys(&self.directory, &script)?;
        yosys(&self.directory, &format!("{nothing} {name}-0.aig"))?;
        let files = [format!("{name}.aig"), format!("{name}-0.aig")];
        compare(&self.directory, [&files[0], &files[1]], self.seconds)
    }

    /// Judges a mutation: a command of Yosys, without a control input. Files are named by `number`.
    ///
    /// # Errors
    /// When a tool fails.
    pub fn judge(&self, number: usize, mutation: &str) -> Result<Judgement, Failure> {
        let place = match (option(mutation, "-cell"), option(mutation, "-port")) {
            (Some(cell), Some(port)) => {
                self.frames.graph().place(cell.trim_start_matches('\\'), port.trim_start_matches('\\'))
            }
            _ => return failed(format!("not a mutation of a cell: {mutation}")),
        };
        let name = format!("wrong-{number}");
        yosys(
            &self.directory,
            &format!(
                "read_rtlil ../{}; {mutation}; dffunmap -srst-only; memory_map -rom-only; \
                 write_json {name}-netlist.json",
                self.netlist
            ),
        )?;
        let wrong = read(&self.directory.join(format!("{name}-netlist.json")))?;
        let judged = self.ask(&place, &wrong, &name);
        for rest in ["-netlist.json", ".json", ".v", ".aig", "-0.aig"] {
            std::fs::remove_file(self.directory.join(format!("{name}{rest}")))
                .map_err(|error| Failure(error.to_string()))?;
        }
        judged
    }

    fn ask(&self, place: &Place, wrong: &Module, name: &str) -> Result<Judgement, Failure> {
        for question in self.questions(place) {
            let frame = self.frames.mutant(question);
            match self.compare(wrong, question, &frame, name)? {
                Comparison::Same => return Ok(Judgement::Equivalent(self.reason(question))),
                Comparison::Differ(inputs) if question == self.whole() => {
                    let [address, x] = ["address_i", "x_i"].map(|name| value(&inputs, name));
                    return Ok(Judgement::Visible { address, x });
                }
                Comparison::Differ(_) | Comparison::Open => {}
            }
        }
        Ok(Judgement::Open)
    }

    /// The answer as a function of the request.
    const fn whole(&self) -> Question {
        Question::Data { from: 1, to: self.graph().ranks }
    }

    /// What is asked of a mutation, the cheapest first.
    fn questions(&self, place: &Place) -> Vec<Question> {
        let Place::Data(fed) = place else { return vec![Question::Control] };
        let mut questions = Vec::new();
        // What does not matter behind one mutated rank may matter behind two.
        if let (Some(&rank), 1) = (fed.first(), fed.len()) {
            let before = rank.saturating_sub(1).max(1);
            questions.extend([
                RANK_BY_RANK,
                Question::Data { from: before, to: rank },
                Question::Data { from: 1, to: rank },
            ]);
        }
        questions.push(self.whole());
        questions.retain(|question| !matches!(question, Question::Data { from, to } if from > to));
        questions.dedup();
        questions
    }

    fn reason(&self, question: Question) -> &'static str {
        match question {
            Question::Control => SAME_STATE,
            _ if question == self.whole() => SAME_ANSWER,
            Question::Data { .. } => SAME_LOAD,
        }
    }
}

/// The word after an option of a command.
fn option<'a>(command: &'a str, name: &str) -> Option<&'a str> {
    command.split_whitespace().skip_while(|&word| word != name).nth(1)
}

/// Where each rank holds the region; nothing in ranks that do not.
fn regions(graph: &Graph, datapath: &Datapath) -> Result<Vec<Vec<Bit>>, Failure> {
    let mut regions = vec![Vec::new(); datapath.rank_count()];
    for probe in probes::probes(datapath) {
        if probe.register.register == hw_model::registers::Register::Region {
            regions[probe.rank] = graph.named(&probe.path);
            if regions[probe.rank].is_empty() {
                return failed(format!("the netlist has no {}", probe.path));
            }
        }
    }
    Ok(regions)
}
