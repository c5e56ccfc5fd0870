//! `blysk stability`: stiff and extreme cases.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::{Args as ClapArgs, ValueEnum};
use hw_model::design::Design;
use hw_model::exponents::Exponents;
use hw_model::fit::Levels;
use vectors::limits::Sweep;
use vectors::whole_file::OutputSet;

use super::bar::Bar;
use super::configuration::MaybeConfiguration;
use super::out::{Out, Outcome};
use super::output;
use super::stability_tables as tables;
use super::table::{Format, write_folded};
use analysis::report::stability::{PartFiles, write};
use analysis::stability::coefficients::coefficient_losses;
use analysis::stability::conditioning::conditioning;
use analysis::stability::edges::edge_report;
use analysis::stability::reference::reference_report;
use analysis::stability::seams::{pairs, seam_report};

/// Measure what stiff and extreme cases cost.
///
/// Five parts: the digits that ways to compute coefficients lose; the condition of the two forms and the widths that
/// it costs; answers at the edges of x, n, formats and ROM words; every pair of neighbouring x (falls, and jumps where
/// one part of the pipeline hands over to another); the f64 reference against exact integers. Edges and seams need a
/// configuration. With --out, each part gets tables as CSV, everything as JSON, and plots as SVG and PNG. Exit
/// status: 0; 1 when an edge is not answered as it must be or the reference errs by more than it promises; 2 for an
/// error.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk stability --part coefficients\n          \
                        blysk stability --config mine.json --out stability\n          \
                        blysk stability --config mine.json --part seams --exponents 2,3 --format csv")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: MaybeConfiguration,
    /// The part of the report to measure.
    #[arg(long, value_enum, default_value_t)]
    part: Part,
    /// Exponents of the configuration that edges and seams look at (default: all).
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    exponents: Option<Exponents>,
    /// How many random cases the part reference computes.
    #[arg(long, value_name = "COUNT", default_value_t = 20_000,
          value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    samples: u64,
    /// Seed of the random cases.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the files to this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// What to print: summaries (table), or every row of one part (csv, json).
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Part {
    /// Digits lost by each way of computing coefficients.
    Coefficients,
    /// Condition of power and centred form, and the widths for 8 to 20 bits.
    Conditioning,
    /// Answers at the edges of x, n, formats and ROM words.
    Edges,
    /// Falls and jumps over every pair of neighbouring x.
    Seams,
    /// The f64 reference against exact integers.
    Reference,
    /// Every part, one after the other.
    #[default]
    All,
}

impl Part {
    fn has(self, part: Self) -> bool {
        self == part || self == Self::All
    }

    fn needs_configuration(self) -> bool {
        matches!(self, Self::Edges | Self::Seams | Self::All)
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = args.configuration.design()?;
    check(args, design.as_ref())?;
    let levels = match &design {
        Some(design) => design.config().levels()?,
        None => Levels::default(),
    };
    let addresses = match &design {
        Some(design) => addresses(args, design)?,
        None => Vec::new(),
    };
    // Made before the work, so that an unwritable place is found at once.
    let inputs = args.configuration.files();
    let begin = |out| output::set(out, "stability", &inputs, names(args.part));
    let set = args.out.as_deref().map(begin).transpose()?;
    let mut session = Session { format: args.format, set, text: Vec::new(), names: Vec::new() };
    let mut holds = true;
    if args.part.has(Part::Coefficients) {
        session.show(&coefficient_losses(levels)?, tables::coefficients)?;
    }
    if args.part.has(Part::Conditioning) {
        session.show(&conditioning(levels)?, tables::conditioning)?;
    }
    if let Some(design) = &design {
        if args.part.has(Part::Edges) {
            let report = edge_report(design, &addresses);
            holds &= report.holds();
            session.show(&report, tables::edges)?;
        }
        if args.part.has(Part::Seams) {
            let bar = Bar::new(u64::try_from(pairs(design, &addresses)).ok());
            let report = seam_report(design, &addresses, &bar);
            bar.finish();
            session.show(&report, tables::seams)?;
        }
    }
    if args.part.has(Part::Reference) {
        let report = reference_report(args.seed, args.samples)?;
        holds &= report.holds();
        session.show(&report, tables::reference)?;
    }
    session.finish(args, out)?;
    Ok(if holds { Outcome::Good } else { Outcome::Fails })
}

/// The names of what the parts write first.
fn names(asked: Part) -> impl Iterator<Item = String> {
    let parts = Part::value_variants().iter().filter(move |&&part| part != Part::All && asked.has(part));
    let names = parts.filter_map(Part::to_possible_value);
    names.flat_map(|part| ["csv", "json"].map(|end| format!("{}.{end}", part.get_name())))
}

fn check(args: &Args, design: Option<&Design>) -> anyhow::Result<()> {
    if args.format != Format::Table && args.part == Part::All {
        bail!("--format csv and json print one part: say --part seams, for example, or --out DIR");
    }
    if design.is_none() && args.part.needs_configuration() {
        bail!(
            "edges and seams are those of a configuration: say --preset NAME or --config FILE, or \
             --part coefficients, conditioning or reference"
        );
    }
    if args.exponents.is_some() && !args.part.needs_configuration() {
        bail!("--exponents is for the parts edges and seams");
    }
    Ok(())
}

/// The ROM addresses that are asked for.
fn addresses(args: &Args, design: &Design) -> anyhow::Result<Vec<u32>> {
    let exponents = design.rom().exponents();
    let asked = args.exponents.as_ref().unwrap_or(exponents);
    let mut addresses = Vec::with_capacity(asked.len());
    for n in asked {
        match exponents.position(n) {
            Some(address) => addresses.push(address as u32),
            None => bail!("--exponents {n}: the ROM has no word for it; it has {exponents}"),
        }
    }
    if args.part.has(Part::Seams) {
        Sweep::Stability.within(pairs(design, &addresses), design.config().input)?;
    }
    Ok(addresses)
}

/// Where the parts go. Nothing is printed before everything is done: an error leaves no half of it.
struct Session {
    format: Format,
    set: Option<OutputSet>,
    text: Vec<u8>,
    names: Vec<String>,
}

impl Session {
    fn show<P: PartFiles>(
        &mut self,
        part: &P,
        people: fn(&P, &mut dyn Write) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        match self.format {
            Format::Table => {
                if !self.text.is_empty() {
                    writeln!(self.text)?;
                }
                people(part, &mut self.text)?;
            }
            Format::Csv => {
                if let Some((_, csv)) = part.tables()?.into_iter().next() {
                    self.text.extend(csv);
                }
            }
            Format::Json => self.text.extend(part.json()?.bytes()),
        }
        if let Some(set) = &mut self.set {
            self.names.extend(write(set, part)?);
        }
        Ok(())
    }

    fn finish(self, args: &Args, out: &mut Out) -> anyhow::Result<()> {
        if let Some(set) = self.set {
            set.commit()?;
        }
        out.write_all(&self.text)?;
        if let (Some(directory), Format::Table) = (&args.out, args.format) {
            let (files, plots): (Vec<_>, Vec<_>) = self.names.into_iter().partition(|name| name.contains('.'));
            writeln!(out, "\nwritten to {}:", directory.display())?;
            write_folded(out, &files.join(", "))?;
            write_folded(out, &format!("plots as .svg and .png: {}", plots.join(", ")))?;
        }
        Ok(())
    }
}
