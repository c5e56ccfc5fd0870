//! The hardware designers' reference of a configuration: a page in Markdown, and pictures.
//!
//! What the pages say of values comes from the data path itself: ranges from integers over every row
//! and every x, waves from the simulator's own run, widths and alignments from the lines that compute.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

mod block;
mod clock;
mod control;
mod divider;
mod examples;
pub mod facts;
mod flip_flops;
mod html;
mod layout;
mod lines;
mod named;
mod page;
mod paths;
mod ports;
mod reasons;
mod registers;
mod scenario;
mod table;
#[cfg(test)]
mod tests;
mod timing;
mod words;

use hw_model::design::Design;
use thiserror::Error;
use vectors::{OutputError, OutputSet};

/// Why there is no reference.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DocumentError {
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A page cannot be filled in.
    #[error("a page cannot be filled in: {0}")]
    Page(#[from] askama::Error),
    /// A page of HTML cannot be written.
    #[error(transparent)]
    Html(#[from] ::page::PageError),
}

/// A configuration to be described.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The design that the pages describe.
    pub design: &'a Design,
    /// The option that chooses the configuration: `--preset compact`.
    pub option: &'a str,
}

/// The page that says what all configurations have in common.
pub const COMMON: &str = "README.md";

/// How the reference is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Pages in Markdown with pictures beside them.
    Markdown,
    /// The same, and for each configuration all of it as one page of HTML.
    Html,
}

/// Adds to `set` the page and the pictures of each configuration, and the page that they share.
/// Returns how many files those are.
///
/// # Errors
/// When a file cannot be written.
pub fn stage(subjects: &[Subject<'_>], form: Form, command: &str, set: &mut OutputSet) -> Result<usize, DocumentError> {
    let mut files = 1;
    let mut entries = Vec::new();
    let mut references = Vec::new();
    for Subject { design, option } in subjects {
        let datapath = design.datapath();
        let name = &design.config().name;
        let scenarios = scenario::scenarios(datapath);
        let text = page::page(design, &scenarios, command, option)?;
        let mut pictures = vec![(format!("{name}-datapath.svg"), block::block(design))];
        for scenario in &scenarios {
            pictures.push((format!("{name}-{}.svg", scenario.name), timing::timing(datapath, scenario)));
        }
        set.write(&format!("{name}.md"), &text)?;
        for (file, picture) in &pictures {
            set.write(file, picture)?;
        }
        files += 2 + scenarios.len();
        entries.push(page::Entry {
            name: name.clone(),
            description: design.config().description.clone(),
            latency: datapath.latency(),
        });
        references.push(html::Reference { design, text, pictures });
    }
    let common = page::common(&entries, command)?;
    if form == Form::Html {
        for reference in &references {
            set.write(&html::file(reference.name()), html::page(reference, &common, &references, command)?)?;
            files += 1;
        }
    }
    set.write(COMMON, common)?;
    Ok(files)
}
