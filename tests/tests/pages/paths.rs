//! Every file and directory that a page names is in the tree, and every link leads to a heading that is there.
//!
//! What names a file of the tree, and what names one that a command writes or that the reader has, is told by a rule:
//!
//! - a relative link always names one, seen from its page;
//! - a name with `/` does where its first part is a file or directory at the top of the tree; where it is not, and the
//!   name is in code and ends with `/`, it is the end of a directory's path unless `.gitignore` has its first part;
//! - a name that ends as only sources end (`.rs`, `.py`, `.md`, …) does: commands write no such files but pages, so a
//!   page's name counts in capitals only, as this tree writes them;
//! - in a table whose head says "file in `DIRECTORY/`" the first column's names stand in that directory;
//! - a name with a placeholder in it (`<n>`, `{rank}`, `*`, or a part in capitals such as `DIR`) names nothing.

use std::collections::BTreeSet;

use crate::tree::{entries, ignored, pages, text};

/// Ends of names that only sources have.
const SOURCES: [&str; 3] = [".rs", ".py", ".svh"];

/// The tree, to be asked for names.
struct Tree {
    entries: BTreeSet<String>,
    ignored: Vec<String>,
}

impl Tree {
    fn new() -> Self {
        Self { entries: entries().into_iter().collect(), ignored: ignored() }
    }

    /// A file or a directory of this path, with or without `/` at its end.
    fn has(&self, path: &str) -> bool {
        self.entries.contains(path) || self.entries.contains(&format!("{path}/"))
    }

    /// A file or a directory whose path ends with these parts.
    fn has_end(&self, path: &str) -> bool {
        let end = format!("/{path}");
        self.has(path) || self.entries.iter().any(|entry| entry.ends_with(&end))
    }

    /// What is wrong with a name in the text of a page, if anything is.
    fn objection(&self, name: &Name) -> Option<String> {
        let path = name.text.as_str();
        let (first, rest) = path.split_once('/').unwrap_or((path, ""));
        if let (true, Some(directory)) = (name.code, &name.directory) {
            let below = format!("{directory}{path}");
            return (!self.has(&below)).then(|| format!("there is no {below}"));
        }
        let in_tree = path.contains('/') && self.has(first);
        if in_tree && !rest.is_empty() {
            return (!self.has(path)).then(|| format!("there is no {path}"));
        }
        let source = SOURCES.iter().any(|end| path.len() > end.len() && path.ends_with(end));
        let page = path.strip_suffix(".md").is_some_and(is_capital);
        let directory = name.code && path.ends_with('/') && !self.ignored.contains(&format!("{first}/"));
        let named = source || page || directory;
        (named && !self.has_end(path)).then(|| format!("nothing in the tree ends with {path}"))
    }
}

/// A word of a page that may be a path.
struct Name {
    text: String,
    /// In a code span or a block of code.
    code: bool,
    /// The directory that the table around it says, for names in its first column.
    directory: Option<String>,
}

fn is_capital(part: &str) -> bool {
    part.chars().any(|c| c.is_ascii_uppercase()) && !part.chars().any(|c| c.is_ascii_lowercase())
}

fn is_of_a_path(c: char) -> bool {
    c.is_ascii_alphanumeric() || "_./-<>{}*$+~…".contains(c)
}

/// A placeholder stands in it, or it is a place of the reader's machine.
fn names_nothing(path: &str) -> bool {
    let stem = |part: &str| part.split('.').next().unwrap_or("").to_owned();
    let capital = |part| is_capital(&stem(part)) && stem(part).len() > 1;
    let placeholder = path.contains(|c| "<>{}*$+~…".contains(c));
    let capitals = path.contains('/') && !path.ends_with(".md") && path.split('/').any(capital);
    placeholder || capitals || path.starts_with('/')
}

/// The words of a text that could be paths.
fn words(text: &str) -> impl Iterator<Item = String> {
    let words = text.split(|c| !is_of_a_path(c)).map(|word| word.trim_end_matches(['.', '-']));
    words.filter(|word| word.contains(['/', '.']) && !names_nothing(word)).map(str::to_owned)
}

/// The directory that the head of a table says: `| file in `sim/src/scene/` | holds |`.
fn table_directory(line: &str) -> Option<String> {
    let rest = line.strip_prefix("| file in `")?;
    rest.split('`').next().filter(|name| name.ends_with('/')).map(str::to_owned)
}

/// Names that a page has in its text and code; the targets of its links are apart.
fn names(page: &str) -> Vec<Name> {
    let mut found = Vec::new();
    let mut block = false;
    // A code span may go on in the next line of its paragraph.
    let mut open = false;
    let mut directory = None;
    for line in page.lines() {
        if line.starts_with("```") {
            block = !block;
            continue;
        }
        if block {
            // What cargo is asked for is a matter of cargo: the crate of the command may move.
            let code = if line.starts_with("$ cargo ") { "" } else { line };
            found.extend(words(code).map(|text| Name { text, code: true, directory: None }));
            continue;
        }
        open &= !line.is_empty();
        if !line.starts_with('|') {
            directory = None;
        } else if let Some(said) = table_directory(line) {
            found.push(Name { text: said.clone(), code: true, directory: None });
            directory = Some(said);
            continue;
        }
        let first_column = line.find(" | ").unwrap_or(line.len());
        let mut place = 0;
        let line = without_targets(line);
        for (index, piece) in line.split('`').enumerate() {
            let code = open != (index % 2 == 1);
            let directory = directory.clone().filter(|_| place < first_column);
            found.extend(words(piece).map(|text| Name { text, code, directory: directory.clone() }));
            place += piece.len() + 1;
        }
        open ^= line.matches('`').count() % 2 == 1;
    }
    found
}

/// A line whose links have their texts only.
fn without_targets(line: &str) -> String {
    let mut kept = String::new();
    for (index, piece) in line.split("](").enumerate() {
        let rest = if index == 0 { piece } else { piece.split_once(')').map_or("", |(_, rest)| rest) };
        kept.push_str(rest);
        kept.push(' ');
    }
    kept
}

/// The targets of the links and pictures of a page that lead into the tree or the page itself.
fn targets(page: &str) -> impl Iterator<Item = &str> {
    let targets = page.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.filter(|target| !target.contains("://"))
}

/// A path seen from a page, from the top of the tree.
fn from_top(page: &str, target: &str) -> String {
    let mut parts: Vec<&str> = page.split('/').collect();
    parts.pop();
    for part in target.split('/') {
        if part == ".." {
            parts.pop();
        } else if part != "." {
            parts.push(part);
        }
    }
    parts.join("/")
}

/// The anchors of a page's headings, made as the sites make them that show Markdown.
fn anchors(page: &str) -> BTreeSet<String> {
    let headings = page.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| -> String {
        let text = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = text.chars().filter(|&c| c.is_alphanumeric() || " -_".contains(c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(anchor).collect()
}

#[test]
fn every_file_that_a_page_names_is_there() {
    let tree = Tree::new();
    let (mut seen, mut wrong) = (0, Vec::new());
    for page in pages() {
        for name in names(&text(&page)) {
            seen += 1;
            wrong.extend(tree.objection(&name).map(|why| format!("{page}: {why}")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen > 500, "only {seen} names were looked at");
}

#[test]
fn every_link_leads_somewhere() {
    let tree = Tree::new();
    let (mut seen, mut wrong) = (0, Vec::new());
    for page in pages() {
        let this = text(&page);
        for target in targets(&this) {
            seen += 1;
            let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
            let there = if path.is_empty() { page.clone() } else { from_top(&page, path) };
            if !tree.has(&there) {
                wrong.push(format!("{page}: {target}: there is no {there}"));
            } else if !anchor.is_empty() && !anchors(&text(&there)).contains(anchor) {
                wrong.push(format!("{page}: {target}: {there} has no such heading"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen > 100, "only {seen} links were looked at");
}

#[test]
fn the_rule_tells_files_of_the_tree_from_others() {
    let tree = Tree::new();
    let objections =
        |page: &str| -> Vec<String> { names(page).iter().filter_map(|name| tree.objection(name)).collect() };
    let right = "`docs/scenes/torus_knot.json`, `tests/src/cli.rs`, cli.rs, `scene/description.rs`, \
                 `paper/vectors.mem`, `results/a.json`, `docs/NAME.json`, `hw-model/rtl/*.sv`, `rom.mem`, \
                 `docs/`, README.md, paper.md";
    assert_eq!(objections(right), [""; 0]);
    let wrong = ["docs/none.json", "`sim/none/`", "none.rs", "`none/`", "NONE.md", "`cli/none.rs`"];
    for name in wrong {
        assert_eq!(objections(name).len(), 1, "{name}");
    }
    let table = "| file in `tests/src/` | holds |\n|---|---|\n| `cli.rs`, `none.rs` | `other.csv` |\n";
    assert_eq!(objections(table), ["there is no tests/src/none.rs"]);
    assert_eq!(from_top("docs/hardware/README.md", "../FILES.md"), "docs/FILES.md");
    assert!(anchors("## `blysk rtl --out DIR`\n").contains("blysk-rtl---out-dir"));
}
