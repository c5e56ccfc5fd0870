//! The page of `blysk certify --html`: what is proved, the enclosures and their plot.

use page::{Page, Section, Standing, Verdict};

use super::print::{self, greatest, shortened};
use crate::html;
use crate::table::Format;
use analysis::report::certificate_figure::errors;
use bounds::certify::certificate::{Certificate, Claim};
use bounds::certify::claim::EveryClaim;
/// The page of a certificate. `judged` has the bound that was asked about, and whether it is proved.
pub(super) fn page(certificate: &Certificate, judged: Option<(f64, bool)>, command: String) -> anyhow::Result<String> {
    let claim = certificate.claim();
    let mut page = Page::new("Certified bounds", command);
    page.lead(certificate.statement());
    let verdict = found(claim).into_iter().fold(verdict(judged), |verdict, (of, bounds)| verdict.point(of, bounds));
    page.verdict(verdict);
    page.section(html::printed("Summary", |out| print::claim(claim, Format::Table, out))?);
    if let Some(chart) = errors(claim) {
        page.section(Section::new("Plot").plot(&chart)?);
    }
    page.section(Section::new("Every bound").table(html::table("", &print::rows(claim), html::ALL_DIGITS)));
    Ok(page.to_html()?)
}

fn verdict(judged: Option<(f64, bool)>) -> Verdict {
    match judged {
        Some((bound, true)) => {
            Verdict::new(Standing::Good, format!("Proved: the absolute error on the epicentre is at most {bound}."))
        }
        Some((bound, false)) => {
            let words = format!("NOT PROVED: that the absolute error on the epicentre is at most {bound}.");
            Verdict::new(Standing::Bad, words)
        }
        None => Verdict::new(Standing::Plain, "Proved: the greatest absolute errors lie between these bounds."),
    }
}

/// Each greatest absolute error that is claimed, and the bounds between which it lies.
fn found(claim: &Claim) -> Vec<(String, String)> {
    let between = |lower, upper| format!("{} … {}", shortened(lower, false), shortened(upper, true));
    match claim {
        Claim::Exponents(claims) => greatest(&claims.claims)
            .into_iter()
            .map(|claim| {
                let name = format!("{}, {}, n = {}", claim.method, claim.region.name(), claim.n);
                (name, between(claim.absolute.lower(), claim.absolute.upper()))
            })
            .collect(),
        Claim::EveryExponent(claims) => {
            let every = |claim: &EveryClaim| between(claim.absolute.lower, claim.absolute.upper);
            claims.claims.iter().map(|claim| (format!("{}, every n ≥ 1", claim.method), every(claim))).collect()
        }
        Claim::Hardware(claim) => [("epicentre", &claim.epicentre), ("all of [0, 1]", &claim.full_range)]
            .map(|(range, overall)| (range.to_owned(), between(overall.lower, overall.upper)))
            .into(),
    }
}
