//! Stimulus files with a mistake: the message names the file, the line and the field.

use blysk_tests::bench;

#[test]
fn a_stimulus_with_a_mistake() {
    let bench = bench!();
    let refused = |stimulus: &str, said: &[&str]| {
        bench.write("in.csv", stimulus);
        let mut said = said.to_vec();
        said.push("in.csv");
        for more in ["--out new", "--trace t.csv --waves w.vcd", ""] {
            bench.refused(&format!("simulate --config small.json --stimulus in.csv {more}"), &said);
        }
    };
    for (line, said) in [
        ("0.5,1,1,1,0", &["`n`", "0.5", "from 1 up"][..]),
        ("NaN,1,1,1,0", &["`n`", "NaN"]),
        ("inf,1,1,1,0", &["`n`", "inf"]),
        (",1,1,1,0", &["`n`", "64 or 2.5"]),
        ("1,NaN,1,1,0", &["`x`", "NaN"]),
        ("1,inf,1,1,0", &["`x`", "inf"]),
        ("1,-2.01,1,1,0", &["`x`", "-2.01", "-2"]),
        ("1,2,1,1,0", &["`x`", "1.998"]),
        ("1,,1,1,0", &["`x`", "0.75"]),
        ("1,0x10,1,1,0", &["`x`", "x_bits"]),
        ("1,1,2,1,0", &["`valid`", "neither 0 nor 1"]),
        ("1,1,1,yes,0", &["`ready`", "neither 0 nor 1"]),
        ("1,1,1,1,", &["`reset`", "neither 0 nor 1"]),
        ("1,1,1,1", &["4 fields", "5 columns"]),
        ("1,1,1,1,0,0", &["6 fields", "5 columns"]),
    ] {
        let mut said = said.to_vec();
        // Comments and empty lines are counted.
        said.push("in.csv:5:");
        refused(&format!("n,x,valid,ready,reset\n1,0.5,1,1,0\n# why\n\n{line}\n"), &said);
    }
    for (stimulus, said) in [
        ("n,x_bits\n1,1024\n", &["in.csv:2:", "`x_bits`", "-1024 to 1023"][..]),
        ("n,x_bits\n1,0x800\n", &["in.csv:2:", "`x_bits`", "11 bits"]),
        ("n,x_bits\n1,0.5\n", &["in.csv:2:", "`x_bits`", "integer"]),
        ("n,y\n1,1\n", &["in.csv:1:", "\"y\"", "x (or x_bits)"]),
        ("n\n1\n", &["in.csv:1:", "`x` is missing"]),
        ("x\n1\n", &["in.csv:1:", "`n` is missing"]),
        ("n,x,x_bits\n1,1,1\n", &["in.csv:1:", "one of them"]),
        ("n,n,x\n1,1,1\n", &["in.csv:1:", "twice"]),
        ("n,x\n", &["no cycles"]),
        ("", &["no cycles"]),
    ] {
        refused(stimulus, said);
    }
    bench.write("in.csv", b"n,x\n1,\xff\n");
    bench.refused("simulate --config small.json --stimulus in.csv", &["in.csv:2:", "UTF-8"]);
    bench.refused(
        "simulate --config small.json --stimulus none.csv --out new",
        &["cannot read the stimulus none.csv", "No such file"],
    );
    bench.refused("simulate --config small.json --stimulus . --out new", &["cannot read the stimulus .", "directory"]);
    bench.refused("simulate --config small.json --out new", &["--stimulus"]);
}
