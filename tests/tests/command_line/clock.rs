//! `blysk clock`, and a clock in a configuration: the fewest ranks that reach it.

use blysk_tests::bench;
use blysk_tests::cli::{SMALL, csv_rows, number};
use serde_json::{Value, json};

/// Every part takes a nanosecond, and nothing any bit.
const DELAYS: &str = r#"{"register": 1, "rom": 1, "lut": 1, "add": 1, "carry": 0, "multiply": 1, "enable": 1,
    "multiplier_bits": 32}"#;

/// The small configuration with another field.
fn with(field: &str, value: Value) -> String {
    let mut config: Value = serde_json::from_str(SMALL).unwrap();
    config[field] = value;
    config.to_string()
}

#[test]
fn parts_add_up_to_the_longest_path() {
    let bench = bench!();
    bench.write("small.json", SMALL);
    bench.write("delays.json", DELAYS);
    let rows = csv_rows(&bench.good("clock --config small.json --device delays.json --format csv"));
    // Register, multiplier, sum, rounding.
    let stage = rows.iter().find(|row| row["through"].ends_with("rounding of stage 2")).unwrap();
    assert_eq!(number(stage, "ns"), 4.0);
    assert_eq!(number(stage, "MHz"), 250.0);
    // Three quotient bits, each a subtraction and a choice.
    let digits = rows.iter().find(|row| row["through"] == "3 quotient bits").unwrap();
    assert_eq!(number(digits, "ns"), 7.0);
    let most = rows.iter().map(|row| number(row, "ns")).fold(0.0, f64::max);
    let table = bench.good("clock --config small.json --device delays.json");
    assert!(table.contains(&format!("about {:.1} MHz", 1e3 / most)), "{table}");
}

/// A rank right behind a block stands in the block, where the table says that blocks have registers.
#[test]
fn registers_of_blocks_take_what_the_table_says() {
    let bench = bench!();
    let ranks = json!({"rom": true, "operands": true, "product": 1, "sum": true});
    bench.write("small.json", with("pipelining", ranks));
    bench.write("without.json", DELAYS);
    let mut table: Value = serde_json::from_str(DELAYS).unwrap();
    table["rom_to_register"] = json!(0.0);
    table["multiply_to_register"] = json!(0.5);
    bench.write("with.json", table.to_string());
    let ns = |config: &str, delays: &str, part: &str| -> Option<f64> {
        let rows = csv_rows(&bench.good(&format!("clock --config {config} --device {delays} --format csv")));
        rows.iter().find(|row| row["through"] == part).map(|row| number(row, "ns"))
    };
    assert_eq!(ns("small.json", "without.json", "multiplier of stage 2"), Some(2.0));
    assert_eq!(ns("small.json", "with.json", "multiplier of stage 2"), Some(1.5));
    assert_eq!(ns("small.json", "without.json", "the ROM's memory"), Some(2.0));
    assert_eq!(ns("small.json", "with.json", "the ROM's memory"), None, "no path outside of the block");
    // Where no rank follows, the blocks are as they were; and so is a product of pieces that are added first.
    bench.write("shallow.json", SMALL);
    let stage = "multiplier of stage 2, sum of stage 2, rounding of stage 2";
    assert_eq!(ns("shallow.json", "with.json", stage), ns("shallow.json", "without.json", stage));
    table["multiplier_bits"] = json!(8);
    bench.write("pieces.json", table.to_string());
    let pieces = "multiplier of stage 2, sum of the pieces of stage 2";
    assert!(ns("small.json", "pieces.json", pieces).is_some_and(|ns| ns >= 3.0));
    table["multiply_to_register"] = json!(-1.0);
    bench.write("below.json", table.to_string());
    let run = bench.run("clock --config small.json --device below.json");
    assert!(run.status == 2 && run.stderr.contains("\"multiply_to_register\" is a delay"), "{}", run.stderr);
}

/// With fewer ranks, or more quotient bits, no configuration reaches the clock.
#[test]
fn the_fewest_ranks_are_those_that_no_others_undercut() {
    let bench = bench!();
    bench.write("delays.json", DELAYS);
    bench.write("small.json", SMALL);
    let latency = |text: &str| -> u64 {
        let (_, rest) = text.split_once("latency ").unwrap();
        rest.split(' ').next().unwrap().parse().unwrap()
    };
    let mut before = 0;
    let mut reached = 0;
    for mhz in [100, 150, 200, 250, 300] {
        let run = bench.run(&format!("clock --config small.json --device delays.json --mhz {mhz}"));
        if run.status == 2 {
            assert!(run.stderr.contains("cannot be reached on the device of the table: ask for"), "{}", run.stderr);
            continue;
        }
        let (text, here) = (run.stdout.clone(), latency(&run.stdout));
        assert!(here >= before, "{mhz} MHz takes fewer cycles than a slower clock: {text}");
        (before, reached) = (here, reached + 1);
        // What is printed, stated by hand, reaches it too.
        let field = |name: &str| -> Option<Value> {
            let line = text.lines().find(|line| line.starts_with(&format!("\"{name}\":")))?;
            serde_json::from_str(line.split_once(':')?.1).ok()
        };
        let mut config: Value = serde_json::from_str(&with("pipelining", field("pipelining").unwrap())).unwrap();
        config["quotient_bits_per_stage"] = field("quotient_bits_per_stage").unwrap();
        bench.write("stated.json", config.to_string());
        let stated = csv_rows(&bench.good("clock --config stated.json --device delays.json --format csv"));
        assert!(stated.iter().all(|row| number(row, "MHz") >= f64::from(mhz)), "{mhz}: {text}");
    }
    assert!(reached >= 3, "{reached}");
}

/// A configuration with a clock is the one with the ranks that follow from it, to the bytes of its hardware.
#[test]
fn a_clock_in_a_configuration_becomes_its_ranks() {
    let bench = bench!();
    bench.write("delays.json", DELAYS);
    bench.write("clocked.json", with("clock", json!({"mhz": 200, "device": "delays.json"})));
    let _written = bench.good("rtl --config clocked.json --count 16 --out clocked");
    let text = bench.good("clock --config clocked.json --device delays.json --mhz 200");
    let stated = text.lines().find_map(|line| line.strip_prefix("\"pipelining\": ")).unwrap();
    assert_ne!(stated, "{}");
    let mut config: Value = serde_json::from_str(&with("pipelining", serde_json::from_str(stated).unwrap())).unwrap();
    let bits = text.lines().find_map(|line| line.strip_prefix("\"quotient_bits_per_stage\": ")).unwrap();
    config["quotient_bits_per_stage"] = bits.parse::<u32>().unwrap().into();
    bench.write("stated.json", config.to_string());
    let _written = bench.good("rtl --config stated.json --count 16 --out stated");
    let package = |of: &str| {
        let text = std::fs::read_to_string(bench.path(of).join("blysk_pkg.sv")).unwrap();
        text.lines().filter(|line| !line.starts_with("//")).collect::<Vec<_>>().join("\n")
    };
    assert_eq!(package("clocked"), package("stated"));
}

#[test]
fn what_is_no_clock_is_refused() {
    let bench = bench!();
    bench.write("small.json", SMALL);
    for (arguments, why) in [
        ("--device asic", "no table of delays is called \"asic\": use one of ecp5, up5k"),
        ("--device small.json", "a table of delays has register"),
        ("--mhz 0", "use a number above 0"),
        ("--mhz -1", "use a number above 0"),
        ("--mhz nan", "use a number above 0"),
        ("--mhz 5000", "cannot be reached on ecp5: ask for"),
    ] {
        let run = bench.run(&format!("clock --config small.json {arguments}"));
        assert_eq!(run.status, 2, "{arguments}: {}", run.stdout);
        assert!(run.stderr.contains(why), "{arguments}: {}", run.stderr);
    }
    for (clock, why) in [
        (json!({"mhz": 50, "device": "ecp6"}), "no table of delays is called \"ecp6\""),
        (json!({"mhz": 50}), "missing field `device`"),
        (json!({"mhz": 50, "device": "gone.json"}), "gone.json"),
        (
            json!({"mhz": 50, "device": {"register": -1, "rom": 1, "lut": 1, "add": 1, "carry": 0, "multiply": 1,
            "enable": 1, "multiplier_bits": 18}}),
            "\"register\" is a delay in nanoseconds",
        ),
    ] {
        bench.write("clocked.json", with("clock", clock.clone()));
        let run = bench.run("rom --config clocked.json");
        assert_eq!(run.status, 2, "{clock}: {}", run.stdout);
        assert!(run.stderr.contains(why), "{clock}: {}", run.stderr);
    }
    let mut both: Value = serde_json::from_str(&with("clock", json!({"mhz": 50, "device": "ecp5"}))).unwrap();
    both["pipelining"] = json!({"rom": true});
    bench.write("both.json", both.to_string());
    let run = bench.run("rom --config both.json");
    assert!(run.status == 2 && run.stderr.contains("leave \"pipelining\" out, or the clock"), "{}", run.stderr);
}

/// The design that is found has the ranks, and the error that was asked for at every x. It may be another than without
/// a clock: a lower degree takes fewer of them.
#[test]
fn a_search_keeps_the_clock() {
    let bench = bench!();
    bench.write("delays.json", DELAYS);
    let search = "design --exponents 1..=4 --input UQ1.8 --output UQ1.8 --error 0.03 --finalists 1";
    let _written = bench.good(&format!("{search} --clock-mhz 240 --device delays.json --out fast.json"));
    let read = |name: &str| -> Value { serde_json::from_slice(&std::fs::read(bench.path(name)).unwrap()).unwrap() };
    let fast = read("fast.json");
    assert_eq!(fast["clock"]["mhz"], 240.0);
    let rows = csv_rows(&bench.good("clock --config fast.json --device delays.json --format csv"));
    assert!(rows.iter().all(|row| number(row, "MHz") >= 240.0), "{rows:?}");
    let _held = bench.good("report --config fast.json --exhaustive --range all --bound 0.03");
    // The table is read: it is not written over.
    bench.refused(
        &format!("{search} --clock-mhz 240 --device delays.json --out delays.json"),
        &["delays.json is an input of this command"],
    );
    assert_eq!(bench.text("delays.json"), DELAYS);
    let run = bench.run(&format!("{search} --clock-mhz 900 --device delays.json"));
    assert!(run.status == 2 && run.stderr.contains("cannot be reached"), "{}", run.stderr);
    let run = bench.run(&format!("{search} --clock-mhz 100"));
    assert!(run.status == 2 && run.stderr.contains("--device"), "{}", run.stderr);
}
