//! The module around two netlists whose registers are gone: it gives both the same, and says where they
//! differ.

use std::fmt::Write;

use hw_model::datapath::front_end::Region;

use super::cut::{Question, RANK_BY_RANK};
use super::facts::Fact;
use super::graph::{Bit, Graph, Holds};

/// Which part of the pipeline reads a bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reader {
    Any,
    Only(Region),
}

/// What is known of the netlist's registers.
#[derive(Debug)]
pub struct Frames {
    graph: Graph,
    facts: Vec<Fact>,
    /// The region's bits in each rank, lowest first; none in ranks that do not have it.
    regions: Vec<Vec<Bit>>,
    /// Of each bit of each register.
    readers: Vec<Vec<Reader>>,
}

impl Frames {
    /// Looks at the netlist without mutations.
    #[must_use]
    pub fn new(graph: Graph, facts: Vec<Fact>, regions: Vec<Vec<Bit>>) -> Self {
        let (polynomial, tail) = (graph.below("polynomial."), graph.below("tail."));
        let reader = |bit| match (polynomial.contains(bit), tail.contains(bit)) {
            (true, false) => Reader::Only(Region::Polynomial),
            (false, true) => Reader::Only(Region::Tail),
            _ => Reader::Any,
        };
        let registers = graph.registers.iter();
        let readers = registers.map(|r| r.output.iter().map(reader).collect()).collect();
        Self { graph, facts, regions, readers }
    }

    /// The graph of the netlist.
    #[must_use]
    pub const fn graph(&self) -> &Graph {
        &self.graph
    }

    /// The modules `right` and `wrong` from the same state: in [`Question::Data`] one in which the
    /// facts hold.
    #[must_use]
    pub fn mutant(&self, question: Question) -> String {
        let mut frame = Frame::new(self, question);
        frame.build(|index, place| format!("state_{index}[{place}]"));
        match question {
            Question::Control => frame.compare_state(),
            Question::Data { .. } => frame.compare_data(&self.known(question)),
        }
        frame.finish()
    }

    /// The modules `right` and `wrong`, all ranks after the first of one region; in `wrong`, what the parts
    /// hold that do not answer there is 0.
    #[must_use]
    pub fn silence(&self, region: Region) -> String {
        let mut frame = Frame::new(self, RANK_BY_RANK);
        frame.build(|index, place| {
            let register = &self.graph.registers[index];
            let is_silent = |only| only != Reader::Any && only != Reader::Only(region);
            match (register.holds, self.code(index, place)) {
                (Holds::Data(_), Some(code)) => format!("1'b{}", region as u8 >> code & 1),
                _ if is_silent(self.readers[index][place]) => {
                    format!("(is_right && state_{index}[{place}])")
                }
                _ => format!("state_{index}[{place}]"),
            }
        });
        frame.compare_data("1'b1");
        frame.finish()
    }

    /// The module `right` alone: a rank that loads what was not offered to it, or is valid without having
    /// loaded or been valid.
    #[must_use]
    pub fn loads(&self) -> String {
        let mut frame = Frame::new(self, Question::Control);
        frame.build(|index, place| format!("state_{index}[{place}]"));
        frame.look_for_loads();
        frame.finish()
    }

    /// The place in the region that a bit of a register has.
    fn code(&self, index: usize, place: usize) -> Option<usize> {
        let register = &self.graph.registers[index];
        let Holds::Data(rank) = register.holds else { return None };
        self.regions[rank].iter().position(|&bit| bit == register.output[place])
    }

    /// The value that cut registers hold (`given`) or are about to load (`data`), in the module `right`;
    /// none where a bit is not in one.
    fn held(&self, question: Question, bits: &[Bit], what: &str) -> Option<String> {
        let bit = |&bit: &Bit| match bit {
            Bit::Constant(value) => Some(format!("1'b{}", u8::from(value))),
            Bit::Net(_) => {
                let (index, place) = self.graph.locate(bit)?;
                let cut = question.cuts(self.graph.registers[index].holds);
                cut.then(|| format!("right_{what}_{index}[{place}]"))
            }
        };
        let bits = bits.iter().rev().map(bit).collect::<Option<Vec<String>>>()?;
        (!bits.is_empty()).then(|| format!("{{{}}}", bits.join(", ")))
    }

    /// That every fact holds of the registers that are cut.
    fn known(&self, question: Question) -> String {
        let conditions = self.facts.iter().filter_map(|fact| {
            let bits = self.graph.named(&fact.path);
            Some(fact.condition(&self.held(question, &bits, "given")?, bits.len()))
        });
        let all: Vec<String> = conditions.collect();
        if all.is_empty() { "1'b1".to_owned() } else { all.join(" && ") }
    }

    /// The bits of a register that are read by what answers in the region the rank is about to have.
    fn read(&self, question: Question, index: usize, rank: usize) -> String {
        let region = self.held(question, &self.regions[rank], "data");
        let is_read = |&reader: &Reader| match (reader, &region) {
            (Reader::Only(only), Some(region)) => format!("{region} == 2'd{}", only as u8),
            _ => "1'b1".to_owned(),
        };
        let bits: Vec<String> = self.readers[index].iter().rev().map(is_read).collect();
        format!("{{{}}}", bits.join(", "))
    }
}

const SIDES: [&str; 2] = ["right", "wrong"];

/// A frame under way.
struct Frame<'a> {
    frames: &'a Frames,
    question: Question,
    inputs: Vec<String>,
    body: String,
    differences: Vec<String>,
}

impl<'a> Frame<'a> {
    const fn new(frames: &'a Frames, question: Question) -> Self {
        Self { frames, question, inputs: Vec::new(), body: String::new(), differences: Vec::new() }
    }

    fn finish(self) -> String {
        let inputs: Vec<String> = self.inputs.iter().map(|input| format!("input {input}")).collect();
        let ports = inputs.join(", ");
        let differences = self.differences.join(",\n    ");
        format!(
            "module frame({ports}, output differ);\n{}  assign differ = |{{\n    {differences}}};\n\
             endmodule\nmodule nothing({ports}, output differ);\n  assign differ = 1'b0;\nendmodule\n",
            self.body
        )
    }

    fn line(&mut self, text: &str) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.body, "  {text}");
    }

    fn width(&self, port: &str) -> usize {
        self.frames.graph.port(port).len()
    }

    fn cut(&self) -> impl Iterator<Item = (usize, Holds)> + use<'a> {
        let (question, registers) = (self.question, self.frames.graph.registers.iter());
        let all = registers.enumerate().map(|(index, register)| (index, register.holds));
        all.filter(move |&(_, holds)| question.cuts(holds))
    }

    /// Instantiates both. `given` says what a bit of a cut register holds; in it, `is_right` tells which
    /// of the two is asked.
    fn build(&mut self, given: impl Fn(usize, usize) -> String) {
        let mut shared = Vec::new();
        for name in ["address_i", "x_i"] {
            self.inputs.push(format!("[{}:0] {name}", self.width(name) - 1));
            shared.push(format!(".{name}({name})"));
        }
        for (name, value) in [("clk_i", 0), ("rst_i", 0), ("in_valid_i", 1), ("out_ready_i", 1)] {
            if self.question == Question::Control {
                self.inputs.push(name.to_owned());
                shared.push(format!(".{name}({name})"));
            } else {
                shared.push(format!(".{name}(1'd{value})"));
            }
        }
        for (index, holds) in self.cut() {
            if holds != Holds::Valid || self.question == Question::Control {
                let width = self.frames.graph.registers[index].output.len();
                self.inputs.push(format!("[{}:0] state_{index}", width - 1));
            }
        }
        for side in SIDES {
            let mut connections = shared.clone();
            for name in ["in_ready_o", "out_valid_o", "intensity_o", "status_o"] {
                self.line(&format!("wire [{}:0] {side}_{name};", self.width(name) - 1));
                connections.push(format!(".{name}({side}_{name})"));
            }
            for (index, holds) in self.cut() {
                connections.push(self.register(side, index, holds, &given));
            }
            self.line(&format!("{side} {side}({});", connections.join(", ")));
        }
    }

    /// Declares what a cut register holds and what it is about to load; returns its connections.
    fn register(&mut self, side: &str, index: usize, holds: Holds, given: impl Fn(usize, usize) -> String) -> String {
        let width = self.frames.graph.registers[index].output.len();
        let is_right = if side == SIDES[0] { "1'b1" } else { "1'b0" };
        let bit = |place| match (holds, self.question) {
            (Holds::Valid, Question::Data { .. }) => "1'b1".to_owned(),
            _ => given(index, place).replace("is_right", is_right),
        };
        let bits: Vec<String> = (0..width).rev().map(bit).collect();
        let top = width - 1;
        self.line(&format!("wire [{top}:0] {side}_given_{index} = {{{}}};", bits.join(", ")));
        self.line(&format!("wire [{top}:0] {side}_data_{index};"));
        self.line(&format!("wire {side}_load_{index}, {side}_clock_{index};"));
        let connect = |port: &str, wire: &str| format!(".{port}_{index}({side}_{wire}_{index})");
        let mut connections = vec![connect("state", "given"), connect("data", "data"), connect("clock", "clock")];
        if holds != Holds::Valid {
            connections.push(connect("load", "load"));
        }
        connections.join(", ")
    }

    /// The valid flags' place in the list of registers.
    fn flags(&self) -> usize {
        self.cut().find(|&(_, holds)| holds == Holds::Valid).map_or(0, |(index, _)| index)
    }

    /// The handshake and the next state.
    fn compare_state(&mut self) {
        let flags = self.flags();
        for name in ["in_ready_o", "out_valid_o"] {
            self.differences.push(format!("right_{name} ^ wrong_{name}"));
        }
        for name in ["intensity_o", "status_o"] {
            self.differences.push(format!("right_out_valid_o && right_{name} != wrong_{name}"));
        }
        for (index, holds) in self.cut() {
            let next = |side| format!("({side}_load_{index} ? {side}_data_{index} : {side}_given_{index})");
            self.differences.push(format!("right_clock_{index} ^ wrong_clock_{index}"));
            self.differences.push(match holds {
                Holds::Valid => format!("right_data_{index} ^ wrong_data_{index}"),
                Holds::Data(rank) => format!("right_data_{flags}[{rank}] && {} != {}", next(SIDES[0]), next(SIDES[1])),
            });
        }
    }

    /// The answer, and what cut registers are about to load, as far as it is read.
    fn compare_data(&mut self, known: &str) {
        self.line(&format!("wire known = {known};"));
        for name in ["intensity_o", "status_o"] {
            self.differences.push(format!("known && right_{name} != wrong_{name}"));
        }
        for (index, holds) in self.cut() {
            if let Holds::Data(rank) = holds {
                let read = self.frames.read(self.question, index, rank);
                self.differences.push(format!("known && ((right_data_{index} ^ wrong_data_{index}) & {read}) != 0"));
            }
        }
    }

    fn look_for_loads(&mut self) {
        let flags = self.flags();
        for (index, holds) in self.cut() {
            let Holds::Data(rank) = holds else { continue };
            let offered = match rank.checked_sub(1) {
                Some(before) => format!("right_given_{flags}[{before}]"),
                None => "in_valid_i".to_owned(),
            };
            self.differences.push(format!(
                "right_load_{index} ? !{offered} : right_data_{flags}[{rank}] && !right_given_{flags}[{rank}]"
            ));
        }
    }
}
