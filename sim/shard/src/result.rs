//! Files of results: what a shard found, and how far a shard has come.

use std::ops::Range;
use std::path::Path;

use bounds::seal::{self, Sealed};
use serde::{Deserialize, Serialize};
use vectors::text_file::{self, SHARD_RESULT};

use crate::kind::Kind;
use crate::part::Part;
use crate::plan::{Plan, VERSION};

/// What was found in consecutive pieces of a job. A result has all pieces of its shard, a checkpoint the first of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Found {
    format: String,
    version: u32,
    /// The version of the program that found it.
    blysk: String,
    /// SHA-256 of the job.
    job: String,
    /// The number of the first piece.
    first: u64,
    /// The number of the piece after the last.
    end: u64,
    /// What was found, in the order of the pieces.
    parts: Vec<Part>,
    /// SHA-256 of the file with this field empty.
    sha256: String,
}

impl Sealed for Found {
    const FORMAT: &'static str = "blysk shard result";
    const VERSION: u32 = 1;
    const WRITER: &'static str = "blysk shard run";
    const NOUN: &'static str = "result";

    fn sha256(&self) -> &str {
        &self.sha256
    }
    fn sha256_mut(&mut self) -> &mut String {
        &mut self.sha256
    }
}

impl Found {
    /// What was found in these pieces of the plan's job.
    #[must_use]
    pub fn new(plan: &Plan, pieces: Range<u64>, parts: Vec<Part>) -> Self {
        seal::seal(Self {
            format: Self::FORMAT.to_owned(),
            version: Self::VERSION,
            blysk: VERSION.to_owned(),
            job: plan.digest().to_owned(),
            first: pieces.start,
            end: pieces.end,
            parts,
            sha256: String::new(),
        })
    }

    /// The pieces that it is about.
    #[must_use]
    pub const fn pieces(&self) -> Range<u64> {
        self.first..self.end
    }

    /// What was found.
    #[must_use]
    pub fn into_parts(self) -> Vec<Part> {
        self.parts
    }

    /// As it stands in a file.
    #[must_use]
    pub fn to_json(&self) -> String {
        seal::to_json(self)
    }

    /// Reads a result that may be believed: as this version of the program writes it, and about this plan's job.
    ///
    /// # Errors
    /// The reason why it is not believed; none where there is no such file.
    pub fn read(path: &Path, plan: &Plan, kind: &dyn Kind) -> Result<Self, Option<String>> {
        let text = text_file::read(path, SHARD_RESULT)
            .map_err(|error| if error.is_missing() { None } else { Some(error.to_string()) })?;
        Self::parse(&text, plan, kind).map_err(|why| Some(format!("{}: {why}", path.display())))
    }

    /// The same from a text.
    ///
    /// # Errors
    /// The reason why it is not believed.
    pub fn parse(text: &str, plan: &Plan, kind: &dyn Kind) -> Result<Self, String> {
        let found: Self = seal::parse(text).map_err(|error| error.to_string())?;
        seal::check(&found, text).map_err(|error| error.to_string())?;
        if found.blysk != VERSION {
            return Err(format!("it is of version {} of blysk, and this is version {VERSION}", found.blysk));
        }
        if found.job != plan.digest() {
            return Err(format!("it is of another job, with digest {}; the plan's is {}", found.job, plan.digest()));
        }
        let pieces = kind.pieces();
        if found.first >= found.end || found.end > pieces {
            return Err(format!("pieces {} to {}: the job has pieces 0 to {pieces}", found.first, found.end));
        }
        kind.check(&found.pieces(), &found.parts)?;
        Ok(found)
    }
}
