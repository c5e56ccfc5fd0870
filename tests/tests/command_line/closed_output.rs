//! Standard output that closes early, as `| head -1` closes it: a verdict is the exit status all the same.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

use blysk_tests::answers::Log;
use blysk_tests::bench;
use blysk_tests::cli::Bench;

/// Runs the command and closes its standard output after the first bytes (or before any).
fn status_behind_head(bench: &Bench, arguments: &str, read: bool) -> i32 {
    let mut child = Command::new(env!("CARGO_BIN_EXE_blysk-under-test"))
        .args(arguments.split_whitespace())
        .current_dir(bench.path(""))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command");
    let mut out = child.stdout.take().expect("a pipe");
    if read {
        let mut first = [0_u8; 1];
        out.read_exact(&mut first).expect("something is printed");
    }
    drop(out);
    let done = child.wait_with_output().expect("the command ends");
    assert_eq!(String::from_utf8_lossy(&done.stderr), "", "{arguments}");
    done.status.code().expect("an exit status")
}

/// A configuration of many exponents, so that its tables are longer than a pipe holds.
fn long(bench: &Bench) {
    let json = bench.text("small.json").replace("\"1..=8\"", "\"1..=1200\"");
    bench.write("long.json", json.replace("\"small\"", "\"long\""));
}

/// Logs of a wrong design, and a certificate of another scene.
fn logs(bench: &Bench) {
    let corpus = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(name);
        fs::read_to_string(path).expect("a file of the corpus")
    };
    bench.write("tiny.json", corpus("configuration/tiny.json"));
    let _vectors = bench.good("vectors --config tiny.json --count 64 --out v");
    let mut log = Log::right(bench, "v");
    log.spoil(3, "intensity");
    bench.write("wrong.csv", log.text());
    let registers = corpus("registers/sixty.txt");
    bench.write("right.txt", &registers);
    let _agrees = bench.good("check --vectors v --registers right.txt");
    // The last register of a cycle in the middle: the status, one flag more or fewer.
    let mut lines: Vec<String> = registers.lines().map(str::to_owned).collect();
    let status = lines[40].pop().expect("a line");
    lines[40].push(if status == '0' { '1' } else { '0' });
    bench.write("wrong.txt", lines.join("\n") + "\n");
    for name in ["close_up", "one_material"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scenes");
        let scene = fs::read(path.join(format!("{name}.json"))).expect("a scene");
        bench.write(&format!("{name}.json"), scene);
    }
    let _certificate = bench.good("specialise close_up.json --preset compact --out hardware");
}

#[test]
fn a_failed_verdict_is_one_though_nobody_reads_it() {
    let bench = bench!();
    long(&bench);
    let _proved = bench.good("certify --exponents 1..=600 --method hermite --out proved.json");
    bench.write("damaged.json", bench.text("proved.json").replacen("\"upper\": 0.00", "\"upper\": 0.01", 1));
    let pareto = bench.good("pareto --exponents 1..=8 --input UQ1.10 --no-timing --format csv");
    bench.write("pareto.csv", pareto.replace(",f64,", ",f16,"));
    logs(&bench);
    for failing in [
        "check --vectors v --log wrong.csv",
        "check --vectors v --registers wrong.txt",
        "specialise one_material.json --check hardware/certificate.json",
        "report --config long.json --bound 1e-9 --format json",
        "report --config long.json --bound 1e-9 --format csv",
        "report --config small.json --bound 1e-9",
        "report --config small.json --bound 0.02 --range all",
        "certify --exponents 1..=600 --method hermite --bound 1e-9 --format json",
        "certify --config small.json --bound 1e-9",
        "certify --check damaged.json",
        "certify --check proved.json --bound 1e-9",
        "certify --check proved.json --config small.json",
        "pareto --exponents 1..=8 --input UQ1.10 --check pareto.csv",
    ] {
        assert_eq!(bench.run(failing).status, 1, "{failing}");
        for read in [true, false] {
            assert_eq!(status_behind_head(&bench, failing, read), 1, "{failing}, read: {read}");
        }
    }
    for holding in [
        "report --config long.json --bound 1 --format json",
        "certify --check proved.json",
        "rom --config long.json --format csv",
        "presets",
    ] {
        assert_eq!(status_behind_head(&bench, holding, true), 0, "{holding}");
    }
}

/// Files are written whole whoever reads the table.
#[test]
fn files_are_written_though_nobody_reads_the_table() {
    let bench = bench!();
    long(&bench);
    assert_eq!(status_behind_head(&bench, "rom --config long.json --format json --out roms", false), 0);
    assert_eq!(bench.text("roms/rom.csv").lines().count(), 1201);
}
