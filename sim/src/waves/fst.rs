//! Waves in the format of GTKWave (FST).

use std::io::{self, Seek, Write};

use fst_writer::{
    FstBodyWriter, FstFileType, FstHeaderWriter, FstInfo, FstScopeType, FstSignalId, FstSignalType, FstVarDirection,
    FstVarType, FstWriteError,
};

use super::hierarchy::{Hierarchy, Scope};
use super::sink::Sink;

/// Changes are held in memory, by signal, until this number of bytes is reached; then they become a
/// block of the file. Larger blocks are hardly smaller files.
const BLOCK_BYTES: usize = 4 << 20;

/// The exponent of ten of the time unit in seconds: ns.
const TIMESCALE: i8 = -9;

/// An FST file under way.
pub(super) struct FstSink<W: Write + Seek> {
    fst: FstBodyWriter<W>,
    ids: Vec<FstSignalId>,
}

impl<W: Write + Seek> FstSink<W> {
    /// Writes the header, with the names of all signals.
    pub(super) fn new(output: W, hierarchy: &Hierarchy) -> io::Result<Self> {
        let info = FstInfo {
            start_time: 0,
            timescale_exponent: TIMESCALE,
            version: "blysk".to_owned(),
            // The same run gives the same bytes.
            date: String::new(),
            file_type: FstFileType::Verilog,
        };
        let (fst, ids) = header(output, &info, hierarchy).map_err(io_error)?;
        Ok(Self { fst, ids })
    }
}

fn header<W: Write + Seek>(
    output: W,
    info: &FstInfo,
    hierarchy: &Hierarchy,
) -> fst_writer::Result<(FstBodyWriter<W>, Vec<FstSignalId>)> {
    let mut header = FstHeaderWriter::new(output, info)?;
    let mut ids = vec![None; hierarchy.widths.len()];
    declare(&mut header, &hierarchy.top, &hierarchy.widths, &mut ids)?;
    // Every signal has a name.
    Ok((header.finish()?, ids.into_iter().flatten().collect()))
}

/// A scope, its signals and the scopes inside. A further name of a signal is an alias.
fn declare<W: Write + Seek>(
    header: &mut FstHeaderWriter<W>,
    scope: &Scope,
    widths: &[u32],
    ids: &mut [Option<FstSignalId>],
) -> fst_writer::Result<()> {
    header.scope(&scope.name, "", FstScopeType::Module)?;
    for (name, number) in &scope.signals {
        let bits = FstSignalType::bit_vec(widths[*number]);
        let (kind, direction) = (FstVarType::Wire, FstVarDirection::Implicit);
        ids[*number] = Some(header.var(name, bits, kind, direction, ids[*number])?);
    }
    for inner in &scope.scopes {
        declare(header, inner, widths, ids)?;
    }
    header.up_scope()
}

impl<W: Write + Seek> Sink for FstSink<W> {
    fn time(&mut self, time: u64) -> io::Result<()> {
        // A block can end before a new time only.
        if self.fst.size() > BLOCK_BYTES {
            self.fst.flush().map_err(io_error)?;
        }
        self.fst.time_change(time).map_err(io_error)
    }

    fn change(&mut self, signal: usize, bits: &[u8]) -> io::Result<()> {
        self.fst.signal_change(self.ids[signal], bits).map_err(io_error)
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        self.fst.finish().map_err(io_error)?.flush()
    }
}

/// The I/O error inside, with its kind.
fn io_error(error: FstWriteError) -> io::Error {
    match error {
        FstWriteError::Io(error) => error,
        // Times that run backwards, bits that are none: a mistake of the program.
        other => io::Error::other(other),
    }
}
