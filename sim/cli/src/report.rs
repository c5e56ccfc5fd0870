//! `blysk report`: the error of every exponent, and the verdict.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::{Args as ClapArgs, ValueEnum};
use hw_model::design::Design;
use hw_model::exponents::{Exponents, parse_exponent};
use vectors::OutputSet;
use vectors::limits::{Sweep, inputs};

use super::bar::Bar;
use super::configuration::Configurations;
use super::out::{Out, Outcome};
use super::output;
use super::report_page::{FILE, page};
use super::table::{Cell, Format, Rows, digits, write_folded};
use analysis::error_report::{ErrorReport, ErrorRow, Options, error_report};
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
    pub(super) range: Range,
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
    pub(super) fn command(&self, option: &str) -> String {
        let range = if self.range == Range::All { " --range all" } else { "" };
        let exhaustive = if self.exhaustive { " --exhaustive" } else { "" };
        format!("blysk report {option} --bound {}{range}{exhaustive} --html", self.bound)
    }
}

/// The x that a verdict is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(super) enum Range {
    /// The epicentre, where x^n >= Q: what [Rom] claims.
    #[default]
    Epicentre,
    /// All of [0, 1].
    All,
}

impl Range {
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Epicentre => "the epicentre",
            Self::All => "all of [0, 1]",
        }
    }

    /// Whether a row keeps the report's bound here.
    const fn holds(self, row: &ErrorRow) -> bool {
        match self {
            Self::Epicentre => row.holds,
            Self::All => row.full_range_holds,
        }
    }

    pub(super) fn outcome<'a>(self, reports: impl IntoIterator<Item = &'a ErrorReport>) -> Outcome {
        let keeps = |report: &ErrorReport| !report.rows.is_empty() && report.rows.iter().all(|row| self.holds(row));
        if reports.into_iter().all(keeps) { Outcome::Good } else { Outcome::Fails }
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
            set.write(FILE, page(args, (design, option), &report, curves)?)?;
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

pub(super) fn percent(fraction: f64) -> String {
    format!("{:.7} %", fraction * 100.0)
}

/// The same screen for a report that was made elsewhere, and its verdict on the epicentre.
pub(super) fn summarise(design: &Design, report: &ErrorReport, out: &mut Out) -> anyhow::Result<Outcome> {
    summary(design, report, out)?;
    Ok(Range::default().outcome([report]))
}

/// One screen: the bound, the worst n and x, and what the error is made of there.
pub(super) fn summary(design: &Design, report: &ErrorReport, out: &mut dyn Write) -> anyhow::Result<()> {
    let Some(worst) = report.worst() else { bail!("there is no exponent to report on") };
    let samples = if report.exhaustive { "every representable x" } else { "sampled x" };
    let seen = report.samples;
    let config = design.config();
    write_folded(out, format!("{}: {}", config.name, config.description).trim_end_matches(": "))?;
    let exponents = design.rom().exponents();
    let list = listed(exponents);
    writeln!(out, "{} exponents ({list}), {samples}: {seen} samples\n", exponents.len())?;
    for range in [Range::Epicentre, Range::All] {
        let (bound, verdict) = (percent(report.bound), verdict(report, range));
        writeln!(out, "bound on {:<15} {bound} {verdict}", range.words())?;
    }
    writeln!(
        out,
        "worst total error        {} at n = {}, x = {}",
        percent(worst.total_abs),
        worst.n,
        digits(worst.total_x, 12)
    )?;
    writeln!(out, "  of it, each at most, and each where it is greatest:")?;
    let parts = [
        ("method", worst.approximation_abs, worst.approximation_x),
        ("ROM coefficients", worst.coefficient_abs, worst.coefficient_x),
        ("data path", worst.datapath_abs, worst.datapath_x),
    ];
    for (name, error, x) in parts {
        writeln!(out, "  {name:<22} {} at x = {}", percent(error), digits(x, 12))?;
    }
    if parts.iter().any(|&(_, error, _)| error > worst.total_abs) {
        writeln!(out, "  (a part is greater than the total: it is so at another x, or others take from it there)")?;
    }
    writeln!(out, "beside it, input         {} (half an ulp of x where x^n is steepest)", percent(worst.input_abs))?;
    if let Some(method) = greatest(report, |row| row.approximation_abs) {
        writeln!(
            out,
            "method alone, absolute   {} at n = {}, x = {}",
            percent(method.approximation_abs),
            method.n,
            digits(method.approximation_x, 12)
        )?;
    }
    if let Some(method) = greatest(report, |row| row.approximation_rel) {
        writeln!(out, "method alone, relative   {} at n = {}", percent(method.approximation_rel), method.n)?;
    }
    if let Some(full) = report.worst_full_range() {
        writeln!(
            out,
            "worst on all of [0, 1]   {} at n = {}, x = {}",
            percent(full.full_range_abs),
            full.n,
            digits(full.full_range_x, 12)
        )?;
    }
    let within = if report.implementation_ulp <= report.budget_ulp { "within" } else { "BEYOND" };
    writeln!(
        out,
        "ROM and data path        {:.4} ulp of the output, {within} the budget of {} ulp",
        report.implementation_ulp, report.budget_ulp
    )?;
    Ok(())
}

/// Whether the bound holds over a range of x, and from which n it does not.
pub(super) fn verdict(report: &ErrorReport, range: Range) -> String {
    let failing = || report.rows.iter().filter(|row| !range.holds(row));
    match failing().next() {
        None if report.rows.is_empty() => "is about no exponent".to_owned(),
        None => "holds for every exponent".to_owned(),
        Some(first) => {
            format!("DOES NOT HOLD for {} of {} exponents, from n = {}", failing().count(), report.rows.len(), first.n)
        }
    }
}

/// The exponents, or their ends where there is no room for all of them.
fn listed(exponents: &Exponents) -> String {
    const MOST: usize = 24;
    let all = exponents.to_string();
    if all.len() > MOST { format!("{} to {}", exponents.first(), exponents.last()) } else { all }
}

/// The first row with the greatest value.
fn greatest(report: &ErrorReport, of: fn(&ErrorRow) -> f64) -> Option<&ErrorRow> {
    report.rows.iter().reduce(|most, row| if of(row) > of(most) { row } else { most })
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

fn comparison(reports: &[ErrorReport], out: &mut Out) -> anyhow::Result<()> {
    let columns = [
        "preset",
        "worst error",
        "at n",
        "at x",
        "method alone",
        "ROM+data path",
        "[0, 1]",
        "on epicentre",
        "on [0, 1]",
    ];
    let mut rows = Rows::new(&columns);
    for report in reports {
        let (Some(worst), Some(full)) = (report.worst(), report.worst_full_range()) else {
            continue;
        };
        let short = |fraction: f64| Cell::from(format!("{:.6} %", fraction * 100.0));
        rows.push(vec![
            Cell::from(report.configuration.clone()),
            short(worst.total_abs),
            Cell::Exponent(worst.n),
            Cell::from(digits(worst.total_x, 8)),
            short(greatest(report, |row| row.approximation_abs).map_or(0.0, |row| row.approximation_abs)),
            Cell::from(format!("{:.3} ulp", report.implementation_ulp)),
            Cell::from(format!("{:.2} %", full.full_range_abs * 100.0)),
            short_verdict(report, Range::Epicentre).into(),
            short_verdict(report, Range::All).into(),
        ]);
    }
    let Some(bound) = reports.first().map(|report| report.bound) else { return Ok(()) };
    writeln!(
        out,
        "Worst total error on the epicentre (x^n >= Q) and on [0, 1], each against the bound of {}:\n",
        percent(bound)
    )?;
    rows.print(out, Format::Table, 6)
}

/// The same in a word or two.
fn short_verdict(report: &ErrorReport, range: Range) -> String {
    let first = report.rows.iter().find(|row| !range.holds(row));
    first.map_or_else(|| "holds".to_owned(), |row| format!("fails, n = {}", row.n))
}

/// Every exponent of every report; the preset's name in front where there are several.
pub(super) fn all_rows(reports: &[ErrorReport], named: bool) -> Rows {
    let mut rows = Rows::new(&files::COLUMNS);
    if named {
        rows.columns.insert(0, "preset".to_owned());
    }
    for report in reports {
        for row in &report.rows {
            let mut cells = cells(row);
            if named {
                cells.insert(0, Cell::from(report.configuration.clone()));
            }
            rows.push(cells);
        }
    }
    rows
}

fn cells(row: &ErrorRow) -> Vec<Cell> {
    let reals = [
        row.n,
        row.approximation_abs,
        row.approximation_rel,
        row.approximation_x,
        row.coefficient_abs,
        row.datapath_abs,
        row.input_abs,
        row.total_abs,
        row.total_x,
        row.full_range_abs,
        row.full_range_x,
    ];
    reals.into_iter().map(Cell::Real).chain([row.holds, row.full_range_holds].map(Cell::Flag)).collect()
}
