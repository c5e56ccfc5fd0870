//! Files that are no text, or text of another kind, given to every option that reads one.

use std::process::Stdio;

use blysk_tests::answers::Log;
use blysk_tests::bench;
use blysk_tests::cli::{Bench, SMALL};

/// Every way to give the command a file, and a good file for each.
fn readers(bench: &Bench) -> Vec<(&'static str, Vec<u8>)> {
    let _made = bench.good("vectors --config small.json --strategy random --count 9 --out v");
    let log = Log::right(bench, "v").only(&["index", "intensity", "status"]).text();
    let _made = bench.good("certify --method hermite --exponents 4 --out c.json");
    bench.write("m.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n");
    let scene = r#"{"name": "test", "image": {"width": 8, "height": 6},
        "camera": {"position": [0, 0, 5], "look_at": [0, 0, 0], "field_of_view_degrees": 40},
        "lights": [{"directional": {"towards": [1, 1, 1], "colour": [1, 1, 1]}}],
        "materials": [{"name": "a", "exponent": 4, "diffuse": [1, 1, 1], "specular": [1, 1, 1]}],
        "geometry": [{"mesh": {"file": "FILE", "material": "a"}}]}"#;
    bench.write("mesh.json", scene.replace("FILE", "file"));
    vec![
        ("rom --config file", SMALL.into()),
        ("report --config file --bound 1", SMALL.into()),
        ("scene file", scene.replace("FILE", "m.obj").into()),
        ("scene mesh.json", bench.read("m.obj")),
        ("simulate --config small.json --stimulus file", b"n,x\n1,0.5\n".into()),
        ("check --vectors v --log file", log.into()),
        ("certify --check file", bench.read("c.json")),
    ]
}

/// A mark and other line ends are no part of a file; UTF-16 is named, as is what is no text.
#[test]
fn marks_are_skipped_and_encodings_named() {
    let bench = bench!();
    for (command, good) in readers(&bench) {
        bench.write("file", &good);
        let said = bench.good(command);
        let text = String::from_utf8(good).unwrap();
        for alike in [format!("\u{feff}{text}"), text.replace('\n', "\r\n"), text.replace('\n', "\r")] {
            bench.write("file", alike);
            assert_eq!(bench.good(command), said, "{command}");
        }
        for mark in ["\u{feff}", ""] {
            let units: Vec<u16> = mark.encode_utf16().chain(text.encode_utf16()).collect();
            let little: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
            let big: Vec<u8> = units.iter().flat_map(|unit| unit.to_be_bytes()).collect();
            for (bytes, name) in [(little, "UTF-16LE"), (big, "UTF-16BE")] {
                bench.write("file", bytes);
                bench.refused(command, &["file", name, "UTF-8"]);
            }
        }
        bench.write("file", [text.trim_end().as_bytes(), b"\n\0\n"].concat());
        let line = text.trim_end().lines().count() + 1;
        bench.refused(command, &[&format!("file:{line}: there is a byte of 0")]);
        bench.write("file", "");
        bench.refused(command, &["file", "empty"]);
    }
}

/// Without end: refused at once, by a process that may have no more than 1 GB.
#[cfg(target_os = "linux")]
#[test]
fn devices_and_streams_without_end_are_refused() {
    let bench = bench!();
    for (command, _) in readers(&bench) {
        let command = command.replace(" file", " /dev/zero");
        if command.ends_with("mesh.json") {
            bench.write("mesh.json", bench.text("mesh.json").replace(": \"file\"", ": \"/dev/zero\""));
        }
        limited(&bench, &command, "/dev/zero", &["/dev/zero:1:", "byte of 0"]);
    }
    let registers = "check --vectors v --registers -";
    limited(&bench, registers, "/dev/zero", &["line 1", "byte of 0"]);
    // A pipe that never breaks its line.
    bench.write("endless.sh", "exec tr '\\0' x </dev/zero");
    for command in [registers, "simulate --config small.json --stimulus /dev/stdin"] {
        let script = format!("sh endless.sh | (ulimit -v 1000000; exec \"$0\" {command})");
        let (status, said) = shell(&bench, &script, "/dev/null");
        assert!(status == Some(2) && said.contains("more than 1048576 bytes"), "{said}");
    }
}

#[cfg(target_os = "linux")]
fn limited(bench: &Bench, command: &str, input: &str, said: &[&str]) {
    let (status, stderr) = shell(bench, &format!("ulimit -v 1000000; exec \"$0\" {command}"), input);
    assert_eq!(status, Some(2), "{command}: {stderr}");
    assert!(said.iter().all(|said| stderr.contains(said)), "{command}: {stderr}");
}

/// The status of a script whose `$0` is the command, and its standard error.
#[cfg(target_os = "linux")]
fn shell(bench: &Bench, script: &str, input: &str) -> (Option<i32>, String) {
    let input = std::fs::File::open(input).unwrap();
    let binary = env!("CARGO_BIN_EXE_blysk-under-test");
    let mut shell = std::process::Command::new("sh");
    let shell = shell.args(["-c", script, binary]).current_dir(bench.path(""));
    let output = shell.stdin(Stdio::from(input)).output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// What is longer than its kind may be is refused before it is read: a file that has no blocks takes no room.
#[test]
fn files_that_are_too_long() {
    let bench = bench!();
    let long = std::fs::File::create(bench.path("long")).unwrap();
    for (bytes, command) in [
        ((16 << 20) + 1, "rom --config long"),
        ((512 << 20) + 1, "simulate --config small.json --stimulus long"),
        ((256 << 20) + 1, "scene long"),
        ((256 << 20) + 1, "certify --check long"),
    ] {
        long.set_len(bytes).unwrap();
        let run = bench.run(command);
        let most = (bytes - 1).to_string();
        assert!(run.status == 2 && run.stdout.is_empty(), "{run:#?}");
        assert!(run.stderr.contains("long") && run.stderr.contains(&most), "{run:#?}");
    }
}
