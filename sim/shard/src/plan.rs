//! A plan: a job with everything that it depends on, and how many shards it is cut into.

use std::ops::Range;

use bounds::seal::{self, Sealed};
use serde::{Deserialize, Serialize};
use vectors::WholeFile;
use vectors::checksum::Checksum;
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
        Ok(Self::made_ready(job, shards, place)?.0)
    }

    /// The same with its kind of work made ready.
    fn made_ready(job: Job, shards: u32, place: Place<'_>) -> Result<(Self, Box<dyn Kind>), ShardError> {
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
        let plan = seal::seal(Self {
            format: Self::FORMAT.to_owned(),
            version: Self::VERSION,
            blysk: VERSION.to_owned(),
            digest: job.digest(),
            pieces,
            shards,
            job,
            sha256: String::new(),
        });
        Ok((plan, kind))
    }

    /// Adds what a job needs before it is planned: the digest of its program, and for RTL what Verilator builds of it.
    /// That the job can be cut into so many shards is looked at before anything is built. A directory that has a plan
    /// has the program already.
    ///
    /// # Errors
    /// As [`new`](Self::new), and when the program cannot be built.
    pub fn prepare(job: &mut Job, shards: u32, place: Place<'_>) -> Result<(), ShardError> {
        let Some(named) = job.program_mut() else { return Ok(()) };
        *named = Some(Checksum { bytes: 0, sha256: String::new() });
        Self::new(job.clone(), shards, place)?;
        let found = match &job.work {
            Work::Rtl(work) => {
                if !place.plan().exists() {
                    rtl::emit(&work.configuration.design()?, &place.rtl(), Self::WRITER)?;
                    rtl::build(&place.rtl())?;
                }
                kinds::digest(&place.program())?
            }
            Work::Program(work) => kinds::digest(&work.path)?,
            Work::Errors(_) | Work::Certify(_) => return Ok(()),
        };
        if let Some(named) = job.program_mut() {
            *named = Some(found);
        }
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
        let (own, kind) = Self::made_ready(plan.job.clone(), plan.shards, place)?;
        if own != plan {
            return Err(wrong("its digest or its number of pieces is not that of its job".to_owned()));
        }
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
