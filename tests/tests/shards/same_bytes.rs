//! One, some and many shards give the files of the command that does the same on one machine.

use blysk_tests::bench;
use blysk_tests::cli::{Bench, SMALL};

use super::campaign::{errors, job, plan, run_all};

/// Merges what these numbers of shards found, and compares with a directory of one machine's.
fn merged_is(bench: &Bench, job: &str, splits: &[u32], status: i32, one: &str) {
    for &shards in splits {
        let directory = format!("split-{shards}");
        plan(bench, job, shards, &directory);
        run_all(bench, shards, &directory);
        let run = bench.run(&format!("shard merge {directory} --out merged-{shards}"));
        assert_eq!(run.status, status, "{run:#?}");
        let merged = bench.tree(&format!("merged-{shards}"));
        assert!(!merged.is_empty());
        assert!(merged == bench.tree(one), "{shards} shards: {run:#?}");
    }
}

/// A piece of x holds 2^18 of them: some exponents with five pieces each.
fn finer() -> String {
    SMALL.replace("\"Q2.9\"", "\"UQ1.20\"").replace("1..=8", "1,2.5,64,1000")
}

#[test]
fn errors_are_those_of_one_machine() {
    let bench = bench!();
    bench.write("finer.json", finer());
    let run = bench.run("report --config finer.json --exhaustive --out one");
    assert!(run.status <= 1, "{run:#?}");
    merged_is(&bench, &errors("finer.json"), &[1, 3, 20], run.status, "one");
}

#[test]
fn certificates_of_configurations_are_those_of_one_machine() {
    let bench = bench!();
    std::fs::create_dir(bench.path("one")).unwrap();
    let _said = bench.good("certify --config small.json --out certificate.json");
    let job = job("{\"certify\": {\"hardware\": {\"file\": \"small.json\"}}}");
    same_certificate(&bench, &job, &[1, 3, 8]);
}

#[test]
fn certificates_of_methods_are_those_of_one_machine() {
    let bench = bench!();
    let _said = bench.good("certify --method composite --exponents 1..=2,2.5 --out certificate.json");
    let work = "{\"certify\": {\"exponents\": {\"methods\": [\"composite\"], \"exponents\": \"1..=2,2.5\"}}}";
    same_certificate(&bench, &job(work), &[1, 3, 6]);
    let _said = bench.good("certify --all-real-n --out certificate.json");
    let work = "{\"certify\": {\"every_exponent\": {\"methods\": [\"hermite\"]}}}";
    same_certificate(&bench, &job(work), &[1]);
}

fn same_certificate(bench: &Bench, job: &str, splits: &[u32]) {
    let one = bench.read("certificate.json");
    for &shards in splits {
        let directory = format!("{:x}-{shards}", job.len());
        plan(bench, job, shards, &directory);
        run_all(bench, shards, &directory);
        let _said = bench.good(&format!("shard merge {directory}"));
        assert!(bench.read(&format!("{directory}/merged/certificate.json")) == one, "{shards} shards of {job}");
    }
}
