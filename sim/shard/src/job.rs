//! A job: what is to be done, as its author writes it, and the same with everything in it that it depends on.

use std::path::{Path, PathBuf};

use analysis::error_report::Options;
use hw_model::config::{Config, ConfigError};
use hw_model::design::{Design, DesignError};
use hw_model::exponents::Exponents;
use hw_model::fit::{Levels, Method};
use hw_model::presets;
use serde::{Deserialize, Serialize};
use thiserror::Error;
use vectors::checksum::{Checksum, checksum};
use vectors::output_text::json;
use vectors::text_file::{self, CONFIGURATION, JOB, TextError};

/// The most runs of a program in one job, 2^16.
pub const MOST_RUNS: usize = 1 << 16;

/// What the field `format` of a job says.
pub const FORMAT: &str = "blysk job";
/// What its field `version` says.
pub const VERSION: u32 = 1;

/// What is to be done.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Job {
    format: String,
    version: u32,
    /// The kind of work with what it works on.
    pub work: Work,
}

/// The kinds of work that can be cut into shards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Work {
    /// `blysk report --exhaustive`.
    Errors(ErrorWork),
    /// `blysk certify`.
    Certify(CertifyWork),
    /// Every x of every exponent through the RTL, in Verilator.
    Rtl(RtlWork),
    /// Runs of a program of one's own.
    Program(ProgramWork),
}

/// The errors of a configuration over every representable x.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ErrorWork {
    /// The configuration whose errors are measured.
    pub configuration: Subject,
    /// The total error on the epicentre must not exceed this fraction of full intensity: above 0, at most 1.
    pub bound: f64,
}

/// The RTL of a configuration beside the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RtlWork {
    /// The configuration whose RTL is simulated.
    pub configuration: Subject,
    /// What was built of the RTL. A plan has it, and a job that is not planned yet has not.
    #[serde(default)]
    pub program: Option<Checksum>,
}

/// Runs of a program, each a piece of work. What the program prints must follow from its arguments alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProgramWork {
    /// The program, by its path from the directory of the job; in a plan, by its absolute path.
    pub path: PathBuf,
    /// What the program is known by. A plan has it, and a job that is not planned yet has not.
    #[serde(default)]
    pub digest: Option<Checksum>,
    /// The arguments of each run.
    pub runs: Vec<Vec<String>>,
}

/// What is certified, by the names that certificates have for it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CertifyWork {
    /// A configuration, over every representable x: `blysk certify --config`.
    Hardware(Subject),
    /// Methods at single exponents: `blysk certify --exponents`.
    Exponents {
        /// The methods, in the order of the certificate.
        methods: Vec<Method>,
        /// The exponents of every method.
        exponents: Exponents,
        /// The levels Q and G of the methods.
        #[serde(default)]
        levels: Levels,
    },
    /// Methods at every real exponent: `blysk certify --all-real-n`.
    EveryExponent {
        /// The methods, in the order of the certificate.
        methods: Vec<Method>,
        /// The levels Q and G of the methods.
        #[serde(default)]
        levels: Levels,
    },
}

/// A configuration, by one of three ways to say which.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Subject {
    /// A preset, by its name.
    Preset(String),
    /// A file, by its path from the directory of the job.
    File(PathBuf),
    /// The configuration itself: what plans have.
    Inline(Box<Config>),
}

/// Why a file is no job.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum JobError {
    /// The file cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The JSON is none, or has other fields.
    #[error("{}: {cause}; docs/scale/README.md has jobs to start from", path.display())]
    Json {
        /// The path of the job.
        path: PathBuf,
        /// What is wrong with the JSON, and where.
        cause: serde_json::Error,
    },
    /// The file is something else, or of another version.
    #[error(
        "{}: it says format {format:?}, version {version}; a job says {FORMAT:?}, version {VERSION}",
        path.display()
    )]
    Version {
        /// The path of the job.
        path: PathBuf,
        /// The format that it says.
        format: String,
        /// The version that it says.
        version: u32,
    },
    /// A configuration that a job names is none.
    #[error("{}: {cause}", path.display())]
    Configuration {
        /// The path of the configuration.
        path: PathBuf,
        /// What is wrong with the configuration.
        cause: ConfigError,
    },
    /// A preset that does not exist.
    #[error("the job's configuration: {0}")]
    NoPreset(DesignError),
    /// A value that is out of its range.
    #[error("the job's {field} is {value}; {wanted}")]
    Range {
        /// The way to the field.
        field: &'static str,
        /// What it says.
        value: String,
        /// What would be right.
        wanted: &'static str,
    },
}

/// What every job begins with.
#[derive(Deserialize)]
struct Header {
    format: String,
    version: u32,
}

impl Job {
    /// A job of this work.
    #[must_use]
    pub fn new(work: Work) -> Self {
        Self { format: FORMAT.to_owned(), version: VERSION, work }
    }

    /// Reads a job, and puts the configurations in it that it names: what comes back depends on no other file.
    ///
    /// # Errors
    /// When it is none, or names something that is not there.
    pub fn read(path: &Path) -> Result<Self, JobError> {
        let text = text_file::read(path, JOB)?;
        Self::parse(&text, path)?.resolved(path.parent().unwrap_or(Path::new("")))
    }

    /// Reads a job that names other files still; `path` is for messages.
    ///
    /// # Errors
    /// When the text is no job.
    pub fn parse(text: &str, path: &Path) -> Result<Self, JobError> {
        let at = |cause| JobError::Json { path: path.to_owned(), cause };
        let Header { format, version } = serde_json::from_str(text).map_err(at)?;
        if format != FORMAT || version != VERSION {
            return Err(JobError::Version { path: path.to_owned(), format, version });
        }
        let job: Self = serde_json::from_str(text).map_err(at)?;
        job.check()?;
        Ok(job)
    }

    /// Whether every value is in its range. (Configurations are checked when hardware is made of them.)
    ///
    /// # Errors
    /// When one is not.
    pub fn check(&self) -> Result<(), JobError> {
        match &self.work {
            Work::Errors(ErrorWork { bound, .. }) if !(*bound > 0.0 && *bound <= 1.0) => Err(JobError::Range {
                field: "errors.bound",
                value: bound.to_string(),
                wanted: "use a number above 0 and at most 1, such as 0.0067 for 0.67 %",
            }),
            Work::Certify(CertifyWork::Exponents { methods, .. } | CertifyWork::EveryExponent { methods, .. })
                if methods.is_empty() =>
            {
                Err(JobError::Range {
                    field: "certify.methods",
                    value: "an empty list".to_owned(),
                    wanted: "name at least one method, such as \"hermite\"",
                })
            }
            Work::Program(ProgramWork { runs, .. }) if !(1..=MOST_RUNS).contains(&runs.len()) => Err(JobError::Range {
                field: "program.runs",
                value: format!("a list of {}", runs.len()),
                wanted: "a job has 1 to 65536 runs",
            }),
            _ => Ok(()),
        }
    }

    fn resolved(mut self, directory: &Path) -> Result<Self, JobError> {
        match &mut self.work {
            Work::Errors(work) => work.configuration.resolve(directory)?,
            Work::Rtl(work) => work.configuration.resolve(directory)?,
            Work::Certify(CertifyWork::Hardware(subject)) => subject.resolve(directory)?,
            Work::Program(work) => {
                let path = directory.join(&work.path);
                work.path = std::path::absolute(&path).unwrap_or(path);
            }
            Work::Certify(_) => {}
        }
        Ok(self)
    }

    /// Where the digest of the program stands that the job runs; none where it runs none.
    pub(crate) fn program_mut(&mut self) -> Option<&mut Option<Checksum>> {
        match &mut self.work {
            Work::Rtl(work) => Some(&mut work.program),
            Work::Program(work) => Some(&mut work.digest),
            Work::Errors(_) | Work::Certify(_) => None,
        }
    }

    /// SHA-256 of everything that the job says: what results are known by.
    #[must_use]
    pub fn digest(&self) -> String {
        // Plain fields with string keys: serialising cannot fail, and reading from memory neither.
        let text = json(self).unwrap_or_default();
        checksum(text.as_bytes()).map_or_else(|_| String::new(), |sum| sum.sha256)
    }
}

impl ErrorWork {
    /// What the report is asked for.
    #[must_use]
    pub const fn options(&self) -> Options {
        Options { bound: self.bound, exhaustive: true }
    }
}

impl Subject {
    /// The hardware of a configuration that stands in the job.
    ///
    /// # Errors
    /// When there is none.
    pub fn design(&self) -> Result<Design, DesignError> {
        match self {
            Self::Inline(config) => Design::new((**config).clone()),
            Self::Preset(name) => Design::preset(name),
            Self::File(path) => Err(DesignError::NoPreset { name: path.display().to_string() }),
        }
    }

    /// Puts the configuration in the place of its name.
    fn resolve(&mut self, directory: &Path) -> Result<(), JobError> {
        let config = match self {
            Self::Inline(_) => return Ok(()),
            Self::Preset(name) => {
                let none = || JobError::NoPreset(DesignError::NoPreset { name: name.clone() });
                let preset = presets::find(name).ok_or_else(none)?;
                preset.config().map_err(|cause| JobError::Configuration { path: PathBuf::from(&*name), cause })?
            }
            Self::File(path) => {
                let path = directory.join(path);
                let text = text_file::read(&path, CONFIGURATION)?;
                Config::from_json(&text).map_err(|cause| JobError::Configuration { path, cause })?
            }
        };
        *self = Self::Inline(Box::new(config));
        Ok(())
    }
}
