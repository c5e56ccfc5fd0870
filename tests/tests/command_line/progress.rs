//! What a terminal shows of work that takes a while, in a terminal of its own (`script`).

use std::process::Command;

use blysk_tests::bench;
use blysk_tests::cli::Bench;

const SCENE: &str = r#"{
  "name": "ball",
  "image": { "width": 8, "height": 8 },
  "camera": { "position": [0, 0, 5], "look_at": [0, 0, 0], "field_of_view_degrees": 40 },
  "lights": [{ "directional": { "towards": [1, 2, 3], "colour": [1, 1, 1] } }],
  "materials": [{ "name": "m", "exponent": 4, "diffuse": [0, 0, 0], "specular": [1, 1, 1] }],
  "geometry": [{ "sphere": { "centre": [0, 0, 0], "radius": 1, "material": "m" } }]
}
"#;

/// What a terminal gets from a command line of the shell, in which `blysk` is the command. Panics where the command
/// fails.
fn shown(bench: &Bench, line: &str) -> String {
    let blysk = bench.command(&[]).get_program().to_string_lossy().into_owned();
    let line = line.replace("blysk ", &format!("{blysk} "));
    let mut script = Command::new("script");
    let script = script.args(["-q", "-e", "-c", &line, "/dev/null"]).current_dir(bench.path(""));
    let output = script.env("TERM", "xterm").output().expect("util-linux has `script`");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{line}: {text}");
    text
}

#[test]
fn work_that_is_counted_has_a_bar() {
    let bench = bench!();
    let lines: String = (0..20_000).map(|line| format!("{},0.5\n", line % 8 + 1)).collect();
    bench.write("in.csv", format!("n,x\n{lines}"));
    bench.write("scene.json", SCENE);
    for (line, what) in [
        ("vectors --config small.json --count 2000 --out new", "of 2,000 vectors"),
        ("rtl --config small.json --count 2000 --out rtl", "of 4,000 lines"),
        ("simulate --config small.json --stimulus in.csv", "of 20,000 cycles"),
        ("certify --method hermite --exponents 1..=40", "of 40 claims"),
        ("specialise scene.json --config small.json --count 16 --out special", "of 513 samples"),
        ("specialise --check special/certificate.json", "of 513 samples"),
        ("render scene.json --config small.json", "of 64 pixels"),
        ("refine --config small.json", "of 810 samples"),
        ("report --config small.json --exhaustive --bound 1", "of 4,104 samples"),
    ] {
        let shown = shown(&bench, &format!("blysk {line}"));
        assert!(shown.contains(what) && shown.contains(" % "), "{line}: {shown:?}");
    }
}

/// Whatever else takes long: here it waits for its input.
#[test]
fn work_that_is_not_counted_has_a_clock() {
    let bench = bench!();
    let _ = bench.good("vectors --config small.json --count 16 --out bundle");
    let line = "{ sleep 3; echo; } | blysk check --vectors bundle --registers - || true";
    let shown = shown(&bench, line);
    assert!(shown.contains("at work for 2 s"), "{shown:?}");
    assert!(shown.contains("nothing was compared"), "{shown:?}");
    let short = self::shown(&bench, "blysk rom --config small.json");
    assert!(!short.contains("at work"), "{short:?}");
}

#[test]
fn nothing_is_shown_where_there_is_no_terminal() {
    let bench = bench!();
    // That standard error is empty is what `good` demands.
    let _ = bench.good("vectors --config small.json --count 2000 --out new");
}
