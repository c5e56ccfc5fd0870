//! `blysk stability`: its files, its numbers against arithmetic done here, and what it refuses.

use std::collections::BTreeMap;

use blysk_tests::bench;
use blysk_tests::cli::{CONFIGURATIONS, csv_rows, number};
use blysk_tests::reference;
use hw_model::highlight::phong;
use serde_json::Value;

/// Part, its tables, and its plots where the small configuration has something to draw.
const PARTS: [(&str, &[&str], &[&str]); 5] = [
    (
        "coefficients",
        &["coefficients", "coefficients_thresholds"],
        &[
            "coefficients_hermite_power",
            "coefficients_hermite_centred",
            "coefficients_three_point_power",
            "coefficients_three_point_centred",
        ],
    ),
    ("conditioning", &["conditioning", "conditioning_widths"], &["conditioning_forms", "conditioning_widths"]),
    ("edges", &["edges", "edges_variants", "edges_words"], &["edges"]),
    ("seams", &["seams", "seams_hand_overs"], &["seams_steps", "seams_image"]),
    ("reference", &["reference", "reference_totals"], &["reference"]),
];

#[test]
fn the_files_of_every_part() {
    let bench = bench!();
    let all = bench.good("stability --config small.json --samples 300 --out deep/all");
    let mut wanted = Vec::new();
    for (part, tables, plots) in PARTS {
        let options = format!("--config small.json --samples 300 --part {part}");
        let alone = bench.good(&format!("stability {options} --out {part}"));
        let (summary, _) = alone.split_once("\nwritten to ").unwrap();
        assert!(all.contains(summary), "{part}:\n{all}");
        let csv = bench.good(&format!("stability {options} --format csv"));
        assert_eq!(csv, bench.text(&format!("{part}/{part}.csv")), "{part}");
        let json = bench.good(&format!("stability {options} --format json"));
        assert_eq!(json, bench.text(&format!("{part}/{part}.json")), "{part}");
        let json: Value = serde_json::from_str(&json).unwrap();
        for (table, rows) in tables.iter().zip(arrays(&json, part)) {
            let csv = csv_rows(&bench.text(&format!("deep/all/{table}.csv")));
            assert!(!csv.is_empty(), "{table}");
            same(table, &csv, rows);
        }
        let mut own: Vec<String> = tables.iter().map(|table| format!("{table}.csv")).collect();
        own.push(format!("{part}.json"));
        own.extend(plots.iter().flat_map(|plot| [format!("{plot}.svg"), format!("{plot}.png")]));
        for name in &own {
            // The same command, alone or with others: the same bytes.
            assert!(bench.read(&format!("{part}/{name}")) == bench.read(&format!("deep/all/{name}")));
            assert!(!name.ends_with(".png") || bench.read(&format!("{part}/{name}")).len() > 5000);
        }
        wanted.extend(own);
    }
    wanted.push("stability.sha256".to_owned());
    wanted.sort_unstable();
    let found: Vec<String> = bench.tree("deep/all").into_keys().map(|name| name.display().to_string()).collect();
    assert_eq!(found, wanted);
}

/// The tables of a part in its JSON, the one with every row first.
fn arrays<'a>(json: &'a Value, part: &str) -> Vec<&'a Vec<Value>> {
    let names: &[&str] = match part {
        "coefficients" => &["rows", "thresholds"],
        "conditioning" => &["conditions", "widths"],
        "edges" => &["rows", "variants", "words"],
        "seams" => &["rows", "hand_overs"],
        _ => &["rows", "totals"],
    };
    names.iter().map(|name| json[name].as_array().unwrap()).collect()
}

fn same(table: &str, csv: &[BTreeMap<String, String>], json: &[Value]) {
    assert_eq!(csv.len(), json.len(), "{table}");
    for (csv, json) in csv.iter().zip(json) {
        let json = json.as_object().unwrap();
        assert_eq!(csv.len(), json.len(), "{table}");
        for (column, value) in json {
            let cell = &csv[column];
            match value {
                Value::Null => {
                    assert!(cell.is_empty() || cell == "NaN", "{table}.{column}: {cell}")
                }
                Value::String(text) => assert_eq!(cell, text, "{table}.{column}"),
                Value::Bool(flag) => assert_eq!(*cell, flag.to_string(), "{table}.{column}"),
                value => assert_eq!(value.as_f64(), Some(number(csv, column)), "{table}.{column}"),
            }
        }
    }
}

/// The loss of the naive way at whole decades, against the table of 32 digits.
#[test]
fn digits_are_lost_as_the_reference_table_says() {
    let bench = bench!();
    let rows = csv_rows(&bench.good("stability --part coefficients --format csv"));
    let mut compared = 0;
    for known in reference::rows().iter().filter(|row| row.method == "hermite") {
        let n = known.exponent;
        if n < 10.0 {
            continue;
        }
        let found = |way: &str| {
            rows.iter().find(|row| {
                row["method"] == "hermite" && row["form"] == "centred" && row["way"] == way && number(row, "n") == n
            })
        };
        let Some(naive) = found("naive") else { continue };
        let q = phong(1.0 / n, 0.5);
        let p = 1.0 - q;
        let d1 = -0.5 / p;
        let d2 = (-(n * 0.5 / q) - d1) / p;
        let d3 = 0.5 * (n - 1.0) / (q * q) - d2;
        let computed = [-(d1 - p * d2 + p * p * d3), d2 - 2.0 * p * d3, -d3];
        let lost = computed.iter().zip(["k1", "k2", "k3"]).map(|(computed, name)| {
            let exact = known.value(name).unwrap();
            ((computed / exact - 1.0).abs() * 53_f64.exp2()).log10()
        });
        let lost = lost.fold(0.0, f64::max);
        // The table's values are f64 here: a loss of 2 digits is known to one in a hundred of itself.
        assert!((number(naive, "digits_lost") - lost).abs() < 0.02 + 10_f64.powf(-lost), "n = {n}");
        let fit = found("fit").unwrap();
        assert!(number(fit, "digits_lost") < 0.1, "n = {n}");
        compared += 1;
    }
    assert!(compared >= 6, "{compared} exponents compared");
}

/// Every pair of neighbouring x, from the vectors that another engine wrote.
#[test]
fn seams_are_those_of_the_vectors() {
    let bench = bench!();
    for (file, _) in CONFIGURATIONS {
        let _summary = bench.good(&format!("vectors --config {file} --strategy exhaustive --out v"));
        let vectors = csv_rows(&bench.text("v/vectors.csv"));
        let seams = csv_rows(&bench.good(&format!("stability --config {file} --part seams --format csv")));
        let fraction = if file == "centred.json" { 9 } else { 8 };
        let mut compared = 0;
        for row in &seams {
            let n = number(row, "n");
            let one = if file == "centred.json" { 1024.0 } else { 512.0 };
            let mut answers: Vec<(i64, i64)> = vectors
                .iter()
                .filter(|vector| vector["n"] == row["n"].trim_end_matches(".0"))
                .map(|vector| (number(vector, "x_bits"), number(vector, "intensity_bits")))
                .filter(|&(x, _)| (0.0..=one).contains(&x))
                .map(|(x, y)| (x as i64, y as i64))
                .collect();
            answers.sort_unstable();
            let steps: Vec<i64> = answers.windows(2).map(|pair| pair[1].1 - pair[0].1).collect();
            let place = format!("{file}, n = {n}");
            assert_eq!(number(row, "pairs"), steps.len() as f64, "{place}");
            let falls = steps.iter().filter(|&&step| step < 0).count();
            assert_eq!(number(row, "falls"), falls as f64, "{place}");
            let deepest = steps.iter().map(|step| -step).max().unwrap().max(0);
            assert_eq!(number(row, "deepest_fall_ulp"), deepest as f64, "{place}");
            let byte = |y: i64| (y * 255 + (1 << (fraction - 1))) >> fraction;
            let image = answers.windows(2).map(|pair| (byte(pair[1].1) - byte(pair[0].1)).abs());
            assert_eq!(number(row, "image_step"), image.max().unwrap() as f64, "{place}");
            compared += steps.len();
        }
        assert!(compared > 1000, "{file}: {compared} pairs");
    }
}

#[test]
fn a_seed_is_written_and_matters() {
    let bench = bench!();
    let of = |seed: u32| {
        let options = format!("--part reference --samples 400 --seed {seed} --format json");
        bench.good(&format!("stability {options}"))
    };
    let (first, again, other) = (of(5), of(5), of(6));
    assert!(first == again && first != other);
    let json: Value = serde_json::from_str(&other).unwrap();
    assert_eq!((&json["seed"], &json["random_samples"]), (&6.into(), &400.into()));
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let bench = bench!();
    for part in ["", "--part edges", "--part seams"] {
        let command = format!("stability {part} --out new");
        bench.refused(&command, &["--preset NAME", "--config FILE", "--part coefficients"]);
    }
    bench.refused("stability --preset papre --out new", &["\"papre\"", "paper, blooming"]);
    bench.refused(
        "stability --preset paper --config small.json --out new",
        &["--preset", "--config", "cannot be used with"],
    );
    for format in ["csv", "json"] {
        let command = format!("stability --config small.json --format {format} --out new");
        bench.refused(&command, &["--part seams"]);
    }
    bench.refused("stability --config small.json --exponents 2,9 --out new", &["--exponents 9", "1..=8"]);
    bench.refused("stability --part coefficients --exponents 2 --out new", &["--exponents", "edges and seams"]);
    bench.refused("stability --part reference --samples 0", &["--samples", "1..=10000000"]);
    bench.refused("stability --part rounding", &["coefficients", "conditioning", "all"]);
    bench.refused("stability --part reference --out small.json", &["a file is in the way"]);
    bench.write("long.json", blysk_tests::cli::CENTRED.replace("UQ1.10", "UQ1.40"));
    bench.refused("stability --config long.json --part seams --out new", &["pairs of neighbouring x", "--exponents"]);
    let alone = bench.good("stability --config long.json --part edges");
    assert!(alone.contains("holds"), "{alone}");
}
