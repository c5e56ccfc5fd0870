//! `docs/VERIFICATION.md` from its own text: the files that it prints are written, its commands are run one after the
//! other in an empty directory, and what it shows of their output is there.

use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use crate::tools::Tools;

/// What a reader of the page does, in order.
#[derive(Debug, PartialEq, Eq)]
enum Step {
    /// A file with these contents.
    File { name: String, contents: String },
    /// A command, and the lines of its output that the page shows.
    Command { command: String, shown: Vec<String> },
}

/// The steps of a page. A block of code is a file where the last line of text before it ends with the file's name, in
/// backquotes, and a colon; a `console` block has commands behind `$ `, lines of theirs that end with `\` go on, and
/// the other lines are output. `…` is output that is left out.
fn steps(page: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut lines = page.lines();
    let mut before = "";
    while let Some(line) = lines.next() {
        let Some(language) = line.strip_prefix("```") else {
            before = if line.is_empty() { before } else { line };
            continue;
        };
        let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        if language == "console" {
            steps.extend(commands(&block));
        } else if let Some(name) = before.strip_suffix("`:").and_then(|text| text.rsplit('`').next()) {
            steps.push(Step::File { name: name.to_owned(), contents: block.join("\n") + "\n" });
        }
        before = "";
    }
    steps
}

fn commands(block: &[&str]) -> Vec<Step> {
    let mut found: Vec<(String, Vec<String>)> = Vec::new();
    for line in block {
        match (line.strip_prefix("$ "), found.last_mut()) {
            (Some(command), _) => found.push((command.to_owned(), Vec::new())),
            (None, Some((command, shown))) if command.ends_with('\\') && shown.is_empty() => {
                command.push('\n');
                command.push_str(line);
            }
            (None, Some((_, shown))) if *line != "…" => shown.push((*line).to_owned()),
            (None, _) => {}
        }
    }
    found.into_iter().map(|(command, shown)| Step::Command { command, shown }).collect()
}

/// The sections of the page whose titles begin with a number, each with its text.
fn ways(page: &str) -> Vec<(&str, &str)> {
    let sections = page.split("\n## ").skip(1);
    let named = sections.filter_map(|section| section.split_once('\n'));
    named.filter(|(title, _)| title.starts_with(|c: char| c.is_ascii_digit())).collect()
}

/// Does what a section says, in a directory of its own.
fn follow(title: &str, text: &str, tools: &Tools) {
    let directory = TempDir::new().unwrap();
    let steps = steps(text);
    let run = steps.iter().filter(|step| matches!(step, Step::Command { .. })).count();
    assert!(run > 0, "{title}: no command");
    for step in steps {
        match step {
            Step::File { name, contents } => {
                let file = directory.path().join(&name);
                fs::create_dir_all(file.parent().unwrap_or(Path::new("."))).unwrap();
                fs::write(file, contents).unwrap();
            }
            Step::Command { command, shown } => {
                let mut shell = Command::new("bash");
                shell.args(["-euo", "pipefail", "-c", &command]).current_dir(directory.path());
                tools.installed(&mut shell);
                let done = shell.output().expect("bash is there");
                let said = [done.stdout.as_slice(), done.stderr.as_slice()].concat();
                let said = String::from_utf8_lossy(&said);
                assert!(done.status.success(), "{title}\n$ {command}\n{said}");
                for line in shown {
                    let there = said.lines().any(|found| found.trim_end() == line.trim_end());
                    assert!(there, "{title}\n$ {command}\nshows {line:?}, and there is\n{said}");
                }
            }
        }
    }
}

#[test]
fn every_way_of_the_page_ends_in_a_passing_check() {
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/VERIFICATION.md")).unwrap();
    let ways = ways(&page);
    assert_eq!(ways.len(), 4, "{:?}", ways.iter().map(|way| way.0).collect::<Vec<_>>());
    let tools = Tools::ready();
    for (title, text) in ways {
        follow(title, text, &tools);
    }
}

#[test]
fn files_commands_and_output_are_told_apart() {
    let page = "Put this into `a/b.py`:\n\n```python\nx = 1\n```\n\nand\n\n```json\n{}\n```\n```console\n\
                $ one \\\n    two\n\
                said\n…\n$ three\n```\n";
    let file = Step::File { name: "a/b.py".into(), contents: "x = 1\n".into() };
    let one = Step::Command { command: "one \\\n    two".into(), shown: vec!["said".into()] };
    let three = Step::Command { command: "three".into(), shown: Vec::new() };
    assert_eq!(steps(page), [file, one, three]);
}
