//! `blysk pareto`: its errors against formulas and exact powers computed here, its files, and what it refuses.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use blysk_tests::bench;
use blysk_tests::cli::{csv_rows, number};
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::fit::{Curve, Fit, Levels, Method, fit, minimax};
use hw_model::highlight::{ExactPower, phong};
use hw_model::presets;
use serde_json::Value;

/// 1025 x and eight exponents.
const SMALL: &str = "pareto --input UQ1.10 --exponents 1..=8 --no-timing";
const FRACTION: u32 = 10;

fn documents(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs").join(name)
}

macro_rules! values {
    ($name:ident, $real:ty) => {
        /// What this contender is said to compute, one sample at a time.
        fn $name(family: &str, n: u32, x: f64) -> f64 {
            let real = |value: f64| -> $real { value as $real };
            let (t, exponent) = (real(x), real(f64::from(n)));
            let s = 1.0 - t;
            let value = match family {
                "powf" => t.powf(exponent),
                // The square and multiply of a textbook, from the last bit.
                "powers" => {
                    (0..32)
                        .fold((1.0, t), |(power, square), bit| {
                            let next = if n >> bit & 1 == 1 { power * square } else { power };
                            (next, square * square)
                        })
                        .0
                }
                "schlick" => t / (exponent - exponent * t + t),
                linear if linear.starts_with("linear_") => {
                    let intervals: u32 = linear["linear_".len()..].parse().expect("a number");
                    let steps = f64::from(intervals);
                    let low = (x * steps).floor().min(steps - 1.0);
                    let at = |i: f64| real(phong(f64::from(n), i / steps));
                    at(low) + (t * real(steps) - real(low)) * (at(low + 1.0) - at(low))
                }
                "minimax_2" => {
                    let fitted = minimax::segments(f64::from(n), 3, 2, minimax::Range::Balanced);
                    let fitted = fitted.expect("a fit");
                    let [_, k1, k2, k3, _] = fitted.segments[0].c;
                    let first = 1.0 - s * (real(k1) - s * (real(k2) - s * real(k3)));
                    match (fitted.segments.get(1), fitted.ends.as_slice()) {
                        (_, [end, ..]) if s <= real(*end) => first.max(0.0),
                        (Some(second), [.., end]) if s <= real(*end) => {
                            let ([c0, c1, c2, c3, _], v) = (second.c.map(real), s - real(second.start));
                            (c0 - v * (c1 - v * (c2 - v * c3))).max(0.0)
                        }
                        _ => 0.0,
                    }
                }
                method => {
                    let method: Method = method.parse().expect("a method");
                    let Fit { epicentre, curve } = fit(method, f64::from(n), Levels::default()).expect("a fit");
                    let cubic = |cubic: &hw_model::highlight::Cubic| {
                        let c = cubic.centred;
                        let value: $real = 1.0 - s * (real(c.k1) - s * (real(c.k2) - s * real(c.k3)));
                        value.max(0.0)
                    };
                    let ratio = |r: &hw_model::highlight::Rational| {
                        let below = real(r.at_one) + real(r.b) * s;
                        if below > t { t / below } else { 1.0 }
                    };
                    match &curve {
                        Curve::Rational(rational) => ratio(rational),
                        Curve::Composite { epicentre: above, tail } => {
                            if s <= real(epicentre.s) {
                                cubic(above)
                            } else {
                                ratio(tail)
                            }
                        }
                        Curve::Cubic(above) => {
                            let minimum = above.centred.first_minimum().unwrap_or(1.0);
                            let cut = real(minimum.clamp(epicentre.s, 1.0));
                            if s <= cut { cubic(above) } else { 0.0 }
                        }
                    }
                }
            };
            f64::from(value)
        }
    };
}
values!(single, f32);
values!(double, f64);

/// The preset for these inputs, asked one x at a time.
fn preset(name: &str) -> impl Fn(u32, u64) -> f64 {
    let config: Config = presets::find(name).expect("a preset").config().expect("it parses");
    let config = config.with_inputs("UQ1.10".parse().expect("a format"), "1..=8".parse().expect("a list"));
    let design = Design::new(config).expect("hardware");
    move |n, k| {
        let answer = design.datapath().evaluate(n - 1, k as i64).intensity;
        answer as f64 * design.config().output.ulp()
    }
}

/// |value − x^n|, from a ratio of integers.
fn error(value: f64, n: u32, k: u64) -> f64 {
    let exact = ExactPower::new(k, FRACTION, n).expect("a power");
    let nearest = exact.to_f64();
    let ulp = nearest.next_up() - nearest;
    (value - nearest + exact.error_in_ulp(nearest) * ulp).abs()
}

#[test]
fn errors_are_those_of_the_formulas_at_every_x() {
    let bench = bench!();
    let rows = csv_rows(&bench.good(&format!("{SMALL} --format csv")));
    assert!(rows.len() >= 25, "{} contenders", rows.len());
    for row in &rows {
        let name = row["contender"].as_str();
        let hardware = name.strip_prefix("preset ").map(preset);
        let value = |n: u32, k: u64| {
            let x = k as f64 / f64::from(1 << FRACTION);
            match (&hardware, name.rsplit_once(' ')) {
                (Some(hardware), _) => hardware(n, k),
                (None, Some((family, "f32"))) => single(family, n, x),
                (None, Some((family, _))) => double(family, n, x),
                (None, None) => panic!("{name}"),
            }
        };
        for region in ["epicentre", "whole"] {
            let (mut worst, mut squares, mut count) = ((0.0, 0, 0), 0.0, 0.0_f64);
            for n in 1..=8 {
                for k in 0..=1 << FRACTION {
                    // x^n ≥ 1/2, exactly.
                    let inside = 2 * u128::from(k).pow(n) >= 1 << (FRACTION * n);
                    if region == "whole" || inside {
                        let error = error(value(n, k), n, k);
                        if error > worst.0 {
                            worst = (error, n, k);
                        }
                        squares += error * error;
                        count += 1.0;
                    }
                }
            }
            let column = |what: &str| number(row, &format!("{region}_{what}"));
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-11 * b + 1e-32;
            assert!(close(column("worst"), worst.0), "{name}: {worst:?} {row:?}");
            assert!(close(column("rms"), f64::sqrt(squares / count)), "{name}: {row:?}");
            if worst.0 > 1e-12 {
                let place = (f64::from(worst.1), worst.2 as f64 / f64::from(1 << FRACTION));
                assert_eq!((column("worst_n"), column("worst_x")), place, "{name}, {region}");
            }
        }
    }
}

/// The front again, from the table that is printed.
#[test]
fn the_dominated_are_dominated_by_those_who_are_named() {
    let bench = bench!();
    let rows = csv_rows(&bench.good(&format!("{SMALL} --format csv")));
    let presets: Vec<_> = rows.iter().filter(|row| row["kind"] == "hardware").collect();
    assert_eq!(presets.len(), presets::ALL.len());
    for region in ["epicentre", "whole"] {
        let costs = |row: &BTreeMap<String, String>| {
            let error = format!("{region}_worst");
            [error.as_str(), "multiplier_bits", "divider_bits", "storage_bits", "latency"]
                .map(|column| number(row, column))
        };
        let beats = |a: &BTreeMap<String, String>, b: &BTreeMap<String, String>| {
            let (a, b) = (costs(a), costs(b));
            a.iter().zip(&b).all(|(a, b)| a <= b) && a != b
        };
        for row in &presets {
            let by = &row[&format!("hardware_{region}_dominated_by")];
            let front = !presets.iter().any(|other| beats(other, row));
            assert_eq!(row[&format!("hardware_{region}_front")], front.to_string(), "{row:?}");
            assert_eq!(by.is_empty(), front);
            if let Some(named) = presets.iter().find(|other| other["contender"] == *by) {
                assert!(beats(named, row), "{row:?}");
            }
        }
    }
}

#[test]
fn without_times_the_same_bytes_and_times_stand_apart() {
    let bench = bench!();
    let said = bench.good(&format!("{SMALL} --out first"));
    let again = bench.good(&format!("{SMALL} --out second"));
    assert_eq!(said, again.replace("second", "first"));
    assert!(bench.tree("first") == bench.tree("second"));
    let timed = bench.good(&format!("{} --rounds 15 --out timed", &SMALL[..SMALL.len() - 12]));
    assert!(timed.contains("ns/sample") && !said.contains("ns/sample"), "{said}");
    assert!(said.contains("no run times") && said.contains("no synthesis results"), "{said}");
    for line in said.lines().chain(timed.lines()) {
        assert!(line.chars().count() <= 100, "{line:?}");
    }
    // What does not depend on the machine is the same with times.
    for name in ["pareto.csv", "pareto_rom_whole.svg", "pareto_multipliers_epicentre.png"] {
        assert!(bench.read(&format!("first/{name}")) == bench.read(&format!("timed/{name}")));
    }
    let names = |directory: &str| -> Vec<String> {
        bench.tree(directory).into_keys().map(|name| name.display().to_string()).collect()
    };
    let times: Vec<String> = names("timed").into_iter().filter(|name| !names("first").contains(name)).collect();
    let expected = [
        "pareto_mixed_epicentre.png",
        "pareto_mixed_epicentre.svg",
        "pareto_mixed_whole.png",
        "pareto_mixed_whole.svg",
        "pareto_time_epicentre.png",
        "pareto_time_epicentre.svg",
        "pareto_time_whole.png",
        "pareto_time_whole.svg",
        "pareto_timing.csv",
    ];
    assert_eq!(times, expected);
    // Without times, those of an earlier run do not stay beside other errors.
    let _said = bench.good(&format!("{SMALL} --out timed"));
    assert!(!bench.path("timed/pareto_timing.csv").exists());
}

#[test]
fn times_are_ordered_and_json_has_both_tables() {
    let bench = bench!();
    let options = "--input UQ1.10 --exponents 2,3.5,8 --rounds 15 --seed 7";
    let said = bench.good(&format!("pareto {options} --out both"));
    assert!(said.contains("left out: powers"), "{said}");
    let json: Value = serde_json::from_str(&bench.text("both/pareto.json")).expect("JSON");
    let (table, times) = (csv_rows(&bench.text("both/pareto.csv")), csv_rows(&bench.text("both/pareto_timing.csv")));
    assert_eq!(json["timing"]["seed"], 7);
    for (csv, json) in [(&table, &json["contenders"]), (&times, &json["timing"]["rows"])] {
        let json = json.as_array().expect("rows");
        assert_eq!(csv.len(), json.len());
        for (csv, json) in csv.iter().zip(json) {
            for (column, value) in json.as_object().expect("an object") {
                match value {
                    Value::Null => assert_eq!(csv[column], ""),
                    Value::String(text) => assert_eq!(&csv[column], text),
                    Value::Bool(flag) => assert_eq!(csv[column], flag.to_string()),
                    value => assert_eq!(value.as_f64(), Some(number(csv, column)), "{column}"),
                }
            }
        }
    }
    for row in &times {
        // The block engine takes one exponent at a time.
        let hardware = row["contender"].starts_with("preset ");
        assert_eq!(row["mixed_median"].is_empty(), hardware);
        for way in ["block", "mixed"].into_iter().take(if hardware { 1 } else { 2 }) {
            let [least, lower, median, upper] = ["least", "lower_quartile", "median", "upper_quartile"]
                .map(|part| number(row, &format!("{way}_{part}")));
            assert!(0.0 < least && least <= lower && lower <= median && median <= upper);
        }
    }
}

#[test]
fn a_sample_says_everywhere_that_it_is_one() {
    let bench = bench!();
    let said = bench.good(&format!("{SMALL} --every 3 --out part"));
    let said = said.replace('\n', " ");
    assert!(said.contains("SAMPLED, one x in 3") && said.contains("(SAMPLED)"), "{said}");
    assert!(csv_rows(&bench.text("part/pareto.csv")).iter().all(|row| row["every"] == "3"));
    assert!(bench.text("part/pareto_rom_whole.svg").contains("SAMPLED"));
    assert!(bench.good(&format!("{SMALL} --every 3 --format markdown")).contains("SAMPLED"));
    let json: Value = serde_json::from_str(&bench.text("part/pareto.json")).expect("JSON");
    assert_eq!((&json["exhaustive"], &json["every"]), (&false.into(), &3.into()));
    // 0, 3, 6, …, 1023, and 1024.
    assert_eq!(json["samples"], 343 * 8);
    assert!(!bench.good(SMALL).contains("SAMPLED"));
}

#[test]
fn synthesis_results_belong_to_the_presets_as_they_are_shipped() {
    let bench = bench!();
    bench.write("synth.csv", fs::read(documents("synthesis.csv")).expect("docs/synthesis.csv"));
    let of = |options: &str| bench.good(&format!("pareto --no-timing {options} --synth synth.csv"));
    let shipped = of("--every 65537");
    assert!(shipped.contains("ECP5 25F") && shipped.contains("does not fit"), "{shipped}");
    let other = of("--input UQ1.10 --exponents 1..=8");
    assert!(other.contains("none of them is of a preset with these"), "{other}");
    // It is found where `make synth` puts it.
    fs::create_dir_all(bench.path("results/synth")).expect("ours");
    fs::rename(bench.path("synth.csv"), bench.path("results/synth/synth.csv")).expect("ours");
    let found = bench.good("pareto --no-timing --every 65537");
    assert!(found.contains("results/synth/synth.csv") && found.contains("ECP5 25F"), "{found}");
}

/// The exhaustive table of the documentation, in seconds: see `analysis/pareto/check.rs`.
#[test]
fn the_table_that_is_kept_holds() {
    let bench = bench!();
    let kept = fs::read_to_string(documents("pareto.csv")).expect("docs/pareto.csv");
    bench.write("pareto.csv", &kept);
    let again = "`make pareto` measures docs/pareto.csv and docs/PARETO.md again; read the difference";
    let run = bench.run("pareto --check pareto.csv --every 16381");
    assert_eq!(run.status, 0, "{again}: {}", run.stdout);
    // A sample cannot tell everything, and says so.
    let said = run.stdout.replace('\n', " ");
    assert!(said.contains("not checked") && said.contains("whole_rms"), "{}", run.stdout);
    let rows = csv_rows(&kept);
    assert!(rows.iter().all(|row| row["every"] == "1"), "docs/pareto.csv is of a sample");
    let page = fs::read_to_string(documents("PARETO.md")).expect("docs/PARETO.md");
    for row in &rows {
        let wanted = [row["contender"].as_str(), row["storage_bits"].as_str()];
        let found = page.lines().any(|line| {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            // Four digits of them are shown.
            let shown = |column: &&str| {
                let numbers = cells.iter().filter_map(|cell| cell.parse::<f64>().ok());
                numbers.into_iter().any(|cell| (cell / number(row, column) - 1.0).abs() < 6e-4)
            };
            wanted.iter().all(|cell| cells.contains(cell))
                && ["epicentre_worst", "epicentre_rms", "whole_worst", "whole_rms"].iter().all(shown)
        });
        assert!(found, "docs/PARETO.md has no line for {row:?}: {again}");
    }
    // It would be seen if it did not hold.
    let (row, worst) = (&rows[0], &rows[0]["whole_worst"]);
    bench.write("pareto.csv", kept.replacen(worst.as_str(), "0.3", 1));
    let run = bench.run("pareto --check pareto.csv --every 65537");
    assert!(run.status == 1 && run.stdout.contains(&row["contender"]), "{run:?}");
}

/// One digit of any column, where the inputs are the table's own.
#[test]
fn every_column_of_a_table_is_checked() {
    let bench = bench!();
    let command = "pareto --exponents 1..=4 --input UQ1.8 --no-timing --format csv";
    let kept = bench.good(command);
    let columns = kept.lines().next().expect("a header").split(',').count();
    bench.write("kept.csv", &kept);
    let check = "pareto --exponents 1..=4 --input UQ1.8 --check kept.csv";
    let held = bench.good(check);
    assert!(!held.contains("not checked"), "{held}");
    let lines: Vec<&str> = kept.lines().collect();
    let preset = lines.iter().position(|line| line.starts_with("preset compact,")).expect("a preset");
    let mut altered = 0;
    for line in [1, preset] {
        for column in 0..columns - 1 {
            let mut cells: Vec<String> = lines[line].split(',').map(str::to_owned).collect();
            let cell = cells[column].clone();
            cells[column] = match cell.as_str() {
                "true" => "false".to_owned(),
                "false" => "true".to_owned(),
                "" => continue,
                cell => match cell.rfind(|c: char| c.is_ascii_digit()) {
                    // The last digit of an f64 may be its neighbour's: the first of those that count.
                    Some(_) => {
                        let at = cell.find(|c: char| ('1'..='9').contains(&c)).unwrap_or(0);
                        let digit = if cell.as_bytes()[at] == b'7' { '8' } else { '7' };
                        format!("{}{digit}{}", &cell[..at], &cell[at + 1..])
                    }
                    None => format!("{cell}x"),
                },
            };
            let mut all = lines.clone();
            let changed = cells.join(",");
            all[line] = &changed;
            bench.write("kept.csv", all.join("\n") + "\n");
            let run = bench.run(check);
            assert!(run.status == 1 || run.status == 2, "{column}: {changed}: {run:#?}");
            altered += 1;
        }
    }
    assert!(altered > 20, "{altered}");
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let bench = bench!();
    let refused = |options: &str, said: &[&str]| bench.refused(&format!("pareto {options}"), said);
    refused("--every 0 --out new", &["--every", "1.."]);
    refused("--rounds 3 --out new", &["--rounds", "15..=100000"]);
    refused("--rounds 20 --no-timing --out new", &["--rounds", "--no-timing"]);
    refused("--exponents 0.5 --out new", &["0.5", "out of range"]);
    refused("--exponents 3,2 --out new", &["increasing order"]);
    refused("--input UQ1.60 --out new", &["UQ1.60", "52 fraction bits"]);
    refused("--input UQ1.40 --out new", &["are more than", "--every"]);
    refused("--input Q1.0 --out new", &["Q1.0"]);
    refused("--input 24 --out new", &["24"]);
    refused("--no-timing --synth nowhere.csv --out new", &["cannot read the table nowhere.csv"]);
    refused("--no-timing --synth small.json --out new", &["small.json", "`make synth`"]);
    refused(&format!("{} --out small.json", &SMALL[7..]), &["a file is in the way"]);
    refused("--check nowhere.csv", &["cannot read the table nowhere.csv"]);
    refused("--check small.json", &["pareto.csv"]);
    bench.write("semicolon.csv", "contender;kind\nschlick f32;f32\n");
    refused("--check semicolon.csv", &["semicolon.csv:1:", "separated by `;`"]);
    refused("--no-timing --synth semicolon.csv --out new", &["semicolon.csv:1:", "separated by `;`"]);
    refused("--check pareto.csv --out new", &["--check", "--out"]);
}

/// Configurations of one's own stand beside the presets, with the inputs of all, and are compared with them.
#[test]
fn own_configurations_are_contenders() {
    let bench = bench!();
    let shown = bench.good("presets show compact");
    bench.write("mine.json", shown.replacen("\"compact\"", "\"mine\"", 1).replace("hermite", "tangent"));
    bench.write("same.json", shown);
    let rows = csv_rows(&bench.good(&format!("{SMALL} --config mine.json --config same.json --format csv")));
    let of = |name: &str| rows.iter().find(|row| row["contender"] == name).unwrap_or_else(|| panic!("{name}"));
    let (mine, same, preset) = (of("config mine"), of("config compact"), of("preset compact"));
    for column in ["whole_worst", "epicentre_rms", "latency", "multiplier_bits", "storage_bits"] {
        assert_eq!(same[column], preset[column], "{column}");
    }
    assert!(mine["whole_worst"] != preset["whole_worst"] && mine["kind"] == "hardware", "{mine:?}");
    let alone = csv_rows(&bench.good(&format!("{SMALL} --format csv")));
    assert_eq!(rows.len(), alone.len() + 2);
    bench.write("kept.csv", bench.good(&format!("{SMALL} --config mine.json --format csv")));
    let inputs = "--input UQ1.10 --exponents 1..=8";
    let held = bench.good(&format!("pareto {inputs} --config mine.json --check kept.csv"));
    assert!(held.contains("holds"), "{held}");
    assert_eq!(bench.run(&format!("pareto {inputs} --check kept.csv")).status, 1);
    bench.refused(&format!("{SMALL} --config mine.json --config mine.json"), &["two configurations", "mine"]);
    bench.refused(&format!("{SMALL} --config nowhere.json --out new"), &["nowhere.json"]);
    bench.refused(&format!("{SMALL} --config mine.json --out mine.json"), &["in the way"]);
}

/// A time is less than another where their quartiles are apart.
#[test]
fn times_within_the_spread_are_the_same() {
    let bench = bench!();
    let _said = bench.good("pareto --input UQ1.10 --exponents 2,5,8 --rounds 15 --out timed");
    let (errors, times) = (csv_rows(&bench.text("timed/pareto.csv")), csv_rows(&bench.text("timed/pareto_timing.csv")));
    let mut compared = 0;
    for way in ["block", "mixed"] {
        let all: Vec<_> = times
            .iter()
            .zip(&errors)
            .filter(|(time, _)| !time[&format!("{way}_median")].is_empty())
            .map(|(time, error)| {
                let ends = ["lower", "upper"].map(|end| number(time, &format!("{way}_{end}_quartile")));
                (time, ends, number(error, "whole_worst"))
            })
            .collect();
        for (row, own, error) in &all {
            let above = |(_, ends, other): &&(_, [f64; 2], f64)| match ends[0] <= own[1] && own[0] <= ends[1] {
                true => other < error,
                false => ends[1] < own[0] && other <= error,
            };
            let by = &row[&format!("{way}_whole_dominated_by")];
            assert_eq!(all.iter().any(|other| above(&other)), !by.is_empty(), "{way}: {row:?}");
            let named = all.iter().find(|(time, ..)| time["contender"] == *by);
            assert!(named.is_none_or(|named| above(&named)), "{way}: {row:?}");
            compared += 1;
        }
    }
    assert!(compared > 40, "{compared}");
}
