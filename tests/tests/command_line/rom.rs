//! `blysk rom`: words that unpack, by the printed layout, to the fields printed beside them.

use blysk_tests::bench;
use blysk_tests::cli::{csv_rows, number};
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
