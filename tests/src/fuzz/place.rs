//! What targets stand on: a directory of their own, and hardware whose files they read.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use hw_model::config::Config;
use hw_model::design::Design;
use tempfile::TempDir;
use vectors::{Bundle, Strategy};

/// The configuration that stimulus, answers, register logs and bundles of the corpus are for.
pub const TINY: &str = r#"{"name": "tiny", "method": "hermite", "exponents": "1..=4", "input": "UQ1.8",
    "output": "UQ1.7"}"#;

/// Puts other contents into a file. A file that is cut to nothing and written again is waited for until it is on the
/// disk, by some file systems; this one is not.
///
/// # Errors
/// When it cannot be written.
pub fn overwrite(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).create(true).truncate(false).open(path)?;
    file.write_all(bytes)?;
    file.set_len(bytes.len() as u64)
}

/// A directory, and the hardware of `TINY` with a bundle of its vectors.
#[derive(Debug)]
pub struct Place {
    directory: TempDir,
    /// The hardware that bundles and logs are judged against.
    pub design: Design,
}

impl Place {
    /// A new one.
    ///
    /// # Panics
    /// When there can be no temporary directory.
    #[must_use]
    pub fn new() -> Self {
        let directory = TempDir::new().expect("a temporary directory");
        let config = Config::from_json(TINY).expect("the tiny configuration is one");
        let design = Design::new(config).expect("the tiny configuration makes hardware");
        let bundle = Bundle::new(&design, Strategy::Mixed, 12, 1, "fuzz").expect("it has vectors");
        bundle.write_to(directory.path().join("right")).expect("the directory is ours");
        fs::create_dir(directory.path().join("read")).expect("the directory is ours");
        Self { directory, design }
    }

    /// The directory of the right bundle.
    #[must_use]
    pub fn bundle(&self) -> PathBuf {
        self.directory.path().join("right")
    }

    /// Puts an input into a file, and says where.
    ///
    /// # Panics
    /// When it cannot.
    #[must_use]
    pub fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.directory.path().join(name);
        overwrite(&path, bytes).expect("the directory is ours");
        path
    }

    /// Puts these files into a directory that has no others, and says where.
    ///
    /// # Panics
    /// When it cannot.
    #[must_use]
    pub fn files(&self, files: &[(String, Vec<u8>)]) -> PathBuf {
        let directory = self.directory.path().join("read");
        for entry in fs::read_dir(&directory).expect("the directory is ours").flatten() {
            fs::remove_file(entry.path()).expect("the file is ours");
        }
        for (name, contents) in files {
            // A name is that of a file here, whatever was made of it.
            let plain = Path::new(name).file_name() == Some(name.as_ref()) && name.len() < 100;
            if plain && !name.contains('\0') {
                fs::write(directory.join(name), contents).expect("the directory is ours");
            }
        }
        directory
    }
}

impl Default for Place {
    fn default() -> Self {
        Self::new()
    }
}
