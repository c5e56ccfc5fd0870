//! What a format of waves has to be able to say.

use std::io;

/// A file of waves under way, whose header is written.
pub(super) trait Sink {
    /// The changes from here on are at `time`, in ns, later than those before.
    fn time(&mut self, time: u64) -> io::Result<()>;

    /// A signal changes to these bits, from the highest down, each `b'0'`, `b'1'` or `b'x'`.
    fn change(&mut self, signal: usize, bits: &[u8]) -> io::Result<()>;

    /// Writes what is left, and flushes.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
