//! Waves as a value change dump (VCD), with the names of the RTL.
//!
//! The clock has a period of 10 ns and rises at 5, 15, 25, … ns. Registers and inputs change with the
//! rising edge, so what cycle k shows stands from 10·k − 5 to 10·k + 5 ns, its last instant being the edge at
//! which [`Cycle`] is taken. A register that was never loaded is `x`.

use std::io::{self, Write};

use hw_model::datapath::{Datapath, Register, Status};
use hw_model::format::QFormat;
use vcd::{IdCode, TimescaleUnit, Value};

use crate::run::Cycle;

const HALF_PERIOD: u64 = 5;

/// A signal of the dump, with the value it had last.
struct Wire {
    id: IdCode,
    width: u32,
    last: Option<Word>,
}

/// The bits of a signal; `None` is unknown.
type Word = Option<u64>;

/// Writes a VCD file cycle by cycle.
pub struct WaveWriter<W: Write> {
    vcd: vcd::Writer<W>,
    clock: IdCode,
    wires: Vec<Wire>,
    registers: Vec<Vec<Register>>,
    input: QFormat,
    output: QFormat,
}

impl<W: Write> WaveWriter<W> {
    /// Writes the header: one module named after the configuration, a scope inside for each rank.
    ///
    /// # Errors
    /// When `output` cannot be written.
    pub fn new(output: W, name: &str, datapath: &Datapath) -> io::Result<Self> {
        let registers: Vec<_> =
            (0..datapath.rank_count()).map(|rank| datapath.registers(rank)).collect();
        let mut vcd = vcd::Writer::new(output);
        vcd.timescale(1, TimescaleUnit::NS)?;
        vcd.add_module(&name.replace('-', "_"))?;
        let clock = vcd.add_wire(1, "clk_i")?;
        let formats = datapath.formats();
        let (input, output) = (formats.input, formats.output);
        let ports = [
            ("rst_i", 1),
            ("in_valid_i", 1),
            ("in_ready_o", 1),
            ("address_i", datapath.rom().address_width()),
            ("x_i", input.width()),
            ("out_valid_o", 1),
            ("out_ready_i", 1),
            ("intensity_o", output.width()),
            ("status_o", Status::WIDTH),
        ];
        let mut wires = Vec::new();
        for (port, width) in ports {
            wires.push(Wire { id: vcd.add_wire(width, port)?, width, last: None });
        }
        for (rank, registers) in registers.iter().enumerate() {
            vcd.add_module(&datapath.rank_name(rank))?;
            wires.push(Wire { id: vcd.add_wire(1, "valid_q")?, width: 1, last: None });
            for register in registers {
                let width = register.format.width();
                let id = vcd.add_wire(width, &format!("{}_q", register.name))?;
                wires.push(Wire { id, width, last: None });
            }
            vcd.upscope()?;
        }
        vcd.upscope()?;
        vcd.enddefinitions()?;
        Ok(Self { vcd, clock, wires, registers, input, output })
    }

    /// Writes one cycle: the rising edge that began it with all that changed there, and the falling
    /// edge in its middle.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn cycle(&mut self, cycle: &Cycle<'_>) -> io::Result<()> {
        let middle = 2 * HALF_PERIOD * cycle.index;
        if cycle.index > 0 {
            self.vcd.timestamp(middle - HALF_PERIOD)?;
            self.vcd.change_scalar(self.clock, Value::V1)?;
            self.changes(cycle)?;
            self.vcd.timestamp(middle)?;
            self.vcd.change_scalar(self.clock, Value::V0)
        } else {
            self.vcd.timestamp(0)?;
            self.vcd.change_scalar(self.clock, Value::V0)?;
            self.changes(cycle)
        }
    }

    fn changes(&mut self, cycle: &Cycle<'_>) -> io::Result<()> {
        let words = self.words(cycle);
        for (wire, word) in self.wires.iter_mut().zip(words) {
            if wire.last == Some(word) {
                continue;
            }
            wire.last = Some(word);
            let bit = |place: u32| match word {
                None => Value::X,
                Some(word) if word >> place & 1 == 1 => Value::V1,
                Some(_) => Value::V0,
            };
            if wire.width == 1 {
                self.vcd.change_scalar(wire.id, bit(0))?;
            } else {
                self.vcd.change_vector(wire.id, (0..wire.width).rev().map(bit))?;
            }
        }
        Ok(())
    }

    /// The word of every wire, in their order.
    fn words(&self, cycle: &Cycle<'_>) -> Vec<Word> {
        let (inputs, outputs) = (cycle.inputs, cycle.outputs);
        let shown = cycle.ranks.last().is_some_and(|rank| rank.loaded);
        let flag = |flag: bool| Some(u64::from(flag));
        let mut words = vec![
            flag(inputs.reset),
            flag(inputs.in_valid),
            flag(outputs.in_ready),
            Some(inputs.address.into()),
            Some(self.input.to_word(inputs.x)),
            flag(outputs.out_valid),
            flag(inputs.out_ready),
            shown.then(|| self.output.to_word(outputs.intensity)),
            shown.then_some(outputs.status.bits().into()),
        ];
        for (rank, registers) in cycle.ranks.iter().zip(&self.registers) {
            words.push(flag(rank.valid));
            words.extend(registers.iter().map(|register| {
                rank.loaded.then(|| register.format.to_word((register.bits)(&rank.signals)))
            }));
        }
        words
    }

    /// Writes the last rising edge, and flushes.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn finish(mut self, cycles: u64) -> io::Result<()> {
        if cycles > 0 {
            self.vcd.timestamp(2 * HALF_PERIOD * cycles - HALF_PERIOD)?;
            self.vcd.change_scalar(self.clock, Value::V1)?;
        }
        self.vcd.flush()
    }
}
