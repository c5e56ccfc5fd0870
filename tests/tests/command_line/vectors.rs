//! `blysk vectors`: the same command, the same bytes; and bytes that are right.

use std::collections::HashSet;

use ::vectors::{Verified, verify};
use blysk_tests::bench;
use blysk_tests::cli::{Bench, CONFIGURATIONS, DIVIDER};
use hw_model::config::Config;
use hw_model::design::Design;

fn design(json: &str) -> Design {
    Design::new(Config::from_json(json).unwrap()).unwrap()
}

/// A bundle that is accepted, and whose every answer is the golden model's.
fn checked(bench: &Bench, directory: &str, design: &Design) -> Verified {
    let verified = verify(bench.path(directory)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(verified.manifest.counts.vectors, verified.vectors.len() as u64);
    for row in &verified.vectors {
        let wanted = design.datapath().evaluate(row.case.address, row.case.x);
        let found = (row.expected.intensity, row.expected.status);
        assert_eq!(found, (wanted.intensity, wanted.status.bits()), "{row:?}");
    }
    let rom = design.rom();
    let words: Vec<_> = rom.rows().iter().map(|row| rom.layout().pack(row)).collect();
    assert_eq!(verified.rom, words);
    verified
}

#[test]
fn the_same_command_gives_the_same_bytes() {
    let bench = bench!();
    for (file, json) in CONFIGURATIONS {
        let design = design(json);
        for strategy in ["mixed", "corners", "even", "random"] {
            let command = format!("vectors --config {file} --strategy {strategy} --count 200 --seed 7");
            let first = bench.good(&format!("{command} --out first"));
            let second = bench.good(&format!("{command} --out deep/second"));
            assert_eq!(first.lines().skip(1).collect::<String>(), second.lines().skip(1).collect::<String>());
            let (first, second) = (bench.tree("first"), bench.tree("deep/second"));
            assert_eq!(first.len(), 7);
            assert!(first == second, "{command}");
            let verified = checked(&bench, "first", &design);
            assert_eq!(verified.manifest.command, format!("blysk {command}"));
            assert_eq!(verified.manifest.counts.requested, 200);
            let count = verified.vectors.len();
            assert!(count == 200 || (strategy == "corners" && (1..200).contains(&count)));
        }
    }
}

#[test]
fn another_seed_gives_other_random_vectors_and_the_same_corners() {
    let bench = bench!();
    let vectors = |strategy: &str, seed: u64| {
        let command = format!("vectors --config small.json --strategy {strategy} --count 96 --seed {seed} --out v");
        let _summary = bench.good(&command);
        bench.text("v/vectors.csv")
    };
    for strategy in ["random", "mixed"] {
        let (first, again, other) = (vectors(strategy, 1), vectors(strategy, 1), vectors(strategy, 2));
        assert!(first == again && first != other, "{strategy}");
    }
    for strategy in ["corners", "even", "exhaustive"] {
        assert!(vectors(strategy, 1) == vectors(strategy, 2), "{strategy}");
    }
}

#[test]
fn the_exhaustive_ones_are_every_value_of_the_ports() {
    let bench = bench!();
    let summary = bench.good("vectors --config divider.json --strategy exhaustive --out all");
    let design = design(DIVIDER);
    let verified = checked(&bench, "all", &design);
    // 4 exponents and at least one address more: 3 bits; x has 9.
    let cases: HashSet<(u32, i64)> = verified.vectors.iter().map(|row| (row.case.address, row.case.x)).collect();
    assert_eq!((cases.len(), verified.vectors.len()), (1 << 12, 1 << 12));
    assert!(cases.iter().all(|(address, x)| *address < 8 && (0..512).contains(x)));
    assert!(summary.contains("4096 vectors, 4 ROM words"), "{summary}");
    assert!(summary.contains(&format!("latency {} cycles", design.datapath().rank_count())));
}

#[test]
fn files_are_replaced_whole() {
    let bench = bench!();
    let _summary = bench.good("vectors --config small.json --count 50 --out v");
    let _summary = bench.good("vectors --config centred.json --count 20 --out v");
    let names: Vec<String> = bench.tree("v").into_keys().map(|name| name.display().to_string()).collect();
    assert_eq!(
        names,
        [
            "expected.mem",
            "manifest.json",
            "negative_control.mem",
            "rom.mem",
            "stimulus.mem",
            "vectors.csv",
            "vectors.sha256"
        ]
    );
    assert_eq!(verify(bench.path("v")).unwrap().vectors.len(), 20);
}

/// On several threads the set is the one that a single one finds, and the summary says how small it is.
#[test]
fn the_fewest_vectors_come_with_their_bound() {
    let bench = bench!();
    let summary = bench.good("vectors --config small.json --strategy compact --out fewest");
    let manifest = verify(bench.path("fewest")).unwrap().manifest;
    let faults = manifest.faults.unwrap();
    assert!(faults.lower_bound <= manifest.counts.vectors && faults.equivalent < faults.faults);
    for said in [
        format!("{} vectors kill {}", manifest.counts.vectors, faults.faults - faults.equivalent),
        format!("fewer than {} does", faults.lower_bound),
    ] {
        assert!(summary.replace('\n', " ").contains(&said), "{summary}");
    }
    let once = bench.text("fewest/faults.csv");
    let _summary = bench.good("vectors --config small.json --strategy compact --out again");
    assert_eq!(once, bench.text("again/faults.csv"));
}
