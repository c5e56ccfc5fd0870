//! The examples run, and what they assert holds.

#[path = "../examples/bundle.rs"]
mod bundle;

#[test]
fn bundle_runs() {
    bundle::main().unwrap();
}
