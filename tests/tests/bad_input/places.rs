//! Output that has no place to go.

use std::path::Path;

use blysk_tests::bench;
use blysk_tests::cli::SMALL;

/// No user, root included, can make a directory below a regular file.
#[test]
fn places_that_cannot_be_written() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n");
    bench.write("file", "keep me");
    for command in [
        "report --config small.json --bound 1",
        "report --all-presets",
        "rom --config small.json",
        "vectors --config small.json",
        "simulate --config small.json --stimulus in.csv",
    ] {
        for place in ["file", "file/dir", "file/dir/deep"] {
            bench.refused(&format!("{command} --out {place}"), &[place, "a file is in the way"]);
        }
        if Path::new("/proc/self").exists() {
            let said = ["/proc/blysk", "cannot"];
            bench.refused(&format!("{command} --out /proc/blysk"), &said);
        }
        bench.refused_list(&[&command.split(' ').collect::<Vec<_>>()[..], &["--out"]].concat(), &["--out"]);
    }
    assert_eq!(bench.text("file"), "keep me");
}

#[cfg(target_os = "linux")]
#[test]
fn targets_that_are_no_files() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n");
    bench.write("file", "keep me");
    std::fs::create_dir_all(bench.path("directory.vcd")).unwrap();
    // Through a link, which a faulty command would replace, and not the device of the machine.
    for (name, to) in [("full.vcd", "/dev/full"), ("none.vcd", "nowhere")] {
        std::os::unix::fs::symlink(to, bench.path(name)).unwrap();
    }
    assert!(Path::new("/dev/full").exists());
    let simulate = "simulate --config small.json --stimulus in.csv";
    for option in ["--trace", "--waves"] {
        for (target, said) in [
            ("full.vcd", "No space left"),
            ("none.vcd", "a link to nowhere, which does not exist"),
            ("directory.vcd", "not a regular file"),
            ("directory.vcd/", "not a regular file"),
            ("..", "file"),
            ("/", "file"),
            ("file/trace.vcd", "a file is in the way"),
        ] {
            let named = target.strip_suffix("/trace.vcd").unwrap_or(target);
            bench.refused(&format!("{simulate} {option} {target}"), &[named, said]);
        }
    }
    // The other file, which could be written, is not.
    for files in ["--trace file/x --waves good.vcd", "--waves file/x.fst --trace good"] {
        bench.refused(&format!("{simulate} {files}"), &["directory file"]);
    }
    for same in ["--trace t --waves t", "--trace t --waves ./t", "--trace ./t --waves directory.vcd/../t"] {
        bench.refused(&format!("{simulate} {same}"), &["--trace", "--waves", "same file"]);
    }
    bench.refused(&format!("{simulate} --out new --trace t"), &["--out", "--trace"]);
    // A directory has the name of a file: nothing of the set is written beside it.
    for (command, name) in [
        ("rom --config small.json", "rom.csv"),
        ("vectors --config small.json", "manifest.json"),
        ("report --config small.json --bound 1", "curves.svg"),
        (simulate, "waves.vcd"),
    ] {
        std::fs::create_dir_all(bench.path("taken").join(name)).unwrap();
        bench.refused(&format!("{command} --out taken"), &[name, "not a regular file"]);
        std::fs::remove_dir_all(bench.path("taken")).unwrap();
    }
}

/// What a command reads is not written over, by whatever name or link.
#[cfg(unix)]
#[test]
fn inputs_are_not_outputs() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n");
    std::fs::hard_link(bench.path("in.csv"), bench.path("hard.csv")).unwrap();
    std::os::unix::fs::symlink("in.csv", bench.path("soft.csv")).unwrap();
    std::fs::create_dir(bench.path("set")).unwrap();
    for (name, text) in [("configuration.json", SMALL), ("trace.csv", "n,x\n1,0.5\n")] {
        bench.write(&format!("set/{name}"), text);
    }
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenes/low_exponents.json");
    let said = "is an input of this command";
    for trace in ["in.csv", "./in.csv", "hard.csv", "soft.csv", "set/../in.csv", "small.json"] {
        let command = format!("simulate --config small.json --stimulus in.csv --trace {trace}");
        bench.refused(&command, &[trace, said]);
    }
    for command in [
        "simulate --config small.json --stimulus set/trace.csv --out set",
        "refine --config small.json --out small.json",
        "certify --config small.json --out small.json",
        "vectors --config small.json --count 9 --format csv --out small.json",
        &format!("specialise {scene} --config set/configuration.json --out set"),
    ] {
        bench.refused(command, &[said]);
    }
    // The mesh of a scene.
    let knot = bench.good("mesh --along 8 --sides 3 --out -");
    std::fs::create_dir(bench.path("pictures")).unwrap();
    bench.write("pictures/render.csv", knot);
    let text = std::fs::read_to_string(scene.replace("low_exponents", "torus_knot")).unwrap();
    bench.write("scene.json", text.replace("torus_knot.obj", "pictures/render.csv"));
    bench.refused("render scene.json --preset paper --out pictures", &["render.csv", said]);
}

/// Work that takes minutes does not begin where its files have no place.
#[test]
fn places_are_looked_at_before_the_work() {
    let bench = bench!();
    bench.write("file", "");
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenes/torus_knot.json");
    let begun = std::time::Instant::now();
    for (command, name) in [
        ("report --preset precise --exhaustive", "curves.svg"),
        ("report --all-presets --exhaustive", "schlick/curves.svg"),
        ("vectors --preset precise --strategy compact", "manifest.json"),
        ("rtl --preset precise --strategy compact", "Makefile"),
        ("pareto", "pareto.csv"),
        ("stability --preset precise", "seams.json"),
        (&format!("specialise {scene} --preset precise"), "rtl/blysk_pkg.sv"),
    ] {
        std::fs::create_dir_all(bench.path("taken").join(name)).unwrap();
        bench.refused(&format!("{command} --out taken"), &[name, "not a regular file"]);
        std::fs::remove_dir_all(bench.path("taken")).unwrap();
        bench.refused(&format!("{command} --out file/x"), &["a file is in the way"]);
        bench.refused(&format!("{command} --out -"), &["--out -", "a directory"]);
    }
    for command in ["certify --preset precise", "refine --preset precise"] {
        bench.refused(&format!("{command} --out file/x"), &["a file is in the way"]);
    }
    assert!(begun.elapsed().as_secs() < 60, "{:?}", begun.elapsed());
}

/// The end of its name says what a file of waves is to be.
#[test]
fn waves_of_no_known_format() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n");
    for name in ["w", "w.txt", "w.vcd.gz", ".vcd", "vcd", "w.VCD", "new/w."] {
        let said = ["--waves", name, ".vcd or .fst"];
        bench.refused(&format!("simulate --config small.json --stimulus in.csv --trace t --waves {name}"), &said);
    }
}

/// A device without room: no file may be longer than a block, as if the disc were full.
#[cfg(unix)]
#[test]
fn a_full_device() {
    let bench = bench!();
    let lines = "1,0.5\n".repeat(200);
    bench.write("in.csv", format!("n,x\n{lines}"));
    let before = bench.tree("");
    for (command, name) in [
        ("simulate --config small.json --stimulus in.csv --out new/deep", "new/deep/"),
        ("simulate --config small.json --stimulus in.csv --trace t.csv", "t.csv"),
        ("simulate --config small.json --stimulus in.csv --waves w.vcd", "w.vcd"),
        ("simulate --config small.json --stimulus in.csv --waves w.fst", "w.fst"),
        ("vectors --config small.json --count 500 --out new/deep", "new/deep/"),
        ("report --config small.json --bound 1 --out new/deep", "new/deep/"),
        ("rom --config small.json --out new/deep", "new/deep/"),
    ] {
        let binary = env!("CARGO_BIN_EXE_blysk-under-test");
        // Ignoring the signal turns the limit into an error of the write.
        let script = format!("trap '' XFSZ; ulimit -f 1; exec {binary} {command}");
        let mut shell = std::process::Command::new("sh");
        let output = shell.args(["-c", &script]).current_dir(bench.path("")).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{command}: {stderr}");
        assert!(output.stdout.is_empty(), "{command}");
        assert!(stderr.contains("cannot write") && stderr.contains(name), "{command}: {stderr}");
        assert!(!stderr.contains("panicked"), "{stderr}");
        let after = bench.tree("");
        assert!(before == after, "{command} left {:?}", after.keys());
    }
}
