//! Fuzz targets: every reader of the project, fed with altered files.
//!
//! A target is a function over bytes ([`Target::run`]). It reads them as the command would, and uses what was read for
//! a step: a configuration becomes hardware, a scene is bounded, a log is judged. It must not panic, take more than
//! [`SLOWEST`], or hold more than [`MOST_MEMORY`]; and a certificate that is accepted must be true by other means.
//!
//! Inputs come from a corpus (`tests/fuzz/corpus/<target>/`), altered by a seed ([`mutate`]): bits and bytes, lines and
//! tokens, nodes of JSON. There is no guidance by coverage: the project builds with a stable compiler alone.

mod archive;
pub mod campaign;
mod certificates;
mod files;
mod models;
pub mod mutate;
mod place;
mod readers;
pub mod run;
mod shards;

use std::fs;
use std::path::PathBuf;
use std::time::Duration;

use mutate::Form;
pub use place::{Place, overwrite};

/// No run may take longer.
pub const SLOWEST: Duration = Duration::from_secs(10);

/// No run may hold more memory, in bytes.
pub const MOST_MEMORY: usize = 1 << 30;

/// What a reader made of its input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It was read, and used.
    Accepted,
    /// It was refused with an error.
    Refused,
}

impl Outcome {
    fn of<T, E>(result: &Result<T, E>) -> Self {
        if result.is_ok() { Self::Accepted } else { Self::Refused }
    }
}

/// A reader, with what is done with what it reads.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// Its name, and that of its corpus.
    pub name: &'static str,
    /// What its inputs look like.
    pub form: Form,
    /// Reads an input, uses what was read, and tells whether it was accepted.
    pub run: fn(&[u8], &Place) -> Outcome,
}

const fn target(name: &'static str, form: Form, run: fn(&[u8], &Place) -> Outcome) -> Target {
    Target { name, form, run }
}

/// Every target, in the order of the tables.
pub const TARGETS: [Target; 18] = [
    target("configuration", Form::Json, readers::configuration),
    target("exponents", Form::Lines, readers::exponents),
    target("scene", Form::Json, readers::scene),
    target("obj", Form::Lines, readers::obj),
    target("mtl", Form::Lines, models::mtl),
    target("gltf", Form::Json, models::gltf),
    target("pareto", Form::Lines, readers::pareto),
    target("stimulus", Form::Lines, files::stimulus),
    target("answers", Form::Lines, files::answers),
    target("registers", Form::Lines, files::registers),
    target("memory", Form::Lines, files::memory),
    target("manifest", Form::Json, files::manifest),
    target("bundle", Form::Archive, files::bundle),
    target("certificate", Form::Json, certificates::certify),
    target("specialised", Form::Json, certificates::specialised),
    target("job", Form::Json, shards::job),
    target("plan", Form::Json, shards::plan),
    target("result", Form::Json, shards::result),
];

impl Target {
    /// The target of this name.
    #[must_use]
    pub fn find(name: &str) -> Option<Self> {
        TARGETS.into_iter().find(|target| target.name == name)
    }

    /// Where its corpus is.
    #[must_use]
    pub fn corpus_directory(&self) -> PathBuf {
        [env!("CARGO_MANIFEST_DIR"), "fuzz", "corpus", self.name].iter().collect()
    }

    /// The files of its corpus, in the order of their names.
    ///
    /// # Panics
    /// When there is none, or one cannot be read.
    #[must_use]
    pub fn corpus(&self) -> Vec<Vec<u8>> {
        let directory = self.corpus_directory();
        let entries = fs::read_dir(&directory).unwrap_or_else(|error| panic!("{directory:?}: {error}"));
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry of the corpus").path()).collect();
        paths.sort();
        assert!(!paths.is_empty(), "{directory:?} is empty");
        paths.iter().map(|path| fs::read(path).expect("a file of the corpus")).collect()
    }
}
