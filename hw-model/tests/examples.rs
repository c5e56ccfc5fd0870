//! The examples run, and what they assert holds.

#[path = "../examples/highlight.rs"]
mod highlight;

#[test]
fn highlight_runs() {
    highlight::main().unwrap();
}
