//! Reading a bundle back, and checking that it is the one that was written.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use dashu_int::UBig;
use thiserror::Error;

use crate::checksum::checksum;
use crate::limits::{MAX_VECTORS, MOST_WORDS};
use crate::manifest::{EXPECTED, FAULTS, FORMAT_VERSION, MANIFEST, Manifest, NEGATIVE_CONTROL, ROM, STIMULUS, TABLE};
use crate::memory_file::{MemoryError, read_words};
use crate::table::{TableError, TableRow, read_table};
use crate::text_file::{self, TextProblem};

/// Why a bundle is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// A file is missing or cannot be read.
    #[error("the bundle is incomplete: cannot read {}: {cause}; write it again", path.display())]
    Io {
        /// The path of the file that cannot be read.
        path: PathBuf,
        /// Why it cannot be read.
        cause: TextProblem,
    },
    /// The manifest is not one.
    #[error("{} is not a manifest: {cause}", path.display())]
    Manifest {
        /// The path of the manifest.
        path: PathBuf,
        /// What is wrong, with line and column.
        cause: serde_json::Error,
    },
    /// The manifest is of another version.
    #[error("{} has format version {found}; this tool reads {FORMAT_VERSION}", path.display())]
    Version {
        /// The path of the manifest.
        path: PathBuf,
        /// The version that the manifest says.
        found: u32,
    },
    /// The manifest does not vouch for a file of the bundle.
    #[error("{} does not list {name}", path.display())]
    NotListed {
        /// The path of the manifest.
        path: PathBuf,
        /// The name of the file that it does not list.
        name: &'static str,
    },
    /// A file is not the one that was written.
    #[error(
        "{} is not the file that was written: its SHA-256 is {found}, the manifest says {expected}; \
         write the bundle again", path.display()
    )]
    Checksum {
        /// The path of the file.
        path: PathBuf,
        /// The SHA-256 of the file as it is.
        found: String,
        /// The SHA-256 that the manifest lists.
        expected: String,
    },
    /// A file goes on where the one that was written ends.
    #[error(
        "{} is not the file that was written: it is longer than {expected} bytes, which the manifest says; \
         write the bundle again", path.display()
    )]
    Long {
        /// The path of the file.
        path: PathBuf,
        /// Its bytes by the manifest.
        expected: u64,
    },
    /// A memory file cannot be read.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// `vectors.csv` cannot be read.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A number of lines or words is not the manifest's.
    #[error("{} has {found} vectors, the manifest says {expected}", path.display())]
    Count {
        /// The path of the file.
        path: PathBuf,
        /// The number of vectors found in the file.
        found: u64,
        /// Vectors by the manifest.
        expected: u64,
    },
    /// A field of the manifest that is out of its range.
    #[error("{}: {field}: {problem}", path.display())]
    Field {
        /// The path of the manifest.
        path: PathBuf,
        /// The name of the manifest's field.
        field: &'static str,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// The bundle has no vectors, so it would check nothing.
    #[error("{} says that there are no vectors; a bundle has at least 1", .0.display())]
    Empty(PathBuf),
    /// A memory file and the table say different things.
    #[error("{}: word {index} is {found:x}, but {TABLE} says {expected:x}", path.display())]
    Disagree {
        /// The path of the memory file.
        path: PathBuf,
        /// The word, counted from 0.
        index: usize,
        /// The word that the memory file has.
        found: UBig,
        /// The word by the table.
        expected: u128,
    },
    /// The negative control is not one wrong word, as the manifest records it.
    #[error(
        "{}: {differing} words differ from {EXPECTED}; the manifest says that only word {vector} does, and is \
         {corrupted} there instead of {expected}", path.display()
    )]
    Control {
        /// The path of the negative control.
        path: PathBuf,
        /// How many words differ.
        differing: usize,
        /// The vector that should.
        vector: u64,
        /// Its word by the manifest.
        corrupted: String,
        /// Its right word by the manifest.
        expected: String,
    },
}

/// A bundle read back.
#[derive(Debug, Clone, PartialEq)]
pub struct Verified {
    /// The bundle's manifest.
    pub manifest: Manifest,
    /// Its cases, with what is expected of them.
    pub vectors: Vec<TableRow>,
    /// The words of the ROM image, by address.
    pub rom: Vec<UBig>,
}

/// Reads every file of the bundle in `directory` and checks it: that the checksums and counts are
/// the manifest's, and that memory files and table say the same.
///
/// # Errors
/// Names the file and what is wrong with it.
pub fn verify(directory: impl AsRef<Path>) -> Result<Verified, VerifyError> {
    let directory = directory.as_ref();
    let manifest = read_manifest(directory)?;
    for name in [ROM, STIMULUS, EXPECTED, NEGATIVE_CONTROL, TABLE] {
        check_file(directory, &manifest, name)?;
    }
    if manifest.faults.is_some() {
        check_file(directory, &manifest, FAULTS)?;
    }
    let vectors = read_table(&directory.join(TABLE))?;
    if vectors.len() as u64 != manifest.counts.vectors {
        let (found, expected) = (vectors.len() as u64, manifest.counts.vectors);
        return Err(VerifyError::Count { path: directory.join(TABLE), found, expected });
    }
    let words = &manifest.words;
    compare(directory, STIMULUS, words.stimulus.width, &vectors, |row| {
        words.stimulus.pack(&[row.case.address.into(), row.case.x])
    })?;
    compare(directory, EXPECTED, words.expected.width, &vectors, |row| {
        words.expected.pack(&[row.expected.status.into(), row.expected.intensity])
    })?;
    check_control(directory, &manifest, &vectors)?;
    let depth = manifest.counts.rom_words as usize;
    let rom = read_words(&directory.join(ROM), words.rom.width, depth)?;
    Ok(Verified { manifest, vectors, rom })
}

/// That the negative control differs from the expected answers in the one word of the manifest.
fn check_control(directory: &Path, manifest: &Manifest, vectors: &[TableRow]) -> Result<(), VerifyError> {
    let path = directory.join(NEGATIVE_CONTROL);
    let (layout, record) = (&manifest.words.expected, &manifest.negative_control);
    let found = read_words(&path, layout.width, vectors.len())?;
    let right =
        vectors.iter().map(|row| UBig::from(layout.pack(&[row.expected.status.into(), row.expected.intensity])));
    let differing: Vec<(usize, UBig, UBig)> = found
        .into_iter()
        .zip(right)
        .enumerate()
        .filter(|(_, (found, right))| found != right)
        .map(|(index, (found, right))| (index, found, right))
        .collect();
    let hex = |word: &UBig| format!("{word:00$x}", layout.digits());
    let as_recorded = differing.first().is_some_and(|(index, found, right)| {
        *index as u64 == record.vector && hex(found) == record.corrupted && hex(right) == record.expected
    });
    if differing.len() == 1 && as_recorded {
        return Ok(());
    }
    Err(VerifyError::Control {
        path,
        differing: differing.len(),
        vector: record.vector,
        corrupted: record.corrupted.clone(),
        expected: record.expected.clone(),
    })
}

fn read_manifest(directory: &Path) -> Result<Manifest, VerifyError> {
    let path = directory.join(MANIFEST);
    let text = match text_file::text(&path, text_file::MANIFEST) {
        Ok(text) => text,
        Err(cause) => return Err(VerifyError::Io { path, cause }),
    };
    // The version first: another version may well have other fields.
    let manifest = serde_json::from_str::<serde_json::Value>(&text).and_then(|value| {
        let version = value.get("format_version").and_then(serde_json::Value::as_u64);
        match version.and_then(|version| u32::try_from(version).ok()) {
            Some(found) if found != FORMAT_VERSION => Ok(Err(found)),
            _ => serde_json::from_str(&text).map(Ok),
        }
    });
    match manifest {
        Err(cause) => Err(VerifyError::Manifest { path, cause }),
        Ok(Err(found)) => Err(VerifyError::Version { path, found }),
        Ok(Ok(Manifest { counts, .. })) if counts.vectors == 0 => Err(VerifyError::Empty(path)),
        Ok(Ok(manifest)) => match check_sizes(&manifest) {
            Ok(()) => Ok(manifest),
            Err((field, problem)) => Err(VerifyError::Field { path, field, problem }),
        },
    }
}

/// Every field that sizes memory or shifts bits is in its range: the counts, and the layouts of words.
fn check_sizes(manifest: &Manifest) -> Result<(), (&'static str, String)> {
    let Manifest { counts, words, .. } = manifest;
    let counted = [("counts.vectors", counts.vectors, MAX_VECTORS), ("counts.rom_words", counts.rom_words, MOST_WORDS)];
    for (field, count, most) in counted {
        if !(1..=most).contains(&count) {
            return Err((field, format!("{count}; a bundle has 1 to {most}")));
        }
    }
    let layouts = [
        ("words.stimulus", &words.stimulus, Some(["address", "x"])),
        ("words.expected", &words.expected, Some(["status", "intensity"])),
        ("words.rom", &words.rom, None),
    ];
    for (field, layout, names) in layouts {
        let named = names.map_or(Ok(()), |names| layout.check_names(&names));
        named.and_then(|()| layout.check()).map_err(|error| (field, error.to_string()))?;
    }
    Ok(())
}

fn check_file(directory: &Path, manifest: &Manifest, name: &'static str) -> Result<(), VerifyError> {
    let path = directory.join(name);
    let Some(expected) = manifest.files.get(name) else {
        return Err(VerifyError::NotListed { path: directory.join(MANIFEST), name });
    };
    // A byte more is enough to see that it is another file, were it one without end.
    let beyond = expected.bytes.saturating_add(1);
    match File::open(&path).and_then(|file| checksum(file.take(beyond))) {
        Err(cause) => Err(VerifyError::Io { path, cause: cause.into() }),
        Ok(found) if found.bytes == beyond => Err(VerifyError::Long { path, expected: expected.bytes }),
        Ok(found) if found != *expected => {
            Err(VerifyError::Checksum { path, found: found.sha256, expected: expected.sha256.clone() })
        }
        Ok(_) => Ok(()),
    }
}

fn compare(
    directory: &Path,
    name: &str,
    width: u32,
    vectors: &[TableRow],
    word: impl Fn(&TableRow) -> u128,
) -> Result<(), VerifyError> {
    let path = directory.join(name);
    let found = read_words(&path, width, vectors.len())?;
    for (index, (found, row)) in found.into_iter().zip(vectors).enumerate() {
        let expected = word(row);
        if found != UBig::from(expected) {
            return Err(VerifyError::Disagree { path, index, found, expected });
        }
    }
    Ok(())
}
