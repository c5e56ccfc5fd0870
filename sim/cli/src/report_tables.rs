//! What a report says: the verdict, one screen of words, and tables.

use std::io::Write;

use anyhow::bail;
use clap::ValueEnum;
use hw_model::design::Design;
use hw_model::exponents::Exponents;

use super::out::Outcome;
use super::table::{Cell, Format, Rows, digits, write_folded};
use analysis::error_report::{ErrorReport, ErrorRow};
use analysis::report::files;

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

pub(super) fn percent(fraction: f64) -> String {
    format!("{:.7} %", fraction * 100.0)
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

/// The reports of several configurations, a row for each.
pub(super) fn comparison(reports: &[ErrorReport], out: &mut dyn Write) -> anyhow::Result<()> {
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
