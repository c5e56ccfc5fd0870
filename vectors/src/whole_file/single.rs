//! One file that appears whole.

use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::staging::{Draft, Staging};

/// One file that appears whole, or a stream.
#[derive(Debug)]
#[must_use = "a file that is not committed is thrown away"]
pub struct WholeFile {
    // Before the staging, so that an abandoned file is gone when its directories are removed.
    draft: Draft,
    staging: Staging,
}

impl WholeFile {
    /// Begins the file at `path`; its directory is made where it does not exist. `-` is standard output.
    ///
    /// # Errors
    /// As [`Staging::begin`].
    pub fn create(path: impl AsRef<Path>) -> Result<Self, OutputError> {
        Self::apart_from(&[], path)
    }

    /// The same, and refuses to write over these files, which are read.
    ///
    /// # Errors
    /// As [`Staging::begin`].
    pub fn apart_from(inputs: &[PathBuf], path: impl AsRef<Path>) -> Result<Self, OutputError> {
        let mut staging = Staging::apart_from(inputs);
        let draft = staging.begin(path.as_ref())?;
        Ok(Self { draft, staging })
    }

    /// Whether this goes to standard output, where nothing else can go then.
    #[must_use]
    pub fn is_standard_output(&self) -> bool {
        self.draft.is_standard_output()
    }

    /// An error of writing this file, with its path.
    #[must_use]
    pub fn error(&self, cause: io::Error) -> OutputError {
        self.draft.error(cause)
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// When the last of it cannot be written, or the rename fails.
    pub fn commit(mut self) -> Result<PathBuf, OutputError> {
        let path = self.draft.path().to_owned();
        self.staging.keep(self.draft)?;
        self.staging.commit()?;
        Ok(path)
    }

    /// Writes contents that are at hand, and gives the file its name.
    ///
    /// # Errors
    /// As [`commit`](Self::commit).
    pub fn fill(mut self, contents: impl AsRef<[u8]>) -> Result<PathBuf, OutputError> {
        self.draft.write_all(contents.as_ref()).map_err(|cause| self.draft.error(cause))?;
        self.commit()
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.draft.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.draft.flush()
    }
}

impl Seek for WholeFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.draft.seek(to)
    }
}
