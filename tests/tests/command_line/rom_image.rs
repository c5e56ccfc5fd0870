//! What the emitted pipeline does with a ROM image that is not its own.

use std::process::{Command, Output};

use blysk_tests::bench;
use blysk_tests::cli::Bench;
use blysk_tests::rtl::rom_image::{put, wrong_images};

fn icarus(bench: &Bench) -> Output {
    let mut make = Command::new("make");
    make.args(["--silent", "-C"]).arg(bench.path("rtl")).args(["icarus", "BUILD=other"]);
    make.env_remove("MAKEFLAGS").env_remove("MFLAGS").env_remove("MAKELEVEL");
    make.output().expect("make is there")
}

/// Each ends the simulation, with the file, and never with a valid 0.
#[test]
fn a_wrong_rom_image_ends_the_simulation() {
    let bench = bench!();
    let _rtl = bench.good("rtl --config centred.json --count 20 --out rtl");
    let right = bench.text("rtl/rom.mem");
    for wrong in wrong_images(&right) {
        put(&bench.path("rtl/rom.mem"), &wrong).expect("the directory is ours");
        let output = icarus(&bench);
        let text = [&output.stdout[..], &output.stderr[..]].concat();
        let text = String::from_utf8_lossy(&text);
        assert!(!output.status.success() && !text.contains("PASS"), "{}: {text}", wrong.name);
        assert!(text.contains(&wrong.said), "{}: {text}", wrong.name);
    }
    // Other ways to write the same words.
    let words: Vec<&str> = right.lines().filter(|line| !line.starts_with("//")).collect();
    let upper = right.to_uppercase().replace('\n', "\r\n");
    for same in [upper, words.join(" "), words.join(" // a word\n\n\t")] {
        bench.write("rtl/rom.mem", &same);
        let output = icarus(&bench);
        assert!(output.status.success(), "{same}\n{output:?}");
    }
}
