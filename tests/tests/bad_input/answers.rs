//! Logs of answers that are none: the message names the file, the line and the column.

use blysk_tests::answers::Log;
use blysk_tests::bench;
use blysk_tests::cli::Bench;

const CHECK: &str = "check --vectors v --log dut.csv";

fn right(bench: &Bench) -> Log {
    let _summary = bench.good("vectors --config small.json --strategy random --count 9 --out v");
    Log::right(bench, "v").only(&["index", "intensity", "status", "stage1.t1"])
}

#[test]
fn a_log_with_a_mistake() {
    let bench = bench!();
    let right = right(&bench);
    for (column, text, said) in [
        ("intensity", "", &["\"\"", "0x"][..]),
        ("intensity", "0x", &["\"0x\"", "hex number"]),
        ("intensity", "0x12g", &["\"0x12g\"", "hex number"]),
        ("intensity", "-1", &["\"-1\"", "0x"]),
        ("intensity", "0x-1", &["hex number"]),
        ("intensity", "0.5", &["\"0.5\""]),
        ("intensity", "0x200", &["9 bits", "UQ1.8"]),
        ("intensity", "0xffffffffffffffffffff", &["9 bits"]),
        ("intensity", "1ff", &["no 0x", "alike"]),
        ("status", "0x10", &["4 bits"]),
        ("status", "clamped", &["\"clamped\""]),
        ("stage1.t1", "0xffffffffffff", &["fit"]),
        ("index", "-1", &["\"-1\"", "0 to 8"]),
        ("index", "0x3", &["decimal"]),
        ("index", "x", &["\"x\"", "decimal"]),
        ("index", "9", &["out of range", "0 to 8"]),
        ("index", "2", &["twice", "line 4"]),
    ] {
        let mut log = right.clone();
        *log.field(7, column) = text.to_owned();
        bench.write("dut.csv", log.text());
        bench.refused(CHECK, &[said, &["dut.csv:9:", &format!("`{column}`")]].concat());
    }
    // Comments and empty lines are counted.
    bench.write("dut.csv", "# mine\nintensity\n\n0x1\nno\n");
    bench.refused(CHECK, &["dut.csv:5:", "`intensity`", "\"no\""]);
    bench.write("dut.csv", "intensity\n001\n0x001\n");
    bench.refused(CHECK, &["dut.csv:3:", "`intensity`", "have not", "alike"]);
}

#[test]
fn a_log_that_is_none() {
    let bench = bench!();
    let right = right(&bench);
    for (text, said) in [
        ("", &["dut.csv:1:", "empty", "`intensity` is missing"][..]),
        ("intensity;status\n0;0\n", &["dut.csv:1:", "separated by `;`"]),
        ("intensity\tstatus\n0\t0\n", &["dut.csv:1:", "separated by tabs"]),
        ("index,intensity\n0;0\n", &["dut.csv:2:", "separated by `;`"]),
        ("intensity\n", &["no answers"]),
        ("index,status\n0,0\n", &["dut.csv:1:", "`intensity` is missing"]),
        ("intensity,t1\n0,0\n", &["dut.csv:1:", "\"t1\"", "vectors.csv"]),
        ("intensity,stage1.t9\n0,0\n", &["dut.csv:1:", "\"stage1.t9\""]),
        ("intensity,intensity\n0,0\n", &["dut.csv:1:", "`intensity` is named twice"]),
        ("index,intensity,index\n0,0,0\n", &["`index` is named twice"]),
        ("intensity,status\n0\n", &["dut.csv:2:", "1 fields", "2 columns"]),
        ("intensity\n0,0\n", &["dut.csv:2:", "2 fields", "1 columns"]),
    ] {
        bench.write("dut.csv", text);
        bench.refused(CHECK, said);
    }
    let mut long = right.only(&["intensity"]);
    long.lines.push(long.lines[0].clone());
    bench.write("dut.csv", long.text());
    bench.refused(CHECK, &["dut.csv:11:", "one too many", "9 vectors"]);
    bench.write("dut.csv", b"intensity\n\xff\n");
    bench.refused(CHECK, &["dut.csv:2:", "UTF-8", "byte 1", "0xff"]);
    bench.refused("check --vectors v --log none.csv", &["cannot read the log none.csv", "No such file"]);
    bench.refused("check --vectors v --log .", &["cannot read", "directory"]);
    bench.refused("check --vectors v", &["--log"]);
    bench.refused("check --log dut.csv", &["--vectors"]);
}

/// A bundle that is not what was written judges no answers.
#[test]
fn vectors_that_are_none() {
    let bench = bench!();
    let log = right(&bench);
    bench.write("dut.csv", log.text());
    bench.refused("check --vectors none --log dut.csv", &["none/manifest.json", "No such file"]);
    let table = bench.text("v/vectors.csv");
    bench.write("v/vectors.csv", table.replacen("random", "chosen", 1));
    bench.refused(CHECK, &["v/vectors.csv", "SHA-256"]);
}
