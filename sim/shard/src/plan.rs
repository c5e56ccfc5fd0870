//! A plan: a job with everything that it depends on, and how many shards it is cut into.

use std::ops::Range;

use bounds::seal::{self, Sealed};
use serde::{Deserialize, Serialize};
use vectors::WholeFile;
use vectors::limits::{MOST_PIECES, MOST_SHARDS};
use vectors::text_file::{self, SHARD_PLAN};

use crate::error::ShardError;
use crate::job::{Job, Work};
use crate::kind::Kind;
use crate::kinds;
use crate::place::Place;
use crate::rtl;

/// The version of this program, which plans and results name.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A job and its number of shards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    format: String,
    version: u32,
    /// The version of the program that planned.
    blysk: String,
    /// SHA-256 of the job below.
    digest: String,
    /// The pieces of the job.
    pieces: u64,
    /// The shards that the pieces are handed out to.
    shards: u32,
    job: Job,
    /// SHA-256 of the file with this field empty.
    sha256: String,
}

impl Sealed for Plan {
    const FORMAT: &'static str = "blysk shard plan";
    const VERSION: u32 = 1;
    const WRITER: &'static str = "blysk shard plan";
    const NOUN: &'static str = "plan";

    fn sha256(&self) -> &str {
        &self.sha256
    }
    fn sha256_mut(&mut self) -> &mut String {
        &mut self.sha256
    }
}

impl Plan {
    /// Cuts a job, whose configurations stand in it, into shards.
    ///
    /// # Errors
    /// When the job cannot be done, or not in so many shards.
    pub fn new(job: Job, shards: u32, place: Place<'_>) -> Result<Self, ShardError> {
        let kind = kinds::of(&job, place)?;
        let pieces = kind.pieces();
        if pieces > MOST_PIECES {
            return Err(ShardError::Pieces { pieces, most: MOST_PIECES });
        }
        let most = pieces.min(MOST_SHARDS.into());
        if shards == 0 || u64::from(shards) > most {
            return Err(ShardError::Shards { shards, most, pieces });
        }
        kind.fits(pieces.div_ceil(shards.into()))?;
        Ok(seal::seal(Self {
            format: Self::FORMAT.to_owned(),
            version: Self::VERSION,
            blysk: VERSION.to_owned(),
            digest: job.digest(),
            pieces,
            shards,
            job,
            sha256: String::new(),
        }))
    }

    /// What a job needs to be built before it is planned: RTL, by Verilator. A directory that has a plan has it already.
    ///
    /// # Errors
    /// When it cannot be built.
    pub fn prepare(job: &mut Job, place: Place<'_>) -> Result<(), ShardError> {
        let Work::Rtl(work) = &mut job.work else { return Ok(()) };
        if !place.plan().exists() {
            let design = work.configuration.design()?;
            rtl::emit(&design, &place.rtl(), "blysk shard plan")?;
            rtl::build(&place.rtl())?;
        }
        work.program = Some(kinds::digest(&place.program())?);
        Ok(())
    }

    /// Reads the plan of a directory, with its kind of work made ready.
    ///
    /// # Errors
    /// When there is none, or it is not what follows from its job.
    pub fn read(place: Place<'_>) -> Result<(Self, Box<dyn Kind>), ShardError> {
        let path = place.plan();
        let text = text_file::read(&path, SHARD_PLAN)?;
        Self::parse(&text, place)
    }

    /// The same from a text.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, place: Place<'_>) -> Result<(Self, Box<dyn Kind>), ShardError> {
        let path = place.plan();
        let wrong = |what: String| ShardError::WrongPlan { path: path.clone(), what };
        let plan: Self = seal::parse(text).map_err(|cause| ShardError::Unreadable { path: path.clone(), cause })?;
        seal::check(&plan, text).map_err(|cause| ShardError::BrokenSeal { path: path.clone(), cause })?;
        if plan.blysk != VERSION {
            return Err(wrong(format!("it is of version {} of blysk, and this is version {VERSION}", plan.blysk)));
        }
        plan.job.check()?;
        if Self::new(plan.job.clone(), plan.shards, place)? != plan {
            return Err(wrong("its digest or its number of pieces is not that of its job".to_owned()));
        }
        let kind = kinds::of(&plan.job, place)?;
        Ok((plan, kind))
    }

    /// Writes the plan to a directory. A directory that has this plan already stays as it is.
    ///
    /// # Errors
    /// When the directory has another plan, or cannot be written to.
    pub fn write(&self, place: Place<'_>) -> Result<(), ShardError> {
        let (path, text) = (place.plan(), seal::to_json(self));
        match text_file::read(&path, SHARD_PLAN) {
            Ok(there) if there == text => Ok(()),
            Err(error) if error.is_missing() => {
                WholeFile::create(&path)?.fill(text)?;
                Ok(())
            }
            _ => Err(ShardError::OtherPlan(path)),
        }
    }

    /// SHA-256 of the job.
    #[must_use]
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// The number of pieces of the job.
    #[must_use]
    pub const fn pieces(&self) -> u64 {
        self.pieces
    }

    /// The number of shards.
    #[must_use]
    pub const fn shards(&self) -> u32 {
        self.shards
    }

    /// The job.
    #[must_use]
    pub const fn job(&self) -> &Job {
        &self.job
    }

    /// The pieces of a shard: as many as of any other, or one more.
    ///
    /// # Errors
    /// When there is no shard of this number.
    pub fn pieces_of(&self, index: u32) -> Result<Range<u64>, ShardError> {
        if index >= self.shards {
            return Err(ShardError::Index { index, last: self.shards - 1 });
        }
        let begin = |index: u64| self.pieces * index / u64::from(self.shards);
        Ok(begin(index.into())..begin(u64::from(index) + 1))
    }

    /// The shards that have any of these pieces.
    #[must_use]
    pub fn shards_of(&self, pieces: &Range<u64>) -> Vec<u32> {
        let meets = |index: &u32| {
            let own = self.pieces_of(*index).unwrap_or_default();
            own.start < pieces.end && pieces.start < own.end
        };
        (0..self.shards).filter(meets).collect()
    }
}
