//! `scripts/synth.py --same-since` takes the table of synthesis over where netlists are the same: names do not count,
//! and everything else does.

use std::fs;
use std::process::Command;

use tempfile::TempDir;

/// A register behind a sum and a choice.
const RIGHT: &str = "module blysk (input logic clk_i, input logic [7:0] a, input logic [7:0] b, output logic [7:0] y);
  logic [7:0] sum, kept;
  assign sum = a + b;
  always_ff @(posedge clk_i) if (a > 8'd5) kept <= sum;
  assign y = kept ^ b;
endmodule
";

/// The shape of each source's netlist is that of the first, or not.
#[test]
fn a_netlist_is_the_same_but_for_names_and_no_more() {
    let renamed = RIGHT.replace("sum", "total").replace("kept", "held");
    let others = [
        ("an operation", RIGHT.replace("a + b", "a - b")),
        ("an operand", RIGHT.replace("a + b", "a + a")),
        ("a constant", RIGHT.replace("8'd5", "8'd6")),
        ("an enable", RIGHT.replace("if (a > 8'd5) ", "")),
        ("a bit", RIGHT.replace("kept ^ b", "kept ^ {b[6:0], b[7]}")),
        ("an edge", RIGHT.replace("posedge", "negedge")),
        ("ports exchanged", RIGHT.replace("kept ^ b", "kept ^ a").replace("a > 8'd5", "b > 8'd5")),
    ];
    let directory = TempDir::new().unwrap();
    let cases = [("names", renamed)].into_iter().chain(others);
    let mut names = Vec::new();
    for (index, (what, text)) in [("", RIGHT.to_owned())].into_iter().chain(cases).enumerate() {
        let place = directory.path().join(index.to_string());
        fs::create_dir(&place).unwrap();
        fs::write(place.join("blysk.sv"), text).unwrap();
        names.push(what);
    }
    let script = "import sys; from pathlib import Path; import synth\n\
                  shapes = [synth.netlist(Path(place), ['blysk.sv']) for place in sys.argv[1:]]\n\
                  print(*(int(shape == shapes[0]) for shape in shapes))";
    let places = (0..names.len()).map(|index| directory.path().join(index.to_string()));
    let mut python = Command::new("python3");
    python
        .args(["-B", "-c", script])
        .args(places)
        .env("PYTHONPATH", concat!(env!("CARGO_MANIFEST_DIR"), "/../scripts"));
    let output = python.output().expect("python3 is there");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    let same: Vec<&str> = said.split_whitespace().collect();
    assert_eq!(same.len(), names.len());
    for (what, same) in names.iter().zip(same) {
        let wanted = if ["", "names"].contains(what) { "1" } else { "0" };
        assert_eq!(same, wanted, "{what}");
    }
}
