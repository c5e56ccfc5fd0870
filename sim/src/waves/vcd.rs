//! Waves as a value change dump (VCD).

use std::io::{self, Write};

use vcd::{TimescaleUnit, Writer};

use super::{Hierarchy, Scope, Sink};

/// A VCD file under way.
///
/// Changes are put together here: the crate formats each bit by itself, which takes most of the time.
pub(super) struct VcdSink<W: Write> {
    vcd: Writer<W>,
    /// What ends the line of a change, for each signal.
    ends: Vec<String>,
    line: Vec<u8>,
}

impl<W: Write> VcdSink<W> {
    /// Writes the header.
    pub(super) fn new(output: W, hierarchy: &Hierarchy) -> io::Result<Self> {
        let mut sink = Self { vcd: Writer::new(output), ends: Vec::new(), line: Vec::new() };
        sink.vcd.timescale(1, TimescaleUnit::NS)?;
        sink.begin(&hierarchy.top)?;
        for rank in &hierarchy.ranks {
            sink.begin(rank)?;
            sink.vcd.upscope()?;
        }
        sink.vcd.upscope()?;
        sink.vcd.enddefinitions()?;
        Ok(sink)
    }

    fn begin(&mut self, scope: &Scope) -> io::Result<()> {
        self.vcd.add_module(&scope.name)?;
        for signal in &scope.signals {
            let id = self.vcd.add_wire(signal.width, &signal.name)?;
            self.ends.push(format!("{}{id}\n", if signal.width == 1 { "" } else { " " }));
        }
        Ok(())
    }
}

impl<W: Write> Sink for VcdSink<W> {
    fn time(&mut self, time: u64) -> io::Result<()> {
        self.vcd.timestamp(time)
    }

    fn change(&mut self, signal: usize, bits: &[u8]) -> io::Result<()> {
        self.line.clear();
        self.line.extend((bits.len() > 1).then_some(b'b'));
        self.line.extend_from_slice(bits);
        self.line.extend_from_slice(self.ends[signal].as_bytes());
        self.vcd.writer().write_all(&self.line)
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.vcd.flush()
    }
}
