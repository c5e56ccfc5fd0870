//! Paths that stand for what the process has open: `/dev/stdout`, `/dev/fd/3`.

#[cfg(unix)]
use std::fs;
use std::fs::File;
use std::io;
#[cfg(unix)]
use std::os::fd::AsFd;
#[cfg(windows)]
use std::os::windows::io::AsHandle;
use std::path::Path;

#[cfg(unix)]
use super::temporary::parent;

/// Links that are followed: more are a circle.
#[cfg(unix)]
const MOST_LINKS: usize = 40;

#[cfg(unix)]
pub(super) fn standard_output() -> io::Result<File> {
    io::stdout().as_fd().try_clone_to_owned().map(File::from)
}

/// The number that a path stands for, where it stands for one.
#[cfg(unix)]
pub(super) fn number(path: &Path) -> Option<u32> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let home = parent(&path).canonicalize().ok()?;
        if home == Path::new("/dev/fd") || is_of_this_process(&home) {
            return path.file_name()?.to_str()?.parse().ok();
        }
        path = home.join(fs::read_link(&path).ok()?);
    }
    None
}

#[cfg(unix)]
fn is_of_this_process(home: &Path) -> bool {
    let own = Path::new("/proc").join(std::process::id().to_string());
    home.starts_with(own) && home.ends_with("fd")
}

#[cfg(windows)]
pub(super) fn standard_output() -> io::Result<File> {
    io::stdout().as_handle().try_clone_to_owned().map(File::from)
}

#[cfg(windows)]
pub(super) const fn number(_: &Path) -> Option<u32> {
    None
}
