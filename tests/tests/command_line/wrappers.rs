//! What `blysk rtl` writes beside the RTL for other languages and tools: read by such.

use ::vectors::rtl::Modules;
use blysk_tests::bench;
use blysk_tests::cli::CONFIGURATIONS;
use blysk_tests::rtl::wrappers::{check, verilog_2005};
use hw_model::config::Config;
use hw_model::design::Design;

#[test]
fn wrappers_and_descriptions_are_read() {
    let bench = bench!();
    for (file, prefix, more) in [
        ("small.json", "blysk", ""),
        ("centred.json", "Shiny_1", "--clock-mhz 133.3"),
        ("divider.json", "entity", "--rom-in-source"),
    ] {
        let _hint = bench.good(&format!("rtl --config {file} --count 9 --prefix {prefix} {more} --out {prefix}"));
        let modules = Modules::new(prefix, None).unwrap();
        check(&bench.path(prefix), &modules).unwrap_or_else(|error| panic!("{file}: {error}"));
    }
    assert!(bench.text("Shiny_1/Shiny_1.sdc").contains("-period 7.502 [get_ports clk_i]"));
    for clock in ["0", "-1", "NaN", "1e9", "fast"] {
        let command = format!("rtl --config small.json --out new --clock-mhz={clock}");
        bench.refused(&command, &["--clock-mhz", "0.001 to 100000"]);
    }
}

#[test]
fn verilog_2005_answers_the_vectors() {
    let bench = bench!();
    for (file, json) in CONFIGURATIONS {
        let place = format!("{file}.rtl");
        let _hint = bench.good(&format!("rtl --config {file} --count 300 --out {place}"));
        let design = Design::new(Config::from_json(json).unwrap()).unwrap();
        let passed = verilog_2005(&bench.path(&place), design.datapath(), 300);
        passed.unwrap_or_else(|error| panic!("{file}: {error}"));
    }
}
