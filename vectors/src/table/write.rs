//! Writes `vectors.csv`: a header, then a line for each vector.

use std::io::{self, Write};

use hw_model::datapath::{Datapath, RankRegister, Signals};
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::quantise::{decimal, real};
use hw_model::registers::Register;

use crate::case::Sample;
use crate::reference::reference;

/// Writes `vectors.csv`, line by line.
pub struct TableWriter<'a, W: Write> {
    design: &'a Design,
    columns: Vec<(usize, RankRegister)>,
    csv: csv::Writer<W>,
    line: csv::StringRecord,
}

impl<'a, W: Write> TableWriter<'a, W> {
    /// Writes the header.
    ///
    /// # Errors
    /// When the writer does.
    pub fn new(design: &'a Design, out: W) -> io::Result<Self> {
        let columns = register_columns(design.datapath());
        let mut csv = csv::Writer::from_writer(out);
        csv.write_record(header(design.datapath(), &columns))?;
        Ok(Self { design, columns, csv, line: csv::StringRecord::new() })
    }

    /// Writes one case; `passage` is what each rank holds for it, first to last.
    ///
    /// # Errors
    /// When the writer does.
    pub fn write(&mut self, index: u64, sample: &Sample, passage: &[Signals]) -> io::Result<()> {
        self.line.clear();
        self.input_fields(index, sample);
        for (rank, register) in &self.columns {
            let bits = register.bits(&passage[*rank]);
            self.line.push_field(&bits.to_string());
            self.line.push_field(&hex(bits, register.format));
        }
        if let Some(last) = passage.last() {
            self.output_fields(sample, last);
        }
        self.csv.write_record(&self.line)?;
        Ok(())
    }

    fn input_fields(&mut self, index: u64, sample: &Sample) {
        let (case, format) = (&sample.case, self.design.config().input);
        for field in [
            index.to_string(),
            sample.kind.to_string(),
            case.exponent.map_or_else(String::new, |exponent| exponent.to_string()),
            case.address.to_string(),
            case.x.to_string(),
            hex(case.x, format),
            decimal(case.x, format),
        ] {
            self.line.push_field(&field);
        }
    }

    fn output_fields(&mut self, sample: &Sample, last: &Signals) {
        let (input, output) = (self.design.config().input, self.design.config().output);
        let power = sample.case.exponent.map(|n| reference(n, sample.case.x, input));
        let error = power.map(|power| (real(last.intensity, output) - power) / output.ulp());
        for field in [
            last.intensity.to_string(),
            hex(last.intensity, output),
            decimal(last.intensity, output),
            last.status.bits().to_string(),
            last.status.to_string(),
            power.map_or_else(String::new, |power| format!("{power:.16e}")),
            error.map_or_else(String::new, |error| format!("{error:.6}")),
        ] {
            self.line.push_field(&field);
        }
    }

    /// Hands the writer back, with everything written to it.
    ///
    /// # Errors
    /// When the last of it cannot be written.
    pub fn finish(self) -> io::Result<W> {
        self.csv.into_inner().map_err(csv::IntoInnerError::into_error)
    }
}

/// The computed registers with their ranks, without those that show a port.
fn register_columns(datapath: &Datapath) -> Vec<(usize, RankRegister)> {
    let last = datapath.rank_count() - 1;
    let is_port = |rank, register| match register {
        Register::X => rank == 0,
        Register::Intensity | Register::Status => rank == last,
        _ => false,
    };
    let computed = |rank| {
        let registers = datapath.registers(rank).into_iter();
        registers
            .filter(move |register| register.computed && !is_port(rank, register.register))
            .map(move |register| (rank, register))
    };
    (0..=last).flat_map(computed).collect()
}

fn header(datapath: &Datapath, columns: &[(usize, RankRegister)]) -> Vec<String> {
    let input = ["index", "kind", "n", "address", "x_bits", "x_hex", "x_real"];
    let output = ["intensity_bits", "intensity_hex", "intensity_real", "status", "flags", "reference", "error_ulp"];
    let mut header: Vec<String> = input.map(str::to_owned).into();
    for (rank, register) in columns {
        let name = datapath.register_name(*rank, register);
        header.extend([name.clone(), format!("{name}_hex")]);
    }
    header.extend(output.map(str::to_owned));
    header
}

/// The bits as a memory word in hex, all digits of the format, after `0x`.
#[must_use]
pub fn hex(bits: i64, format: QFormat) -> String {
    format!("0x{:01$x}", format.to_word(bits), format.width().div_ceil(4) as usize)
}
