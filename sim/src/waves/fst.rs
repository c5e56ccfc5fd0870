//! Waves in the format of GTKWave (FST).

use std::io::{self, Seek, Write};

use fst_writer::{
    FstBodyWriter, FstFileType, FstHeaderWriter, FstInfo, FstScopeType, FstSignalId, FstSignalType,
    FstVarDirection, FstVarType, FstWriteError,
};

use super::{Hierarchy, Scope, Sink};

/// Changes are held in memory, by signal, until there are so many bytes of them; then they become a
/// block of the file. Larger blocks are hardly smaller files.
const BLOCK_BYTES: usize = 4 << 20;

/// Seconds to the power of ten: ns.
const TIMESCALE: i8 = -9;

/// The longest name that readers of the format are sure to have room for.
const NAME_BYTES: usize = 511;

/// An FST file under way.
pub(super) struct FstSink<W: Write + Seek> {
    fst: FstBodyWriter<W>,
    ids: Vec<FstSignalId>,
}

impl<W: Write + Seek> FstSink<W> {
    /// Writes the header.
    pub(super) fn new(output: W, hierarchy: &Hierarchy) -> io::Result<Self> {
        let info = FstInfo {
            start_time: 0,
            timescale_exponent: TIMESCALE,
            version: "blysk".to_owned(),
            // The same run gives the same bytes.
            date: String::new(),
            file_type: FstFileType::Verilog,
        };
        let mut ids = Vec::new();
        let fst = header(output, &info, hierarchy, &mut ids).map_err(io_error)?;
        Ok(Self { fst, ids })
    }
}

fn header<W: Write + Seek>(
    output: W,
    info: &FstInfo,
    hierarchy: &Hierarchy,
    ids: &mut Vec<FstSignalId>,
) -> fst_writer::Result<FstBodyWriter<W>> {
    let mut fst = FstHeaderWriter::new(output, info)?;
    begin(&mut fst, &hierarchy.top, ids)?;
    for rank in &hierarchy.ranks {
        begin(&mut fst, rank, ids)?;
        fst.up_scope()?;
    }
    fst.up_scope()?;
    fst.finish()
}

fn begin<W: Write + Seek>(
    fst: &mut FstHeaderWriter<W>,
    scope: &Scope,
    ids: &mut Vec<FstSignalId>,
) -> fst_writer::Result<()> {
    // The name of a configuration is ASCII and as long as it likes; all others are short.
    let name = scope.name.get(..NAME_BYTES).unwrap_or(&scope.name);
    fst.scope(name, "", FstScopeType::Module)?;
    for signal in &scope.signals {
        let bits = FstSignalType::bit_vec(signal.width);
        let (kind, direction) = (FstVarType::Wire, FstVarDirection::Implicit);
        ids.push(fst.var(&signal.name, bits, kind, direction, None)?);
    }
    Ok(())
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
