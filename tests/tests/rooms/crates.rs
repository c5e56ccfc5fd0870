//! The arrows between crates, from what `cargo metadata` says of the manifests.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use serde::Deserialize;

/// Each crate of the product, and the crates of the workspace that it may know. A room that is not here has no place
/// yet.
const ARROWS: [(&str, &[&str]); 15] = [
    ("hw-model", &[]),
    ("vectors", &["hw-model"]),
    ("sim", &["hw-model", "vectors"]),
    ("model", &["hw-model", "vectors", "sim"]),
    ("blysk-c", &["hw-model", "model"]),
    // Of vectors: the limits of work, progress, and the digests of seals.
    ("bounds", &["hw-model", "vectors"]),
    ("plot", &[]),
    ("page", &["plot"]),
    ("analysis", &["hw-model", "vectors", "bounds", "plot"]),
    ("scenes", &["hw-model", "vectors", "bounds", "plot"]),
    ("blysk-python", &["hw-model", "vectors", "sim", "model", "bounds", "analysis"]),
    ("shard", &["hw-model", "vectors", "bounds", "analysis"]),
    ("document", &["hw-model", "vectors", "sim", "plot", "page"]),
    // What a register can hold is what the reference says of it.
    ("serve", &["hw-model", "vectors", "sim", "analysis", "page", "document"]),
    // What it shows is drawn by those it asks.
    ("cli", &["hw-model", "vectors", "sim", "bounds", "analysis", "scenes", "shard", "page", "document", "serve"]),
];

/// What tests and benchmarks of a crate may know besides: those of the analyses time the clocked
/// simulator too, and those of the C library run the emitted RTL.
const ARROWS_OF_TESTS: [(&str, &str); 2] = [("analysis", "sim"), ("blysk-c", "vectors")];

/// Crates that test, which nothing may depend on but they themselves.
const TESTERS: [&str; 2] = ["blysk-tests", "naive"];

/// Libraries that one crate names and no other.
const AT_HOME: [(&str, &str); 13] = [
    ("kuva", "plot"),
    ("resvg", "plot"),
    ("svg", "plot"),
    ("pulldown-cmark", "page"),
    ("clap", "cli"),
    ("anyhow", "cli"),
    ("indicatif", "cli"),
    ("comfy-table", "cli"),
    ("signal-hook", "cli"),
    ("axum", "serve"),
    ("tokio", "serve"),
    ("pyo3", "blysk-python"),
    ("numpy", "blysk-python"),
];

#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    dependencies: Vec<Dependency>,
}

#[derive(Deserialize)]
struct Dependency {
    name: String,
    /// None is a dependency of the crate itself, `dev` one of its tests.
    kind: Option<String>,
    /// Of a crate of this workspace.
    path: Option<String>,
}

impl Dependency {
    fn is_of_tests(&self) -> bool {
        self.kind.as_deref() == Some("dev")
    }
}

fn packages() -> Vec<Package> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        .output()
        .expect("cargo runs");
    let problem = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{problem}");
    serde_json::from_slice::<Metadata>(&output.stdout).expect("metadata").packages
}

#[test]
fn crates_know_only_those_below_them() {
    let allowed = BTreeMap::from(ARROWS);
    let mut seen = BTreeSet::new();
    for package in packages() {
        let name = package.name.as_str();
        if TESTERS.contains(&name) {
            continue;
        }
        let may = allowed.get(name).unwrap_or_else(|| panic!("{name} has no row in ARROWS"));
        seen.insert(name.to_owned());
        for other in package.dependencies.iter().filter(|other| other.path.is_some()) {
            let known = other.name.as_str();
            let for_tests = other.is_of_tests() && ARROWS_OF_TESTS.contains(&(name, known));
            assert!(may.contains(&known) || for_tests, "{name} may not know {known}");
        }
    }
    assert_eq!(seen.len(), ARROWS.len(), "every crate of ARROWS is in the workspace: {seen:?}");
}

/// A crate stands behind all that it may know: so the table has no circle.
#[test]
fn the_arrows_go_one_way() {
    let places: BTreeMap<&str, usize> = ARROWS.iter().enumerate().map(|(place, &(name, _))| (name, place)).collect();
    for (name, may) in ARROWS {
        for other in may {
            assert!(places[other] < places[name], "{name} stands before {other}");
        }
    }
}

#[test]
fn libraries_are_named_in_their_room_alone() {
    let packages = packages();
    for (library, home) in AT_HOME {
        let names = |package: &&Package| package.dependencies.iter().any(|d| d.name == library);
        let named: Vec<&str> = packages.iter().filter(names).map(|package| package.name.as_str()).collect();
        assert_eq!(named, [home], "{library}");
    }
}
