//! Output that has no place to go.

use std::path::Path;

use blysk_tests::bench;

/// A directory below a regular file can be made by nobody, root included.
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
        bench.refused_list(
            &[&command.split(' ').collect::<Vec<_>>()[..], &["--out"]].concat(),
            &["--out"],
        );
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
    // Through links, which a faulty command would replace, and not the devices of the machine.
    for device in ["full", "null"] {
        let path = Path::new("/dev").join(device);
        assert!(path.exists(), "{}", path.display());
        std::os::unix::fs::symlink(path, bench.path(&format!("{device}.vcd"))).unwrap();
    }
    let simulate = "simulate --config small.json --stimulus in.csv";
    for option in ["--trace", "--waves"] {
        for (target, said) in [
            ("full.vcd", "not a regular file"),
            ("null.vcd", "not a regular file"),
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
    for same in
        ["--trace t --waves t", "--trace t --waves ./t", "--trace ./t --waves directory.vcd/../t"]
    {
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

/// The end of its name says what a file of waves is to be.
#[test]
fn waves_of_no_known_format() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,0.5\n");
    for name in ["w", "w.txt", "w.vcd.gz", ".vcd", "vcd", "w.VCD", "new/w."] {
        let said = ["--waves", name, ".vcd or .fst"];
        bench.refused(
            &format!("simulate --config small.json --stimulus in.csv --trace t --waves {name}"),
            &said,
        );
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
