//! `blysk rom`: words that unpack, by the printed layout, to the fields printed beside them; and its images, as others
//! read them.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use ::vectors::memory_file::{self, Value};
use blysk_tests::bench;
use blysk_tests::cli::{CONFIGURATIONS, csv_rows, number};
use dashu_int::UBig;
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::presets::ALL;

/// A field as the terminal shows it.
struct Field {
    name: String,
    signed: bool,
    fraction: i32,
    msb: usize,
    lsb: usize,
}

/// The stored fields of the layout printed for people, and how many constants there are.
fn layout(table: &str) -> (Vec<Field>, usize) {
    let mut constants = 0;
    let mut fields = Vec::new();
    for line in table.lines().skip(1).take_while(|line| !line.trim().is_empty()) {
        let cells: Vec<&str> = line.split_whitespace().collect();
        if cells[2] == "constant" {
            constants += 1;
            continue;
        }
        let (msb, lsb) = cells[2].split_once(':').unwrap();
        let (_, fraction) = cells[1].split_once('.').unwrap();
        fields.push(Field {
            name: cells[0].to_owned(),
            signed: cells[1].starts_with('Q'),
            fraction: fraction.parse().unwrap(),
            msb: msb.parse().unwrap(),
            lsb: lsb.parse().unwrap(),
        });
    }
    (fields, constants)
}

/// Bits `msb` down to `lsb` of a word in hexadecimal, digit by digit.
fn bits(word: &str, field: &Field) -> i64 {
    let digits: Vec<u32> = word.chars().rev().map(|digit| digit.to_digit(16).unwrap()).collect();
    let bit = |place: usize| i64::from(digits[place / 4] >> (place % 4) & 1);
    let value: i64 = (field.lsb..=field.msb).map(|place| bit(place) << (place - field.lsb)).sum();
    let width = field.msb - field.lsb + 1;
    if field.signed && bit(field.msb) == 1 { value - (1 << width) } else { value }
}

#[test]
fn every_word_unpacks_to_its_row() {
    let bench = bench!();
    let mut compared = 0;
    for preset in ALL {
        let design = Design::new(preset.config().unwrap()).unwrap();
        let table = bench.good(&format!("rom --preset {}", preset.name));
        let (fields, constants) = layout(&table);
        assert_eq!(fields.len() + constants, design.rom().layout().fields().len());
        let text = bench.good(&format!("rom --preset {} --format csv", preset.name));
        let rows = csv_rows(&text);
        assert_eq!(rows.len(), 256);
        for (address, row) in rows.iter().enumerate() {
            assert_eq!(number(row, "address"), address as f64);
            assert_eq!(number(row, "n"), (address + 1) as f64);
            for field in &fields {
                let found = bits(&row["word"], field);
                assert_eq!(row[&format!("{}_bits", field.name)], found.to_string());
                let real = number(row, &format!("{}_real", field.name));
                assert_eq!(real, found as f64 / f64::from(field.fraction).exp2());
                let model = design.rom().rows()[address];
                let name = design.rom().layout().fields().iter().map(|field| field.name);
                let name = name.into_iter().find(|name| name.name() == field.name).unwrap();
                assert_eq!(model.get(name), found, "{} n = {}", preset.name, address + 1);
                compared += 1;
            }
            let shown = table.lines().any(|line| line.split_whitespace().last() == Some(&row["word"]));
            assert!(shown, "the table for people has the word of n = {}", address + 1);
        }
        let width = fields.iter().map(|field| field.msb + 1).max().unwrap();
        let size = format!("256 words of {width} bits, {} bits in all", 256 * width);
        assert_eq!(table.lines().last(), Some(size.as_str()));
    }
    assert!(compared > 5 * 256 * 2, "{compared} fields compared");
}

#[test]
fn some_exponents_and_files() {
    let bench = bench!();
    let all = bench.good("rom --config small.json --format csv --out all");
    assert_eq!(bench.text("all/rom.csv"), all);
    let json = bench.good("rom --config small.json --format json --out again");
    assert_eq!(bench.text("all/rom.json"), json);
    assert!(bench.tree("all") == bench.tree("again"));
    assert_eq!(bench.tree("all").len(), 3);
    let parsed: Vec<serde_json::Value> = serde_json::from_str(&json).unwrap();
    assert_eq!((parsed.len(), &parsed[6]["n"]), (8, &serde_json::json!(7.0)));

    let some = bench.good("rom --config small.json --exponents 2,7 --format csv");
    let wanted: Vec<&str> = all.lines().enumerate().filter(|(line, _)| [0, 2, 7].contains(line)).map(|l| l.1).collect();
    assert_eq!(some.lines().collect::<Vec<_>>(), wanted);
}

/// An image as another program reads it: its words.
fn read_elsewhere(format: &str, image: &str, design: &Design) -> Vec<UBig> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let rom = design.rom();
    let mut reader = Command::new(root.join("target/venv/bin/python"))
        .arg(root.join("tests/src/rtl/rom_images.py"))
        .args([format, &rom.layout().word_width().to_string(), &rom.depth().to_string()])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("scripts/setup was run");
    reader.stdin.take().expect("a pipe").write_all(image.as_bytes()).unwrap();
    let output = reader.wait_with_output().unwrap();
    assert!(output.status.success(), "{format} of {}", design.config().name);
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(|word| UBig::from_str_radix(word, 16).unwrap()).collect()
}

/// Every word of every preset's images, read back by libraries (one by its grammar).
#[test]
fn images_are_read_by_others() {
    let bench = bench!();
    let presets = ALL.map(|preset| (format!("--preset {}", preset.name), preset.config().unwrap()));
    let small = CONFIGURATIONS.map(|(file, json)| (format!("--config {file}"), Config::from_json(json).unwrap()));
    for (option, config) in presets.into_iter().chain(small) {
        let design = Design::new(config).unwrap();
        let words: Vec<UBig> = design.rom().rows().iter().map(|row| design.rom().layout().pack(row)).collect();
        for format in ["hex", "mif", "coe"] {
            let image = bench.good(&format!("rom {option} --format {format}"));
            assert_eq!(read_elsewhere(format, &image, &design), words, "{option} {format}");
        }
        let image = bench.good(&format!("rom {option} --format mem"));
        let read = memory_file::parse(&image, Path::new("rom.mem")).unwrap();
        let read: Vec<_> = read.into_iter().map(|entry| entry.value).collect();
        assert_eq!(read, words.into_iter().map(Value::Known).collect::<Vec<_>>(), "{option}");
    }
}

#[test]
fn an_image_is_one_file_of_the_whole_rom() {
    let bench = bench!();
    let printed = bench.good("rom --config small.json --format mif");
    assert!(printed.lines().nth(1).is_some_and(|line| line.ends_with("blysk rom --config small.json --format mif")));
    let said = bench.good("rom --config small.json --format mif --out image");
    assert!(said.contains("image/rom.mif: 8 words of "), "{said}");
    assert_eq!(bench.text("image/rom.mif"), printed);
    assert_eq!(bench.tree("image").len(), 2);
    bench.refused("rom --config small.json --format coe --exponents 1", &["every word", "--exponents"]);
    // Eight segments of degree 4 with wide coefficients: more than a record of Intel HEX holds.
    bench.write(
        "wide.json",
        r#"{"name": "wide", "method": "minimax", "degree": 4, "segments": 8, "exponents": "7.5,40", "input": "UQ1.44",
            "output": "UQ1.40", "cut": "balanced"}"#,
    );
    bench.refused("rom --config wide.json --format hex", &["255", "mem, mif or coe"]);
    assert!(bench.good("rom --config wide.json --format coe").ends_with(";\n"));
}
