//! What `blysk rtl` writes, whatever the names in it; and what its Makefile takes for a verdict.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use blysk_tests::bench;
use blysk_tests::cli::{Bench, SMALL};
use hw_model::rtl::{SOURCES, TOP};
use proptest::prelude::*;
use proptest::sample::select;

/// Pieces of names that mean something to Verilog, make, YAML or a shell.
const PIECES: [&str; 30] = [
    "a", "Z", "0", "_", "-", " ", "\n", "\r", "\t", "$", "$(x)", "#", "'", "\"", "\\", "`x", ";", "//", "*/", ":",
    "%s", "é", "\u{301}", "\u{2028}", "\u{202e}", "\u{7f}", "~", "&", "{", "!",
];
const WORDS: [&str; 12] =
    ["always", "logic", "bool", "std", "TOP", "dut", "clk", "stimulus", "blysk", "blysk_tb", "blysk_rom", "complete"];

fn make(directory: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new("make");
    command.arg("--silent").arg("-C").arg(directory).args(arguments);
    command.env_remove("MAKEFLAGS").env_remove("MFLAGS").env_remove("MAKELEVEL");
    command.output().expect("make is there")
}

fn text(output: &Output) -> String {
    String::from_utf8_lossy(&[&output.stdout[..], &output.stderr[..]].concat()).into_owned()
}

/// The pipeline as a designer's own: the same under another name.
fn own(name: &str) -> String {
    let module = format!("module {TOP} #(");
    SOURCES.map(|(_, text)| text.replace(&module, &format!("module {name} #("))).concat()
}

/// Emits a bundle and runs it in Icarus as the hint says, when it is not refused; the core file must be YAML. Tells
/// whether it was taken.
fn taken(configuration: &str, name: &str, place: &str, dut: &str) -> bool {
    let bench = bench!();
    let json = SMALL.replace("\"small\"", &serde_json::to_string(name).unwrap());
    bench.write(configuration, json);
    let dut_option = format!("--dut={dut}");
    let command = ["rtl", "--config", configuration, "--count", "9", "--out", place, &dut_option];
    let run = bench.run_list(&command);
    if run.status != 0 {
        assert_eq!(run.status, 2, "{run:#?}");
        return false;
    }
    let hint = run.stdout.split("try: ").nth(1).expect("a hint").trim();
    fs::write(bench.path(place).join("dut.sv"), own(dut)).unwrap();
    let hint = format!("{} ARGUMENTS=+plain", hint.replace("DUT=FILE", "DUT=dut.sv"));
    let shell =
        Command::new("bash").args(["-c", &hint]).current_dir(bench.path("")).env_remove("MAKEFLAGS").output().unwrap();
    assert!(shell.status.success() && text(&shell).contains("PASS 9 vectors"), "{run:#?} {}", text(&shell));
    yaml(&bench.path(place).join("blysk.core"));
    true
}

/// FuseSoC's own reader.
fn yaml(path: &Path) {
    let python = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/venv/bin/python");
    let script = "import sys, yaml; yaml.safe_load(open(sys.argv[1], encoding='utf-8'))['name']";
    let output = Command::new(python).args(["-c", script]).arg(path).output().expect("scripts/setup was run");
    assert!(output.status.success(), "{}", text(&output));
}

fn nasty() -> impl Strategy<Value = String> {
    let pieces = proptest::collection::vec(select(&PIECES[..]), 1..5).prop_map(|all| all.concat());
    prop_oneof![pieces, select(&WORDS[..]).prop_map(str::to_owned), "[a-z_][a-z0-9_]{0,8}"]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, max_shrink_iters: 20, ..ProptestConfig::default() })]

    #[test]
    fn any_name_of_a_module_is_refused_or_compiles(dut in nasty()) {
        let _ = taken("small.json", "small", "rtl", &dut);
    }

    #[test]
    fn any_name_of_a_configuration_is_refused_or_compiles(name in nasty()) {
        let _ = taken("small.json", &name, "rtl", TOP);
    }

    /// These are never refused: a path is quoted wherever it goes.
    #[test]
    fn any_name_of_a_file_or_directory_compiles(file in nasty(), place in nasty()) {
        // A name, and no way to somewhere else.
        let name = |text: &str| format!("f{}", text.replace('/', ""));
        let configuration = format!("{}.json", name(&file));
        prop_assert!(taken(&configuration, "small", &name(&place), TOP));
    }
}

fn emitted(dut: &str) -> Bench {
    let bench = bench!();
    let said = bench.good(&format!("rtl --config small.json --count 9 --out rtl --dut {dut}"));
    assert!(said.contains("try: make -C rtl icarus"), "{said}");
    bench
}

/// A simulator's own words after the verdict do not count, and two verdicts are none.
#[test]
fn the_makefile_finds_the_verdict() {
    let bench = emitted("blysk");
    let control = fs::read_to_string(bench.path("rtl/manifest.json")).unwrap();
    let control: serde_json::Value = serde_json::from_str(&control).unwrap();
    let found = format!("FAIL vector {}: x: clamp.intensity is 1", control["negative_control"]["vector"]);
    let own = "blysk_tb.sv:464: $finish called at 71605000 (1ps)";
    for (target, said, good) in [
        ("icarus", vec!["PASS 9 vectors"], true),
        ("icarus", vec!["7 cycles", "PASS 9 vectors", own], true),
        ("waves", vec!["PASS 9 vectors", own], true),
        ("icarus", vec!["PASS 8 vectors"], false),
        ("icarus", vec!["FAIL vector 1", "PASS 9 vectors"], false),
        ("waves", vec!["PASS 9 vectors", "FAIL vector 1"], false),
        ("icarus", vec![own], false),
        ("control", vec![&found[..]], true),
        ("control", vec![&found, own], true),
        ("control", vec![&found, "PASS 9 vectors"], false),
        ("control", vec!["FAIL vector 9999: x: clamp.intensity is 1"], false),
        ("control", vec!["PASS 9 vectors"], false),
        ("control", vec![own], false),
    ] {
        bench.write("simulator", format!("#!/bin/sh\ncat <<'END'\n{}\nEND\n", said.join("\n")));
        let output = make(&bench.path("rtl"), &[target, "IVERILOG=true", "VVP=sh ../simulator"]);
        assert_eq!(output.status.success(), good, "make {target}: {said:?}: {}", text(&output));
    }
}

#[test]
fn a_module_that_is_not_there_is_asked_for() {
    let bench = emitted("my_highlight");
    let output = make(&bench.path("rtl"), &["icarus"]);
    assert!(!output.status.success());
    assert!(text(&output).contains("DUT=FILE"), "{}", text(&output));
    let output = make(&bench.path("rtl"), &["icarus", "DUT=nowhere.sv"]);
    assert!(!output.status.success());
    assert!(text(&output).contains("nowhere.sv"), "{}", text(&output));
}

/// With the words in the source no image is asked for, Icarus answers every vector, and Yosys still finds a memory.
#[test]
fn the_rom_stands_in_the_source() {
    let bench = bench!();
    // Of few words Yosys makes no memory.
    let said = bench.good("rtl --preset compact --count 300 --out rtl --rom-in-source --prefix shiny");
    assert!(said.contains("module shiny"), "{said}");
    let sources: String = bench
        .tree("rtl")
        .into_iter()
        .filter(|(name, _)| name.extension().is_some_and(|e| e == "sv"))
        .filter(|(name, _)| !name.ends_with("shiny_tb.sv"))
        .map(|(_, text)| String::from_utf8(text.unwrap()).unwrap())
        .collect();
    assert!(!sources.contains("ROM_FILE") && !sources.contains("$readmemh") && !sources.contains("$fopen"));
    let output = make(&bench.path("rtl"), &["icarus"]);
    assert!(output.status.success() && text(&output).contains("PASS 300 vectors"), "{}", text(&output));
    let output = make(&bench.path("rtl"), &["lint"]);
    assert!(output.status.success(), "{}", text(&output));
    let files = SOURCES.map(|(name, _)| name.replace(TOP, "shiny")).join(" ");
    let script = format!(
        "read_verilog -sv shiny_pkg.sv {files}; hierarchy -check -top shiny; proc; flatten; opt; memory -nomap; \
         select -assert-count 1 t:$mem_v2; check -assert"
    );
    let output = Command::new("yosys").args(["-q", "-p", &script]).current_dir(bench.path("rtl")).output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    bench.refused("rtl --config small.json --out new --rom-in-source --dut mine", &["--rom-in-source", "--dut"]);
}
