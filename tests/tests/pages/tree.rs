//! The files of the tree, as a fresh clone has them.

use std::fs;
use std::path::{Path, PathBuf};

/// The top of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ is in the repository").to_owned()
}

/// Directories that `.gitignore` names, each with `/` at its end: what a build or a command leaves there is not the
/// tree's.
pub fn ignored() -> Vec<String> {
    let list = fs::read_to_string(root().join(".gitignore")).expect(".gitignore");
    list.lines().filter(|line| line.ends_with('/')).map(str::to_owned).collect()
}

/// Every file and directory of the tree, as paths from its top with `/` between names and after a directory, sorted.
pub fn entries() -> Vec<String> {
    let (root, ignored) = (root(), ignored());
    let mut found = Vec::new();
    let mut waiting = vec![root.clone()];
    while let Some(directory) = waiting.pop() {
        for entry in fs::read_dir(&directory).expect("a directory") {
            let path = entry.expect("an entry").path();
            let name = path.strip_prefix(&root).expect("below the top");
            let mut name = name.to_str().expect("names are UTF-8").to_owned();
            if path.is_dir() {
                name.push('/');
                if name == ".git/" || ignored.contains(&name) {
                    continue;
                }
                waiting.push(path);
            }
            found.push(name);
        }
    }
    found.sort();
    found
}

/// The pages: every Markdown file at the top and below docs/, as paths from the top.
pub fn pages() -> Vec<String> {
    let of_pages = |name: &String| name.ends_with(".md") && (!name.contains('/') || name.starts_with("docs/"));
    let pages: Vec<String> = entries().into_iter().filter(of_pages).collect();
    assert!(pages.iter().any(|page| page == "README.md") && pages.len() > 15, "{pages:?}");
    pages
}

/// The text of a file of the tree.
pub fn text(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}
