//! `docs/SUMMARY.md`, the contents of the book that `make book` builds, names every page of docs/ once, and no other.

use std::collections::BTreeSet;

use crate::tree::{entries, text};

/// The page of a line of the contents, such as `- [Commands](COMMANDS.md)`, from docs/.
fn page(line: &str) -> Option<&str> {
    line.trim_start().strip_prefix("- [")?.split_once("](")?.1.strip_suffix(')')
}

#[test]
fn the_contents_of_the_book_are_the_pages() {
    let contents = text("docs/SUMMARY.md");
    let named: Vec<&str> = contents.lines().filter_map(page).collect();
    let once: BTreeSet<&str> = named.iter().copied().collect();
    assert_eq!(once.len(), named.len(), "a page is named twice: {named:?}");

    let entries = entries();
    let pages: BTreeSet<&str> = entries
        .iter()
        .filter_map(|name| name.strip_prefix("docs/"))
        .filter(|name| name.ends_with(".md") && *name != "SUMMARY.md")
        .collect();
    assert!(pages.len() > 20, "{pages:?}");
    assert_eq!(once, pages, "left: docs/SUMMARY.md, right: the pages below docs/");
}
