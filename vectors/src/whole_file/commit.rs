//! Steps that others can see, and the way back.

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
        std::fs::remove_file(target)?;
        self.0.push(Step::Replaced(target.to_owned(), old));
        Ok(())
    }

    /// Gives a file its name; what had it is replaced.
    pub(super) fn put(&mut self, file: Temporary, target: &Path) -> io::Result<()> {
        let old = target.exists().then(|| Temporary::of(target)).transpose()?;
        step()?;
        file.rename(target).map_err(|(_, error)| error)?;
        let target = target.to_owned();
        self.0.push(
            old.map_or_else(
                || Step::Made(target.clone()),
                |old| Step::Replaced(target.clone(), old),
            ),
        );
        Ok(())
    }

    /// Gives a directory its name, which nothing has.
    pub(super) fn put_directory(&mut self, directory: Temporary, target: &Path) -> io::Result<()> {
        step()?;
        directory.rename(target).map_err(|(_, error)| error)?;
        self.0.push(Step::MadeDirectory(target.to_owned()));
        Ok(())
    }

    /// Goes back, last step first. What cannot be put back is left aside and named.
    pub(super) fn undo(self, cause: OutputError) -> OutputError {
        self.0.into_iter().rev().fold(cause, |cause, made| match made {
            Step::Made(path) => {
                let _ = std::fs::remove_file(path);
                cause
            }
            Step::MadeDirectory(path) => {
                let _ = Temporary::take_back(&path);
                cause
            }
            Step::Replaced(path, old) => match old.rename(&path) {
                Ok(()) => cause,
                Err((old, _)) => {
                    OutputError::NotUndone { cause: Box::new(cause), path, aside: old.leave() }
                }
            },
        })
    }
}
