//! Every register of every cycle, as CSV.

use std::io::{self, Write};

use hw_model::datapath::{Datapath, RankRegister};

use vectors::output_text::io_error;
use vectors::rtl::probes::ports;

use crate::run::Cycle;

/// Writes a line for each cycle: the ports, then every register of every rank before the edge. A
/// register that was never loaded is `x`, as an RTL simulator shows it.
pub struct TraceWriter<W: Write> {
    csv: csv::Writer<W>,
    registers: Vec<Vec<RankRegister>>,
}

impl<W: Write> TraceWriter<W> {
    /// Writes the header.
    ///
    /// # Errors
    /// When `output` cannot be written.
    pub fn new(output: W, datapath: &Datapath) -> io::Result<Self> {
        let registers: Vec<_> = (0..datapath.rank_count()).map(|rank| datapath.registers(rank)).collect();
        let mut csv = csv::Writer::from_writer(output);
        let mut header = vec!["cycle".to_owned()];
        header.extend(ports(datapath).iter().filter_map(|port| port.column.map(str::to_owned)));
        for (rank, registers) in registers.iter().enumerate() {
            header.push(format!("{}.valid", datapath.rank_name(rank)));
            header.extend(registers.iter().map(|register| datapath.register_name(rank, register)));
        }
        csv.write_record(&header).map_err(io_error)?;
        Ok(Self { csv, registers })
    }

    /// Writes one cycle.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn cycle(&mut self, cycle: &Cycle<'_>) -> io::Result<()> {
        let (inputs, outputs) = (cycle.inputs, cycle.outputs);
        let flag = |flag: bool| i64::from(flag);
        let shown = cycle.ranks.result_loaded();
        let ports = [
            Some(cycle.index as i64),
            Some(flag(inputs.reset)),
            Some(flag(inputs.in_valid)),
            Some(flag(outputs.in_ready)),
            Some(inputs.address.into()),
            Some(inputs.x),
            Some(flag(outputs.out_valid)),
            Some(flag(inputs.out_ready)),
            shown.then_some(outputs.intensity),
            shown.then_some(outputs.status.bits().into()),
        ];
        for port in ports {
            field(&mut self.csv, port)?;
        }
        for (rank, registers) in cycle.ranks.iter().zip(&self.registers) {
            field(&mut self.csv, Some(flag(rank.valid)))?;
            for register in registers {
                field(&mut self.csv, rank.loaded.then(|| register.bits(&rank.signals)))?;
            }
        }
        self.csv.write_record(None::<&[u8]>).map_err(io_error)
    }

    /// Flushes.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn finish(mut self) -> io::Result<()> {
        self.csv.flush()
    }
}

fn field<W: Write>(csv: &mut csv::Writer<W>, bits: Option<i64>) -> io::Result<()> {
    let written = match bits {
        Some(bits) => csv.write_field(bits.to_string()),
        None => csv.write_field("x"),
    };
    written.map_err(io_error)
}
