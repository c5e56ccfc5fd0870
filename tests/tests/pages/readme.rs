//! The commands of README, docs/COMMANDS.md and the tutorials work as they are printed, one after the other, in a
//! directory that has nothing but the files of docs/ they name; and what the pages show of their output is there.

use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use crate::tree::{root, text};

/// A command of a page, the exit status that its comment says, 0 where it says none, and the lines of its output that
/// the page shows; `…` is output that is left out.
#[derive(Debug, PartialEq, Eq)]
struct Printed {
    command: String,
    status: i32,
    shown: Vec<String>,
}

/// Commands for a clone of the repository, and those that fetch one: this test is a part of what they do.
const OF_A_CLONE: [&str; 4] = ["cargo", "git", "make", "cd"];

/// The command on a line of a block of README, such as `$ blysk presets   # a comment`.
fn printed(line: &str) -> Option<Printed> {
    let (command, comment) = line.strip_prefix("$ ")?.split_once(" #").unwrap_or((&line[2..], ""));
    let status = comment
        .split("exit status ")
        .nth(1)
        .and_then(|rest| rest.split(|c: char| !c.is_ascii_digit()).next().and_then(|digits| digits.parse().ok()));
    Some(Printed { command: command.trim().to_owned(), status: status.unwrap_or(0), shown: vec![] })
}

/// Whether a command is for a clone: its first word says so, but `make -C` runs what `blysk` wrote.
fn is_of_a_clone(command: &str) -> bool {
    let first = command.split(' ').next().expect("a command has a word");
    OF_A_CLONE.contains(&first) && !command.starts_with("make -C ")
}

/// The commands of the console blocks of a page, in order.
fn commands(page: &str) -> Vec<Printed> {
    let mut block = false;
    let mut found: Vec<Printed> = Vec::new();
    for line in page.lines() {
        if line.starts_with("```") {
            block = line == "```console";
        } else if let Some(command) = printed(line).filter(|_| block) {
            found.push(command);
        } else if let Some(before) = found.last_mut().filter(|_| block) {
            before.shown.push(line.to_owned());
        }
    }
    found.into_iter().filter(|printed| !is_of_a_clone(&printed.command)).collect()
}

/// Copies a directory of files.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a directory of ours");
    for entry in fs::read_dir(from).expect("a directory of the tree") {
        let path = entry.expect("an entry").path();
        fs::copy(&path, to.join(path.file_name().expect("a name"))).expect("a file");
    }
}

fn names(directory: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(directory).expect("a directory of ours");
    entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8")).collect()
}

/// Whether an output has these lines, one right after the other but for what `…` leaves out.
fn shows(said: &str, shown: &[String]) -> bool {
    let mut said = said.lines().map(str::trim_end);
    let mut left_out = false;
    for line in shown {
        if line == "…" {
            left_out = true;
            continue;
        }
        let found = if left_out { said.any(|other| other == line) } else { said.next() == Some(line) };
        if !found {
            return false;
        }
        left_out = false;
    }
    shown.is_empty() || left_out || said.next().is_none()
}

#[test]
fn commands_of_readme_work_in_an_empty_directory() {
    let page = text("README.md");
    assert!(page.lines().count() < 150, "README is for the first minutes");
    let shown = work(&commands(&page));
    assert!(shown > 25, "{shown} lines of output");
}

#[test]
fn commands_of_their_page_work_in_an_empty_directory() {
    let commands = commands(&text("docs/COMMANDS.md"));
    assert!(commands.len() > 20, "{commands:?}");
    work(&commands);
}

/// A tutorial breaks what it wrote, and shows what is said of it.
#[test]
fn commands_of_the_tutorials_work_in_an_empty_directory() {
    for (page, least) in [("hardware", 20), ("verification", 8), ("graphics", 10)] {
        let commands = commands(&text(&format!("docs/tutorial/{page}.md")));
        let shown = work(&commands);
        assert!(commands.len() >= 6 && shown >= least, "{page}: {} commands, {shown} lines of output", commands.len());
    }
}

/// Runs commands in an empty directory; gives how many lines are shown of what they print.
fn work(commands: &[Printed]) -> usize {
    let (programs, directory) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    symlink(env!("CARGO_BIN_EXE_blysk-under-test"), programs.path().join("blysk")).unwrap();
    let path = format!("{}:{}", programs.path().display(), std::env::var("PATH").unwrap());
    let inputs = ["docs/examples", "docs/scenes"];
    for input in inputs {
        copy(&root().join(input), &directory.path().join(input));
    }
    let before = inputs.map(|input| names(&directory.path().join(input)));

    for Printed { command, status, shown } in commands {
        let mut shell = Command::new("bash");
        shell.args(["-euo", "pipefail", "-c", command]).current_dir(directory.path()).env("PATH", &path);
        let run = shell.env_remove("MAKEFLAGS").output().expect("bash is there");
        let output = String::from_utf8_lossy(&run.stdout);
        let said = format!("$ {command}\n{output}{}", String::from_utf8_lossy(&run.stderr));
        assert_eq!(run.status.code(), Some(*status), "{said}");
        assert!(shows(&output, shown), "the page shows\n{}\nof {said}", shown.join("\n"));
    }
    // All outputs are below one directory, which .gitignore has.
    assert_eq!(names(directory.path()), BTreeSet::from(["docs".to_owned(), "results".to_owned()]));
    assert_eq!(inputs.map(|input| names(&directory.path().join(input))), before);
    commands.iter().map(|printed| printed.shown.len()).sum()
}

#[test]
fn what_is_shown_is_there_or_not() {
    let said = "one\ntwo\nthree\n";
    let shows = |shown: &str| shows(said, &shown.lines().map(str::to_owned).collect::<Vec<_>>());
    assert!(["", "one\ntwo\nthree", "one\n…", "…\nthree", "…\ntwo\n…", "one\n…\nthree"].into_iter().all(shows));
    assert!(
        ["one", "two\n…", "one\nthree", "…\ntwo", "one\n…\nfour\n…", "three\n…\none"].into_iter().all(|no| !shows(no))
    );
}

#[test]
fn commands_and_their_statuses_are_found() {
    let page = "$ no\n```console\n$ blysk a --b 1   # words, exit status 1: not so\n$ make test\n\
                $ make -C results/rtl\nwhat it says\n$ cargo install x\n```\n$ no\n```json\n$ no\n```\n";
    let found = commands(page);
    let found: Vec<_> =
        found.iter().map(|printed| (printed.command.as_str(), printed.status, printed.shown.join(","))).collect();
    let said = "what it says".to_owned();
    assert_eq!(found, [("blysk a --b 1", 1, String::new()), ("make -C results/rtl", 0, said)]);
}
