//! The command: its address, its port, its end.

use std::io::Read;
use std::process::Command;

use blysk_tests::bench;

use crate::client::Served;

fn ended_by(signal: &str) -> (Option<i32>, String) {
    let bench = bench!();
    let mut served = Served::start(&bench, &[]);
    assert_eq!(served.get("/").status, 200);
    let status = Command::new("kill").args([signal, &served.child.id().to_string()]).status().expect("kill runs");
    assert!(status.success());
    let status = served.child.wait().expect("it ends");
    let mut said = String::new();
    served.child.stderr.take().expect("piped").read_to_string(&mut said).expect("text");
    (status.code(), said)
}

#[test]
fn a_signal_ends_it_without_a_word() {
    assert_eq!(ended_by("-INT"), (Some(130), String::new()));
    assert_eq!(ended_by("-TERM"), (Some(143), String::new()));
}

#[test]
fn its_files_go_with_it() {
    let bench = bench!();
    let temporary = bench.path("temporary");
    std::fs::create_dir(&temporary).unwrap();
    let mut command = bench.command(&["serve", "--port", "0", "--open", "no"]);
    let mut child = command.env("TMPDIR", &temporary).stdout(std::process::Stdio::piped()).spawn().unwrap();
    let mut first = [0; 7];
    child.stdout.as_mut().unwrap().read_exact(&mut first).unwrap();
    assert_eq!(std::fs::read_dir(&temporary).unwrap().count(), 1);
    Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(143));
    assert_eq!(std::fs::read_dir(&temporary).unwrap().count(), 0);
}

#[test]
fn a_port_is_had_once() {
    let bench = bench!();
    let served = Served::start(&bench, &[]);
    let wanted = format!("port {} of 127.0.0.1 is taken", served.port);
    bench.refused(&format!("serve --open no --port {}", served.port), &[&wanted, "--port 0"]);
}

#[test]
fn what_it_begins_with_is_checked_before_it_listens() {
    let bench = bench!();
    bench.refused("serve --preset papyrus", &["there is no preset \"papyrus\"", "compact"]);
    bench.refused("serve --config none.json", &["none.json"]);
    bench.write("bad.json", "{\n  \"name\": 3\n}\n");
    bench.refused("serve --config bad.json", &["bad.json", "line 2"]);
    bench.refused("serve --port 70000", &["70000"]);
}

#[test]
fn the_page_opens_with_what_was_said() {
    let bench = bench!();
    let begun = |options: &[&str]| Served::start(&bench, options).get("/api/begin").good();
    assert_eq!(begun(&[])["configuration"]["preset"], "paper");
    assert_eq!(begun(&["--preset", "compact"])["configuration"]["preset"], "compact");
    let begun = begun(&["--config", "small.json"]);
    assert_eq!(begun["configuration"]["text"], blysk_tests::cli::SMALL);
    assert_eq!(begun["presets"].as_array().unwrap().len(), hw_model::presets::ALL.len());
}
