//! `blysk vectors --coverage`: what it says of every bit, against every input there is.

use std::collections::BTreeMap;

use blysk_tests::bench;
use blysk_tests::cli::CONFIGURATIONS;
use hw_model::config::Config;
use hw_model::design::Design;
use serde_json::Value;

/// The bits that every input leaves at 0 and those that every input leaves at 1, by rank and register.
fn constant(design: &Design) -> BTreeMap<(String, String), (u64, u64)> {
    let datapath = design.datapath();
    let input = design.config().input;
    let mut seen = BTreeMap::<_, (u64, u64)>::new();
    for address in 0..1 << design.rom().address_width() {
        for x in input.min_bits()..=input.max_bits() {
            for (rank, signals) in datapath.passage(address, x).iter().enumerate() {
                for register in datapath.registers(rank) {
                    let word = register.format.to_word(register.bits(signals));
                    let entry = seen.entry((datapath.rank_name(rank), register.name().to_owned())).or_default();
                    entry.0 |= word;
                    entry.1 |= !word;
                }
            }
        }
    }
    seen.into_iter().map(|(name, (ones, zeros))| (name, (!ones, !zeros))).collect()
}

fn number(value: &Value, field: &str) -> u64 {
    value[field].as_u64().unwrap_or_else(|| panic!("{field} of {value}"))
}

fn list<'a>(value: &'a Value, field: &str) -> &'a Vec<Value> {
    value[field].as_array().unwrap_or_else(|| panic!("{field} of {value}"))
}

#[test]
fn what_is_said_of_every_bit_is_so() {
    let bench = bench!();
    for (file, json) in CONFIGURATIONS {
        let said = bench.good(&format!("vectors --config {file} --strategy exhaustive --coverage --out {file}.all"));
        let coverage: Value = serde_json::from_str(&bench.text(&format!("{file}.all/coverage.json"))).unwrap();
        let design = Design::new(Config::from_json(json).unwrap()).unwrap();
        let constant = constant(&design);
        let (mut bits, mut toggled, mut fixed) = (0, 0, 0);
        for register in list(&coverage, "registers") {
            let name =
                (register["rank"].as_str().unwrap().to_owned(), register["register"].as_str().unwrap().to_owned());
            let (zeros, ones) = constant[&name];
            for bit in list(register, "fixed") {
                let always = if number(bit, "always") == 1 { ones } else { zeros };
                assert!(always >> number(bit, "bit") & 1 == 1, "{file} {name:?} {bit}");
                assert!(register["reason"].is_string());
            }
            for bit in list(register, "missed") {
                let place = number(bit, "bit");
                // Every input was there, so what was not seen is never so.
                assert_eq!(bit["one"].as_bool(), Some(zeros >> place & 1 == 0), "{file} {name:?} {bit}");
                assert_eq!(bit["zero"].as_bool(), Some(ones >> place & 1 == 0), "{file} {name:?} {bit}");
            }
            let of = |what| list(register, what).len() as u64;
            assert_eq!(number(register, "toggled") + of("fixed") + of("missed"), number(register, "width"), "{name:?}");
            bits += number(register, "width");
            toggled += number(register, "toggled");
            fixed += of("fixed");
        }
        assert_eq!([bits, toggled, fixed], ["bits", "toggled", "fixed"].map(|field| number(&coverage, field)));
        assert!(toggled > 0 && said.contains(&format!("{toggled} of {bits} bits rose and fell")), "{said}");
        for class in list(&coverage, "corners") {
            assert_eq!(number(class, "met"), number(class, "available"), "{class}");
        }
        for region in list(&coverage, "regions") {
            let ranks = number(region, "ranks");
            for cross in ["stalled", "before_bubble", "before_request"] {
                assert_eq!(number(region, cross), ranks, "{file} {cross} {region}");
            }
        }
        let regions: u64 = list(&coverage, "regions").iter().map(|region| number(region, "requests")).sum();
        let passages: u64 = list(&coverage, "passages").iter().map(|passage| number(passage, "count")).sum();
        let vectors = 1 << (design.rom().address_width() + design.config().input.width());
        assert_eq!((regions, passages), (vectors, vectors - 1));
        assert!(said.lines().all(|line| line.chars().count() <= 100), "{said}");
    }
}

/// Few vectors cover little, and the same command says the same; a bundle without `--coverage` leaves no old one.
#[test]
fn few_vectors_miss_much() {
    let bench = bench!();
    let command = "vectors --preset compact --strategy even --count 3 --coverage";
    let first = bench.good(&format!("{command} --out few"));
    let coverage: Value = serde_json::from_str(&bench.text("few/coverage.json")).unwrap();
    let second = bench.good(&format!("{command} --out again"));
    assert_eq!(first.lines().skip(1).collect::<Vec<_>>(), second.lines().skip(1).collect::<Vec<_>>());
    assert!(bench.tree("few") == bench.tree("again"));
    assert!(number(&coverage, "toggled") * 2 < number(&coverage, "bits") - number(&coverage, "fixed"));
    assert!(list(&coverage, "corners").iter().any(|class| number(class, "met") < number(class, "available")));
    let _summary = bench.good("vectors --preset compact --strategy even --count 3 --out few");
    assert!(!bench.path("few/coverage.json").exists());
    bench.refused("vectors --config small.json --coverage --format csv --out new", &["--coverage", "--format files"]);
}
