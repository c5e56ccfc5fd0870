//! Why a shard cannot be planned, run or merged.

use std::path::PathBuf;

use analysis::report::FilesError;

use bounds::certify::hardware::HardwareError;
use bounds::certify::search::NotProved;
use bounds::seal::{BrokenSeal, Unreadable};
use hw_model::design::DesignError;
use hw_model::fit::FitError;
use thiserror::Error;
use vectors::OutputError;
use vectors::limits::TooManyInputs;
use vectors::text_file::TextError;

use crate::job::JobError;
use crate::refused::Refused;
use crate::rtl::RtlError;

/// Why a shard cannot be planned, run or merged.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ShardError {
    /// The job is none.
    #[error(transparent)]
    Job(#[from] JobError),
    /// A file cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A file of the merged report cannot be made.
    #[error(transparent)]
    Files(#[from] FilesError),
    /// No hardware can be made of the job's configuration.
    #[error("the job's configuration: {0}")]
    Design(#[from] DesignError),
    /// A method has no epicentre for one of the exponents.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// There can be no certificate of the configuration.
    #[error(transparent)]
    Hardware(#[from] HardwareError),
    /// The error of a method could not be enclosed.
    #[error("{what}: {cause}")]
    NotProved {
        /// The method with its exponent and region.
        what: String,
        /// Why there is no proof.
        cause: NotProved,
    },
    /// RTL cannot be built, or does not answer.
    #[error(transparent)]
    Rtl(#[from] RtlError),
    /// A job that runs a program whose digest it does not name.
    #[error("the job names no digest of its program; `blysk shard plan` adds it")]
    NotBuilt,
    /// A program that is not the one of the plan.
    #[error("{} is not the program of the plan, with SHA-256 {wanted}; plan again", path.display())]
    OtherProgram {
        /// The path of the program.
        path: PathBuf,
        /// The digest that the plan names.
        wanted: String,
    },
    /// A run of a program that has no result.
    #[error("{} {arguments} {what}", path.display())]
    Program {
        /// The path of the program.
        path: PathBuf,
        /// The arguments of the run.
        arguments: String,
        /// What went wrong.
        what: String,
    },
    /// A shard would have more inputs than one run goes through.
    #[error(transparent)]
    TooMany(#[from] TooManyInputs),
    /// The number of shards does not fit the job.
    #[error("--shards {shards}: use 1 to {most}; the job has {pieces} pieces, and a shard has at least one")]
    Shards {
        /// The number that was asked for.
        shards: u32,
        /// The most that the job takes.
        most: u64,
        /// The pieces of the job.
        pieces: u64,
    },
    /// The job has more pieces than can be planned.
    #[error(
        "the job has {pieces} pieces, and at most {most} are planned; use fewer exponents or a narrower input format"
    )]
    Pieces {
        /// The pieces of the job.
        pieces: u64,
        /// The most that are planned.
        most: u64,
    },
    /// There is no shard of this number.
    #[error("--index {index}: the plan has shards 0 to {last}")]
    Index {
        /// The number that was asked for.
        index: u32,
        /// The last shard of the plan.
        last: u32,
    },
    /// The directory has a plan of something else.
    #[error(
        "{} is the plan of another job, or of another number of shards; give --out another directory",
        .0.display()
    )]
    OtherPlan(PathBuf),
    /// A file is no plan.
    #[error("{}: {cause}", path.display())]
    Unreadable {
        /// The path of the file.
        path: PathBuf,
        /// What is wrong with the file.
        cause: Unreadable,
    },
    /// A plan is not as it was written.
    #[error("{}: {cause}; write the plan again", path.display())]
    BrokenSeal {
        /// The path of the plan.
        path: PathBuf,
        /// What is wrong with its seal.
        cause: BrokenSeal,
    },
    /// A plan does not say what follows from its job.
    #[error("{}: {what}; write the plan again", path.display())]
    WrongPlan {
        /// The path of the plan.
        path: PathBuf,
        /// What the plan says, and what it should.
        what: String,
    },
    /// The results of a plan cannot be merged.
    #[error(transparent)]
    Refused(#[from] Refused),
    /// A directory or a checkpoint cannot be used.
    #[error("{}: {cause}", path.display())]
    Io {
        /// The path.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// A result has parts of another kind of work: a mistake of the program, not of its user.
    #[error("the parts of the results are not of the kind of the job")]
    Kind,
}
