//! Files that are written whole or not at all.
//!
//! Everything goes to hidden temporary files in the directory of the destination (the same file
//! system, so that a rename is atomic) and gets its name only in [`OutputSet::commit`]. Until then
//! an error, an early return or a panic leaves nothing behind: the temporary files go, and so do
//! the directories that were made for them.
//!
//! Each rename is atomic, the sequence of them is not. Files get their names in the order in which
//! they were kept, so the file that vouches for the others (the manifest) belongs last.

use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, TempPath};
use thiserror::Error;

/// Temporary files are hidden, and say whose they are should a power cut leave one behind.
const TEMPORARY_PREFIX: &str = ".blysk-";

/// Large enough that a write is rarely a system call.
const BUFFER_BYTES: usize = 1 << 16;

/// Why nothing was written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The directory could not be made, or is something else.
    #[error("cannot use the directory {}: {cause}; {}", path.display(), advice(cause))]
    Directory {
        /// The directory.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// A file could not be written.
    #[error("cannot write {}: {cause}; {}", path.display(), advice(cause))]
    Write {
        /// The file, under the name it would have had.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// The destination is a directory or a device, which a rename must not replace.
    #[error("{} is not a regular file; give the path of a file", .0.display())]
    NotAFile(PathBuf),
    /// The path has no file name, or the name of a file in a set has directories in it.
    #[error("{} is not the name of a file; give a path that ends in one", .0.display())]
    NoName(PathBuf),
    /// A file of the set was begun and not kept: a mistake of the program, not of its user.
    #[error("{} was begun but not finished, so nothing was written", .0.display())]
    Unfinished(PathBuf),
}

fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "choose a place that you may write to"
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "free some space or choose another place"
        }
        ErrorKind::NotADirectory | ErrorKind::AlreadyExists => {
            "a file is in the way: choose another name or move it"
        }
        _ => "check the path and the disc behind it",
    }
}

/// A file under way. What is written to it has no name until its set is committed.
#[derive(Debug)]
#[must_use = "a file that is not kept is thrown away"]
pub struct OutputFile {
    target: PathBuf,
    writer: BufWriter<File>,
    temporary: TempPath,
}

impl OutputFile {
    fn create(directory: &Path, target: PathBuf) -> Result<Self, OutputError> {
        // Following links: a link to a device is a device.
        if fs::metadata(&target).is_ok_and(|found| !found.is_file()) {
            return Err(OutputError::NotAFile(target));
        }
        let mut builder = Builder::new();
        builder.prefix(TEMPORARY_PREFIX);
        if let Some(permissions) = usual_permissions() {
            builder.permissions(permissions);
        }
        match builder.tempfile_in(directory) {
            Ok(file) => {
                let (file, temporary) = file.into_parts();
                let writer = BufWriter::with_capacity(BUFFER_BYTES, file);
                Ok(Self { target, writer, temporary })
            }
            // Its text names the temporary file, by a name that is another one each time.
            Err(error) => Err(OutputError::Write { path: target, cause: error.kind().into() }),
        }
    }

    /// The path the file will have.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.target
    }

    /// An error of writing this file, with its path.
    #[must_use]
    pub fn error(&self, cause: io::Error) -> OutputError {
        OutputError::Write { path: self.target.clone(), cause }
    }

    /// Everything to the disc: a full disc shows here at the latest.
    fn finish(self) -> Result<Finished, OutputError> {
        let Self { target, writer, temporary } = self;
        let written = writer.into_inner().map_err(io::IntoInnerError::into_error);
        match written.and_then(|file| file.sync_all()) {
            Ok(()) => Ok(Finished { target, temporary }),
            Err(cause) => Err(OutputError::Write { path: target, cause }),
        }
    }
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// For formats whose header is filled in last.
impl Seek for OutputFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.writer.seek(to)
    }
}

/// What a file gets from `open` usually; the process's umask takes its share. (A temporary file is
/// otherwise its owner's alone, and a colleague could not read the vectors.)
#[cfg(unix)]
fn usual_permissions() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
const fn usual_permissions() -> Option<Permissions> {
    None
}

#[derive(Debug)]
struct Finished {
    target: PathBuf,
    temporary: TempPath,
}

/// Files of one directory that appear together.
#[derive(Debug)]
pub struct OutputSet {
    directory: PathBuf,
    /// Directories made for this set, outermost first.
    created: Vec<PathBuf>,
    begun: Vec<PathBuf>,
    finished: Vec<Finished>,
    obsolete: Vec<PathBuf>,
}

impl OutputSet {
    /// A set of files in `directory`, which is made, with the directories above it, where it does
    /// not exist.
    ///
    /// # Errors
    /// When the directory cannot be made or is not one.
    pub fn create(directory: impl AsRef<Path>) -> Result<Self, OutputError> {
        let directory = match directory.as_ref() {
            path if path.as_os_str().is_empty() => PathBuf::from("."),
            path => path.to_owned(),
        };
        let mut set = Self {
            directory: directory.clone(),
            created: Vec::new(),
            begun: Vec::new(),
            finished: Vec::new(),
            obsolete: Vec::new(),
        };
        let mut missing: Vec<&Path> = directory
            .ancestors()
            .filter(|path| !path.as_os_str().is_empty())
            .take_while(|path| !path.exists())
            .collect();
        while let Some(path) = missing.pop() {
            match fs::create_dir(path) {
                Ok(()) => set.created.push(path.to_owned()),
                // Somebody else was faster: as good, but not ours to remove.
                Err(error) if error.kind() == ErrorKind::AlreadyExists && path.is_dir() => {}
                Err(cause) => {
                    return Err(OutputError::Directory { path: directory, cause });
                }
            }
        }
        if !directory.is_dir() {
            let cause = ErrorKind::NotADirectory.into();
            return Err(OutputError::Directory { path: directory, cause });
        }
        Ok(set)
    }

    /// The directory of the set.
    #[must_use]
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// Begins a file, to be handed back to [`keep`](Self::keep). Several may be under way.
    ///
    /// # Errors
    /// When the directory cannot be written to, `name` is no plain file name, or something that is
    /// not a regular file has that name.
    pub fn file(&mut self, name: &str) -> Result<OutputFile, OutputError> {
        let target = self.directory.join(name);
        if Path::new(name).file_name() != Some(name.as_ref()) {
            return Err(OutputError::NoName(target));
        }
        let file = OutputFile::create(&self.directory, target.clone())?;
        self.begun.push(target);
        Ok(file)
    }

    /// Takes a written file into the set.
    ///
    /// # Errors
    /// When the last of it cannot be written.
    pub fn keep(&mut self, file: OutputFile) -> Result<(), OutputError> {
        self.finished.push(file.finish()?);
        Ok(())
    }

    /// Writes a file whose contents are at hand.
    ///
    /// # Errors
    /// As [`file`](Self::file) and [`keep`](Self::keep).
    pub fn write(&mut self, name: &str, contents: impl AsRef<[u8]>) -> Result<(), OutputError> {
        let mut file = self.file(name)?;
        file.write_all(contents.as_ref()).map_err(|cause| file.error(cause))?;
        self.keep(file)
    }

    /// Says that a file of this name, left by an earlier run, would no longer belong to the others: unless
    /// the set has it too, [`commit`](Self::commit) removes it.
    pub fn obsolete(&mut self, name: &str) {
        self.obsolete.push(self.directory.join(name));
    }

    /// Gives every kept file its name, in the order of keeping, and returns their paths. Files of
    /// the same names are replaced.
    ///
    /// # Errors
    /// When a file was begun and not kept (nothing is written then), or a rename fails (the files
    /// before it have their names then).
    pub fn commit(mut self) -> Result<Vec<PathBuf>, OutputError> {
        let kept = |path: &PathBuf| self.finished.iter().any(|file| file.target == *path);
        if let Some(path) = self.begun.iter().find(|path| !kept(path)) {
            return Err(OutputError::Unfinished(path.clone()));
        }
        for path in &self.obsolete {
            // Before the others get their names: what is left between is a file too few, not a wrong one.
            if !kept(path) && path.is_file() {
                fs::remove_file(path)
                    .map_err(|cause| OutputError::Write { path: path.clone(), cause })?;
            }
        }
        let mut paths = Vec::with_capacity(self.finished.len());
        for Finished { target, temporary } in std::mem::take(&mut self.finished) {
            if let Err(error) = temporary.persist(&target) {
                return Err(OutputError::Write { path: target, cause: error.error });
            }
            paths.push(target);
        }
        self.created.clear();
        Ok(paths)
    }
}

impl Drop for OutputSet {
    fn drop(&mut self) {
        self.finished.clear();
        for directory in self.created.iter().rev() {
            // Fails where somebody put something there meanwhile, and then it must stay.
            let _ = fs::remove_dir(directory);
        }
    }
}

/// One file that appears whole.
#[derive(Debug)]
#[must_use = "a file that is not committed is thrown away"]
pub struct WholeFile {
    // Before the set, so that an abandoned file is gone when the set removes its directories.
    file: OutputFile,
    set: OutputSet,
}

impl WholeFile {
    /// Begins the file at `path`; its directory is made where it does not exist.
    ///
    /// # Errors
    /// As [`OutputSet::create`] and [`OutputSet::file`].
    pub fn create(path: impl AsRef<Path>) -> Result<Self, OutputError> {
        let path = path.as_ref();
        let no_name = || OutputError::NoName(path.to_owned());
        let name = path.file_name().and_then(|name| name.to_str()).ok_or_else(no_name)?;
        if path.is_dir() {
            return Err(OutputError::NotAFile(path.to_owned()));
        }
        let mut set = OutputSet::create(path.parent().unwrap_or(Path::new(".")))?;
        let file = set.file(name)?;
        Ok(Self { file, set })
    }

    /// An error of writing this file, with its path.
    #[must_use]
    pub fn error(&self, cause: io::Error) -> OutputError {
        self.file.error(cause)
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// When the last of it cannot be written, or the rename fails.
    pub fn commit(mut self) -> Result<PathBuf, OutputError> {
        let path = self.file.path().to_owned();
        self.set.keep(self.file)?;
        self.set.commit()?;
        Ok(path)
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for WholeFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}
