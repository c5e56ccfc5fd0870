//! Where a command's files go. They are begun before its work, so that a place where nothing can be written is found at
//! once, and never over what it reads.

use std::path::{Path, PathBuf};

use anyhow::bail;
use vectors::{OutputSet, WholeFile};

/// Standard output, as an option has it.
pub(super) fn is_standard_output(path: &Path) -> bool {
    path == Path::new("-")
}

/// The set of files that a command writes to `--out DIR`: with a list of them, and names that are known before the
/// work.
pub(super) fn set<N: AsRef<str>>(
    directory: &Path,
    command: &str,
    inputs: &[PathBuf],
    names: impl IntoIterator<Item = N>,
) -> anyhow::Result<OutputSet> {
    if is_standard_output(directory) {
        bail!("--out -: several files do not go to standard output; give a directory (./- where it has that name)");
    }
    Ok(OutputSet::apart_from(inputs, directory)?.listed(command)?.announce(names)?)
}

/// The file that a command writes to `--out FILE`, where `-` is standard output.
pub(super) fn file(out: Option<&PathBuf>, inputs: &[PathBuf]) -> anyhow::Result<Option<WholeFile>> {
    Ok(out.map(|path| WholeFile::apart_from(inputs, path)).transpose()?)
}

/// Writes it, where there is one. True where it went to standard output, which then has nothing else.
pub(super) fn fill(file: Option<WholeFile>, contents: impl AsRef<[u8]>) -> anyhow::Result<bool> {
    let Some(file) = file else { return Ok(false) };
    let alone = file.is_standard_output();
    file.fill(contents)?;
    Ok(alone)
}
