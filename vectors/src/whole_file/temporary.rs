//! What a run makes under names of its own, until it gets its name or goes.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::Builder;

/// Temporary files are hidden, and say whose they are should a power cut leave one behind.
const PREFIX: &str = ".blysk-";

/// Every temporary file and directory of this process.
static ALIVE: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Held while files get their names. Taken before [`ALIVE`], where both are.
static COMMITTING: Mutex<()> = Mutex::new(());

/// What is protected is consistent after every line, so a panic elsewhere does not matter.
fn lock<T>(mutex: &'static Mutex<T>) -> MutexGuard<'static, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// While this lives, a signal waits: it meets the old set or the new one.
pub(super) fn committing() -> MutexGuard<'static, ()> {
    lock(&COMMITTING)
}

/// Removes every temporary file and directory of this process, for a handler of signals that ends the process then.
/// A commit under way is waited for, and no later one begins.
pub fn remove_temporaries() {
    let committing = lock(&COMMITTING);
    let alive = lock(&ALIVE);
    for path in alive.iter() {
        remove(path);
    }
    // Never given back: what would make another temporary file waits until the process has ended.
    std::mem::forget((committing, alive));
}

/// Makes something inside a temporary directory: a signal waits until it is there. Otherwise the handler could have
/// listed the directory before, and would find it not empty when it comes to remove it.
pub(super) fn no_signal_meanwhile<T>(make: impl FnOnce() -> T) -> T {
    let _alive = lock(&ALIVE);
    make()
}

/// Nothing can be done about what cannot be removed.
fn remove(path: &Path) {
    let _ = match fs::symlink_metadata(path) {
        Ok(found) if found.is_dir() => fs::remove_dir_all(path),
        _ => fs::remove_file(path),
    };
}

/// A temporary file or directory, removed where it is dropped.
#[derive(Debug)]
pub(super) struct Temporary(PathBuf);

impl Temporary {
    /// `make` gets names until one is free.
    fn make<T>(directory: &Path, make: impl FnMut(&Path) -> io::Result<T>) -> io::Result<(Self, T)> {
        let mut alive = lock(&ALIVE);
        let made = Builder::new().prefix(PREFIX).make_in(directory, make);
        // The text of an error would name a file by a name that is another one each time.
        let (made, path) = made.map_err(|error| error.kind())?.into_parts();
        let path = path.keep().map_err(|error| error.error)?;
        alive.insert(path.clone());
        Ok((Self(path), made))
    }

    /// An empty file, which others may read as the umask lets them.
    pub(super) fn file(directory: &Path) -> io::Result<(Self, File)> {
        let mut options = OpenOptions::new();
        options.read(true).write(true).create_new(true);
        Self::make(directory, |path| options.open(path))
    }

    /// A new, empty directory in `parent`, hidden and with a name of its own.
    pub(super) fn directory(parent: &Path) -> io::Result<Self> {
        Ok(Self::make(parent, |path| fs::create_dir(path))?.0)
    }

    /// Another name of a file, or a copy where the file system has no such names.
    pub(super) fn of(file: &Path) -> io::Result<Self> {
        let directory = parent(file);
        match Self::make(directory, |path| fs::hard_link(file, path)) {
            Ok((linked, ())) => Ok(linked),
            Err(_) => {
                let (copy, _) = Self::file(directory)?;
                fs::copy(file, copy.path())?;
                Ok(copy)
            }
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.0
    }

    /// Gives it its name, in the place of a file that has it. Where that fails it is as it was.
    pub(super) fn rename(self, target: &Path) -> Result<(), (Self, io::Error)> {
        let mut alive = lock(&ALIVE);
        match fs::rename(&self.0, target) {
            Ok(()) => {
                alive.remove(&self.0);
                Ok(())
            }
            Err(error) => {
                drop(alive);
                Err((self, error))
            }
        }
    }

    /// Leaves it where it is.
    pub(super) fn leave(self) -> PathBuf {
        lock(&ALIVE).remove(&self.0);
        self.0.clone()
    }

    /// What is at `target` gets a temporary name again.
    pub(super) fn take_back(target: &Path) -> io::Result<Self> {
        let back = Self::directory(parent(target))?;
        fs::rename(target, back.path())?;
        Ok(back)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let mut alive = lock(&ALIVE);
        if alive.remove(&self.0) {
            remove(&self.0);
        }
    }
}

/// The directory that a file stands in.
pub(super) fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// A directory for files that are not output; it and they are gone when it is dropped.
#[derive(Debug)]
pub struct Scratch(Temporary);

impl Scratch {
    /// A new one, where the system has its temporary files.
    ///
    /// # Errors
    /// When it cannot be made.
    pub fn new() -> io::Result<Self> {
        Temporary::directory(&std::env::temp_dir()).map(Self)
    }

    /// The path of the directory.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.0.path()
    }
}
