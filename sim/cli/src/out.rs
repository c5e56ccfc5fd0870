//! What a command hands back: its words on standard output, and its verdict.

use std::io::{self, BufWriter, Write};

use super::bar;

/// What a command found.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Everything asked for was done, and holds where something was checked.
    Good,
    /// Something that was checked does not hold.
    Fails,
    /// What has no end of its own was ended by this signal.
    Stopped(i32),
}

/// Standard output, buffered.
pub(crate) type Out = BufWriter<Stdout>;

/// Takes standard output.
pub(crate) fn lock() -> Out {
    BufWriter::new(Stdout::lock())
}

/// Standard output, whose errors say that it is what could not be written.
///
/// Whoever reads it may stop (`| head`). The rest then goes nowhere, and the command comes to its end all the same:
/// its exit status is its verdict, and its files are written.
pub(crate) struct Stdout {
    lock: io::StdoutLock<'static>,
    closed: bool,
}

impl Stdout {
    fn lock() -> Self {
        Self { lock: io::stdout().lock(), closed: false }
    }

    /// Whether nobody reads any more.
    pub(crate) const fn is_closed(&self) -> bool {
        self.closed
    }

    /// What a write gave, or `rest` where nobody reads any more.
    fn unless_closed<T>(&mut self, result: io::Result<T>, rest: T) -> io::Result<T> {
        match result {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(rest)
            }
            result => result.map_err(named),
        }
    }
}

impl Write for Stdout {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Results and what stands for them until then share the terminal.
        bar::end();
        if self.closed {
            return Ok(bytes.len());
        }
        let result = self.lock.write(bytes);
        self.unless_closed(result, bytes.len())
    }
    fn flush(&mut self) -> io::Result<()> {
        if self.closed {
            return Ok(());
        }
        let result = self.lock.flush();
        self.unless_closed(result, ())
    }
}

/// Keeps the kind: an interrupted write is tried again.
fn named(error: io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("cannot write to standard output: {error}"))
}
