//! SHA-256 of what passes through.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Size and checksum of a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Checksum {
    /// The number of bytes of the file.
    pub bytes: u64,
    /// SHA-256, 64 hex digits.
    pub sha256: String,
}

/// A writer that takes the checksum of what passes through it.
#[derive(Debug)]
pub struct Checked<W> {
    inner: W,
    hash: Sha256,
    bytes: u64,
}

impl<W> Checked<W> {
    /// Nothing has passed yet.
    pub fn new(inner: W) -> Self {
        Self { inner, hash: Sha256::new(), bytes: 0 }
    }

    /// The writer below, to which all bytes went on.
    pub const fn get_ref(&self) -> &W {
        &self.inner
    }

    /// The writer, and the checksum of what passed.
    pub fn finish(self) -> (W, Checksum) {
        let digits = self.hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        (self.inner, Checksum { bytes: self.bytes, sha256: digits })
    }
}

impl<W: Write> Write for Checked<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.hash.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

/// The checksum of everything a reader gives.
///
/// # Errors
/// When the reader does.
pub fn checksum(mut from: impl io::Read) -> io::Result<Checksum> {
    let mut checked = Checked::new(io::sink());
    io::copy(&mut from, &mut checked)?;
    Ok(checked.finish().1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_the_published_one() {
        let found = checksum(&b"abc"[..]).unwrap();
        let wanted = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(found, Checksum { bytes: 3, sha256: wanted.to_owned() });
    }
}
