//! The wheel: built, installed in an environment of its own, and tested there by pytest.

use std::path::Path;
use std::process::Command;

/// `scripts/python` builds and tests; what it printed is the message where it fails. A run that tested nothing fails.
#[test]
fn the_wheel_is_built_and_passes_its_tests() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let output = Command::new(root.join("scripts/python"))
        .args(["--profile", "release-checked", "--blysk", env!("CARGO_BIN_EXE_blysk-under-test")])
        .output()
        .expect("scripts/python runs");
    let told = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
    assert!(output.status.success(), "{told}");
    let passed = told.lines().rev().find_map(|line| line.split_once(" passed"));
    let count = passed.and_then(|(count, _)| count.trim_start_matches(['=', ' ']).parse::<u32>().ok());
    assert!(count.is_some_and(|count| count > 50), "too few tests ran: {told}");
    assert!(!told.contains(" skipped"), "{told}");
}
