//! What the requests share.

use std::path::PathBuf;
use std::time::Duration;

use tempfile::TempDir;
use vectors::limits::{SERVED_SECONDS, SERVED_WAITING};

use crate::configuration::Configuration;
use crate::known::Cache;
use crate::pool::Pool;
use crate::sessions::Sessions;

/// The configuration that the page opens with.
#[derive(Debug, Clone)]
pub enum Start {
    /// A preset, by its name.
    Preset(String),
    /// The text of a configuration file.
    Text(String),
}

impl From<Start> for Configuration {
    fn from(start: Start) -> Self {
        match start {
            Start::Preset(name) => Self::Preset(name),
            Start::Text(text) => Self::Text(text),
        }
    }
}

/// How much is done at the same time, and for how long.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// Requests that are worked on at the same time, 1 or more.
    pub workers: usize,
    /// Requests that may wait for a worker; the next one is refused.
    pub waiting: usize,
    /// How long an answer is waited for.
    pub deadline: Duration,
}

impl Default for Limits {
    /// As many workers as the machine has cores, 2 at least: one long request then leaves the page alive.
    fn default() -> Self {
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        Self { workers: cores.max(2), waiting: SERVED_WAITING, deadline: Duration::from_secs(SERVED_SECONDS) }
    }
}

/// What the requests share.
#[derive(Debug)]
pub(crate) struct App {
    /// What the page opens with.
    pub(crate) start: Configuration,
    /// Designs that were asked about.
    pub(crate) cache: Cache,
    /// Pipelines that are clocked by hand.
    pub(crate) sessions: Sessions,
    /// Who works.
    pub(crate) pool: Pool,
    /// Where sets of files are made before they are put into an archive. It goes with the server.
    directory: TempDir,
}

impl App {
    /// Nothing has been asked yet.
    pub(crate) fn new(start: Start, limits: Limits) -> std::io::Result<Self> {
        Ok(Self {
            start: start.into(),
            cache: Cache::default(),
            sessions: Sessions::default(),
            pool: Pool::new(limits.workers.max(1), limits.waiting, limits.deadline),
            directory: tempfile::Builder::new().prefix("blysk-serve-").tempdir()?,
        })
    }

    /// The directory of the server's own files.
    pub(crate) fn directory(&self) -> PathBuf {
        self.directory.path().to_owned()
    }
}
