//! Files that are none: standard output, pipes, devices, links.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

use blysk_tests::bench;
use blysk_tests::cli::Bench;

/// Every command that has one file, with what says where it goes at its end.
const COMMANDS: [&str; 6] = [
    "mesh --along 9 --sides 3 --out",
    "vectors --config small.json --count 40 --format csv --out",
    "design --exponents 1..=4 --input UQ1.8 --output UQ1.8 --error 0.05 --out",
    "refine --config small.json --reach 1 --out",
    "certify --config small.json --out",
    "simulate --config small.json --stimulus in.csv --trace",
];

fn with_stimulus() -> Bench {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n7,0.25\n");
    bench
}

#[test]
fn standard_output_has_the_file_and_nothing_else() {
    let bench = with_stimulus();
    for command in COMMANDS {
        let _said = bench.good(&format!("{command} file"));
        let file = bench.text("file");
        assert!(file.len() > 100, "{command}");
        assert_eq!(bench.good(&format!("{command} -")), file, "{command}");
        if cfg!(target_os = "linux") {
            for path in ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"] {
                assert_eq!(bench.good(&format!("{command} {path}")), file, "{command} {path}");
            }
        }
        assert!(!bench.path("-").exists());
    }
    let bundle = bench.good("vectors --config small.json --count 40 --out bundle");
    assert!(bundle.contains("40 vectors"), "{bundle}");
    let table = bench.good("vectors --config small.json --count 40 --format csv --out -");
    assert_eq!(table, bench.text("bundle/vectors.csv"));
    let rom = bench.good("rom --config small.json --format csv --out rom");
    assert_eq!(bench.good("rom --config small.json --format csv --out -"), rom);
    assert_eq!(rom, bench.text("rom/rom.csv"));
    bench.refused("vectors --config small.json --out -", &["--out -", "a directory"]);
}

/// A verdict is one whoever reads the certificate.
#[test]
fn a_bound_that_fails_is_in_the_exit_status_of_a_stream_too() {
    let bench = with_stimulus();
    let run = bench.run("certify --config small.json --bound 1e-9 --out -");
    assert!(run.status == 1 && run.stdout.ends_with("}\n"), "{run:#?}");
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let mut command = bench.command(&["certify", "--config", "small.json", "--bound", "1e-9", "--out", "-"]);
    let output = command.stdout(writer).stderr(Stdio::piped()).output().unwrap();
    assert_eq!((output.status.code(), output.stderr.len()), (Some(1), 0), "{output:?}");
}

/// A redirected file is not exchanged for another one, and keeps what was in it.
#[cfg(target_os = "linux")]
#[test]
fn a_redirected_file_is_written_and_not_replaced() {
    let bench = with_stimulus();
    for (descriptor, path) in [(1, "/dev/stdout"), (1, "-"), (3, "/dev/fd/3")] {
        bench.write("log", "before\n");
        let binary = env!("CARGO_BIN_EXE_blysk-under-test");
        let script = format!("exec {binary} {} {path} {descriptor}>>log", COMMANDS[0]);
        let mut shell = Command::new("sh");
        let output = shell.args(["-c", &script]).current_dir(bench.path("")).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        let text = bench.text("log");
        assert!(text.starts_with("before\n# blysk mesh"), "{text}");
        assert!(text.trim_end().ends_with(|last: char| last.is_ascii_digit()), "{text}");
    }
    assert!(Path::new("/dev/stdout").is_symlink());
}

#[cfg(target_os = "linux")]
#[test]
fn pipes_and_devices_are_written_through() {
    let bench = with_stimulus();
    let made = Command::new("mkfifo").arg(bench.path("pipe")).status().unwrap();
    assert!(made.success());
    std::os::unix::fs::symlink("/dev/null", bench.path("null")).unwrap();
    for command in COMMANDS {
        let _said = bench.good(&format!("{command} file"));
        let path = bench.path("pipe");
        let reader = std::thread::spawn(move || {
            let mut text = String::new();
            File::open(path).unwrap().read_to_string(&mut text).unwrap();
            text
        });
        let _said = bench.good(&format!("{command} pipe"));
        assert_eq!(reader.join().unwrap(), bench.text("file"), "{command}");
        let _said = bench.good(&format!("{command} null"));
        assert!(bench.path("null").is_symlink(), "{command}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_stays_and_its_file_is_replaced() {
    let bench = with_stimulus();
    std::fs::create_dir(bench.path("real")).unwrap();
    bench.write("real/file", "old");
    std::os::unix::fs::symlink("real/file", bench.path("link")).unwrap();
    for command in COMMANDS {
        let _said = bench.good(&format!("{command} link"));
        let _said = bench.good(&format!("{command} file"));
        assert!(bench.path("link").is_symlink(), "{command}");
        assert_eq!(bench.read("real/file"), bench.read("file"), "{command}");
    }
}
