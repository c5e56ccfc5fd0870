//! `blysk presets`: a list that is true, and configurations that can be used again.

use blysk_tests::bench;
use blysk_tests::cli::{csv_rows, number};
use hw_model::design::Design;
use hw_model::presets::ALL;

#[test]
fn the_list_says_what_the_hardware_is() {
    let bench = bench!();
    let text = bench.good("presets list --format csv");
    assert_eq!(text, bench.good("presets --format csv"));
    let rows = csv_rows(&text);
    assert_eq!(rows.len(), ALL.len());
    for (row, preset) in rows.iter().zip(ALL) {
        let design = Design::new(preset.config().unwrap()).unwrap();
        assert_eq!(row["preset"], preset.name);
        assert_eq!(number(row, "latency"), design.datapath().rank_count() as f64);
        assert_eq!(number(row, "rom_bits"), design.rom().bits() as f64);
        let multipliers = row["multipliers"].split(' ').count();
        let wanted = match preset.name {
            "paper" => 4,
            "schlick" => 1,
            _ => 3,
        };
        assert_eq!(multipliers, wanted, "{row:?}");
    }
}

/// `show NAME > mine.json`, then `--config mine.json`, is `--preset NAME`.
#[test]
fn a_shown_preset_is_the_preset() {
    let bench = bench!();
    for preset in ALL {
        bench.write("mine.json", bench.good(&format!("presets show {}", preset.name)));
        let by = |which: &str| bench.good(&format!("rom {which} --format json"));
        let name = format!("--preset {}", preset.name);
        assert!(by(&name) == by("--config mine.json"), "{}", preset.name);
    }
}

/// The same for a report, of the preset that takes least time.
#[test]
fn a_shown_preset_gives_the_same_report() {
    let bench = bench!();
    bench.write("mine.json", bench.good("presets show schlick"));
    let by_name = bench.run("report --preset schlick --format csv --out by_name");
    let by_file = bench.run("report --config mine.json --format csv --out by_file");
    assert!(!by_name.stdout.is_empty());
    assert_eq!((by_name.status, by_name.stdout), (by_file.status, by_file.stdout));
    assert!(bench.tree("by_name") == bench.tree("by_file"));
}
