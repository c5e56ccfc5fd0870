//! `blysk report`: the error of every exponent, and the verdict.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::Args as ClapArgs;
use hw_model::design::Design;
use hw_model::exponents::parse_exponent;
use vectors::OutputSet;
use vectors::limits::{Sweep, inputs};

use super::bar::Bar;
use super::configuration::Configurations;
use super::out::{Out, Outcome};
use super::output;
use super::report_page::{FILE, page};
use super::report_tables::{Range, all_rows, comparison, summary};
use super::table::Format;
use analysis::error_report::{ErrorReport, Options, error_report};
use analysis::report::files;

/// Measure the error for every exponent and judge it against a bound.
///
/// Approximation (the method alone), coefficient, data-path and input-quantisation error are kept
/// apart; the verdict compares the total on the epicentre with the bound. With --out, the directory
/// gets error_vs_n.csv, error_vs_n.json, and plots as SVG and PNG. Exit status: 0 when the bound holds for
/// every exponent, 1 when it does not, 2 for an error.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk report --preset paper --out results\n          \
                        blysk report --config mine.json --exhaustive --bound 0.005\n          \
                        blysk report --all-presets --out results")]
pub(super) struct Args {
    #[command(flatten)]
    subject: Configurations,
    /// Write the report's files to this directory (with --all-presets: one directory inside for each).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write report.html there too: verdict, plots that tell values and every exponent, in one file.
    #[arg(long, requires = "out")]
    html: bool,
    /// Greatest total error allowed, as a fraction of 1.
    #[arg(long, default_value_t = 0.0067, value_parser = bound)]
    bound: f64,
    /// The x whose verdict is the exit status; the other range's verdict is printed beside it.
    #[arg(long, value_enum, default_value_t)]
    range: Range,
    /// Every representable x, instead of corners and an even spread.
    #[arg(long)]
    exhaustive: bool,
    /// The exponent of the plot of curves (default: 64, or the middle one of the configuration).
    #[arg(long, value_name = "N", value_parser = parse_exponent)]
    curves: Option<f64>,
    /// What to print: a summary (table), or every row (csv, json).
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl Args {
    /// The names of the files of one configuration.
    fn names(&self) -> impl Iterator<Item = String> + use<> {
        files::names().chain(self.html.then(|| FILE.to_owned()))
    }

    /// The command for the configuration that `option` chooses, without the place of its files.
    fn command(&self, option: &str) -> String {
        let range = if self.range == Range::All { " --range all" } else { "" };
        let exhaustive = if self.exhaustive { " --exhaustive" } else { "" };
        format!("blysk report {option} --bound {}{range}{exhaustive} --html", self.bound)
    }
}

pub(super) fn bound(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(bound) if bound > 0.0 && bound <= 1.0 => Ok(bound),
        _ => Err("use a number above 0 and at most 1, such as 0.0067 for 0.67 %".to_owned()),
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    match args.subject.designs()?.as_slice() {
        [(design, option)] if !args.subject.all_presets => one(args, (design, option), out),
        designs => several(args, designs, out),
    }
}

fn one(args: &Args, (design, option): (&Design, &str), out: &mut Out) -> anyhow::Result<Outcome> {
    let begin = |out| output::set(out, "report", &args.subject.files(), args.names());
    let mut set = args.out.as_deref().map(begin).transpose()?;
    let report = measure(args, (design, option), set.as_mut())?;
    commit(set)?;
    match args.format {
        Format::Table => summary(design, &report, out)?,
        format => all_rows(std::slice::from_ref(&report), false).print(out, format, 17)?,
    }
    if let (Some(directory), Format::Table) = (&args.out, args.format) {
        written(&directory.display().to_string(), args, out)?;
    }
    Ok(args.range.outcome([&report]))
}

fn written(place: &str, args: &Args, out: &mut Out) -> std::io::Result<()> {
    let tables: Vec<&str> = files::TABLES.into_iter().chain(args.html.then_some(FILE)).collect();
    let (tables, plots) = (tables.join(", "), files::PLOTS.join(", "));
    writeln!(out, "\nwritten to {place}:\n  {tables}\n  plots as .svg and .png: {plots}")
}

fn commit(set: Option<OutputSet>) -> anyhow::Result<()> {
    set.map(OutputSet::commit).transpose()?;
    Ok(())
}

/// Measures, and adds the files if there is a place for them.
fn measure(args: &Args, (design, option): (&Design, &str), set: Option<&mut OutputSet>) -> anyhow::Result<ErrorReport> {
    let curves = curves_exponent(args.curves, design)?;
    let within = || Sweep::Report.within(inputs(design), design.config().input);
    let samples = args.exhaustive.then(within).transpose()?;
    let options = Options { bound: args.bound, exhaustive: args.exhaustive };
    let bar = Bar::new(samples);
    let report = error_report(design, options, &bar)?;
    bar.finish();
    if let Some(set) = set {
        files::write(set, design, &report, curves)?;
        if args.html {
            set.write(FILE, page(args.range, args.command(option), design, &report, curves)?)?;
        } else {
            set.obsolete(FILE);
        }
    }
    Ok(report)
}

fn curves_exponent(asked: Option<f64>, design: &Design) -> anyhow::Result<f64> {
    let exponents = design.rom().exponents();
    match asked {
        Some(n) if exponents.position(n).is_none() => {
            bail!("--curves {n}: the ROM has no word for it; it has {exponents}")
        }
        Some(n) => Ok(n),
        None => Ok(files::exponent_of_curves(design)),
    }
}

/// The same screen for a report that was made elsewhere, and its verdict on the epicentre.
pub(super) fn summarise(design: &Design, report: &ErrorReport, out: &mut Out) -> anyhow::Result<Outcome> {
    summary(design, report, out)?;
    Ok(Range::default().outcome([report]))
}

/// Every preset: files for each, and one table.
fn several(args: &Args, designs: &[(Design, String)], out: &mut Out) -> anyhow::Result<Outcome> {
    let name = |design: &Design| design.config().name.clone();
    let names = designs.iter().map(|(design, _)| name(design));
    let names = names.flat_map(|directory| args.names().map(move |file| format!("{directory}/{file}")));
    let begin = |out| output::set(out, "report", &[], names);
    let mut set = args.out.as_deref().map(begin).transpose()?;
    let mut reports = Vec::new();
    for (design, option) in designs {
        reports.push(match &mut set {
            Some(set) => set.within(&name(design), |set| measure(args, (design, option), Some(set)))?,
            None => measure(args, (design, option), None)?,
        });
    }
    commit(set)?;
    if args.format == Format::Table {
        comparison(&reports, out)?;
        if let Some(directory) = &args.out {
            written(&directory.join("<preset>").display().to_string(), args, out)?;
        }
    } else {
        all_rows(&reports, true).print(out, args.format, 17)?;
    }
    Ok(args.range.outcome(&reports))
}
