//! An HTML page in one file, which needs no network: style sheet, script and data stand in it.
//!
//! A [`Page`] has a title, the command that makes it, a [`Verdict`] and sections; a [`Section`] has paragraphs, tables,
//! plots and pictures. Text is escaped by the template, in which only what says `safe` goes through as it is. Tables
//! can be sorted and searched, plots tell the value of a point; both by script (`assets/`), which computes nothing that
//! is shown: it moves and hides what the page has. The same page gives the same bytes.
//!
//! ```
//! use page::{Page, Section, Standing, Table, Verdict};
//!
//! let mut table = Table::new("Errors", &["n", "error, %"]);
//! table.row(["64".into(), "0.5443".into()]);
//! let mut page = Page::new("Report: compact", "blysk report --preset compact");
//! page.verdict(Verdict::new(Standing::Good, "The bound holds for every exponent."));
//! page.section(Section::new("Rows").table(table));
//! assert!(page.to_html()?.starts_with("<!doctype html>"));
//! # Ok::<(), page::PageError>(())
//! ```
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

pub mod assets;
mod error;
mod figure;
pub mod markdown;
mod section;
mod sheet;
mod table;

pub use error::PageError;
pub use section::Section;
pub use sheet::{Page, Standing, Verdict};
pub use table::{Cell, Table};
