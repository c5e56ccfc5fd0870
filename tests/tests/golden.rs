//! The files in `tests/golden/`, made again by the commands in its README and compared byte for byte.
//!
//! They catch what no other test looks for: a change that was not meant. After one that was meant, rewrite
//! them with `BLYSK_BLESS=1 cargo test -p blysk-tests --test golden` and read the difference.

use std::fs;
use std::path::{Path, PathBuf};

use blysk_tests::bench;
use blysk_tests::cli::tree;

/// What the commands read; everything else beside the README they write.
const SOURCES: [&str; 2] = ["golden.json", "stimulus.csv"];
const README: &str = "README.md";

fn directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("golden")
}

/// A command of the README: its arguments, and the file its standard output goes to.
struct Command {
    arguments: String,
    redirected: Option<String>,
}

fn commands() -> Vec<Command> {
    let readme = fs::read_to_string(directory().join(README)).expect("the README");
    let lines = readme.lines().filter_map(|line| line.strip_prefix("    blysk "));
    lines
        .map(|line| match line.split_once(" > ") {
            Some((arguments, file)) => Command { arguments: arguments.to_owned(), redirected: Some(file.to_owned()) },
            None => Command { arguments: line.to_owned(), redirected: None },
        })
        .collect()
}

#[test]
fn the_golden_files_are_what_their_commands_make() {
    let bench = bench!();
    for (name, _) in bench.tree("") {
        fs::remove_file(bench.path("").join(name)).expect("ours");
    }
    for name in SOURCES {
        bench.write(name, fs::read(directory().join(name)).expect("a source"));
    }
    let commands = commands();
    assert_eq!(commands.len(), 6, "commands in the README");
    for Command { arguments, redirected } in commands {
        let printed = bench.good(&arguments);
        if let Some(file) = redirected {
            bench.write(&file, printed);
        }
    }
    // Of a report only the table: the pictures have tests of their own, and are large.
    for picture in bench.tree("report").into_keys().filter(|name| !name.ends_with("error_vs_n.csv")) {
        fs::remove_file(bench.path("report").join(picture)).expect("ours");
    }

    let made = bench.tree("");
    if std::env::var_os("BLYSK_BLESS").is_some_and(|value| value == "1") {
        bless(&made);
    }
    let mut kept = tree(&directory());
    kept.remove(Path::new(README)).expect("the README");
    let names = |tree: &blysk_tests::cli::Tree| tree.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&made), names(&kept), "files made, files kept");
    for (name, made) in &made {
        let kept = &kept[name];
        assert!(made == kept, "{}", difference(name, made.as_deref(), kept.as_deref()));
    }
}

/// Replaces every golden file but the sources and the README.
fn bless(made: &blysk_tests::cli::Tree) {
    for name in tree(&directory()).into_keys() {
        let path = directory().join(&name);
        let ours = SOURCES.iter().chain([&README]).any(|source| name == Path::new(source));
        if path.is_file() && !ours {
            fs::remove_file(path).expect("a golden file can be removed");
        }
    }
    for (name, contents) in made {
        let path = directory().join(name);
        match contents {
            None => fs::create_dir_all(path).expect("a directory"),
            Some(contents) => fs::write(path, contents).expect("a golden file can be written"),
        }
    }
}

/// The first line in which two files differ.
fn difference(name: &Path, made: Option<&[u8]>, kept: Option<&[u8]>) -> String {
    let text = |bytes: Option<&[u8]>| String::from_utf8_lossy(bytes.unwrap_or_default()).into_owned();
    let (made, kept) = (text(made), text(kept));
    let line = made.lines().zip(kept.lines()).take_while(|(made, kept)| made == kept).count();
    format!(
        "{}, line {}:\n  made {:?}\n  kept {:?}\nIf the change is meant, see {README}.",
        name.display(),
        line + 1,
        made.lines().nth(line),
        kept.lines().nth(line)
    )
}
