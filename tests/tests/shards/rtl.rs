//! RTL in Verilator beside the model, in shards: a harness that is built once, and differences that are found.

use std::fs;

use blysk_tests::bench;
use blysk_tests::cli::Bench;

use super::campaign::{job, plan, run_all};

/// Every x of the small configuration, 9 fraction bits and 1, in each of 8 rows.
const RESULTS: u64 = 513 * 8;

fn merged(bench: &Bench, directory: &str, status: i32) -> String {
    let run = bench.run(&format!("shard merge {directory} --out {directory}-merged"));
    assert_eq!(run.status, status, "{run:#?}");
    run.stdout
}

#[test]
fn rtl_agrees_and_a_wrong_rom_is_found() {
    let bench = bench!();
    plan(&bench, &job("{\"rtl\": {\"configuration\": {\"file\": \"small.json\"}}}"), 3, "rtl");
    run_all(&bench, 3, "rtl");
    let said = merged(&bench, "rtl", 0);
    let wanted = format!("small: {RESULTS} results of the RTL compared with the model, 0 differences");
    assert!(said.contains(&wanted), "{said}");

    // The ROM image with its last word altered: the row of the last exponent differs, and no other.
    let rom = bench.text("rtl/rtl/rom.mem");
    let last = rom.trim_end().lines().last().unwrap();
    let flipped: String = last.chars().map(|digit| if digit == '0' { '1' } else { '0' }).collect();
    bench.write("rtl/rtl/rom.mem", rom.replace(last, &flipped));
    for index in 0..3 {
        fs::remove_file(bench.path(&format!("rtl/results/shard-0000{index}.json"))).unwrap();
    }
    run_all(&bench, 3, "rtl");
    let said = merged(&bench, "rtl", 1);
    assert!(!said.contains(" 0 differences"), "{said}");
    let table = bench.text("rtl-merged/exhaustive.csv");
    let rows: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(rows.len(), 8);
    assert!(rows[..7].iter().all(|row| row.ends_with(",513,0,")), "{table}");
    assert!(!rows[7].contains(",513,0,"), "{table}");

    // Another harness is not run.
    fs::remove_file(bench.path("rtl/results/shard-00000.json")).unwrap();
    bench.write("rtl/rtl/exhaustive/exhaustive", "#!/bin/sh\nexit 0\n");
    bench.refused("shard run rtl --index 0", &["is not the program of the plan, with SHA-256", "plan again"]);
    fs::remove_file(bench.path("rtl/rtl/exhaustive/exhaustive")).unwrap();
    bench.refused("shard run rtl --index 0", &["exhaustive: No such file"]);
}

#[test]
fn runs_of_a_program_are_kept_as_they_print() {
    let bench = bench!();
    bench.write("say.sh", "#!/bin/sh\necho \"said $1\"\nexit $2\n");
    let executable = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    fs::set_permissions(bench.path("say.sh"), executable).unwrap();
    let runs = "[[\"a b\", \"0\"], [\"c\", \"3\"], [\"d\", \"0\"]]";
    plan(&bench, &job(&format!("{{\"program\": {{\"path\": \"say.sh\", \"runs\": {runs}}}}}")), 2, "runs");
    run_all(&bench, 2, "runs");
    let said = merged(&bench, "runs", 1);
    assert!(said.contains("3 runs, 1 of them with a status that is not 0"), "{said}");
    assert_eq!(bench.text("runs-merged/run-00000.txt"), "said a b\n");
    assert_eq!(bench.text("runs-merged/runs.csv"), "run,arguments,status,bytes\n0,a b 0,0,9\n1,c 3,3,7\n2,d 0,0,7\n");
    bench.write("say.sh", "#!/bin/sh\necho another\n");
    fs::remove_file(bench.path("runs/results/shard-00000.json")).unwrap();
    bench.refused("shard run runs --index 0", &["say.sh is not the program of the plan"]);
    bench.write("job.json", job("{\"program\": {\"path\": \"say.sh\", \"runs\": []}}"));
    bench.refused(
        "shard plan job.json --shards 1 --out none",
        &["program.runs is a list of 0; a job has 1 to 65536 runs"],
    );
    bench.write("job.json", job("{\"program\": {\"path\": \"absent.sh\", \"runs\": [[]]}}"));
    bench.refused("shard plan job.json --shards 1 --out none", &["absent.sh: No such file"]);
}
