//! `blysk rom`: what the coefficient ROM holds.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::{Args as ClapArgs, ValueEnum};
use hw_model::design::Design;
use hw_model::exponents::Exponents;
use hw_model::quantise::{decimal, real};
use hw_model::rom::{Field, Place};
use vectors::rom_image::{ImageFormat, rom_image};

use super::configuration::Configuration;
use super::out::{Out, Outcome};
use super::output;
use super::table::{Cell, Format as TableFormat, Rows};

/// Print the ROM: the layout of a word, and every word with its fields; or the ROM's image for a tool.
///
/// The table shows words and real values; csv and json also each field's integer. The images are for $readmemh (mem),
/// Quartus (hex: Intel HEX with addresses in words; mif) and Vivado's Block Memory Generator (coe).
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk rom --preset compact --exponents 1,2,64\n         \
                        blysk rom --preset compact --format mif > rom.mif\n         \
                        blysk rom --config mine.json --format csv --out roms")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: Configuration,
    /// Print the words of these exponents only.
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    exponents: Option<Exponents>,
    /// How to print the words and their fields.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Also write rom.csv and rom.json to this directory; - prints, and writes none. Of an image, rom.FORMAT is
    /// written there and not printed.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// What is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Format {
    /// For people, at most 100 columns wide.
    #[default]
    Table,
    /// Comma-separated values with a header.
    Csv,
    /// An array of objects.
    Json,
    /// An image for $readmemh.
    Mem,
    /// An image in Intel HEX, addresses counted in words, as Quartus does.
    Hex,
    /// An image as Memory Initialization File (Quartus).
    Mif,
    /// An image as coefficient file (Vivado).
    Coe,
}

impl Format {
    const fn kind(self) -> Result<TableFormat, ImageFormat> {
        match self {
            Self::Table => Ok(TableFormat::Table),
            Self::Csv => Ok(TableFormat::Csv),
            Self::Json => Ok(TableFormat::Json),
            Self::Mem => Err(ImageFormat::Mem),
            Self::Hex => Err(ImageFormat::Hex),
            Self::Mif => Err(ImageFormat::Mif),
            Self::Coe => Err(ImageFormat::Coe),
        }
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = args.configuration.design()?;
    match args.format.kind() {
        Ok(format) => tables(args, &design, format, out),
        Err(format) => image(args, &design, format, out),
    }
}

/// The image of the whole ROM, printed or as a file.
fn image(args: &Args, design: &Design, format: ImageFormat, out: &mut Out) -> anyhow::Result<Outcome> {
    if args.exponents.is_some() {
        bail!("an image has every word of the ROM; leave --exponents out, or say --format table, csv or json");
    }
    let command = format!("blysk rom {} --format {format}", args.configuration.option());
    let image = rom_image(design, format, &command)?;
    let Some(directory) = args.out.as_ref().filter(|path| !output::is_standard_output(path)) else {
        out.write_all(&image)?;
        return Ok(Outcome::Good);
    };
    let name = format!("rom.{format}");
    let mut set = output::set(directory, "rom", &args.configuration.files(), [&name])?;
    set.write(&name, &image)?;
    set.commit()?;
    let (depth, width) = (design.rom().depth(), design.rom().layout().word_width());
    writeln!(out, "{}: {depth} words of {width} bits", directory.join(name).display())?;
    Ok(Outcome::Good)
}

fn tables(args: &Args, design: &Design, format: TableFormat, out: &mut Out) -> anyhow::Result<Outcome> {
    let addresses = addresses(design, args.exponents.as_ref())?;
    let rows = all_fields(design, &addresses);
    let directory = args.out.as_ref().filter(|path| !output::is_standard_output(path));
    let names = ["rom.csv", "rom.json"];
    // Files first: nothing is printed where they cannot be written, and `| head` does not stop them.
    if let Some(directory) = directory {
        let mut set = output::set(directory, "rom", &args.configuration.files(), names)?;
        let (mut csv, mut json) = (Vec::new(), Vec::new());
        rows.csv(&mut csv)?;
        rows.json(&mut json)?;
        let [table, object] = names;
        set.write(table, &csv)?;
        set.write(object, &json)?;
        set.commit()?;
    }
    if format == TableFormat::Table {
        layout(design).print(out, format, 6)?;
        writeln!(out)?;
        for_people(design, &addresses).print(out, format, 6)?;
        let rom = design.rom();
        let (depth, width) = (rom.depth(), rom.layout().word_width());
        writeln!(out, "\n{depth} words of {width} bits, {} bits in all", rom.bits())?;
    } else {
        rows.print(out, format, 17)?;
    }
    Ok(Outcome::Good)
}

/// The addresses of these exponents, or all of them.
pub(super) fn addresses(design: &Design, exponents: Option<&Exponents>) -> anyhow::Result<Vec<u32>> {
    let rom = design.rom();
    let Some(exponents) = exponents else { return Ok((0..rom.depth() as u32).collect()) };
    let mut addresses = Vec::new();
    for exponent in exponents.iter() {
        match rom.exponents().position(exponent) {
            Some(address) => addresses.push(address as u32),
            None => bail!("the ROM has no word for n = {exponent}; it has {}", rom.exponents()),
        }
    }
    Ok(addresses)
}

fn layout(design: &Design) -> Rows {
    let mut rows = Rows::new(&["field", "format", "bits of the word"]);
    for field in design.rom().layout().fields() {
        let place = match field.place {
            Place::Stored { lsb } => format!("{}:{lsb}", lsb + field.format.width() - 1),
            Place::Constant { bits } => format!("constant {}", decimal(bits, field.format)),
        };
        rows.push(vec![Cell::from(field.name.name()), field.format.to_string().into(), place.into()]);
    }
    rows
}

fn word(design: &Design, address: u32) -> String {
    let layout = design.rom().layout();
    let digits = layout.word_width().div_ceil(4) as usize;
    format!("{:0digits$x}", layout.pack(&design.datapath().row(address)))
}

fn stored(design: &Design) -> Vec<Field> {
    let fields = design.rom().layout().fields().iter().copied();
    fields.filter(|field| matches!(field.place, Place::Stored { .. })).collect()
}

/// Address, exponent, and the word.
fn for_people(design: &Design, addresses: &[u32]) -> Rows {
    let mut rows = Rows::new(&["address", "n", "word"]);
    for &address in addresses {
        let exponent = design.rows()[address as usize].exponent;
        let word = word(design, address);
        rows.push(vec![Cell::Integer(address.into()), Cell::Exponent(exponent), word.into()]);
    }
    rows
}

/// Address, exponent, word, and every stored field as an integer and as a real value.
fn all_fields(design: &Design, addresses: &[u32]) -> Rows {
    let fields = stored(design);
    let mut rows = Rows::new(&["address", "n", "word"]);
    for field in &fields {
        rows.columns.push(format!("{}_bits", field.name));
        rows.columns.push(format!("{}_real", field.name));
    }
    for &address in addresses {
        let row = design.datapath().row(address);
        let exponent = design.rows()[address as usize].exponent;
        let mut cells = vec![Cell::Integer(address.into()), Cell::Exponent(exponent), word(design, address).into()];
        for field in &fields {
            let bits = row.get(field.name);
            cells.push(Cell::Integer(bits));
            cells.push(Cell::Real(real(bits, field.format)));
        }
        rows.push(cells);
    }
    rows
}
