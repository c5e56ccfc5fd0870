//! Waves as a value change dump (VCD).

use std::io::{self, Write};

use vcd::{IdCode, TimescaleUnit, VarType, Writer};

use super::hierarchy::{Hierarchy, Scope};
use super::sink::Sink;

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
    /// Writes the header, with the names of all signals.
    pub(super) fn new(output: W, hierarchy: &Hierarchy) -> io::Result<Self> {
        let mut vcd = Writer::new(output);
        vcd.timescale(1, TimescaleUnit::NS)?;
        let mut ids = vec![None; hierarchy.widths.len()];
        declare(&mut vcd, &hierarchy.top, &hierarchy.widths, &mut ids)?;
        vcd.enddefinitions()?;
        // Every signal has a name.
        let signals = ids.into_iter().flatten().zip(&hierarchy.widths);
        let end = |(id, &width)| format!("{}{id}\n", if width == 1 { "" } else { " " });
        let ends = signals.map(end).collect();
        Ok(Self { vcd, ends, line: Vec::new() })
    }
}

/// A scope, its signals and the scopes inside. A further name of a signal has the same code.
fn declare<W: Write>(vcd: &mut Writer<W>, scope: &Scope, widths: &[u32], ids: &mut [Option<IdCode>]) -> io::Result<()> {
    vcd.add_module(&scope.name)?;
    for (name, number) in &scope.signals {
        let width = widths[*number];
        match ids[*number] {
            None => ids[*number] = Some(vcd.add_wire(width, name)?),
            Some(id) => vcd.var_def(VarType::Wire, width, id, name, None)?,
        }
    }
    for inner in &scope.scopes {
        declare(vcd, inner, widths, ids)?;
    }
    vcd.upscope()
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
