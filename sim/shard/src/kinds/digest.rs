//! What a program is known by.

use std::fs::File;
use std::path::Path;

use vectors::checksum::{Checksum, checksum};

use crate::error::ShardError;

/// Size and SHA-256 of a file.
pub(crate) fn digest(path: &Path) -> Result<Checksum, ShardError> {
    File::open(path).and_then(checksum).map_err(|cause| ShardError::Io { path: path.to_owned(), cause })
}
