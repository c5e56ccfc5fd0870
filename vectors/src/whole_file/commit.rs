//! Steps that others can see, and the way back.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::steps::step;
use super::temporary::Temporary;

/// A step that was made.
#[derive(Debug)]
enum Step {
    /// A file got a name that was free.
    Made(PathBuf),
    /// A directory got a name that was free.
    MadeDirectory(PathBuf),
    /// What had this name, and what becomes of it if nothing fails: it goes.
    Replaced(PathBuf, Temporary),
}

/// The steps so far.
#[derive(Debug, Default)]
pub(super) struct Journal(Vec<Step>);

impl Journal {
    /// Takes the name from a file.
    pub(super) fn remove(&mut self, target: &Path) -> io::Result<()> {
        let old = Temporary::of(target)?;
        step()?;
        fs::remove_file(target)?;
        self.0.push(Step::Replaced(target.to_owned(), old));
        Ok(())
    }

    /// Gives a file its name; what had it is replaced.
    pub(super) fn put(&mut self, file: Temporary, target: &Path) -> io::Result<()> {
        let old = target.exists().then(|| Temporary::of(target)).transpose()?;
        step()?;
        file.rename(target).map_err(|(_, error)| error)?;
        let target = target.to_owned();
        self.0.push(old.map_or_else(|| Step::Made(target.clone()), |old| Step::Replaced(target.clone(), old)));
        Ok(())
    }

    /// Gives a directory its name. Where another process made it meanwhile, for a set beside this one, what is in it
    /// gets its name there.
    pub(super) fn put_directory(&mut self, directory: Temporary, target: &Path) -> io::Result<()> {
        step()?;
        match directory.rename(target) {
            Ok(()) => {
                self.0.push(Step::MadeDirectory(target.to_owned()));
                Ok(())
            }
            Err((directory, error)) if target.is_dir() => self.put_below(directory.path(), target, error),
            Err((_, error)) => Err(error),
        }
    }

    /// Directories only: a file in a directory that is there belongs to a set that is.
    fn put_below(&mut self, from: &Path, target: &Path, taken: io::Error) -> io::Result<()> {
        for entry in fs::read_dir(from)? {
            let entry = entry?;
            let (from, target) = (entry.path(), target.join(entry.file_name()));
            if !from.is_dir() {
                return Err(taken);
            }
            step()?;
            match fs::rename(&from, &target) {
                Ok(()) => self.0.push(Step::MadeDirectory(target)),
                Err(taken) => self.put_below(&from, &target, taken)?,
            }
        }
        Ok(())
    }

    /// Goes back, last step first. What cannot be put back is left aside and named.
    pub(super) fn undo(self, cause: OutputError) -> OutputError {
        self.0.into_iter().rev().fold(cause, |cause, made| match made {
            Step::Made(path) => {
                let _ = fs::remove_file(path);
                cause
            }
            Step::MadeDirectory(path) => {
                let _ = Temporary::take_back(&path);
                cause
            }
            Step::Replaced(path, old) => match old.rename(&path) {
                Ok(()) => cause,
                Err((old, _)) => OutputError::NotUndone { cause: Box::new(cause), path, aside: old.leave() },
            },
        })
    }
}
