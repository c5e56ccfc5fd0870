//! The page of `blysk certify --html`: what is proved, the enclosures and their plot.

use page::{Page, Section, Standing, Verdict};

use super::print;
use crate::html;
use crate::table::Format;
use analysis::report::certificate_figure::errors;
use bounds::certify::certificate::Certificate;
/// The page of a certificate. `judged` has the bound that was asked about, and whether it is proved.
pub(super) fn page(certificate: &Certificate, judged: Option<(f64, bool)>, command: String) -> anyhow::Result<String> {
    let claim = certificate.claim();
    let mut page = Page::new("Certified bounds", command);
    page.lead(certificate.statement());
    page.verdict(match judged {
        Some((bound, true)) => {
            Verdict::new(Standing::Good, format!("Proved: the absolute error on the epicentre is at most {bound}."))
        }
        Some((bound, false)) => Verdict::new(
            Standing::Bad,
            format!("NOT PROVED: the absolute error on the epicentre is not shown to be at most {bound}."),
        ),
        None => Verdict::new(
            Standing::Plain,
            "Every interval below is proved to hold the greatest error; none was asked to \
                                               stay within a bound (--bound).",
        ),
    });
    page.section(html::printed("Summary", |out| print::claim(claim, Format::Table, out))?);
    if let Some(chart) = errors(claim) {
        page.section(Section::new("Plot").plot(&chart)?);
    }
    page.section(Section::new("Every bound").table(html::table("", &print::rows(claim))));
    Ok(page.to_html()?)
}
