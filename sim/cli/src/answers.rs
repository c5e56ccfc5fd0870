//! The answers of a simulated stimulus: the first of them for people, or all of them as CSV.

use std::io::Write;

use hw_model::datapath::Datapath;
use hw_model::quantise::{decimal, real};

use sim::run::{Cycle, Results, Taken};
use vectors::output_text::io_error;

use super::out::Out;
use super::table::{Cell, Format, Rows};

/// Answers that people are shown.
const SHOWN: usize = 20;

const COLUMNS: [&str; 8] = ["cycle", "n", "address", "x", "x_bits", "intensity", "intensity_bits", "status"];

/// What a run answers.
pub(super) struct Answers<'a> {
    datapath: &'a Datapath,
    results: Results,
    first: First,
    all: Option<csv::Writer<&'a mut Out>>,
}

/// The first answers.
pub(super) struct First(Rows);

impl<'a> Answers<'a> {
    /// Of this data path; all of them are written to `all` as they come.
    pub(super) fn new(datapath: &'a Datapath, all: Option<&'a mut Out>) -> anyhow::Result<Self> {
        let mut all = all.map(csv::Writer::from_writer);
        if let Some(all) = &mut all {
            all.write_record(COLUMNS).map_err(io_error)?;
        }
        let columns = ["cycle", "n", "x", "intensity", "intensity_bits", "status"];
        let first = First(Rows::new(&columns));
        Ok(Self { datapath, results: Results::default(), first, all })
    }

    /// The next cycle of the run.
    pub(super) fn cycle(&mut self, cycle: &Cycle<'_>) -> anyhow::Result<()> {
        let Some(taken) = self.results.cycle(cycle) else { return Ok(()) };
        let formats = self.datapath.formats();
        let Taken { cycle, request: (address, x), intensity, status } = taken;
        let n = self.datapath.rom().exponents().as_slice().get(address as usize);
        if let Some(all) = &mut self.all {
            let row = [
                cycle.to_string(),
                n.map(f64::to_string).unwrap_or_default(),
                address.to_string(),
                decimal(x, formats.input),
                x.to_string(),
                decimal(intensity, formats.output),
                intensity.to_string(),
                status.bits().to_string(),
            ];
            all.write_record(row).map_err(io_error)?;
        } else if self.first.0.rows.len() < SHOWN {
            self.first.0.push(vec![
                Cell::Integer(cycle as i64),
                n.map_or(Cell::None, |&n| Cell::Exponent(n)),
                real(x, formats.input).into(),
                real(intensity, formats.output).into(),
                Cell::Integer(intensity),
                status.to_string().into(),
            ]);
        }
        Ok(())
    }

    /// Writes what is left to be written.
    pub(super) fn finish(self) -> anyhow::Result<First> {
        if let Some(mut all) = self.all {
            all.flush()?;
        }
        Ok(self.first)
    }
}

impl First {
    /// Prints them, and how many of `all` are not among them.
    pub(super) fn print(&self, all: u64, out: &mut Out) -> anyhow::Result<()> {
        if all == 0 {
            return Ok(());
        }
        writeln!(out)?;
        self.0.print(out, Format::Table, 9)?;
        let more = all.saturating_sub(self.0.rows.len() as u64);
        if more > 0 {
            writeln!(out, "... and {more} more answers; --out - prints all of them as CSV")?;
        }
        Ok(())
    }
}
