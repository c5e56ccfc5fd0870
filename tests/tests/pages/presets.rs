//! The table of presets in README says what docs/pareto.csv and docs/synthesis.csv have measured.

use std::collections::BTreeMap;

use hw_model::presets;

use crate::tree::text;

type Row = BTreeMap<String, String>;

fn rows(name: &str) -> Vec<Row> {
    csv::Reader::from_reader(text(name).as_bytes()).deserialize().map(|row| row.expect("a row")).collect()
}

/// A part of 1 in per cent, to four digits.
fn per_cent(part: &str) -> String {
    let value = 100.0 * part.parse::<f64>().expect("a number");
    let before = value.log10().floor() as i32 + 1;
    format!("{value:.*} %", (4 - before.max(0)) as usize)
}

#[test]
fn the_table_of_presets_is_what_was_measured() {
    let (errors, synthesis) = (rows("docs/pareto.csv"), rows("docs/synthesis.csv"));
    let readme = text("README.md");
    for preset in presets::ALL {
        let name = format!("preset {}", preset.name);
        let error = errors.iter().find(|row| row["contender"] == name).expect("a contender");
        let on_ecp5 = |row: &&Row| row["configuration"] == preset.name && row["device"].starts_with("ECP5");
        let built = synthesis.iter().find(on_ecp5).expect("a row");
        let cells = [
            format!("`{}`", preset.name),
            per_cent(&error["epicentre_worst"]),
            per_cent(&error["whole_worst"]),
            error["latency"].clone(),
            built["dsp_blocks"].clone(),
            error["storage_bits"].clone(),
            built["f_max_mhz"].clone(),
        ];
        let row = format!("| {} |", cells.join(" | "));
        assert!(readme.lines().any(|line| line.starts_with(&row)), "{row}");
    }
}
