//! Shards as a library: any split gives what one machine finds, and a checkpoint changes no byte.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use analysis::error_report::error_report;
use shard::ShardError;
use shard::job::{Job, Work};
use shard::merge::merge;
use shard::merged::Merged;
use shard::place::Place;
use shard::plan::Plan;
use shard::refused::Refused;
use shard::result::Found;
use shard::run::run;
use shard::status::{State, status};
use tempfile::TempDir;

/// Five pieces for each of four exponents.
const CONFIGURATION: &str = r#"{"name": "finer", "method": "hermite", "exponents": "1,2.5,64,1000", "input": "UQ1.20",
    "output": "UQ1.9", "cut": "minimum"}"#;

const JOB: &str = r#"{"format": "blysk job", "version": 1,
    "work": {"errors": {"configuration": {"file": "finer.json"}, "bound": 0.0067}}}"#;

/// A plan in a directory of its own.
fn planned(shards: u32) -> (TempDir, Plan) {
    let directory = TempDir::new().unwrap();
    fs::write(directory.path().join("finer.json"), CONFIGURATION).unwrap();
    fs::write(directory.path().join("job.json"), JOB).unwrap();
    let job = Job::read(&directory.path().join("job.json")).unwrap();
    let plan = Plan::new(job, shards, Place(directory.path())).unwrap();
    plan.write(Place(directory.path())).unwrap();
    (directory, plan)
}

/// Runs a shard, and returns how many pieces were measured.
fn measured(directory: &Path, index: u32) -> u64 {
    let progress = AtomicU64::new(0);
    let place = Place(directory);
    let (plan, kind) = Plan::read(place).unwrap();
    let ran = run(place, (&plan, &*kind), index, Duration::ZERO, &progress).unwrap();
    assert!(ran.not_believed.is_empty(), "{ran:?}");
    if !ran.measured.is_empty() {
        assert_eq!(progress.load(Ordering::Relaxed), ran.pieces.end - ran.pieces.start);
    }
    ran.measured.end - ran.measured.start
}

#[test]
fn every_split_gives_the_report_of_one_machine() {
    for shards in [1, 3, 20] {
        let (directory, plan) = planned(shards);
        assert_eq!(plan.pieces(), 20);
        for index in (0..shards).rev() {
            let pieces = plan.pieces_of(index).unwrap();
            assert_eq!(measured(directory.path(), index), pieces.end - pieces.start);
            assert_eq!(measured(directory.path(), index), 0, "its result is there");
        }
        let Ok(Merged::Errors { design, report }) = merge(Place(directory.path())) else { panic!("no report") };
        let Work::Errors(work) = &plan.job().work else { panic!("another job") };
        let one = error_report(&design, work.options(), &AtomicU64::new(0)).unwrap();
        assert_eq!(report, one, "{shards} shards");
    }
}

#[test]
fn a_shard_goes_on_from_its_checkpoint_to_the_same_bytes() {
    let (directory, plan) = planned(2);
    let place = Place(directory.path());
    assert_eq!(measured(directory.path(), 1), 10);
    let whole = fs::read(place.result(1)).unwrap();
    // A checkpoint in the middle of a row.
    let (_, kind) = Plan::read(place).unwrap();
    for done in [11, 13, 19] {
        let mut parts = Vec::new();
        for piece in 10..done {
            let part = kind.measure(piece).unwrap();
            kind.join(&mut parts, part);
        }
        fs::remove_file(place.result(1)).unwrap();
        fs::create_dir_all(place.checkpoint(1).parent().unwrap()).unwrap();
        fs::write(place.checkpoint(1), Found::new(&plan, 10..done, parts).to_json()).unwrap();
        let states = status(place).unwrap();
        assert_eq!((&states[0].state, &states[1].state), (&State::Waiting, &State::Begun(done - 10)));
        assert_eq!(measured(directory.path(), 1), 20 - done);
        assert!(fs::read(place.result(1)).unwrap() == whole, "other bytes after a checkpoint at {done}");
        assert!(!place.checkpoint(1).exists());
    }
}

/// Shards that begin together make the same directories, and none of them fails by it.
#[test]
fn shards_may_begin_at_the_same_time() {
    for _ in 0..10 {
        let (directory, _) = planned(20);
        std::thread::scope(|scope| {
            for index in 0..4 {
                let directory = directory.path();
                scope.spawn(move || measured(directory, index));
            }
        });
    }
}

#[test]
fn gaps_and_doubles_are_refused() {
    let (directory, _) = planned(3);
    let place = Place(directory.path());
    let refused = || match merge(place) {
        Err(ShardError::Refused(refused)) => refused,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(), Refused::Gap { first: 0, last: 19, missing: vec![0, 1, 2] });
    for index in [0, 2] {
        measured(directory.path(), index);
    }
    assert_eq!(refused(), Refused::Gap { first: 6, last: 12, missing: vec![1] });
    measured(directory.path(), 1);
    fs::copy(place.result(1), place.results().join("copy.json")).unwrap();
    let said = refused().to_string();
    assert!(said.contains("piece 6 is in two results") && said.contains("copy.json"), "{said}");
    fs::remove_file(place.results().join("copy.json")).unwrap();
    assert!(merge(place).is_ok());
}
