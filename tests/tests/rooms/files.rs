//! No circle of files inside a crate: what two files share stands in a third, and not in the `mod.rs` above them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Sources of crates without circles.
const CRATES: [&str; 14] = [
    "hw-model/src",
    "hw-model/bindings/c/src",
    "hw-model/bindings/model/src",
    "hw-model/bindings/python/src",
    "vectors/src",
    "sim/src",
    "sim/analysis/src",
    "sim/bounds/src",
    "sim/cli/src",
    "sim/document/src",
    "sim/plot/src",
    "sim/scenes/src",
    "sim/serve/src",
    "sim/shard/src",
];

/// A module, by the names of the way to it.
type Module = Vec<String>;

/// Which modules each module names.
type Graph = BTreeMap<Module, BTreeSet<Module>>;

#[test]
fn no_file_is_known_by_what_it_knows() {
    for sources in CRATES {
        let graph = graph(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(sources));
        assert!(graph.len() > 3, "{sources} has its files elsewhere");
        assert!(graph.values().any(|known| !known.is_empty()), "{sources}: no file knows another");
        if let Some(circle) = circle(&graph) {
            let circle: Vec<String> = circle.iter().map(|module| module.join("::")).collect();
            panic!("{sources}: {}", circle.join(" knows "));
        }
    }
}

#[test]
fn a_circle_is_seen() {
    let module = |name: &str| vec![name.to_owned()];
    let arrow = |from, to| (module(from), BTreeSet::from([module(to)]));
    let mut graph = Graph::from([arrow("a", "b"), arrow("b", "c")]);
    assert_eq!(circle(&graph), None);
    graph.extend([arrow("c", "b")]);
    assert_eq!(circle(&graph), Some(vec![module("b"), module("c"), module("b")]));
}

#[test]
fn paths_are_found_in_use_and_in_expressions() {
    let text = "use crate::a::{b::C, d::{self, E}};\nfn f() { super::g::h(); }";
    let found = paths(text);
    let expected = ["crate::a::b::C", "crate::a::d::self", "crate::a::d::E", "super::g::h"];
    assert_eq!(found, expected.map(|path| path.split("::").map(str::to_owned).collect::<Vec<_>>()));
}

#[test]
fn a_child_is_known_by_its_whole_name() {
    assert!(begins_path("use thiserror::Error; fn f() { error::g() }", "error"));
    assert!(!begins_path("use thiserror::Error; use other::error::E;", "error"));
}

fn graph(sources: &Path) -> Graph {
    let mut files = BTreeMap::new();
    collect(sources, sources, &mut files);
    let known = |(module, file): (&Module, &PathBuf)| {
        let text = without_tests(&fs::read_to_string(file).expect("a source file is read"));
        let own = children(&text);
        let mut known: BTreeSet<Module> = paths(&text).iter().filter_map(|path| target(module, path, &files)).collect();
        // A child is known by its bare name.
        known.extend(own.iter().filter(|name| begins_path(&text, name)).map(|name| {
            let mut child = module.clone();
            child.push((*name).to_owned());
            child
        }));
        known.remove(module);
        (module.clone(), known)
    };
    files.iter().map(known).collect()
}

/// True where a path begins with this name, which is not the end of another one: `error` and not `thiserror`.
fn begins_path(text: &str, name: &str) -> bool {
    let is_end = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    text.match_indices(&format!("{name}::")).any(|(at, _)| !text[..at].ends_with(is_end))
}

/// Every module with a file, tests left out.
fn collect(root: &Path, directory: &Path, files: &mut BTreeMap<Module, PathBuf>) {
    for entry in fs::read_dir(directory).expect("a source directory is read") {
        let path = entry.expect("an entry is read").path();
        let name = path.file_stem().and_then(|name| name.to_str()).expect("a plain name");
        if name == "tests" {
            continue;
        }
        if path.is_dir() {
            collect(root, &path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") && name != "main" {
            let place = path.with_extension("");
            let place = place.strip_prefix(root).expect("below the root");
            let parts = place.iter().filter_map(|part| part.to_str());
            let module = parts.filter(|part| !["mod", "lib"].contains(part)).map(str::to_owned);
            files.insert(module.collect(), path);
        }
    }
}

/// The text without comments, and without what follows the first module of tests.
fn without_tests(text: &str) -> String {
    let end = ["#[cfg(test)]\nmod ", "#[cfg(test)]\npub(crate) mod "].iter().filter_map(|begin| text.find(begin)).min();
    let end = end.unwrap_or(text.len());
    let code = |line: &str| line.split("//").next().unwrap_or_default().to_owned() + "\n";
    text[..end].lines().map(code).collect()
}

/// The modules that a file declares.
fn children(text: &str) -> Vec<&str> {
    text.lines()
        .filter_map(|line| {
            let line = line.trim().strip_suffix(';')?;
            let line = line.strip_prefix("pub ").unwrap_or(line);
            line.strip_prefix("mod ")
        })
        .collect()
}

/// Every path that begins with `crate`, `super` or `self`, groups taken apart.
fn paths(text: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(at) = ["crate::", "super::", "self::"].iter().filter_map(|p| rest.find(p)).min() {
        let before = rest[..at].chars().next_back();
        rest = &rest[at..];
        if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':') {
            rest = &rest[1..];
            continue;
        }
        rest = path(rest, &[], &mut found);
    }
    found
}

/// Takes one path from the front of `text`, adds it or those of its group to `found`, and returns what follows.
fn path<'a>(mut text: &'a str, front: &[String], found: &mut Vec<Vec<String>>) -> &'a str {
    let mut names = front.to_vec();
    loop {
        let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
        if end > 0 {
            names.push(text[..end].to_owned());
        }
        text = &text[end..];
        match text.strip_prefix("::") {
            Some(after) if after.starts_with('{') => return group(&after[1..], &names, found),
            Some(after) => text = after,
            None => break,
        }
        if !text.starts_with(|c: char| c.is_alphanumeric() || c == '_') {
            break;
        }
    }
    found.push(names);
    text
}

fn group<'a>(mut text: &'a str, front: &[String], found: &mut Vec<Vec<String>>) -> &'a str {
    loop {
        text = text.trim_start();
        if let Some(after) = text.strip_prefix('}') {
            return after;
        }
        text = path(text, front, found);
        // ` as name`, and what stands between two paths.
        let end = text.find([',', '}']).unwrap_or(text.len());
        text = &text[end..];
        text = text.strip_prefix(',').unwrap_or(text);
    }
}

/// The module that a path of `from` leads into; none where it is `from` itself.
fn target(from: &Module, path: &[String], files: &BTreeMap<Module, PathBuf>) -> Option<Module> {
    let mut place: Module = if path[0] == "crate" { Vec::new() } else { from.clone() };
    let ups = path.iter().take_while(|name| *name == "super").count();
    place.truncate(place.len().checked_sub(ups)?);
    place.extend(path[ups.max(1)..].iter().cloned());
    while !files.contains_key(&place) {
        place.pop()?;
    }
    (place != *from).then_some(place)
}

/// The first circle there is: from a module back to itself.
fn circle(graph: &Graph) -> Option<Vec<Module>> {
    let mut done = BTreeSet::new();
    graph.keys().find_map(|start| follow(start, graph, &mut Vec::new(), &mut done))
}

fn follow(module: &Module, graph: &Graph, way: &mut Vec<Module>, done: &mut BTreeSet<Module>) -> Option<Vec<Module>> {
    if let Some(begin) = way.iter().position(|earlier| earlier == module) {
        return Some(way[begin..].iter().cloned().chain([module.clone()]).collect());
    }
    if done.contains(module) {
        return None;
    }
    way.push(module.clone());
    let known = graph.get(module).into_iter().flatten();
    let found = known.into_iter().find_map(|next| follow(next, graph, way, done));
    way.pop();
    done.insert(module.clone());
    found
}
