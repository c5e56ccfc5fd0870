//! The page of `blysk report --html`: the verdict, the summary, the plots and every row.

use std::slice;

use hw_model::design::Design;
use page::{Page, Section, Standing, Verdict};

use super::html;
use super::out::Outcome;
use super::report_tables::{Range, all_rows, percent, summary, verdict};
use super::table::digits;
use analysis::error_report::ErrorReport;
use analysis::report::files;

/// The file of the page, beside the others of a report.
pub(super) const FILE: &str = "report.html";

/// The page of one configuration, which `command` makes. `curves` is the exponent of the plot of curves.
pub(super) fn page(
    range: Range,
    command: String,
    design: &Design,
    report: &ErrorReport,
    curves: f64,
) -> anyhow::Result<String> {
    let name = &report.configuration;
    let mut page = Page::new(format!("Error report: configuration {name}"), command);
    let description = &design.config().description;
    if !description.is_empty() {
        page.lead(format!("{description}."));
    }
    page.verdict(judged(range, report));
    page.section(html::printed("Summary", |out| summary(design, report, out))?);
    let charts = files::charts(design, report, curves);
    page.section(charts.iter().try_fold(Section::new("Plots"), |section, chart| section.plot(chart))?);
    let rows = all_rows(slice::from_ref(report), false);
    let caption = "Fractions of full intensity; every x with xⁿ ≥ Q, and full_range for all of [0, 1]";
    page.section(Section::new("Every exponent").table(html::table(caption, &rows, html::DIGITS)));
    Ok(page.to_html()?)
}

fn judged(range: Range, report: &ErrorReport) -> Verdict {
    let standing = if range.outcome([report]) == Outcome::Good { Standing::Good } else { Standing::Bad };
    let words = format!("On {}, the bound of {} {}.", range.words(), percent(report.bound), verdict(report, range));
    let other = if range == Range::All { Range::Epicentre } else { Range::All };
    let mut judged = Verdict::new(standing, words).point(format!("on {}", other.words()), verdict(report, other));
    if let Some(worst) = report.worst() {
        let at = format!("{} at n = {}, x = {}", percent(worst.total_abs), worst.n, digits(worst.total_x, 12));
        judged = judged.point("worst on the epicentre", at);
    }
    if let Some(worst) = report.worst_full_range() {
        judged =
            judged.point("worst on all of [0, 1]", format!("{} at n = {}", percent(worst.full_range_abs), worst.n));
    }
    let (found, budget) = (report.implementation_ulp, report.budget_ulp);
    judged.point("ROM and data path", format!("{found:.4} ulp of the output; the budget is {budget} ulp"))
}
