//! `blysk simulate` from outside: the trace and the waves of runs full of stalls, bubbles and resets.
//!
//! The trace is checked against a model of the pipeline that is written down here once more, as short
//! as the rules in `sim/src/pipeline/mod.rs`; the waves against the trace; the printed counts against what
//! can be counted in the trace.

mod counts;
mod formats;
mod names;
mod replay;
mod rules;
mod save_files;
mod stimulus;
mod trace;
mod waves;

use blysk_tests::bench;
use blysk_tests::cli::{Bench, CONFIGURATIONS};
use blysk_tests::waves::Waves;
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::presets;

use stimulus::{Stimulus, patterns};
use trace::Trace;

/// The small configurations and two presets: with and without a divider.
fn designs() -> Vec<(String, Design)> {
    let design = |json: &str| Design::new(Config::from_json(json).unwrap()).unwrap();
    let small = CONFIGURATIONS.map(|(file, json)| (format!("--config {file}"), design(json)));
    let large = ["paper", "compact"].map(|name| {
        let preset = presets::find(name).unwrap();
        (format!("--preset {name}"), design(preset.json))
    });
    small.into_iter().chain(large).collect()
}

/// What one run left, read back.
struct Recorded {
    trace: Trace,
    counts: String,
}

fn simulate(bench: &Bench, which: &str, stimulus: &Stimulus) -> Recorded {
    bench.write("in.csv", stimulus.to_csv());
    let counts = bench.good(&format!("simulate {which} --stimulus in.csv --out run --format json"));
    Recorded { trace: Trace::read(&bench.text("run/trace.csv")), counts }
}

/// Every design under every pattern of stalls, bubbles and resets.
#[test]
fn a_run_keeps_the_rules_and_its_waves_and_counts_agree() {
    let bench = bench!();
    let mut runs = 0;
    for (which, design) in designs() {
        for (pattern, stimulus) in patterns(&design) {
            let place = format!("{which}, {pattern}");
            let recorded = simulate(&bench, &which, &stimulus);
            rules::check(&recorded.trace, &design, &stimulus, &place);
            waves::check(&bench.read("run/waves.vcd"), &recorded.trace, &design, &place);
            formats::check(&bench, &which, &recorded.trace, &design, &place);
            counts::check(&recorded.counts, &recorded.trace, &design, &place);
            runs += 1;
        }
    }
    assert_eq!(runs, 5 * 7, "runs");
}

/// `--out` is `--trace` and `--waves`; either can be had alone.
#[test]
fn the_files_can_be_had_one_by_one() {
    let bench = bench!();
    let (_, design) = designs().swap_remove(0);
    let (_, stimulus) = patterns(&design).swap_remove(0);
    let both = simulate(&bench, "--config small.json", &stimulus);
    let run = "simulate --config small.json --stimulus in.csv --format json";
    for options in ["--trace t.csv", "--waves w.vcd", "--trace new/t.csv --waves new/w.vcd", ""] {
        assert_eq!(bench.good(&format!("{run} {options}")), both.counts);
    }
    for (file, same) in [
        ("t.csv", "run/trace.csv"),
        ("new/t.csv", "run/trace.csv"),
        ("w.vcd", "run/waves.vcd"),
        ("new/w.vcd", "run/waves.vcd"),
    ] {
        assert!(bench.read(file) == bench.read(same), "{file}");
    }
    // The counts in their other formats.
    let csv = bench.good("simulate --config small.json --stimulus in.csv --format csv");
    let table = bench.good("simulate --config small.json --stimulus in.csv");
    counts::same_in_every_format(&both.counts, &csv, &table);
}

/// A name with a hyphen is no identifier: the scope has underscores.
#[test]
fn the_top_scope_is_an_identifier() {
    let bench = bench!();
    let json = blysk_tests::cli::SMALL.replace("\"small\"", "\"small-2-a\"");
    bench.write("hyphen.json", json);
    bench.write("in.csv", "n,x\n1,1\n");
    let _counts = bench.good("simulate --config hyphen.json --stimulus in.csv --waves w.vcd");
    assert!(bench.text("w.vcd").contains("$scope module small_2_a $end"));
    // The longest one.
    let json = blysk_tests::cli::SMALL.replace("\"small\"", &format!("\"{}\"", "n".repeat(100)));
    bench.write("long.json", json);
    let _counts = bench.good("simulate --config long.json --stimulus in.csv --waves w.fst");
    let clock = format!("{}.clk_i", "n".repeat(100));
    assert!(Waves::read(&bench.path("w.fst"), &clock).edges.len() > 1);
}
