//! A bundle of vectors: stimulus, expected answers, ROM image, table and manifest.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use hw_model::datapath::Signals;
use hw_model::design::Design;
use thiserror::Error;

use crate::case::{Sample, Strategy};
use crate::checksum::{Checked, Checksum};
use crate::manifest::{
    Counts, EXPECTED, FORMAT_VERSION, Hardware, MANIFEST, Manifest, ROM, STIMULUS, TABLE, Words,
};
use crate::memory_file::{Header, write_header, write_word};
use crate::packing::WordLayout;
use crate::stimulus::Stimulus;
use crate::table::TableWriter;
use crate::whole_file::{OutputError, OutputFile, OutputSet};

/// The most vectors of one bundle, 2^22. The table of the `paper` preset has about 600 bytes a line,
/// so this is some 2.5 GB.
pub const MAX_VECTORS: u64 = 1 << 22;

/// Why a bundle cannot be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BundleError {
    /// Nothing asked for.
    #[error("a bundle of 0 vectors would check nothing; ask for a count of 1 or more")]
    NoVectors,
    /// More than [`MAX_VECTORS`].
    #[error(
        "{strategy} would give {count} vectors, more than {MAX_VECTORS}; {}", advice(*strategy)
    )]
    TooMany {
        /// The strategy.
        strategy: Strategy,
        /// How many vectors it would give.
        count: u128,
    },
    /// The files could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

fn advice(strategy: Strategy) -> &'static str {
    match strategy {
        Strategy::Exhaustive => "use a narrower input format or fewer exponents, or a sample",
        _ => "ask for a lower count, or several bundles with different seeds",
    }
}

/// A bundle, chosen but not yet written.
#[derive(Debug, Clone)]
pub struct Bundle<'a> {
    design: &'a Design,
    stimulus: Stimulus<'a>,
    strategy: Strategy,
    requested: u64,
    seed: u64,
    command: String,
}

impl<'a> Bundle<'a> {
    /// Chooses `count` cases ([`Strategy`] says how; the exhaustive one does not ask the count).
    /// `command` is what the files say they were made by.
    ///
    /// # Errors
    /// When there would be no vectors, or more than [`MAX_VECTORS`].
    pub fn new(
        design: &'a Design,
        strategy: Strategy,
        count: u64,
        seed: u64,
        command: &str,
    ) -> Result<Self, BundleError> {
        if count == 0 && strategy != Strategy::Exhaustive {
            return Err(BundleError::NoVectors);
        }
        if count > MAX_VECTORS && strategy != Strategy::Exhaustive {
            return Err(BundleError::TooMany { strategy, count: count.into() });
        }
        let stimulus = Stimulus::new(design, strategy, count, seed);
        let len = stimulus.len();
        if len > u128::from(MAX_VECTORS) {
            return Err(BundleError::TooMany { strategy, count: len });
        }
        let requested = if strategy == Strategy::Exhaustive { len as u64 } else { count };
        Ok(Self { design, stimulus, strategy, requested, seed, command: command.to_owned() })
    }

    /// The design.
    #[must_use]
    pub const fn design(&self) -> &'a Design {
        self.design
    }

    /// The cases, in the order of the files.
    #[must_use]
    pub fn samples(&self) -> Box<dyn Iterator<Item = Sample> + '_> {
        self.stimulus.samples()
    }

    /// How many cases there are; at most [`MAX_VECTORS`].
    #[must_use]
    pub fn vector_count(&self) -> u64 {
        self.stimulus.len() as u64
    }

    /// What a reader should know about the choice: corners left out, fewer cases than asked for.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let corners = self.stimulus.corners();
        let (taken, available) = (corners.samples().len() as u64, corners.available());
        let mut notes = Vec::new();
        if taken < available {
            notes.push(format!(
                "{taken} of the design's {available} corners are here, shared over the ROM's rows; \
                 strategy corners with a count of {available} has them all"
            ));
        }
        if self.vector_count() < self.requested {
            notes.push(format!(
                "{} vectors were asked for; the design has {available} corners and no more",
                self.requested
            ));
        }
        notes
    }

    /// Writes the five files into `directory`, which is made where it does not exist: all of them, or
    /// none.
    ///
    /// # Errors
    /// When the directory or a file cannot be written.
    pub fn write_to(&self, directory: impl AsRef<Path>) -> Result<Manifest, BundleError> {
        let mut set = OutputSet::create(directory)?;
        let manifest = self.stage(&mut set)?;
        set.commit()?;
        Ok(manifest)
    }

    /// Writes the five files into a set that the caller commits, perhaps with files of its own.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn stage(&self, set: &mut OutputSet) -> Result<Manifest, BundleError> {
        let words = Words::of(self.design.datapath());
        let mut files = BTreeMap::new();
        files.insert(ROM.to_owned(), self.stage_rom(set, &words.rom)?);
        let kinds = self.stage_vectors(set, &words, &mut files)?;
        let manifest = self.manifest(words, files, kinds);
        set.write(MANIFEST, manifest.to_json())?;
        Ok(manifest)
    }

    fn stage_rom(&self, set: &mut OutputSet, layout: &WordLayout) -> Result<Checksum, OutputError> {
        let rom = self.design.rom();
        let mut file = Begun::new(set, ROM)?;
        file.header("ROM image", layout, rom.depth() as u64, &self.command)?;
        for row in rom.rows() {
            file.word(layout, &rom.layout().pack(row))?;
        }
        file.keep(set)
    }

    fn stage_vectors(
        &self,
        set: &mut OutputSet,
        words: &Words,
        files: &mut BTreeMap<String, Checksum>,
    ) -> Result<BTreeMap<String, u64>, OutputError> {
        let count = self.vector_count();
        let mut stimulus = Begun::new(set, STIMULUS)?;
        stimulus.header("stimulus", &words.stimulus, count, &self.command)?;
        let mut expected = Begun::new(set, EXPECTED)?;
        expected.header("expected answers", &words.expected, count, &self.command)?;
        let csv = Begun::new(set, TABLE)?;
        let in_table = |cause| OutputError::Write { path: set.directory().join(TABLE), cause };
        let mut table = TableWriter::new(self.design, csv.0).map_err(in_table)?;

        let mut kinds = BTreeMap::new();
        for (index, sample) in (0..).zip(self.samples()) {
            let passage = self.design.datapath().passage(sample.case.address, sample.case.x);
            let address = i64::from(sample.case.address);
            stimulus.word(&words.stimulus, &words.stimulus.pack(&[address, sample.case.x]))?;
            expected.word(&words.expected, &words.expected.pack(&answer(&passage)))?;
            table.write(index, &sample, &passage).map_err(in_table)?;
            *kinds.entry(sample.kind).or_insert(0) += 1;
        }
        let csv = Begun(table.finish().map_err(in_table)?);
        for (name, file) in [(STIMULUS, stimulus), (EXPECTED, expected), (TABLE, csv)] {
            files.insert(name.to_owned(), file.keep(set)?);
        }
        Ok(kinds.into_iter().map(|(kind, count)| (kind.to_string(), count)).collect())
    }

    fn manifest(
        &self,
        words: Words,
        files: BTreeMap<String, Checksum>,
        kinds: BTreeMap<String, u64>,
    ) -> Manifest {
        Manifest {
            format_version: FORMAT_VERSION,
            blysk_version: env!("CARGO_PKG_VERSION").to_owned(),
            command: self.command.clone(),
            strategy: self.strategy,
            seed: self.seed,
            counts: Counts {
                requested: self.requested,
                vectors: self.vector_count(),
                rom_words: self.design.rom().depth() as u64,
                corners_available: self.stimulus.corners().available(),
                kinds,
            },
            notes: self.notes(),
            hardware: Hardware::of(self.design.datapath()),
            words,
            files,
            configuration: self.design.config().clone(),
        }
    }
}

/// Status and intensity of the last rank.
fn answer(passage: &[Signals]) -> [i64; 2] {
    passage.last().map_or([0; 2], |last| [last.status.bits().into(), last.intensity])
}

/// A file under way with its checksum, whose errors say which file it is.
struct Begun(Checked<OutputFile>);

impl Begun {
    fn new(set: &mut OutputSet, name: &str) -> Result<Self, OutputError> {
        set.file(name).map(|file| Self(Checked::new(file)))
    }

    fn header(
        &mut self,
        title: &str,
        layout: &WordLayout,
        words: u64,
        command: &str,
    ) -> Result<(), OutputError> {
        let header = Header { title, layout, words, command };
        write_header(&mut self.0, &header).map_err(|cause| self.0.get_ref().error(cause))
    }

    fn word(
        &mut self,
        layout: &WordLayout,
        word: &impl std::fmt::LowerHex,
    ) -> Result<(), OutputError> {
        write_word(&mut self.0, layout, word).map_err(|cause| self.0.get_ref().error(cause))
    }

    fn keep(mut self, set: &mut OutputSet) -> Result<Checksum, OutputError> {
        self.0.flush().map_err(|cause| self.0.get_ref().error(cause))?;
        let (file, checksum) = self.0.finish();
        set.keep(file)?;
        Ok(checksum)
    }
}

/// The files of a bundle in `directory`, in the order in which they are written.
#[must_use]
pub fn file_paths(directory: &Path) -> [PathBuf; 5] {
    [ROM, STIMULUS, EXPECTED, TABLE, MANIFEST].map(|name| directory.join(name))
}
