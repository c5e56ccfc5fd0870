//! The claims as a page in Markdown.

use askama::Template;

use crate::claims::{Claim, EXAMINED, Evidence, GREATEST};

#[derive(Template)]
#[template(path = "claims.md", escape = "none")]
struct Page<'a> {
    command: &'a str,
    claims: &'a [Claim],
    examined: u64,
    greatest: u64,
}

/// The page. `command` is what makes it.
///
/// # Errors
/// When the page cannot be filled in.
pub fn page(claims: &[Claim], command: &str) -> Result<String, askama::Error> {
    Page { command, claims, examined: EXAMINED, greatest: GREATEST }.render()
}

/// A link to the heading of a claim: its brackets would be the template's own.
fn link(claim: &Claim) -> String {
    format!("[{0}](#{0})", claim.id)
}

/// The numbers of a claim: what, n, value, allowed.
fn rows(claim: &Claim) -> Vec<[String; 4]> {
    claim
        .evidence
        .iter()
        .map(|evidence| {
            let allowed = evidence.limit.map(|limit| number(limit, evidence.unit));
            [
                evidence.what.clone(),
                evidence.n.map_or_else(|| "-".to_owned(), exponent),
                value(evidence),
                allowed.unwrap_or_else(|| "-".to_owned()),
            ]
        })
        .collect()
}

/// The exponent with the digits that tell it from its neighbours.
fn exponent(n: f64) -> String {
    if n.fract() == 0.0 { n.to_string() } else { format!("{n:.4}") }
}

/// The number with its unit.
#[must_use]
pub fn value(evidence: &Evidence) -> String {
    number(evidence.value, evidence.unit)
}

/// Seven digits: n = 114 and n = 115 differ in the fifth.
fn number(value: f64, unit: &str) -> String {
    let plain = value == 0.0 || (1e-4..1e7).contains(&value.abs());
    let text = match value {
        _ if !plain => format!("{value:.3e}"),
        _ if value.fract() == 0.0 => value.to_string(),
        _ => format!("{value:.7}").trim_end_matches('0').to_owned(),
    };
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_keep_what_tells_them_apart() {
        let shown = [(0.669_956_3, "%", "0.6699563 %"), (17.0, "times", "17 times"), (4.05e-8, "", "4.050e-8")];
        for (value, unit, text) in shown {
            assert_eq!(number(value, unit), text);
        }
        assert_eq!((exponent(1e9), exponent(2.4375)), ("1000000000".to_owned(), "2.4375".to_owned()));
    }
}
