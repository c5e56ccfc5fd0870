//! What is refused: gaps, doubles, results of other jobs and versions, damage, and jobs that are none.

use std::fs;

use blysk_tests::bench;
use blysk_tests::cli::Bench;
use vectors::checksum::checksum;

use super::campaign::{errors, job, plan, run_all};

/// A plan of three shards, all run.
fn campaign() -> Bench {
    let bench = bench!();
    plan(&bench, &errors("small.json"), 3, "campaign");
    run_all(&bench, 3, "campaign");
    bench
}

const RESULT: &str = "campaign/results/shard-00001.json";

/// A sealed file with a piece of its text replaced, sealed again.
fn resealed(text: &str, from: &str, to: &str) -> String {
    let altered = text.replacen(from, to, 1);
    assert_ne!(altered, text, "{from:?} is not in the file");
    let (before, seal) = altered.rsplit_once("\"sha256\": \"").unwrap();
    let (_, after) = seal.split_once('"').unwrap();
    let open = format!("{before}\"sha256\": \"\"{after}");
    let digest = checksum(open.as_bytes()).unwrap().sha256;
    format!("{before}\"sha256\": \"{digest}\"{after}")
}

#[test]
fn a_gap_is_refused() {
    let bench = campaign();
    fs::remove_file(bench.path(RESULT)).unwrap();
    bench.refused("shard merge campaign", &["pieces 2 to 4 are in no result; run shard 1"]);
    for index in [0, 2] {
        fs::remove_file(bench.path(&format!("campaign/results/shard-0000{index}.json"))).unwrap();
    }
    bench.refused("shard merge campaign", &["pieces 0 to 7 are in no result; run shards 0, 1, 2"]);
}

#[test]
fn a_double_is_refused() {
    let bench = campaign();
    bench.write("campaign/results/again.json", bench.read(RESULT));
    bench.refused("shard merge campaign", &["piece 2 is in two results", "again.json", "shard-00001.json"]);
}

#[test]
fn a_result_of_another_job_is_refused() {
    let bench = campaign();
    plan(&bench, &errors("small.json").replace("0.0067", "0.0068"), 3, "other");
    run_all(&bench, 3, "other");
    bench.write(RESULT, bench.read("other/results/shard-00001.json"));
    bench.refused("shard merge campaign", &["shard-00001.json: it is of another job"]);
    let said = bench.good("shard run campaign --index 1");
    assert!(said.contains("not believed") && said.contains("3 pieces measured"), "{said}");
    assert!(bench.run("shard merge campaign").status <= 1);
}

#[test]
fn a_result_of_another_version_or_with_damage_is_refused() {
    let bench = campaign();
    let right = bench.text(RESULT);
    let version = format!("\"blysk\": \"{}\"", env!("CARGO_PKG_VERSION"));
    let error = right.split_once("\"error\": ").unwrap().1.split([',', '\n']).next().unwrap();
    let error = format!("\"error\": {error}");
    let alterations: [(&str, &str, &str); 9] = [
        (&version, "\"blysk\": \"9.9.9\"", "it is of version 9.9.9 of blysk"),
        ("\"version\": 1", "\"version\": 2", "version 2"),
        ("blysk shard result", "blysk shard plan", "it says format"),
        ("\"first\": 2", "\"first\": 3", "its pieces have"),
        ("\"end\": 5", "\"end\": 9", "the job has pieces 0 to 8"),
        ("\"end\": 5", "\"end\": 2", "the job has pieces 0 to 8"),
        ("\"samples\": 513", "\"samples\": 512", "512 samples of address 2: its pieces have 513 samples"),
        ("\"x\": ", "\"x\": 9", "the pieces have x from 0 to 512"),
        (&error, "\"error\": 9.5", "errors are 0 to 2"),
    ];
    for (from, to, said) in alterations {
        bench.write(RESULT, resealed(&right, from, to));
        bench.refused("shard merge campaign", &["shard-00001.json", said]);
        // The same without a new seal.
        bench.write(RESULT, right.replacen(from, to, 1));
        bench.refused("shard merge campaign", &["shard-00001.json"]);
    }
    bench.write(RESULT, &right[..right.len() / 2]);
    bench.refused("shard merge campaign", &["it is not a result as blysk shard run writes it"]);
    bench.write(RESULT, right);
    assert!(bench.run("shard merge campaign").status <= 1);
}

#[test]
fn plans_that_do_not_follow_from_their_job_are_refused() {
    let bench = campaign();
    let right = bench.text("campaign/plan.json");
    let alterations = [
        ("\"pieces\": 8", "\"pieces\": 9", "its digest or its number of pieces is not that of its job"),
        ("\"shards\": 3", "\"shards\": 0", "use 1 to 8"),
        ("\"shards\": 3", "\"shards\": 9", "use 1 to 8"),
        ("\"bound\": 0.0067", "\"bound\": 0.0068", "its digest"),
        ("\"bound\": 0.0067", "\"bound\": 2.0", "errors.bound"),
    ];
    for (from, to, said) in alterations {
        bench.write("campaign/plan.json", resealed(&right, from, to));
        bench.refused("shard merge campaign", &[said]);
        bench.refused("shard run campaign --index 0", &[said]);
        bench.write("campaign/plan.json", right.replacen(from, to, 1));
        bench.refused("shard status campaign", &["plan.json", "sealed"]);
    }
    // What is no configuration is so with any seal.
    let altered = right.replacen("\"1..=8\"", "\"0..=8\"", 1);
    assert_ne!(altered, right);
    bench.write("campaign/plan.json", altered);
    bench.refused("shard merge campaign", &["plan.json", "the exponent 0 is out of range"]);
}

#[test]
fn places_and_numbers_that_do_not_fit_are_refused() {
    let bench = campaign();
    bench.refused("shard run campaign --index 3", &["--index 3: the plan has shards 0 to 2"]);
    bench.refused("shard run nowhere --index 0", &["cannot read the plan nowhere/plan.json"]);
    bench.refused("shard merge nowhere", &["cannot read the plan"]);
    bench.refused("shard plan job.json --shards 4 --out campaign", &["plan of another job, or of another number"]);
    bench.refused("shard plan job.json --shards 0 --out new", &["--shards 0: use 1 to 8"]);
    bench.refused("shard plan job.json --shards 9 --out new", &["--shards 9: use 1 to 8; the job has 8 pieces"]);
    // The same plan again is no other.
    let before = bench.tree("campaign");
    let _said = bench.good("shard plan job.json --shards 3 --out campaign");
    assert!(before == bench.tree("campaign"));
}

#[test]
fn jobs_that_are_none_are_refused() {
    let bench = bench!();
    let hardware = |subject: &str| job(&format!("{{\"certify\": {{\"hardware\": {subject}}}}}"));
    let long = bench.good("presets show compact").replace("UQ1.23", "UQ1.45");
    bench.write("long.json", long);
    let jobs = [
        (String::new(), "the file is empty"),
        ("[]".to_owned(), "job.json"),
        ("{}".to_owned(), "missing field `format`"),
        (errors("small.json").replace("blysk job", "blysk jobs"), "a job says \"blysk job\", version 1"),
        (errors("small.json").replace("\"version\": 1", "\"version\": 2"), "version 2; a job says"),
        (errors("small.json").replace("0.0067", "0"), "the job's errors.bound is 0; use a number above 0"),
        (errors("small.json").replace("0.0067", "1.5"), "the job's errors.bound is 1.5"),
        (errors("small.json").replace("0.0067", "\"1\""), "expected f64"),
        (errors("small.json").replace("\"bound\"", "\"bounds\""), "unknown field `bounds`"),
        (errors("absent.json"), "cannot read the configuration absent.json"),
        (errors("job.json"), "job.json"),
        (errors("long.json"), "the job has 34359738624 pieces, and at most 4294967296 are planned"),
        (hardware("{\"preset\": \"polish\"}"), "polish"),
        (hardware("{\"name\": \"compact\"}"), "unknown variant `name`"),
        (hardware("{\"file\": \"long.json\"}"), "are more than the 1099511627776 (2^40)"),
        (job("{\"polish\": {}}"), "unknown variant `polish`"),
        (job("{\"certify\": {\"every_exponent\": {\"methods\": []}}}"), "name at least one method"),
        (
            job("{\"certify\": {\"every_exponent\": {\"methods\": [\"minimax\"]}}}"),
            "minimax; use methods with a formula",
        ),
        (job("{\"certify\": {\"exponents\": {\"methods\": [\"hermite\"], \"exponents\": \"0\"}}}"), "job.json"),
        (
            job("{\"certify\": {\"every_exponent\": {\"methods\": [\"hermite\"], \"levels\": {\"q\": 2}}}}"),
            "must satisfy 0 < g < q < 1",
        ),
    ];
    for (text, said) in jobs {
        bench.write("job.json", &text);
        bench.refused("shard plan job.json --shards 1 --out campaign", &[said]);
    }
}
