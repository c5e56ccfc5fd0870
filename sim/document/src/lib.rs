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
mod layout;
mod lines;
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

/// Adds to `set` the page and the pictures of each configuration, and the page that they share.
/// Returns how many files those are.
///
/// # Errors
/// When a file cannot be written.
pub fn stage(subjects: &[Subject<'_>], command: &str, set: &mut OutputSet) -> Result<usize, DocumentError> {
    let mut files = 1;
    let mut entries = Vec::new();
    for Subject { design, option } in subjects {
        let datapath = design.datapath();
        let name = &design.config().name;
        let scenarios = scenario::scenarios(datapath);
        let text = page::page(design, &scenarios, command, option)?;
        set.write(&format!("{name}.md"), text)?;
        set.write(&format!("{name}-datapath.svg"), block::block(design))?;
        for scenario in &scenarios {
            let file = format!("{name}-{}.svg", scenario.name);
            set.write(&file, timing::timing(datapath, scenario))?;
        }
        files += 2 + scenarios.len();
        entries.push(page::Entry {
            name: name.clone(),
            description: design.config().description.clone(),
            latency: datapath.latency(),
        });
    }
    set.write(COMMON, page::common(&entries, command)?)?;
    Ok(files)
}
