//! The page in Chromium.

use std::path::Path;
use std::process::Command;

use blysk_tests::bench;

use crate::client::Served;

#[test]
fn the_page_shows_what_evaluate_prints() {
    let bench = bench!();
    let served = Served::start(&bench, &[]);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let output = Command::new(root.join("target/venv/bin/python"))
        .arg(root.join("tests/browser/test_serve.py"))
        .arg(format!("http://127.0.0.1:{}/", served.port))
        .arg(env!("CARGO_BIN_EXE_blysk-under-test"))
        .output()
        .expect("scripts/setup makes target/venv");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.contains(" checks, 0 failed"), "{said}");
}
