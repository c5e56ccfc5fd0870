//! Commands that are killed, or that fail, while they write: afterwards there is the old set, the new set, or files
//! that every reader refuses.
//!
//! `BLYSK_ABORT_AT_STEP` and `BLYSK_FAIL_AT_STEP` (builds with debug assertions have them) stop at each step of a
//! commit that others can see. `BLYSK_KILLS=all` adds the commands that take seconds.

use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use blysk_tests::bench;
use blysk_tests::cli::{Bench, Run, SMALL, Tree};
use vectors::checksum::checksum;
use vectors::verify;
use vectors::whole_file::check_list;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenes/close_up.json");
/// Where the commands write.
const PLACE: &str = "set";

/// A command that writes a set.
struct Case {
    /// Its arguments without the place.
    arguments: String,
    /// Which of the steps are tried: every one, or every third.
    stride: usize,
}

impl Case {
    fn name(&self) -> &str {
        self.arguments.split(' ').next().unwrap_or_default()
    }
}

fn cases() -> Vec<Case> {
    let every = [
        "rom --config small.json".to_owned(),
        "vectors --config small.json --count 40".to_owned(),
        "rtl --config small.json --count 20".to_owned(),
        "simulate --config small.json --stimulus in.csv".to_owned(),
        "document --config small.json".to_owned(),
        format!("specialise {SCENE} --config one.json --count 20"),
    ];
    let some =
        [format!("render {SCENE} --config one.json --size 16x12"), "report --config small.json --bound 1".to_owned()];
    let slow = [
        "claims",
        "stability --config small.json --samples 9",
        "pareto --input UQ1.6 --exponents 1,2 --no-timing",
        "report --all-presets --bound 1",
    ];
    let case = |stride| move |arguments| Case { arguments, stride };
    let mut cases: Vec<Case> = every.into_iter().map(case(1)).chain(some.into_iter().map(case(3))).collect();
    if std::env::var_os("BLYSK_KILLS").is_some_and(|asked| asked == "all") {
        cases.extend(slow.map(str::to_owned).map(case(7)));
    }
    cases
}

fn prepared() -> Bench {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n7,0.25\n");
    bench.write("one.json", SMALL.replace("1..=8", "1,8,64"));
    bench
}

/// Without what a killed command may leave: hidden files, and what they are in.
fn visible(tree: Tree) -> Tree {
    let hidden = |path: &Path| path.components().any(|part| part.as_os_str().to_string_lossy().starts_with(".blysk-"));
    tree.into_iter().filter(|(path, _)| !hidden(path)).collect()
}

/// The files of another run of the command: other contents, and a list of them.
fn older(bench: &Bench, new: &Tree, name: &str) -> Tree {
    let list = format!("{name}.sha256");
    let mut old = Tree::new();
    let mut lines = String::new();
    for (path, contents) in new {
        let shown = path.display().to_string();
        old.insert(path.clone(), contents.as_ref().map(|_| format!("old {shown}\n").into_bytes()));
        if contents.is_some() && shown != list {
            let found = checksum(format!("old {shown}\n").as_bytes()).unwrap();
            lines += &format!("{}  {shown}\n", found.sha256);
        }
    }
    old.insert(list.into(), Some(lines.into_bytes()));
    // A file of the user's.
    old.insert("mine.txt".into(), Some(b"mine".to_vec()));
    lay(bench, &old);
    assert_eq!(check_list(&bench.path(PLACE), name).unwrap().len(), files(&old) - 2);
    old
}

fn files(tree: &Tree) -> usize {
    tree.values().flatten().count()
}

fn lay(bench: &Bench, tree: &Tree) {
    let place = bench.path(PLACE);
    if place.exists() {
        std::fs::remove_dir_all(&place).unwrap();
    }
    std::fs::create_dir(&place).unwrap();
    for (path, contents) in tree {
        match contents {
            None => std::fs::create_dir_all(place.join(path)).unwrap(),
            Some(contents) => {
                std::fs::create_dir_all(place.join(path).parent().unwrap()).unwrap();
                std::fs::write(place.join(path), contents).unwrap();
            }
        }
    }
}

fn arguments(case: &Case) -> Vec<String> {
    let words = case.arguments.split(' ').chain(["--out", PLACE]);
    words.map(str::to_owned).collect()
}

/// Runs the command with a variable; the status is none where it was killed.
fn run_with(bench: &Bench, case: &Case, variable: &str, step: usize) -> (Option<i32>, String) {
    let arguments = arguments(case);
    let list: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let mut command = bench.command(&list);
    let output = command.env(variable, step.to_string()).output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// What a command that was stopped left.
#[derive(Debug, PartialEq)]
enum Left {
    Old,
    New,
    Refused,
}

/// The old files, the new ones, or files that no reader takes.
fn left(bench: &Bench, name: &str, old: &Tree, new: &Tree) -> Left {
    let found = visible(bench.tree(PLACE));
    if found == *old {
        return Left::Old;
    }
    assert_eq!(found.get(Path::new("mine.txt")), old.get(Path::new("mine.txt")));
    let with_mine = |tree: &Tree| {
        let mut tree = tree.clone();
        tree.extend(old.get_key_value(Path::new("mine.txt")).map(|(k, v)| (k.clone(), v.clone())));
        tree
    };
    if found == with_mine(new) {
        return Left::New;
    }
    let place = bench.path(PLACE);
    let refused = check_list(&place, name).unwrap_err().to_string();
    assert!(refused.contains("incomplete") && refused.contains(".sha256"), "{refused}");
    // Readers of one part of the files: where they take it, it is the new one as a whole.
    let whole = |tree: &Tree| {
        let listed = |path: &&std::path::PathBuf| !path.to_string_lossy().ends_with(".sha256");
        tree.keys().filter(listed).all(|path| found.get(path) == tree.get(path))
    };
    match name {
        "specialise" => {
            let run = bench.run(&format!("specialise --check {PLACE}/certificate.json"));
            assert_ne!(run.status, 0, "{run:#?}");
        }
        "vectors" | "rtl" => assert!(verify(&place).is_err() || whole(new)),
        _ => {}
    }
    Left::Refused
}

#[test]
fn killed_or_failed_at_any_step_of_a_commit() {
    let bench = prepared();
    for case in cases() {
        let name = case.name();
        let list = arguments(&case);
        let run: Run = bench.run_list(&list.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(run.status, 0, "{run:#?}");
        let new = bench.tree(PLACE);
        let old = older(&bench, &new, name);
        let mut refused = 0;
        let mut step = 1;
        loop {
            lay(&bench, &old);
            let (status, said) = run_with(&bench, &case, "BLYSK_ABORT_AT_STEP", step);
            let found = left(&bench, name, &old, &new);
            if status.is_some() {
                assert_eq!((status, found), (Some(0), Left::New), "{name} {step}: {said}");
                break;
            }
            assert_eq!(found == Left::Old, step == 1, "{name} {step}: {found:?}");
            refused += usize::from(found == Left::Refused);

            lay(&bench, &old);
            let (status, said) = run_with(&bench, &case, "BLYSK_FAIL_AT_STEP", step);
            assert_eq!(status, Some(2), "{name} {step}: {said}");
            assert!(said.contains("free some space"), "{name} {step}: {said}");
            assert!(bench.tree(PLACE) == old, "{name} {step}: a step that fails leaves the old set");
            step += case.stride;
        }
        // Each file has a step, so that a run without debug assertions, which has none, fails here.
        assert!(refused + 2 >= files(&new) / case.stride, "{name}: {refused} states");

        // Where there is no directory, one step makes it.
        std::fs::remove_dir_all(bench.path(PLACE)).unwrap();
        let before = visible(bench.tree(""));
        for (variable, status) in [("BLYSK_ABORT_AT_STEP", None), ("BLYSK_FAIL_AT_STEP", Some(2))] {
            let (found, said) = run_with(&bench, &case, variable, 1);
            assert_eq!(found, status, "{name}: {said}");
            assert!(visible(bench.tree("")) == before, "{name}");
        }
        let (status, said) = run_with(&bench, &case, "BLYSK_ABORT_AT_STEP", 2);
        assert_eq!(status, Some(0), "{name}: {said}");
        assert!(bench.tree(PLACE) == new, "{name}");
        std::fs::remove_dir_all(bench.path(PLACE)).unwrap();
    }
}

/// Commands of one file: the old one or the new one.
#[test]
fn killed_or_failed_with_one_file() {
    let bench = prepared();
    for command in [
        "mesh --along 9 --sides 3 --out",
        "vectors --config small.json --count 40 --format csv --out",
        "design --exponents 1..=2 --input UQ1.6 --output UQ1.6 --error 0.1 --out",
        "refine --config small.json --reach 1 --out",
        "certify --config small.json --out",
        "simulate --config small.json --stimulus in.csv --trace",
    ] {
        let words: Vec<&str> = command.split(' ').chain(["file"]).collect();
        for variable in ["BLYSK_ABORT_AT_STEP", "BLYSK_FAIL_AT_STEP"] {
            bench.write("file", "old");
            let before = visible(bench.tree(""));
            let output = bench.command(&words).env(variable, "1").output().unwrap();
            assert!(!output.status.success(), "{command} {output:?}");
            assert!(visible(bench.tree("")) == before, "{command} {variable}: {output:?}");
            let output = bench.command(&words).env(variable, "2").output().unwrap();
            assert!(output.status.success(), "{command} {output:?}");
            assert_ne!(bench.text("file"), "old", "{command}");
        }
    }
}

/// SIGKILL after 0, 50, 100, … ms, until the command is done before it.
#[test]
fn killed_every_fifty_milliseconds() {
    let bench = prepared();
    let mut killed = 0;
    for case in cases() {
        let name = case.name();
        let list = arguments(&case);
        let list: Vec<&str> = list.iter().map(String::as_str).collect();
        assert_eq!(bench.run_list(&list).status, 0, "{name}");
        let new = bench.tree(PLACE);
        let old = older(&bench, &new, name);
        for delay in (0..).map(|count| Duration::from_millis(50 * count)) {
            lay(&bench, &old);
            let mut command = bench.command(&list);
            let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            std::thread::sleep(delay);
            let done = child.try_wait().unwrap().is_some();
            child.kill().unwrap();
            child.wait().unwrap();
            let found = left(&bench, name, &old, &new);
            if done {
                assert_eq!(found, Left::New, "{name} after {delay:?}");
                break;
            }
            killed += 1;
        }
        std::fs::remove_dir_all(bench.path(PLACE)).unwrap();
    }
    assert!(killed >= 2 * cases().len() / 2, "{killed} commands were killed");
}

/// A signal that can be handled leaves nothing, whatever was under way.
#[cfg(unix)]
#[test]
fn signals_remove_what_is_under_way() {
    let bench = prepared();
    std::fs::create_dir(bench.path("there")).unwrap();
    bench.write("there/trace.csv", "old");
    let pipe = std::process::Command::new("mkfifo").arg(bench.path("pipe")).status().unwrap();
    assert!(pipe.success());
    std::fs::remove_file(bench.path("pipe")).unwrap();
    let before = bench.tree("");
    for (signal, status) in [("INT", 130), ("TERM", 143)] {
        // More than once: where the signal comes while a file is made is not the same each time.
        for place in ["there", "new", "new/deep"].repeat(20) {
            let pipe = std::process::Command::new("mkfifo").arg(bench.path("pipe")).status();
            assert!(pipe.unwrap().success());
            // The stimulus never comes, and the places are begun before it is waited for.
            let words = ["simulate", "--config", "small.json", "--stimulus", "pipe", "--out", place];
            let mut command = bench.command(&words);
            let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            let begun = Instant::now();
            while !under_way(&bench) {
                assert!(begun.elapsed().as_secs() < 30, "nothing is begun");
                std::thread::sleep(Duration::from_millis(1));
            }
            let kill = format!("kill -{signal} {}", child.id());
            let sent = std::process::Command::new("sh").args(["-c", &kill]).status().unwrap();
            assert!(sent.success());
            assert_eq!(child.wait().unwrap().code(), Some(status), "{signal} {place}");
            std::fs::remove_file(bench.path("pipe")).unwrap();
            assert!(bench.tree("") == before, "{signal} {place}: {:?}", bench.tree("").keys());
        }
    }
}

/// Whether a file has begun in the directory or one below it.
#[cfg(unix)]
fn under_way(bench: &Bench) -> bool {
    let hidden = |directory: &str| {
        let entries = std::fs::read_dir(bench.path(directory)).unwrap();
        let names = entries.flatten().map(|entry| entry.file_name());
        names.filter(|name| name.to_string_lossy().starts_with(".blysk-")).count()
    };
    hidden("") + hidden("there") > 0
}
