//! Names that would reach SystemVerilog, Makefile, core file or a shell and break there.

use blysk_tests::bench;
use hw_model::names::RESERVED;

use super::edited;

/// What is no plain identifier, or has a line, a comment, an expansion or a quote in it.
const ODD: [&str; 16] =
    ["", " ", "a b", "1abc", "a\nb", "a$b", "$finish", "a#b", "a\"b", "a'b", "a\\", "\\a ", "a;b", "a/b", "é", "`a"];

#[test]
fn the_module_under_test_is_a_free_plain_identifier() {
    let bench = bench!();
    let refused = |name: &str, said: &str| {
        let option = format!("--dut={name}");
        let command = ["rtl", "--config", "small.json", "--out", "rtl", &option];
        bench.refused_list(&command, &["--dut", said]);
    };
    for name in ODD.into_iter().chain(["a-b", "-"]) {
        refused(name, "letters, digits and _");
    }
    for word in RESERVED {
        refused(word, "reserved word");
    }
    for name in ["blysk_tb", "blysk_pkg", "blysk_rom", "blysk_stage", "blysk_tail_digits"] {
        refused(name, "the bundle itself");
    }
    refused("bool", "Icarus");
    refused("TOP", "Verilator");
    refused(&"a".repeat(101), "at most 100");
}

#[test]
fn a_configuration_has_a_name_for_files() {
    let bench = bench!();
    let named = |name: &str| {
        let name = serde_json::to_string(name).unwrap();
        edited("\"name\": \"small\"", &format!("\"name\": {name}"))
    };
    for name in ODD.iter().filter(|name| **name != "1abc").chain(&["-", "-x", ".."]) {
        bench.write("odd.json", named(name));
        bench.refused("rtl --config odd.json --out rtl", &["`name`", "letters, digits, - and _"]);
    }
    bench.write("odd.json", named(&"a".repeat(101)));
    bench.refused("rtl --config odd.json --out rtl", &["`name`", "at most 100"]);
}
