//! No line of source, script or page is longer than what a reader's window shows.
//!
//! Exceptions are by rule. A row of a Markdown table and a line with a link cannot be broken. A template, and what a
//! command wrote into a page, is as long as the command's output. The exception for a line without a space is the same:
//! there is no place to break it.

use crate::tree::{entries, text};

/// Characters in a line, at most: `max_width` of rustfmt.toml, which holds for code but not for comments and strings.
const WIDTH: usize = 120;

/// Kinds of files that people read, by the ends of their names.
const KINDS: [&str; 6] = [".rs", ".sv", ".svh", ".py", ".toml", ".md"];

/// Whether people write this file: templates, corpora of broken files and golden outputs are shaped by what reads them.
fn is_written_by_people(name: &str) -> bool {
    let elsewhere = ["/templates/", "tests/fuzz/corpus/", "tests/golden/"];
    KINDS.iter().any(|kind| name.ends_with(kind)) && !elsewhere.iter().any(|place| name.contains(place))
}

/// Whether a command wrote what follows in a page: a mark "made by" or "written by" says so.
fn begins_output(line: &str) -> bool {
    let line = line.to_lowercase();
    let says = line.contains("made by") || line.contains("written by");
    line.starts_with("made by `") || (line.starts_with("<!--") && says)
}

/// Lines that are too long, counted from 1, with their lengths.
fn too_long(name: &str, text: &str) -> Vec<(usize, usize)> {
    let page = name.ends_with(".md");
    let mut output = false;
    let mut found = Vec::new();
    for (index, line) in text.lines().enumerate() {
        output = page && (output || begins_output(line)) && !line.starts_with("<!-- end");
        let length = line.chars().count();
        let bare = line.trim_start().trim_start_matches(['/', '!', '#', '*', '-']).trim();
        let unbreakable = line.contains("](") || line.contains("://") || !bare.contains(' ');
        let row = bare.starts_with('|');
        if length > WIDTH && !output && !unbreakable && !row {
            found.push((index + 1, length));
        }
    }
    found
}

#[test]
fn no_line_is_too_long() {
    let names: Vec<String> = entries().into_iter().filter(|name| is_written_by_people(name)).collect();
    assert!(names.len() > 300, "only {} files of the tree were found", names.len());
    let mut long = Vec::new();
    for name in names {
        let found = too_long(&name, &text(&name));
        long.extend(found.into_iter().map(|(line, length)| format!("{name}:{line}: {length}")));
    }
    assert!(long.is_empty(), "more than {WIDTH} characters in a line:\n{}", long.join("\n"));
}

/// rustfmt breaks code where this test breaks everything else.
#[test]
fn rustfmt_has_the_same_width() {
    assert!(text("rustfmt.toml").lines().any(|line| line == format!("max_width = {WIDTH}")));
}

#[test]
fn exceptions_are_only_those_of_the_rules() {
    let words = "word ".repeat(25);
    let one_word = "x".repeat(130);
    let long = [format!("{words}\n"), format!("/// {words}\n"), format!("a = \"{words}\"\n")];
    for text in &long {
        assert_eq!(too_long("a.rs", text), [(1, text.trim_end_matches('\n').len())], "{text}");
    }
    for text in [format!("| {words} |"), format!("{words} [a](b)"), format!("// {one_word}")] {
        assert_eq!(too_long("a.rs", &text), [], "{text}");
    }
    let page = format!("<!-- table: made by `make synth` -->\n{words}\n<!-- end of table -->\n{words}\n");
    assert_eq!(too_long("a.md", &page), [(4, 125)]);
    assert_eq!(too_long("a.rs", &page), [(2, 125), (4, 125)]);
    assert!(begins_output("Made by `blysk claims --format markdown`; `make docs` makes it again"));
    assert!(!begins_output("This page was made by hand."));
}
