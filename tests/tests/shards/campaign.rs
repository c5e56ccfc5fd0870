//! Planning, running and merging in a directory of a test's own.

use blysk_tests::cli::Bench;

/// A job of this work, as JSON.
pub fn job(work: &str) -> String {
    format!("{{\"format\": \"blysk job\", \"version\": 1, \"work\": {work}}}")
}

/// Errors of the configuration in a file, against the default bound.
pub fn errors(file: &str) -> String {
    job(&format!("{{\"errors\": {{\"configuration\": {{\"file\": \"{file}\"}}, \"bound\": 0.0067}}}}"))
}

/// Plans a job in a directory of its own.
pub fn plan(bench: &Bench, job: &str, shards: u32, directory: &str) {
    bench.write("job.json", job);
    let said = bench.good(&format!("shard plan job.json --shards {shards} --out {directory}"));
    assert!(said.contains(&format!(" in {shards} shards")), "{said}");
}

/// Runs every shard of a plan, the last first.
pub fn run_all(bench: &Bench, shards: u32, directory: &str) {
    for index in (0..shards).rev() {
        let said = bench.good(&format!("shard run {directory} --index {index}"));
        assert!(said.contains("pieces measured"), "{said}");
    }
}
