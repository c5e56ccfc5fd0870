//! A shard that is killed goes on from its checkpoint, to the same bytes; and one that is done is not run again.

use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

use blysk_tests::bench;
use blysk_tests::cli::Bench;

use super::campaign::{errors, plan};

/// Some seconds of work.
fn with_much_work() -> Bench {
    let bench = bench!();
    let compact = bench.good("presets show compact");
    bench.write("compact.json", compact.replace("1..=256", "1..=40,40.5,41.5"));
    bench
}

/// Runs a shard until it has written a checkpoint, and kills it so that it cannot tidy up.
fn kill_after_checkpoint(bench: &Bench, directory: &str, index: u32) {
    let arguments = ["shard", "run", directory, "--index", &index.to_string(), "--every", "0"];
    let mut child = bench.command(&arguments).stdout(Stdio::null()).spawn().expect("the command runs");
    let checkpoint = bench.path(&format!("{directory}/checkpoints/shard-{index:05}.json"));
    let begun = Instant::now();
    while !checkpoint.exists() {
        assert!(begun.elapsed() < Duration::from_secs(120), "no checkpoint");
        assert_eq!(child.try_wait().unwrap(), None, "it ended before it could be killed");
        sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    let _status = child.wait().unwrap();
}

#[test]
fn a_killed_shard_goes_on_to_the_same_bytes() {
    let bench = with_much_work();
    let job = errors("compact.json");
    plan(&bench, &job, 2, "killed");
    plan(&bench, &job, 2, "whole");
    kill_after_checkpoint(&bench, "killed", 1);
    let states = bench.run("shard status killed --format csv");
    assert_eq!(states.status, 1, "{states:#?}");
    assert!(states.stdout.contains(",begun") && states.stdout.contains("0,693,0,waiting"), "{states:#?}");
    let said = bench.good("shard run killed --index 1");
    assert!(said.contains("went on from a checkpoint"), "{said}");
    let said = bench.good("shard run whole --index 1");
    assert!(said.contains("693 pieces measured"), "{said}");
    let [killed, whole] = ["killed", "whole"].map(|of| bench.read(&format!("{of}/results/shard-00001.json")));
    assert!(killed == whole, "other bytes after a kill");
    assert!(!bench.path("killed/checkpoints/shard-00001.json").exists(), "a checkpoint is left");
    let said = bench.good("shard run killed --index 1");
    assert!(said.contains("its result is there already"), "{said}");
}

/// A checkpoint with one digit altered is told, and the shard begins anew.
#[test]
fn a_damaged_checkpoint_is_not_believed() {
    let bench = bench!();
    plan(&bench, &errors("small.json"), 1, "campaign");
    std::fs::create_dir(bench.path("campaign/checkpoints")).unwrap();
    let _said = bench.good("shard run campaign --index 0");
    let result = bench.text("campaign/results/shard-00000.json");
    let damaged = result.replacen("\"end\": 8", "\"end\": 7", 1);
    assert_ne!(damaged, result);
    bench.write("campaign/checkpoints/shard-00000.json", damaged);
    std::fs::remove_file(bench.path("campaign/results/shard-00000.json")).unwrap();
    let run = bench.run("shard run campaign --index 0");
    assert!(run.status == 0 && run.stdout.contains("not believed"), "{run:#?}");
    assert!(run.stdout.contains("shard 0: 8 pieces measured"), "{run:#?}");
    assert_eq!(bench.text("campaign/results/shard-00000.json"), result);
}
