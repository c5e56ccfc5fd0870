//! Waves as a value change dump (VCD).

use std::io::{self, Write};

use vcd::{IdCode, TimescaleUnit, Value, Writer};

use super::{Hierarchy, Scope, Sink};

/// A VCD file under way.
pub(super) struct VcdSink<W: Write> {
    vcd: Writer<W>,
    ids: Vec<IdCode>,
}

impl<W: Write> VcdSink<W> {
    /// Writes the header.
    pub(super) fn new(output: W, hierarchy: &Hierarchy) -> io::Result<Self> {
        let mut sink = Self { vcd: Writer::new(output), ids: Vec::new() };
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
            self.ids.push(self.vcd.add_wire(signal.width, &signal.name)?);
        }
        Ok(())
    }
}

impl<W: Write> Sink for VcdSink<W> {
    fn time(&mut self, time: u64) -> io::Result<()> {
        self.vcd.timestamp(time)
    }

    fn change(&mut self, signal: usize, bits: &[u8]) -> io::Result<()> {
        let value = |bit: u8| match bit {
            b'0' => Value::V0,
            b'1' => Value::V1,
            _ => Value::X,
        };
        let id = self.ids[signal];
        match *bits {
            [bit] => self.vcd.change_scalar(id, value(bit)),
            _ => self.vcd.change_vector(id, bits.iter().map(|&bit| value(bit))),
        }
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.vcd.flush()
    }
}
