//! One set of random configurations, requests and clock cycles for the command, Rust, Python, C and DPI-C: equal bits.
//!
//! Rust's answers (the crate `model`) are in the case; `tests/naive` holds them against a model that shares no code.

use std::fs;
use std::path::Path;
use std::process::Command;

use hw_model::handshake::Handshake;
use tempfile::TempDir;

use crate::cases::{CONFIGURATIONS, CYCLES, Case, REQUESTS, all};
use crate::tools::{Tools, passes};

#[test]
fn every_way_to_the_model_gives_the_same_bits() {
    let tools = Tools::ready();
    let directory = TempDir::new().unwrap();
    let place = directory.path();
    let c = c_program(&tools, place);
    let dpi = dpi_program(&tools, place);
    let (mut requests, mut cycles, mut taken) = (0, 0, 0);
    for (index, case) in all().iter().enumerate() {
        write(case, place);
        let name = format!("configuration {index}: {}", case.configuration);
        let python = Command::new(&tools.python)
            .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden_model/answers.py"))
            .args(FILES)
            .current_dir(place)
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .output();
        passes(python, "Python");
        compare(case, "Python", place, &name);
        passes(Command::new(&c).args(FILES).current_dir(place).output(), "C");
        compare(case, "C", place, &name);
        let plus = PLUS.iter().map(|(plus, file)| format!("+{plus}={file}"));
        passes(Command::new(&dpi).args(plus).current_dir(place).output(), "DPI-C");
        words(case, place);
        compare(case, "DPI-C", place, &name);
        command_answers(case, place, &name);
        taken += command_clocked(case, place, &name);
        requests += case.xs.len();
        cycles += case.cycles.len();
    }
    assert_eq!((requests, cycles), (CONFIGURATIONS * REQUESTS, CONFIGURATIONS * CYCLES));
    assert!(requests >= 1_000_000 && cycles >= 100_000 && taken > cycles / 4, "{requests} {cycles} {taken}");
    println!("{requests} requests, {cycles} cycles with {taken} results, in command, Rust, Python, C and DPI-C");
}

/// The files of `answers.py` and `answers.c`, in the order of their arguments.
const FILES: [&str; 5] = ["configuration.json", "requests.bin", "cycles.bin", "answers.bin", "shown.bin"];
/// The same of `answers.sv`, as words in hex.
const PLUS: [(&str, &str); 5] = [
    ("configuration", "configuration.json"),
    ("requests", "requests.hex"),
    ("cycles", "cycles.hex"),
    ("answers", "answers.hex"),
    ("shown", "shown.hex"),
];

/// Writes what is asked, in each form.
fn write(case: &Case, place: &Path) {
    for (_, file) in PLUS {
        let _ = fs::remove_file(place.join(file));
    }
    let input = case.model.datapath().formats().input;
    let requests = || case.addresses.iter().zip(&case.xs);
    let cycle =
        |c: &sim::pipeline::Inputs| [i64::from(c.reset), c.in_valid.into(), c.address.into(), c.x, c.out_ready.into()];
    fs::write(place.join("configuration.json"), &case.configuration).unwrap();
    write_integers(place, "requests.bin", requests().flat_map(|(&address, &x)| [address.into(), x]));
    write_integers(place, "cycles.bin", case.cycles.iter().flat_map(cycle));
    let word = |x: i64| input.to_word(x);
    let lines: String = requests().map(|(address, &x)| format!("{address:x} {:x}\n", word(x))).collect();
    fs::write(place.join("requests.hex"), lines).unwrap();
    let line = |c: &sim::pipeline::Inputs| {
        let [reset, in_valid, address, x, out_ready] = cycle(c);
        format!("{reset} {in_valid} {address:x} {:x} {out_ready}\n", word(x))
    };
    fs::write(place.join("cycles.hex"), case.cycles.iter().map(line).collect::<String>()).unwrap();
}

fn write_integers(place: &Path, name: &str, integers: impl Iterator<Item = i64>) {
    fs::write(place.join(name), integers.flat_map(i64::to_le_bytes).collect::<Vec<u8>>()).unwrap();
}

fn read_integers<const COLUMNS: usize>(place: &Path, name: &str) -> Vec<[i64; COLUMNS]> {
    let bytes = fs::read(place.join(name)).unwrap();
    fs::remove_file(place.join(name)).unwrap();
    let integers: Vec<i64> = bytes.as_chunks().0.iter().map(|&bytes| i64::from_le_bytes(bytes)).collect();
    assert_eq!(integers.len() % COLUMNS, 0);
    integers.as_chunks().0.to_vec()
}

/// The words of the ports, as the integers that they mean.
fn words(case: &Case, place: &Path) {
    let output = case.model.datapath().formats().output;
    for (from, to, intensity) in [("answers.hex", "answers.bin", 0), ("shown.hex", "shown.bin", 2)] {
        let text = fs::read_to_string(place.join(from)).unwrap();
        let line = |line: &str| {
            let words: Vec<u64> = line.split(' ').map(|word| u64::from_str_radix(word, 16).unwrap()).collect();
            let meant = |(place, &word)| if place == intensity { output.from_word(word) } else { word as i64 };
            words.iter().enumerate().map(meant).collect::<Vec<i64>>()
        };
        write_integers(place, to, text.lines().flat_map(line));
    }
}

/// What a way answered, beside the case's answers.
fn compare(case: &Case, way: &str, place: &Path, name: &str) {
    let (answers, shown) = (read_integers(place, "answers.bin"), read_integers(place, "shown.bin"));
    assert_eq!((answers.len(), shown.len()), (case.answers.len(), case.shown.len()), "{way}, {name}");
    for (index, (found, wanted)) in answers.iter().zip(&case.answers).enumerate() {
        assert_eq!(found, wanted, "{way}, request {index}: {} {}, {name}", case.addresses[index], case.xs[index]);
    }
    for (cycle, (found, wanted)) in shown.iter().zip(&case.shown).enumerate() {
        // Without a result, intensity and status mean nothing; the model shows what the registers hold.
        assert_eq!(found, wanted, "{way}, cycle {cycle}: {:?}, {name}", case.cycles[cycle]);
    }
}

/// `blysk evaluate`, requests as lines of CSV.
fn command_answers(case: &Case, place: &Path, name: &str) {
    let lines = case.addresses.iter().zip(&case.xs).map(|(address, x)| format!("{address},{x}\n"));
    fs::write(place.join("requests.csv"), "address,x_bits\n".to_owned() + &lines.collect::<String>()).unwrap();
    let said = blysk(place, "evaluate --config configuration.json --format csv requests.csv");
    let answers = columns(&said, ["intensity_bits", "status"]);
    assert_eq!(answers.len(), case.answers.len(), "{name}");
    for (index, (found, wanted)) in answers.iter().zip(&case.answers).enumerate() {
        assert_eq!(found, wanted, "command, request {index}: {} {}, {name}", case.addresses[index], case.xs[index]);
    }
}

/// `blysk simulate`, which holds a request until it is taken: so it is given those that were taken, in their cycles.
fn command_clocked(case: &Case, place: &Path, name: &str) -> usize {
    let exponents = case.model.design().rom().exponents();
    let missing = (1..).map(|step| f64::from(step) + 0.123_456_789).find(|&n| exponents.position(n).is_none());
    let n = |address: u32| exponents.as_slice().get(address as usize).copied().or(missing).unwrap();
    // Without a handshake nothing waits, whatever the port says.
    let waits = case.model.datapath().control().handshake != Handshake::None;
    let mut stimulus = "n,x_bits,valid,ready,reset\n".to_owned();
    let mut wanted = Vec::new();
    for (cycle, (inputs, [in_ready, out_valid, intensity, status])) in case.cycles.iter().zip(&case.shown).enumerate() {
        let taken = inputs.in_valid && *in_ready == 1 && !inputs.reset;
        let [valid, ready, reset] = [taken, inputs.out_ready, inputs.reset].map(u8::from);
        stimulus += &format!("{},{},{valid},{ready},{reset}\n", n(inputs.address), inputs.x);
        if *out_valid == 1 && (inputs.out_ready || !waits) && !inputs.reset {
            wanted.push([cycle as i64, *intensity, *status]);
        }
    }
    fs::write(place.join("stimulus.csv"), stimulus).unwrap();
    let said = blysk(place, "simulate --config configuration.json --stimulus stimulus.csv --out -");
    let mut found = columns(&said, ["cycle", "intensity_bits", "status"]);
    // Behind the last line the pipeline runs until it is empty.
    found.retain(|[cycle, ..]| *cycle < case.cycles.len() as i64);
    assert_eq!(found, wanted, "simulate, {name}");
    wanted.len()
}

fn blysk(place: &Path, words: &str) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_blysk-under-test"));
    passes(command.args(words.split(' ')).current_dir(place).output(), words)
}

/// Columns of a table, as integers.
fn columns<const COUNT: usize>(table: &str, names: [&str; COUNT]) -> Vec<[i64; COUNT]> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let header = reader.headers().unwrap().clone();
    let places = names.map(|name| header.iter().position(|column| column == name).unwrap());
    reader.records().map(|row| row.unwrap()).map(|row| places.map(|place| row[place].parse().unwrap())).collect()
}

fn c_program(tools: &Tools, place: &Path) -> std::path::PathBuf {
    let program = place.join("answers_c");
    let mut cc = Command::new("cc");
    cc.args(["-std=c11", "-O1", "-Wall", "-Wextra", "-Werror", "-o"]).arg(&program);
    cc.arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden_model/answers.c"));
    passes(cc.args(tools.linked()).output(), "cc");
    program
}

fn dpi_program(tools: &Tools, place: &Path) -> std::path::PathBuf {
    let build = place.join("dpi");
    let mut verilator = tools.verilator();
    verilator.args(["--binary", "--timing", "-j", "2", "-Wno-fatal", "--top-module", "answers", "--Mdir"]).arg(&build);
    verilator.args(["-CFLAGS", "-fcoroutines -O1", "-MAKEFLAGS", "CFG_CXXFLAGS_PCH_I=-include", "-o", "answers"]);
    verilator.arg(tools.dpi("blysk_dpi_pkg.sv"));
    verilator.arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden_model/answers.sv"));
    let libraries = tools.linked().join(" ");
    passes(verilator.args(["-LDFLAGS", &libraries]).output(), "verilator");
    build.join("answers")
}
