//! The reference of a configuration as one page of HTML: its page in Markdown, the page that all share, and the
//! pictures of both, in one file.

use hw_model::design::Design;
use page::markdown::{self, Link};
use page::{Page, PageError, Standing, Verdict};

use super::COMMON;
use super::page::bound;
use super::words::places;

/// What has been written of a configuration.
pub(super) struct Reference<'a> {
    /// The design that it describes.
    pub(super) design: &'a Design,
    /// Its page in Markdown.
    pub(super) text: String,
    /// Its pictures: names of files, and SVG.
    pub(super) pictures: Vec<(String, String)>,
}

impl Reference<'_> {
    /// The name of the configuration.
    pub(super) fn name(&self) -> &str {
        &self.design.config().name
    }
}

/// The name of the file with a configuration's page.
pub(super) fn file(name: &str) -> String {
    format!("{name}.html")
}

/// The page of one of the references, with links to the others.
pub(super) fn page(
    reference: &Reference<'_>,
    common: &str,
    all: &[Reference<'_>],
    command: &str,
) -> Result<String, PageError> {
    let link = |address: &str| leads(address, reference, all);
    let picture = |address: &str| {
        let found = reference.pictures.iter().find(|(name, _)| name == address);
        found.map(|(name, svg)| {
            format!("<span class=\"picture\" role=\"group\" tabindex=\"0\" aria-label=\"{name}\">{svg}</span>")
        })
    };
    let own = markdown::read(&reference.text, "Overview", &link, &picture);
    let shared = markdown::read(common, "All configurations", &link, &picture);
    let mut page = Page::new(own.title, command);
    page.verdict(verdict(reference.design));
    for section in own.sections.into_iter().chain(shared.sections) {
        page.section(section);
    }
    page.to_html()
}

/// What a designer asks first: whether the error is within its budget, and what the hardware takes.
fn verdict(design: &Design) -> Verdict {
    let (datapath, config) = (design.datapath(), design.config());
    let (bound, budget) = (bound(design), config.error_budget_ulp);
    let standing = if bound <= budget { Standing::Good } else { Standing::Bad };
    let (bound, budget) = (places(bound, 4), places(budget, 6));
    let words = match standing {
        Standing::Good => {
            format!("ROM and data path err by at most {bound} output ulp, within the budget of {budget}.")
        }
        _ => format!("ROM and data path can err by {bound} output ulp, BEYOND the budget of {budget}."),
    };
    Verdict::new(standing, words)
        .point("latency", format!("{} cycles", datapath.latency()))
        .point("x in, intensity out", format!("{}, {}", config.input, config.output))
        .point("ROM", format!("{} words of {} bits", design.rom().depth(), design.rom().layout().word_width()))
        .point("exponents", design.rom().exponents().to_string())
}

/// Where a link of the Markdown leads in the one file.
fn leads(address: &str, reference: &Reference<'_>, all: &[Reference<'_>]) -> Link {
    let (file, heading) = address.split_once('#').unwrap_or((address, ""));
    let name = file.strip_suffix(".md").unwrap_or(file);
    match (file, heading) {
        ("" | COMMON, heading) if !heading.is_empty() => Link::To(format!("#{heading}")),
        (COMMON, _) => Link::To("#all-configurations".to_owned()),
        _ if name == reference.name() => Link::To("#overview".to_owned()),
        _ if all.iter().any(|other| other.name() == name) => Link::To(self::file(name)),
        // A page of the project that stands elsewhere.
        _ => Link::Nowhere,
    }
}
