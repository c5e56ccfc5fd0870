//! How long each kind of input file may be.

use super::problem::TextProblem;

/// A kind of input file.
#[derive(Debug, Clone, Copy)]
pub struct TextKind {
    /// What messages call it.
    pub noun: &'static str,
    /// The most bytes that are read.
    pub most_bytes: u64,
    /// The most bytes of one line.
    pub most_line_bytes: u64,
    /// Bytes that are not UTF-8 are read as `?` each: for files whose words do not matter.
    pub lossy: bool,
    /// What an empty file should have, where [`super::read()`] refuses it.
    pub when_empty: Option<&'static str>,
}

const MIB: u64 = 1 << 20;
const GIB: u64 = 1 << 30;

/// The most bytes of a line of a file that is read line by line.
const LINE: u64 = MIB;

impl TextKind {
    /// A file that is kept in memory as a whole; JSON may well have one line.
    const fn whole(noun: &'static str, most_bytes: u64, when_empty: &'static str) -> Self {
        let when_empty = Some(when_empty);
        Self { noun, most_bytes, most_line_bytes: most_bytes, lossy: false, when_empty }
    }

    /// A file that is read line by line.
    const fn lines(noun: &'static str, most_bytes: u64) -> Self {
        Self { noun, most_bytes, most_line_bytes: LINE, lossy: false, when_empty: None }
    }

    pub(super) const fn too_long(&self) -> TextProblem {
        TextProblem::Long { noun: self.noun, most: self.most_bytes }
    }
}

/// A configuration of a pipeline, as JSON.
pub const CONFIGURATION: TextKind =
    TextKind::whole("configuration", 16 * MIB, "`blysk presets show NAME` prints a configuration to start from");

/// A map of a module's ports, as JSON.
pub const PORT_MAP: TextKind =
    TextKind::whole("map of ports", MIB, "write what the ports are called: {\"ports\": {\"clk_i\": \"clk\"}}");

/// A scene, as JSON.
pub const SCENE: TextKind = TextKind::whole("scene", 256 * MIB, "`blysk scene --schema` prints what a scene has");

/// A mesh: only its numbers count, and its names may be Latin-1.
pub const MESH: TextKind =
    TextKind { lossy: true, ..TextKind::whole("mesh", 512 * MIB, "it has no face; give at least one line `f a b c`") };

/// A library of materials: its names may be Latin-1.
pub const MATERIALS: TextKind =
    TextKind { lossy: true, ..TextKind::whole("library of materials", 64 * MIB, "it has no `newmtl name`") };

/// A model as glTF, or a buffer of it: JSON, or bytes that are no text.
pub const MODEL: TextKind = TextKind::whole("model", 512 * MIB, "export the model again");

/// A certificate of `blysk certify` or `blysk specialise`, as JSON.
pub const CERTIFICATE: TextKind = TextKind::whole("certificate", 256 * MIB, "write the certificate again");

/// A job of `blysk shard`, as JSON.
pub const JOB: TextKind = TextKind::whole("job", 16 * MIB, "docs/scale/README.md has jobs to start from");

/// What `blysk shard plan` wrote.
pub const SHARD_PLAN: TextKind = TextKind::whole("plan", 64 * MIB, "write the plan again");

/// What `blysk shard run` wrote: the result of a shard, or how far a shard has come.
pub const SHARD_RESULT: TextKind = TextKind::whole("result", 256 * MIB, "run the shard again");

/// The manifest of a bundle.
pub const MANIFEST: TextKind = TextKind::whole("manifest", 16 * MIB, "write the bundle again");

/// A memory image. An empty one is told by the words that it should have.
pub const MEMORY: TextKind = TextKind { most_line_bytes: 256 * MIB, ..TextKind::lines("memory file", 256 * MIB) };

/// The table of a bundle, with every register of every vector.
pub const VECTOR_TABLE: TextKind = TextKind::lines("table", 8 * GIB);

/// What `blysk pareto` wrote.
pub const PARETO_TABLE: TextKind = TextKind::whole("table", 16 * MIB, "`blysk pareto --out DIR` writes pareto.csv");

/// What `make synth` wrote.
pub const SYNTHESIS_TABLE: TextKind = TextKind::whole("table", 16 * MIB, "`make synth` writes synth.csv");

/// A stimulus of `blysk simulate`, as CSV.
pub const STIMULUS: TextKind = TextKind::lines("stimulus", 512 * MIB);

/// Questions for the golden model, which are answered as they come.
pub const QUESTIONS: TextKind = TextKind { most_line_bytes: 4096, ..TextKind::lines("list of questions", 1 << 60) };

/// A log of answers.
pub const ANSWER_LOG: TextKind = TextKind::lines("log", 16 * GIB);

/// A log of every register of every cycle, between the lines that a simulator prints of its own.
pub const REGISTER_LOG: TextKind = TextKind { lossy: true, ..TextKind::lines("log", 64 * GIB) };
