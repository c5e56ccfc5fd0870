//! The examples run, and what they assert holds.

#[path = "../examples/stalled_pipeline.rs"]
mod stalled_pipeline;

#[test]
fn stalled_pipeline_runs() {
    stalled_pipeline::main().unwrap();
}
