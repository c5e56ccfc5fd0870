//! Where a path leads.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::descriptors;
use super::error::OutputError;
use super::temporary::parent;

/// Standard output, where a file is asked for.
pub(super) const STANDARD_OUTPUT: &str = "-";

/// Where a path leads.
pub(super) enum Target {
    /// To a regular file, or to where one can be made: no link any more.
    File(PathBuf),
    /// To something that is written through.
    Stream(Stream),
}

/// A pipe or a character device.
#[derive(Debug)]
pub(super) struct Stream {
    file: File,
    /// Whether it is this process's standard output, which then has room for nothing else.
    pub(super) standard_output: bool,
    closed: bool,
}

/// The reader of a stream may stop: that is no error, and what comes after goes nowhere.
impl Write for Stream {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.closed {
            return Ok(bytes.len());
        }
        match self.file.write(bytes) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(bytes.len())
            }
            other => other,
        }
    }
    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Follows a path. A stream is opened, which for a named pipe waits until a reader opens it.
pub(super) fn find(path: &Path) -> Result<Target, OutputError> {
    let stream = |file: io::Result<File>, standard_output| match file {
        Ok(file) => Ok(Target::Stream(Stream { file, standard_output, closed: false })),
        Err(cause) => Err(OutputError::Write { path: path.to_owned(), cause }),
    };
    if path == Path::new(STANDARD_OUTPUT) {
        return stream(descriptors::standard_output(), true);
    }
    match descriptors::number(path) {
        Some(1) => return stream(descriptors::standard_output(), true),
        // Opened anew, a file would be written from its beginning, over what stands there.
        Some(_) => return stream(OpenOptions::new().append(true).open(path), false),
        None => {}
    }
    match fs::metadata(path) {
        Ok(found) if is_stream(&found) => stream(OpenOptions::new().write(true).open(path), false),
        _ => regular(path).map(Target::File),
    }
}

/// The regular file that a path leads to, or the place where one can be made.
pub(super) fn regular(path: &Path) -> Result<PathBuf, OutputError> {
    if path.file_name().is_none() {
        return Err(OutputError::NoName(path.to_owned()));
    }
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => return Err(OutputError::NotAFile(path.to_owned())),
        Ok(_) => {}
        Err(_) if path.as_os_str().as_encoded_bytes().ends_with(b"/") => {
            return Err(OutputError::NoName(path.to_owned()));
        }
        Err(_) => return no_link(path).map(|()| path.to_owned()),
    }
    if path.is_symlink() {
        let real = fs::canonicalize(path);
        return real.map_err(|cause| OutputError::Write { path: path.to_owned(), cause });
    }
    Ok(path.to_owned())
}

/// That a path which leads nowhere is not a link that says otherwise.
pub(super) fn no_link(path: &Path) -> Result<(), OutputError> {
    match fs::read_link(path) {
        Ok(to) => Err(OutputError::Dangling { path: path.to_owned(), to }),
        Err(_) => Ok(()),
    }
}

/// A path without links, by which outputs can be compared: the file need not be there yet.
pub(super) fn place(path: &Path) -> PathBuf {
    let home = parent(path);
    let home = home.canonicalize().or_else(|_| std::path::absolute(home));
    let name = path.file_name().unwrap_or_default();
    home.map_or_else(|_| path.to_owned(), |home| home.join(name))
}

/// Which regular file stands behind a path, whatever its names are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Identity(#[cfg(unix)] (u64, u64), #[cfg(not(unix))] PathBuf);

impl Identity {
    /// Nothing where there is no regular file.
    pub(super) fn of(path: &Path) -> Option<Self> {
        let found = fs::metadata(path).ok().filter(Metadata::is_file)?;
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt;
            Some(Self((found.dev(), found.ino())))
        }
        #[cfg(not(unix))]
        {
            let _ = found;
            path.canonicalize().ok().map(Self)
        }
    }
}

#[cfg(unix)]
fn is_stream(found: &Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    let kind = found.file_type();
    kind.is_char_device() || kind.is_fifo()
}

#[cfg(not(unix))]
fn is_stream(_: &Metadata) -> bool {
    false
}
