//! The files that one command writes into a directory.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::list::{line, list_name};
use super::staging::{Draft, Staging};
use super::temporary::parent;
use crate::checksum::{Checked, Checksum};

/// A file of a set, under way. What is written to it has no name until its set is committed.
#[derive(Debug)]
#[must_use = "a file that is not kept is thrown away"]
pub struct OutputFile {
    /// The path from the set's directory, with `/`.
    name: String,
    draft: Checked<Draft>,
}

impl OutputFile {
    /// The path the file will have.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.draft.get_ref().path()
    }

    /// An error of writing this file, with its path.
    #[must_use]
    pub fn error(&self, cause: io::Error) -> OutputError {
        self.draft.get_ref().error(cause)
    }
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.draft.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.draft.flush()
    }
}

/// Files of one directory that appear together.
#[derive(Debug)]
pub struct OutputSet {
    directory: PathBuf,
    /// The sub-directory that files are begun in, with a `/` at its end; empty for none.
    below: String,
    list: Option<OutputFile>,
    /// Name and SHA-256 of every kept file.
    sums: BTreeMap<String, String>,
    staging: Staging,
}

impl OutputSet {
    /// A set of files in `directory`, which appears, with the directories above it, where it does not exist.
    ///
    /// # Errors
    /// When the directory cannot be made or written to, or is not one.
    pub fn create(directory: impl AsRef<Path>) -> Result<Self, OutputError> {
        Self::apart_from(&[], directory)
    }

    /// The same, and refuses to write over these files, which are read.
    ///
    /// # Errors
    /// As [`create`](Self::create).
    pub fn apart_from(inputs: &[PathBuf], directory: impl AsRef<Path>) -> Result<Self, OutputError> {
        let directory = match directory.as_ref() {
            path if path.as_os_str().is_empty() => PathBuf::from("."),
            path => path.to_owned(),
        };
        let mut staging = Staging::apart_from(inputs);
        staging.prepare(&directory)?;
        Ok(Self { directory, below: String::new(), list: None, sums: BTreeMap::new(), staging })
    }

    /// Has the set listed: the command's list gets the SHA-256 of each file, and its name last.
    ///
    /// # Errors
    /// As [`file`](Self::file).
    pub fn listed(mut self, command: &str) -> Result<Self, OutputError> {
        self.list = Some(self.file(&list_name(command))?);
        Ok(self)
    }

    /// Says that files of these names will be written, so that what is in their way is found before the work.
    ///
    /// # Errors
    /// When something that is not a regular file has such a name, or an input, or a directory cannot be written to.
    pub fn announce<N: AsRef<str>>(mut self, names: impl IntoIterator<Item = N>) -> Result<Self, OutputError> {
        let mut directories = BTreeSet::from([self.directory.clone()]);
        for name in names {
            let path = self.directory.join(name.as_ref());
            self.staging.look(&path)?;
            let directory = parent(&path);
            if directories.insert(directory.to_owned()) {
                self.staging.prepare(directory)?;
            }
        }
        Ok(self)
    }

    /// The directory that files are begun in.
    #[must_use]
    pub fn directory(&self) -> PathBuf {
        if self.below.is_empty() { self.directory.clone() } else { self.directory.join(&self.below) }
    }

    /// Lets `stage` write its files into a sub-directory.
    ///
    /// # Errors
    /// Those of `stage`.
    pub fn within<T, E>(&mut self, name: &str, stage: impl FnOnce(&mut Self) -> Result<T, E>) -> Result<T, E> {
        let above = self.below.len();
        self.below += name;
        self.below.push('/');
        let staged = stage(self);
        self.below.truncate(above);
        staged
    }

    /// Begins a file, to be handed back to [`keep`](Self::keep). Several may be under way.
    ///
    /// # Errors
    /// When the directory cannot be written to, `name` is no plain file name, or something that is
    /// not a regular file has that name.
    pub fn file(&mut self, name: &str) -> Result<OutputFile, OutputError> {
        let target = self.directory().join(name);
        if Path::new(name).file_name() != Some(name.as_ref()) {
            return Err(OutputError::NoName(target));
        }
        let draft = Checked::new(self.staging.begin_file(&target)?);
        Ok(OutputFile { name: format!("{}{name}", self.below), draft })
    }

    /// Takes a written file into the set, and says what its contents are.
    ///
    /// # Errors
    /// When the last of it cannot be written.
    pub fn keep(&mut self, file: OutputFile) -> Result<Checksum, OutputError> {
        self.keep_as(file, false)
    }

    fn keep_as(&mut self, file: OutputFile, seal: bool) -> Result<Checksum, OutputError> {
        let (draft, checksum) = file.draft.finish();
        self.staging.keep_as(draft, seal)?;
        self.sums.insert(file.name, checksum.sha256.clone());
        Ok(checksum)
    }

    /// Writes a file whose contents are at hand.
    ///
    /// # Errors
    /// As [`file`](Self::file) and [`keep`](Self::keep).
    pub fn write(&mut self, name: &str, contents: impl AsRef<[u8]>) -> Result<(), OutputError> {
        let file = self.filled(name, contents.as_ref())?;
        self.keep(file).map(drop)
    }

    /// The same for a file that vouches for others: at no time does it stand beside files of another set.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub fn seal(&mut self, name: &str, contents: impl AsRef<[u8]>) -> Result<(), OutputError> {
        let file = self.filled(name, contents.as_ref())?;
        self.keep_as(file, true).map(drop)
    }

    fn filled(&mut self, name: &str, contents: &[u8]) -> Result<OutputFile, OutputError> {
        let mut file = self.file(name)?;
        file.write_all(contents).map_err(|cause| file.error(cause))?;
        Ok(file)
    }

    /// Says that a file of this name, left by an earlier run, would no longer belong to the others: unless
    /// the set has it too, [`commit`](Self::commit) removes it.
    pub fn obsolete(&mut self, name: &str) {
        self.staging.obsolete(self.directory().join(name));
    }

    /// Gives every kept file its name, and returns their paths, in the order of keeping. Files of
    /// the same names are replaced.
    ///
    /// # Errors
    /// When a file was begun and not kept, or a step fails: nothing is written then, and what was there is as it was.
    pub fn commit(mut self) -> Result<Vec<PathBuf>, OutputError> {
        if let Some(mut list) = self.list.take() {
            let text: String = self.sums.iter().map(|(name, sha256)| line(name, sha256)).collect();
            list.write_all(text.as_bytes()).map_err(|cause| list.error(cause))?;
            self.keep_as(list, true)?;
        }
        self.staging.commit()
    }
}
