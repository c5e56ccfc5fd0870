//! `blysk rtl --dut` of modules that are not as the pipeline is: right ones pass, and of wrong assumptions the
//! testbench says which one fails.

use std::fs;
use std::process::Command;

use blysk_tests::bench;
use blysk_tests::cli::{Bench, SMALL};
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::rtl::{SOURCES, TOP};

/// The pipeline under another name, for a module around it.
fn inner() -> String {
    SOURCES.map(|(_, text)| text.replace(&format!("module {TOP} #("), "module inner #(")).concat()
}

/// Nothing waits: two more ranks behind the pipeline, reset active low.
const TIMED: &str = "
module timed (
  input logic clk, input logic reset_n, input logic request, input logic test_mode,
  input logic [blysk_pkg::ADDRESS_WIDTH-1:0] n, input logic [blysk_pkg::INPUT_WIDTH-1:0] cosine,
  output logic answer, output logic [blysk_pkg::OUTPUT_WIDTH-1:0] y, output logic [blysk_pkg::STATUS_WIDTH-1:0] flags
);
  logic [2:0] valid;
  logic [blysk_pkg::OUTPUT_WIDTH-1:0] y_0, y_1;
  logic [blysk_pkg::STATUS_WIDTH-1:0] flags_0, flags_1;
  logic unused;
  inner pipeline (.clk_i(clk), .rst_i(!reset_n || test_mode), .in_valid_i(request), .in_ready_o(unused),
    .address_i(n), .x_i(cosine), .out_valid_o(valid[0]), .out_ready_i(1'b1), .intensity_o(y_0), .status_o(flags_0));
  always_ff @(posedge clk) begin
    {y_1, flags_1} <= {y_0, flags_0};
    {y, flags} <= {y_1, flags_1};
    valid[2:1] <= reset_n ? valid[1:0] : 2'b00;
  end
  assign answer = valid[2];
endmodule
";

/// An enable: nothing moves without it.
const ENABLED: &str = "
module enabled (
  input logic clk, input logic rst_i, input logic enable, input logic in_valid_i,
  input logic [blysk_pkg::ADDRESS_WIDTH-1:0] address_i, input logic [blysk_pkg::INPUT_WIDTH-1:0] x_i,
  output logic none_o, output logic [blysk_pkg::OUTPUT_WIDTH-1:0] intensity_o
);
  logic moves, ready, valid;
  logic [blysk_pkg::STATUS_WIDTH-1:0] status;
  always @(negedge clk) moves <= enable || rst_i;
  assign none_o = !valid;
  inner pipeline (.clk_i(clk && moves), .rst_i, .in_valid_i, .in_ready_o(ready), .address_i, .x_i,
    .out_valid_o(valid), .out_ready_i(1'b1), .intensity_o, .status_o(status));
endmodule
";

/// Only numbers: no flag at all.
const BARE: &str = "
module bare (
  input logic clk_i, input logic [blysk_pkg::ADDRESS_WIDTH-1:0] address_i,
  input logic [blysk_pkg::INPUT_WIDTH-1:0] x_i, output logic [blysk_pkg::OUTPUT_WIDTH-1:0] intensity_o
);
  logic ready, valid, rst = 1'b1;
  logic [blysk_pkg::STATUS_WIDTH-1:0] status;
  always @(posedge clk_i) rst <= 1'b0;
  inner pipeline (.clk_i, .rst_i(rst), .in_valid_i(1'b1), .in_ready_o(ready), .address_i, .x_i,
    .out_valid_o(valid), .out_ready_i(1'b1), .intensity_o, .status_o(status));
endmodule
";

const TIMED_PORTS: &str = r#"{"ports": {"clk_i": "clk", "rst_i": "!reset_n", "in_valid_i": "request",
    "in_ready_o": null, "address_i": "n", "x_i": "cosine", "out_valid_o": "answer", "out_ready_i": null,
    "intensity_o": "y", "status_o": "flags"}, "tied": {"test_mode": 0}}"#;
const ENABLED_PORTS: &str = r#"{"ports": {"clk_i": "clk", "in_ready_o": null, "out_ready_i": "enable",
    "out_valid_o": "!none_o", "status_o": null}}"#;
const BARE_PORTS: &str = r#"{"ports": {"rst_i": null, "in_valid_i": null, "in_ready_o": null, "out_valid_o": null,
    "out_ready_i": null, "status_o": null}}"#;

/// What the small pipeline takes.
fn latency() -> usize {
    Design::new(Config::from_json(SMALL).unwrap()).unwrap().datapath().rank_count()
}

/// What `make TARGET` says in Icarus of this module with these ports and this latency, and whether it ended well.
fn said(bench: &Bench, (name, module, ports): (&str, &str, &str), latency: usize, target: &str) -> (bool, String) {
    bench.write("ports.json", ports);
    let command = format!(
        "rtl --config small.json --count 300 --out rtl --dut {name} --dut-latency {latency} --ports ports.json"
    );
    let _hint = bench.good(&command);
    fs::write(bench.path("rtl/dut.sv"), inner() + module).unwrap();
    let mut make = Command::new("make");
    make.args(["--silent", "-C"]).arg(bench.path("rtl")).args([target, "DUT=dut.sv"]);
    let output = make.env_remove("MAKEFLAGS").env_remove("MFLAGS").env_remove("MAKELEVEL").output().expect("make");
    let text = String::from_utf8_lossy(&[&output.stdout[..], &output.stderr[..]].concat()).into_owned();
    let log = fs::read_to_string(bench.path("rtl/build/log")).unwrap_or_default();
    (output.status.success(), if target == "control" { log } else { text })
}

#[test]
fn modules_of_other_ports_and_latencies_pass() {
    let bench = bench!();
    for (module, latency) in [
        (("timed", TIMED, TIMED_PORTS), latency() + 2),
        (("enabled", ENABLED, ENABLED_PORTS), latency()),
        (("bare", BARE, BARE_PORTS), latency()),
    ] {
        let (good, text) = said(&bench, module, latency, "icarus");
        assert!(good && text.contains("PASS 300 vectors"), "{}: {text}", module.0);
        let (good, text) = said(&bench, module, latency, "control");
        assert!(good && text.contains("dut.intensity is "), "{}: {text}", module.0);
        let (good, text) = said(&bench, module, latency, "waves");
        assert!(good && bench.text("rtl/waves.gtkw").contains("blysk_tb.intensity["), "{text}");
    }
    // With the pipeline's own ports, and the handshake.
    let (good, text) = said(&bench, ("inner", "", "{}"), latency(), "icarus");
    assert!(good && text.contains("PASS 300 vectors"), "{text}");
    let (good, text) = said(&bench, ("inner", "", "{}"), latency() - 1, "icarus");
    assert!(!good && text.contains("answers come 1 cycle late"), "{text}");
}

/// One wrong assumption at a time.
#[test]
fn the_assumption_that_fails_is_named() {
    let bench = bench!();
    let right = latency() + 2;
    let timed = |module: &'static str, ports: &'static str| ("timed", module, ports);
    let early = format!("answers come 2 cycles early, after {right} and not after {}", right + 2);
    let late = format!("answers come 3 cycles late, after {right} and not after {}", right - 3);
    let edited = |from: &str, to: &str| -> &'static str { TIMED.replace(from, to).leak() };
    let ports = |from: &str, to: &str| -> &'static str { TIMED_PORTS.replace(from, to).leak() };
    let delayed = edited("assign answer = valid[2]", "assign answer = valid[1]");
    let flags = edited("{y, flags} <= {y_1, flags_1}", "{y, flags} <= {y_1, ~flags_1}");
    let cases: [(&str, &str, usize, &str); 6] = [
        (TIMED, TIMED_PORTS, right + 2, &early),
        (TIMED, TIMED_PORTS, right - 3, &late),
        (TIMED, ports("!reset_n", "reset_n"), right, "is rst_i (port reset_n) active high"),
        (TIMED, ports("\"test_mode\": 0", "\"test_mode\": 1"), right, "is rst_i (port reset_n) active low"),
        (delayed, TIMED_PORTS, right, "out_valid_o (port answer) is not where the answers are"),
        (flags, TIMED_PORTS, right, "status_o (port flags) is wrong in all of"),
    ];
    for (module, ports, latency, wanted) in cases {
        let (good, text) = said(&bench, timed(module, ports), latency, "icarus");
        assert!(!good && text.contains(wanted), "{wanted}: {text}");
        assert_eq!(text.lines().filter(|line| line.starts_with("FAIL")).count(), 1, "{text}");
    }
    // Without a flag the time of the answers alone tells.
    let (good, text) = said(&bench, ("bare", BARE, BARE_PORTS), latency() + 1, "icarus");
    assert!(!good && text.contains("answers come 1 cycle early"), "{text}");
    let stuck = BARE.replace(".clk_i, .rst_i(rst)", ".clk_i(1'b0), .rst_i(rst)");
    let (good, text) = said(&bench, ("bare", &stuck, BARE_PORTS), latency(), "icarus");
    assert!(!good && text.contains("unknown bits (x) in every cycle; is clk_i the clock"), "{text}");
    // A wrong answer is no wrong assumption.
    let wrong = edited("{y_0, flags_0};", "{y_0 == 255 ? y_0 - 1'b1 : y_0, flags_0};");
    let (good, text) = said(&bench, timed(wrong, TIMED_PORTS), right, "icarus");
    assert!(!good && text.contains("FAIL vector ") && text.contains("dut.intensity is 9'hfe"), "{text}");
}

#[test]
fn a_map_with_a_mistake() {
    let bench = bench!();
    let refused = |map: &str, said: &[&str]| {
        bench.write("map.json", map);
        let command = "rtl --config small.json --out new --dut mine --ports map.json";
        let said: Vec<&str> = said.iter().copied().chain(["map.json"]).collect();
        bench.refused(command, &said);
    };
    refused(r#"{"ports": {"clock": "clk"}}"#, &["port clock", "clk_i, rst_i"]);
    refused(r#"{"ports": {"x_i": null}}"#, &["port x_i", "must have it"]);
    refused(r#"{"ports": {"x_i": "!x"}}"#, &["port x_i", "active low"]);
    refused(r#"{"ports": {"x_i": "a b"}}"#, &["port x_i", "letters, digits"]);
    refused(r#"{"ports": {"x_i": "always"}}"#, &["port x_i", "reserved"]);
    refused(r#"{"ports": {"x_i": "clk_i"}}"#, &["clk_i", "already"]);
    refused(r#"{"ports": {"in_valid_i": null}}"#, &["port out_valid_o", "in_valid_i"]);
    refused(r#"{"ports": {"out_valid_o": null}}"#, &["port out_valid_o", "wait"]);
    refused(r#"{"tied": {"scan": 2}}"#, &["port scan", "0 or 1"]);
    refused(r#"{"port": {}}"#, &["`port`", "\"ports\" and \"tied\""]);
    refused("", &["\"clk_i\": \"clk\""]);
    bench.refused("rtl --config small.json --out new --dut mine --ports none.json", &["none.json", "No such file"]);
    bench.refused("rtl --config small.json --out new --ports map.json", &["--dut"]);
    bench.refused("rtl --config small.json --out new --dut mine --dut-latency 65537", &["65537"]);
}
