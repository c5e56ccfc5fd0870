//! A bundle of vectors: stimulus, expected answers, ROM image, table and manifest.

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use hw_model::datapath::Signals;
use hw_model::design::Design;
use thiserror::Error;

use crate::case::{Case, Sample, Strategy};
use crate::checksum::Checksum;
use crate::fault_table::write_faults;
use crate::faults::{Compact, OneByOne, Workers};
pub use crate::limits::MAX_VECTORS;
use crate::limits::{Sweep, TooManyInputs, inputs};
use crate::manifest::{
    Counts, EXPECTED, FAULTS, FORMAT_VERSION, FaultCounts, Hardware, MANIFEST, Manifest, NEGATIVE_CONTROL, ROM,
    STIMULUS, TABLE, Words,
};
use crate::memory_file::{Header, write_header, write_word};
use crate::negative_control::{Flip, NegativeControl};
use crate::packing::WordLayout;
use crate::rom_image;
use crate::rtl::files::{EXPONENTS, STAGES};
use crate::stimulus::Stimulus;
use crate::table::TableWriter;
use crate::whole_file::{OutputError, OutputFile, OutputSet};

/// The name of the list of a bundle's files, `vectors.sha256`, without its end.
pub const COMMAND: &str = "vectors";

/// Why a bundle cannot be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BundleError {
    /// A count of 0, with which the bundle would check nothing.
    #[error("a bundle of 0 vectors would check nothing; ask for a count of 1 or more")]
    NoVectors,
    /// A count above [`MAX_VECTORS`].
    #[error(
        "{strategy} would give {count} vectors, more than {MAX_VECTORS}; {}", advice(*strategy)
    )]
    TooMany {
        /// The strategy that was asked for.
        strategy: Strategy,
        /// How many vectors it would give.
        count: u128,
    },
    /// More inputs than a search can go through.
    #[error(transparent)]
    TooManyInputs(#[from] TooManyInputs),
    /// The files could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

fn advice(strategy: Strategy) -> &'static str {
    match strategy {
        Strategy::Exhaustive => "use a narrower input format or fewer exponents, or a sample",
        Strategy::List => "make several bundles",
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
    watcher: Watcher<'a>,
}

/// Who is told how many more vectors are written.
#[derive(Clone, Copy)]
struct Watcher<'a>(&'a (dyn Fn(u64) + Sync));

impl fmt::Debug for Watcher<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Watcher")
    }
}

impl<'a> Bundle<'a> {
    /// Chooses `count` cases ([`Strategy`] says how; two of them do not ask the count). `command` is
    /// what the files say they were made by.
    ///
    /// # Errors
    /// When there would be no vectors, or more than [`MAX_VECTORS`]; when a search would have no end.
    pub fn new(
        design: &'a Design,
        strategy: Strategy,
        count: u64,
        seed: u64,
        command: &str,
    ) -> Result<Self, BundleError> {
        Self::with_workers(design, strategy, count, seed, command, &OneByOne)
    }

    /// The same; `workers` do what takes long, which is the search of [`Strategy::Compact`].
    ///
    /// # Errors
    /// As [`Bundle::new`].
    pub fn with_workers(
        design: &'a Design,
        strategy: Strategy,
        count: u64,
        seed: u64,
        command: &str,
        workers: &impl Workers,
    ) -> Result<Self, BundleError> {
        Self::check_count(strategy, count)?;
        if strategy == Strategy::Compact {
            Sweep::Compact.within(inputs(design), design.config().input)?;
        }
        let stimulus = Stimulus::with_workers(design, strategy, count, seed, workers);
        let requested = (!strategy.counts_itself()).then_some(count);
        Self::of_stimulus(design, stimulus, strategy, requested, seed, command)
    }

    /// The cases of a list of the user's own, in their order. The `seed` draws the wrong word of the negative control.
    ///
    /// # Errors
    /// When there are no cases, or more than [`MAX_VECTORS`].
    pub fn of_cases(design: &'a Design, cases: &[Case], seed: u64, command: &str) -> Result<Self, BundleError> {
        let stimulus = Stimulus::of_cases(design, cases, seed);
        Self::of_stimulus(design, stimulus, Strategy::List, None, seed, command)
    }

    fn of_stimulus(
        design: &'a Design,
        stimulus: Stimulus<'a>,
        strategy: Strategy,
        requested: Option<u64>,
        seed: u64,
        command: &str,
    ) -> Result<Self, BundleError> {
        let len = stimulus.len();
        if len == 0 {
            return Err(BundleError::NoVectors);
        }
        if len > u128::from(MAX_VECTORS) {
            return Err(BundleError::TooMany { strategy, count: len });
        }
        let requested = requested.unwrap_or(len as u64);
        let (command, watcher) = (command.to_owned(), Watcher(&|_| {}));
        Ok(Self { design, stimulus, strategy, requested, seed, command, watcher })
    }

    /// The same bundle, which tells `watcher` how many more vectors are written, each time they are.
    #[must_use]
    pub fn watched(self, watcher: &'a (dyn Fn(u64) + Sync)) -> Self {
        Self { watcher: Watcher(watcher), ..self }
    }

    /// Counts `vectors` more that are written to one of the files.
    pub(crate) fn written(&self, vectors: u64) {
        (self.watcher.0)(vectors);
    }

    /// Checks a count alone, for callers that have work to do before the bundle.
    ///
    /// # Errors
    /// When there would be no vectors, or more than [`MAX_VECTORS`].
    pub fn check_count(strategy: Strategy, count: u64) -> Result<(), BundleError> {
        match count {
            _ if strategy.counts_itself() => Ok(()),
            0 => Err(BundleError::NoVectors),
            count if count > MAX_VECTORS => Err(BundleError::TooMany { strategy, count: count.into() }),
            _ => Ok(()),
        }
    }

    /// The design for which the vectors are made.
    #[must_use]
    pub const fn design(&self) -> &'a Design {
        self.design
    }

    /// What the search of [`Strategy::Compact`] found; none with the other strategies.
    #[must_use]
    pub const fn compact(&self) -> Option<&Compact> {
        self.stimulus.compact()
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

    /// What a reader should know about the choice: what it kills, corners left out, fewer cases than
    /// asked for.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let (corners, targets) = (self.stimulus.corners(), self.stimulus.targets());
        let (present, available) = (corners.present(), corners.available());
        let mut notes = Vec::new();
        if targets.faults() > 0 {
            notes.push(format!(
                "targets kill {} of the {} faults that a ROM row can have (a field one unit off)",
                targets.killed(),
                targets.faults()
            ));
        }
        if let Some(compact) = self.stimulus.compact() {
            notes.extend(found(compact));
        }
        if present < available {
            notes.push(format!(
                "{present} of the design's {available} corners are here, shared over the ROM's rows; \
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

    /// Writes the files into `directory`, which is made where it does not exist: all of them, or
    /// none.
    ///
    /// # Errors
    /// When the directory or a file cannot be written.
    pub fn write_to(&self, directory: impl AsRef<Path>) -> Result<Manifest, BundleError> {
        let mut set = OutputSet::create(directory)?.listed(COMMAND)?;
        let manifest = self.stage(&mut set)?;
        set.commit()?;
        Ok(manifest)
    }

    /// Writes `vectors.csv` alone, and hands the writer back.
    ///
    /// # Errors
    /// When the writer does.
    pub fn write_table<W: Write>(&self, to: W) -> io::Result<W> {
        let mut table = TableWriter::new(self.design, to)?;
        for (index, sample) in (0..).zip(self.samples()) {
            let passage = self.design.datapath().passage(sample.case.address, sample.case.x);
            table.write(index, &sample, &passage)?;
        }
        table.finish()
    }

    /// The answer that is wrong in the negative control.
    #[must_use]
    pub fn flip(&self) -> Flip {
        Flip::draw(self.design.datapath(), self.vector_count(), self.seed)
    }

    /// Writes the files into a set that the caller commits, perhaps with files of its own.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn stage(&self, set: &mut OutputSet) -> Result<Manifest, BundleError> {
        // Of another bundle in the same directory, they would be about other vectors.
        for name in [FAULTS, STAGES, EXPONENTS] {
            set.obsolete(name);
        }
        let words = Words::of(self.design.datapath());
        let mut files = BTreeMap::new();
        files.insert(ROM.to_owned(), self.stage_rom(set, ROM)?);
        if let Some(compact) = self.stimulus.compact() {
            files.insert(FAULTS.to_owned(), stage_faults(set, compact)?);
        }
        let (kinds, control) = self.stage_vectors(set, &words, &mut files)?;
        let manifest = self.manifest(words, files, kinds, control);
        set.seal(MANIFEST, manifest.to_json())?;
        Ok(manifest)
    }

    /// The ROM image, as the file `name`.
    pub(crate) fn stage_rom(&self, set: &mut OutputSet, name: &str) -> Result<Checksum, OutputError> {
        let mut file = Begun::new(set, name)?;
        rom_image::mem(self.design, &self.command, &mut file.0).map_err(|cause| file.0.error(cause))?;
        file.keep(set)
    }

    fn stage_vectors(
        &self,
        set: &mut OutputSet,
        words: &Words,
        files: &mut BTreeMap<String, Checksum>,
    ) -> Result<(BTreeMap<String, u64>, NegativeControl), OutputError> {
        let begin = |set: &mut OutputSet, name, title, layout| {
            let mut file = Begun::new(set, name)?;
            file.header(title, layout, self.vector_count(), &self.command)?;
            Ok::<_, OutputError>(file)
        };
        let mut stimulus = begin(set, STIMULUS, "stimulus", &words.stimulus)?;
        let mut expected = begin(set, EXPECTED, "expected answers", &words.expected)?;
        let mut control = begin(set, NEGATIVE_CONTROL, "expected answers, one of them wrong", &words.expected)?;
        let csv = Begun::new(set, TABLE)?;
        let in_table = |cause| OutputError::Write { path: set.directory().join(TABLE), cause };
        let mut table = TableWriter::new(self.design, csv.0).map_err(in_table)?;

        let datapath = self.design.datapath();
        let flip = self.flip();
        let mut wrong = flip.record(&words.expected, 0);
        let mut kinds = BTreeMap::new();
        for (index, sample) in (0..).zip(self.samples()) {
            let passage = datapath.passage(sample.case.address, sample.case.x);
            let address = i64::from(sample.case.address);
            stimulus.word(&words.stimulus, &words.stimulus.pack(&[address, sample.case.x]))?;
            let word = words.expected.pack(&answer(&passage));
            expected.word(&words.expected, &word)?;
            if index == flip.vector {
                wrong = flip.record(&words.expected, word);
                control.word(&words.expected, &flip.corrupt(word))?;
            } else {
                control.word(&words.expected, &word)?;
            }
            table.write(index, &sample, &passage).map_err(in_table)?;
            self.written(1);
            *kinds.entry(sample.kind).or_insert(0) += 1;
        }
        let csv = Begun(table.finish().map_err(in_table)?);
        let written = [(STIMULUS, stimulus), (EXPECTED, expected), (NEGATIVE_CONTROL, control), (TABLE, csv)];
        for (name, file) in written {
            files.insert(name.to_owned(), file.keep(set)?);
        }
        let kinds = kinds.into_iter().map(|(kind, count)| (kind.to_string(), count));
        Ok((kinds.collect(), wrong))
    }

    fn manifest(
        &self,
        words: Words,
        files: BTreeMap<String, Checksum>,
        kinds: BTreeMap<String, u64>,
        negative_control: NegativeControl,
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
            faults: self.stimulus.compact().map(FaultCounts::of),
            negative_control,
            hardware: Hardware::of(self.design.datapath()),
            words,
            files,
            configuration: self.design.config().clone(),
        }
    }
}

/// What the search found, in words.
fn found(compact: &Compact) -> [String; 2] {
    let FaultCounts { faults, equivalent, lower_bound, inputs } = FaultCounts::of(compact);
    let vectors = compact.samples().len();
    let names: Vec<String> = compact.equivalent().map(|fault| fault.to_string()).collect();
    let which = if names.is_empty() { String::new() } else { format!(": {}", names.join(", ")) };
    [
        format!(
            "{vectors} vectors kill {} of {faults} faults; no set of fewer than {lower_bound} does",
            faults - equivalent
        ),
        format!("{equivalent} are equivalent, no input of {inputs} tells them apart{which}"),
    ]
}

fn stage_faults(set: &mut OutputSet, compact: &Compact) -> Result<Checksum, OutputError> {
    let file = Begun::new(set, FAULTS)?;
    let in_faults = |cause| OutputError::Write { path: set.directory().join(FAULTS), cause };
    Begun(write_faults(file.0, compact.verdicts()).map_err(in_faults)?).keep(set)
}

/// Status and intensity of the last rank.
fn answer(passage: &[Signals]) -> [i64; 2] {
    passage.last().map_or([0; 2], |last| [last.status.bits().into(), last.intensity])
}

/// A file under way, whose errors say which file it is.
struct Begun(OutputFile);

impl Begun {
    fn new(set: &mut OutputSet, name: &str) -> Result<Self, OutputError> {
        set.file(name).map(Self)
    }

    fn header(&mut self, title: &str, layout: &WordLayout, words: u64, command: &str) -> Result<(), OutputError> {
        let header = Header { title, layout, words, command };
        write_header(&mut self.0, &header).map_err(|cause| self.0.error(cause))
    }

    fn word(&mut self, layout: &WordLayout, word: &impl std::fmt::LowerHex) -> Result<(), OutputError> {
        write_word(&mut self.0, layout, word).map_err(|cause| self.0.error(cause))
    }

    fn keep(self, set: &mut OutputSet) -> Result<Checksum, OutputError> {
        set.keep(self.0)
    }
}

/// The names of the files of a bundle.
pub fn names(strategy: Strategy) -> impl Iterator<Item = &'static str> {
    let faults = (strategy == Strategy::Compact).then_some(FAULTS);
    [ROM, STIMULUS, EXPECTED, NEGATIVE_CONTROL, TABLE, MANIFEST].into_iter().chain(faults)
}

/// The files that every bundle has, in `directory`, in the order in which they are written.
#[must_use]
pub fn file_paths(directory: &Path) -> [PathBuf; 6] {
    [ROM, STIMULUS, EXPECTED, NEGATIVE_CONTROL, TABLE, MANIFEST].map(|name| directory.join(name))
}
