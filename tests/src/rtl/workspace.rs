//! Directories of emitted RTL.

use std::path::{Path, PathBuf};

use hw_model::design::Design;
use vectors::rtl::Emission;
use vectors::{Bundle, OutputSet, Strategy, rtl};

use super::simulators::{fresh, repository};
use super::{Failure, failed};

/// A directory of RTL, testbench and vectors that was emitted.
#[derive(Debug)]
pub struct Emitted<'a> {
    /// The design that was emitted.
    pub design: &'a Design,
    /// The path of the directory.
    pub directory: PathBuf,
    /// The number of vectors in it.
    pub vectors: u64,
    /// The vector that is wrong in the negative control.
    pub control: u64,
}

/// A fresh directory `target/rtl/<name>` with the RTL of a design and its vectors.
///
/// # Errors
/// When it cannot be written.
pub fn emit<'a>(design: &'a Design, name: &str, strategy: Strategy, count: u64) -> Result<Emitted<'a>, Failure> {
    emit_as(design, name, &Emission::default(), (strategy, count))
}

/// The same as it is asked to be: with names of its own, or the ROM in the source.
///
/// # Errors
/// When it cannot be written.
pub fn emit_as<'a>(
    design: &'a Design,
    name: &str,
    emission: &Emission,
    (strategy, count): (Strategy, u64),
) -> Result<Emitted<'a>, Failure> {
    let directory = fresh(name)?;
    let command = format!("make rtl, {name}");
    let written = Bundle::new(design, strategy, count, 1, &command).and_then(|bundle| {
        let mut set = OutputSet::create(&directory)?;
        let manifest = rtl::stage(&bundle, emission, &command, &mut set)?;
        set.commit()?;
        Ok((bundle.vector_count(), manifest.negative_control.vector))
    });
    match written {
        Ok((vectors, control)) => Ok(Emitted { design, directory, vectors, control }),
        Err(error) => failed(error.to_string()),
    }
}

/// A copy of a directory of RTL, without what was built there.
///
/// # Errors
/// When it cannot be written.
pub fn copy(from: &Path, name: &str) -> Result<PathBuf, Failure> {
    let to = repository().join("target/rtl").join(name);
    let copied = || -> std::io::Result<()> {
        if to.exists() {
            std::fs::remove_dir_all(&to)?;
        }
        std::fs::create_dir_all(&to)?;
        for entry in std::fs::read_dir(from)? {
            let entry = entry?;
            if entry.file_type()?.is_file() {
                std::fs::copy(entry.path(), to.join(entry.file_name()))?;
            }
        }
        Ok(())
    };
    match copied() {
        Ok(()) => Ok(to),
        Err(error) => failed(format!("cannot copy {}: {error}", from.display())),
    }
}
