//! Rules of the sources that no lint holds: `unsafe` blocks stand in `pointers.rs`, and every exported function goes
//! through `guard` or cannot panic.

use std::fs;
use std::path::Path;

fn sources() -> Vec<(String, String)> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let entries = fs::read_dir(directory).expect("the sources").flatten().map(|entry| entry.path());
    let name = |path: &Path| path.file_name().and_then(|name| name.to_str()).expect("a name").to_owned();
    entries.map(|path| (name(&path), fs::read_to_string(&path).expect("a source"))).collect()
}

#[test]
fn unsafe_blocks_stand_in_one_module() {
    let with: Vec<String> =
        sources().into_iter().filter(|(_, text)| text.contains("unsafe {")).map(|(name, _)| name).collect();
    assert_eq!(with, ["pointers.rs"]);
}

#[test]
fn exported_functions_are_guarded() {
    // They give back what is there from the start, or take what needs no work.
    let plain = ["blysk_last_error", "blysk_abi_version", "blysk_version"];
    let mut seen = 0;
    for (name, text) in sources() {
        for function in text.split("\n#[unsafe(no_mangle)]\n").skip(1) {
            let body = function.split("\n}").next().expect("a body");
            let guarded =
                ["guard(", "Model::make(", "text(scoreboard", "show(pipeline"].iter().any(|call| body.contains(call));
            assert!(guarded || plain.iter().any(|plain| body.contains(plain)), "{name}: {body}");
            seen += 1;
        }
    }
    assert!(seen > 25, "{seen} exported functions");
}
