//! The page of `blysk pareto --html`: who is dominated by nobody, then tables and plots.

use page::{Page, Section, Standing, Verdict};

use super::html;
use super::pareto_tables::{scope, sections};
use super::table::Rows;
use analysis::pareto::{ContenderRow, ParetoReport};
use analysis::report::pareto_figures::figures;

/// The file of the page, beside the others of a comparison.
pub(super) const FILE: &str = "pareto.html";

/// The whole comparison; `origin` says where synthesis results are from.
pub(super) fn page(report: &ParetoReport, origin: &str, command: String) -> anyhow::Result<String> {
    let mut page = Page::new("What precision costs", command);
    page.lead(scope(report));
    page.verdict(verdict(report));
    for section in sections(report) {
        let part = Section::new(section.title).table(html::table("", &section.rows, html::DIGITS));
        page.section(section.notes.into_iter().fold(part, Section::text));
    }
    let charts = figures(report);
    page.section(charts.iter().try_fold(Section::new("Plots"), |section, (_, chart)| section.plot(chart))?);
    page.section(contenders(report));
    let notes = report.left_out.iter().map(|line| format!("Left out: {line}."));
    let notes = notes.chain([origin.to_owned()]);
    page.section(notes.fold(Section::new("Scope"), Section::text));
    Ok(page.to_html()?)
}

fn contenders(report: &ParetoReport) -> Section {
    let mut rows = Rows::new(&["contender", "what it computes"]);
    for row in &report.contenders {
        rows.push(vec![row.contender.clone().into(), row.what.clone().into()]);
    }
    Section::new("What each computes").table(html::table("", &rows, html::DIGITS))
}

fn verdict(report: &ParetoReport) -> Verdict {
    let front = |of: fn(&ContenderRow) -> Option<bool>| {
        let rows = report.contenders.iter().filter(|row| of(row) == Some(true));
        let names: Vec<&str> = rows.map(|row| row.contender.trim_start_matches("preset ")).collect();
        if names.is_empty() { "none".to_owned() } else { names.join(", ") }
    };
    let (epicentre, whole) = (front(|row| row.hardware_epicentre_front), front(|row| row.hardware_whole_front));
    let seen = if report.exhaustive { "every representable x" } else { "SAMPLED x: greater errors may lie between" };
    Verdict::new(Standing::Plain, format!("Hardware that no other dominates on all of [0, 1]: {whole}."))
        .point("on the epicentre", epicentre)
        .point("errors", format!("of {seen}"))
        .point("contenders", report.contenders.len().to_string())
}
