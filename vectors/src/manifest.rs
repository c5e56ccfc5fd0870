//! `manifest.json`: what a bundle of vectors is, and what its files must be.
//!
//! Maps are ordered and there is no time in it: the same command gives the same bytes.

use std::collections::BTreeMap;

use hw_model::config::Config;
use hw_model::datapath::Datapath;
use hw_model::format::QFormat;
use hw_model::rom::Place;
use serde::{Deserialize, Serialize};

use crate::case::Strategy;
use crate::checksum::Checksum;
use crate::faults::Compact;
use crate::negative_control::NegativeControl;
use crate::output_text::json;
use crate::packing::WordLayout;

/// The manifest's own name.
pub const MANIFEST: &str = "manifest.json";
/// `{address, x}` of each case.
pub const STIMULUS: &str = "stimulus.mem";
/// `{status, intensity}` of each case.
pub const EXPECTED: &str = "expected.mem";
/// The name of the ROM image, one word a row.
pub const ROM: &str = "rom.mem";
/// Every case with what each stage holds.
pub const TABLE: &str = "vectors.csv";

/// [`EXPECTED`] with one wrong word: a testbench given this must fail.
pub const NEGATIVE_CONTROL: &str = "negative_control.mem";
/// Every fault and the vector that kills it, where the strategy looked for them.
pub const FAULTS: &str = "faults.csv";

/// The version of the manifest itself; a reader refuses others.
pub const FORMAT_VERSION: u32 = 2;

/// What made a bundle, how its words are laid out, and the checksum of each file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// The version of this format, [`FORMAT_VERSION`] when written.
    pub format_version: u32,
    /// Version of the tool that wrote the bundle.
    pub blysk_version: String,
    /// The command that made it.
    pub command: String,
    /// How cases were chosen.
    pub strategy: Strategy,
    /// The seed of the random cases.
    pub seed: u64,
    /// How many cases there are.
    pub counts: Counts,
    /// What a reader should know about the choice.
    pub notes: Vec<String>,
    /// The faults, where the strategy looked for all of them.
    pub faults: Option<FaultCounts>,
    /// The word that is wrong in [`NEGATIVE_CONTROL`].
    pub negative_control: NegativeControl,
    /// The pipeline's ports and ranks.
    pub hardware: Hardware,
    /// What the words of each memory file are made of.
    pub words: Words,
    /// Size and checksum of each file.
    pub files: BTreeMap<String, Checksum>,
    /// The whole configuration, so that the bundle can be made again from its manifest alone.
    pub configuration: Config,
}

/// How many cases there are.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counts {
    /// Cases asked for (all of them, for the exhaustive strategy).
    pub requested: u64,
    /// Cases in the files.
    pub vectors: u64,
    /// Words in the ROM image.
    pub rom_words: u64,
    /// Corners the design has, whether or not they are in the files; 0 where none were looked for.
    pub corners_available: u64,
    /// Cases of each kind; a case chosen for several reasons counts under the first.
    pub kinds: BTreeMap<String, u64>,
}

/// What the vectors kill, where that is known of every fault.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FaultCounts {
    /// Faults of the model.
    pub faults: u64,
    /// Those that no input tells from right hardware; the vectors kill all others.
    pub equivalent: u64,
    /// Fewer vectors than this cannot kill as much.
    pub lower_bound: u64,
    /// The inputs that were tried: every x of [0, 1] in every row.
    pub inputs: u64,
}

/// The pipeline as a testbench sees it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hardware {
    /// Clock cycles from an accepted input to its output, when nothing stalls.
    pub latency: u32,
    /// Bits of each data port.
    pub port_widths: BTreeMap<String, u32>,
    /// The bit of each status flag.
    pub status_flags: BTreeMap<String, u32>,
    /// ROM fields that are the same in every row and so not in its words.
    pub rom_constants: Vec<RomConstant>,
    /// The registers, rank by rank.
    pub ranks: Vec<Rank>,
}

/// A ROM field that never changes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RomConstant {
    /// The name of the field, such as `c1`.
    pub name: String,
    /// The format of its bits.
    pub format: QFormat,
    /// Its bits, the same in every row.
    pub bits: i64,
}

/// One rank of registers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rank {
    /// Its name, as in the table's columns.
    pub name: String,
    /// The registers of the rank, in the order of traces.
    pub registers: Vec<RankRegister>,
}

/// One register of a rank.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RankRegister {
    /// The name of the register, as in traces.
    pub name: String,
    /// The format of its bits.
    pub format: QFormat,
    /// False where the value is only carried along; the table has no column for it then.
    pub computed: bool,
}

/// What the words of each memory file are made of.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Words {
    /// The layout of a word of [`STIMULUS`].
    pub stimulus: WordLayout,
    /// The layout of a word of [`EXPECTED`].
    pub expected: WordLayout,
    /// The layout of a word of [`ROM`].
    pub rom: WordLayout,
}

impl Words {
    /// The layouts of a data path.
    #[must_use]
    pub fn of(datapath: &Datapath) -> Self {
        Self {
            stimulus: WordLayout::stimulus(datapath),
            expected: WordLayout::expected(datapath),
            rom: WordLayout::rom(datapath.rom().layout()),
        }
    }
}

impl FaultCounts {
    /// The counts of a search.
    #[must_use]
    pub fn of(compact: &Compact) -> Self {
        Self {
            faults: compact.verdicts().len() as u64,
            equivalent: compact.equivalent().count() as u64,
            lower_bound: compact.lower_bound(),
            inputs: compact.inputs(),
        }
    }
}

impl Hardware {
    /// The ports and ranks of a data path.
    #[must_use]
    pub fn of(datapath: &Datapath) -> Self {
        let (rom, formats) = (datapath.rom(), datapath.formats());
        let port_widths = [
            ("address", rom.address_width()),
            ("x", formats.input.width()),
            ("intensity", formats.output.width()),
            ("status", datapath.status_width()),
        ];
        let flags = datapath.status_flags().iter();
        let flags = flags.map(|(flag, name)| (*name, flag.bits().trailing_zeros()));
        let constants = rom.layout().fields().iter().filter_map(|field| match field.place {
            Place::Stored { .. } => None,
            Place::Constant { bits } => Some(RomConstant { name: field.name.to_string(), format: field.format, bits }),
        });
        Self {
            latency: datapath.latency() as u32,
            port_widths: named(port_widths),
            status_flags: named(flags),
            rom_constants: constants.collect(),
            ranks: (0..datapath.rank_count()).map(|rank| Rank::of(datapath, rank)).collect(),
        }
    }
}

impl Rank {
    fn of(datapath: &Datapath, rank: usize) -> Self {
        let registers = datapath.registers(rank).into_iter().map(|register| RankRegister {
            name: register.name().to_owned(),
            format: register.format,
            computed: register.computed,
        });
        Self { name: datapath.rank_name(rank), registers: registers.collect() }
    }
}

impl Manifest {
    /// The manifest as JSON, ready to be parsed again.
    #[must_use]
    pub fn to_json(&self) -> String {
        // Plain fields and string keys: serialising cannot fail.
        json(self).unwrap_or_default()
    }
}

fn named<'a>(pairs: impl IntoIterator<Item = (&'a str, u32)>) -> BTreeMap<String, u32> {
    pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}
