//! The recipes of docs/scale: a local Snakemake, in which a worker is killed, and what stands beside it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use blysk_tests::bench;
use blysk_tests::cli::Bench;

use super::campaign::{errors, plan, run_all};

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A workflow of the errors of `configuration.json` in two shards.
fn workflow(bench: &Bench) -> Command {
    let snakemake = repository().join("target/snakemake/bin/snakemake");
    assert!(snakemake.exists(), "{} is not there; run scripts/setup", snakemake.display());
    bench.write("job.json", errors("configuration.json"));
    let mut command = Command::new(snakemake);
    command
        .arg("--snakefile")
        .arg(repository().join("docs/scale/Snakefile"))
        .args(["--cores", "2", "--retries", "2", "--config", "job=job.json", "shards=2", "out=campaign", "every=0"])
        .arg(format!("blysk={}", env!("CARGO_BIN_EXE_blysk-under-test")))
        .current_dir(bench.path(""))
        // What it keeps of its own belongs to this test.
        .env("XDG_CACHE_HOME", bench.path("cache"))
        .stdin(Stdio::null());
    command
}

/// The process of a shard, by the arguments that it was started with.
fn worker(index: u32, directory: &Path) -> Option<u32> {
    let wanted = format!("shard\0run\0campaign\0--index\0{index}\0");
    let processes = fs::read_dir("/proc").expect("Linux tells its processes").flatten();
    let found = processes.filter(|process| {
        let own = |name: &str| fs::read(process.path().join(name)).unwrap_or_default();
        let is_below = fs::read_link(process.path().join("cwd")).is_ok_and(|place| place == directory);
        let arguments = String::from_utf8_lossy(&own("cmdline")).into_owned();
        is_below && arguments.contains(&wanted) && arguments.starts_with(env!("CARGO_BIN_EXE_blysk-under-test"))
    });
    found.filter_map(|process| process.file_name().to_str()?.parse().ok()).next()
}

#[test]
fn a_workflow_whose_worker_is_killed_gives_the_files_of_one_machine() {
    let bench = bench!();
    let compact = bench.good("presets show compact");
    bench.write("configuration.json", compact.replace("1..=256", "1..=32,32.5,33.5"));
    let child = workflow(&bench).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("snakemake runs");
    let directory = bench.path("").canonicalize().unwrap();
    let checkpoint = bench.path("campaign/checkpoints/shard-00001.json");
    let begun = Instant::now();
    let killed = loop {
        assert!(begun.elapsed() < Duration::from_secs(300), "no checkpoint");
        if checkpoint.exists()
            && let Some(process) = worker(1, &directory)
        {
            break Command::new("kill").args(["-KILL", &process.to_string()]).status().unwrap();
        }
        sleep(Duration::from_millis(5));
    };
    assert!(killed.success(), "the worker was not there to be killed");
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("went on from a checkpoint"), "the killed worker was not resumed: {said}");
    let run = bench.run("report --config configuration.json --exhaustive --out one");
    assert!(run.status <= 1, "{run:#?}");
    assert!(bench.tree("one") == bench.tree("campaign/merged"), "{said}");
}

#[test]
fn files_for_slurm_name_every_shard() {
    let bench = bench!();
    plan(&bench, &errors("small.json"), 3, "plain");
    bench.write("job.json", errors("small.json"));
    let _said = bench.good("shard plan job.json --shards 3 --out campaign --slurm");
    let array = bench.text("campaign/shards.sbatch");
    assert!(array.contains("#SBATCH --array=0-2\n") && array.contains("#SBATCH --requeue\n"), "{array}");
    assert!(!bench.path("plain/shards.sbatch").exists());
    // As Slurm would run it.
    run_all(&bench, 2, "campaign");
    for (file, number) in [("shards.sbatch", "2"), ("merge.sbatch", "")] {
        let status = Command::new("sh")
            .arg(bench.path("campaign").join(file))
            .env("BLYSK", env!("CARGO_BIN_EXE_blysk-under-test"))
            .env("SLURM_SUBMIT_DIR", bench.path("campaign"))
            .env("SLURM_ARRAY_TASK_ID", number)
            .stdout(Stdio::null())
            .status()
            .unwrap();
        assert!(status.code().is_some_and(|code| code <= 1), "{file}: {status}");
    }
    assert!(bench.path("campaign/merged/report.sha256").exists());
}

/// Recipes are short enough to be read before they are run.
#[test]
fn recipes_have_less_than_forty_lines() {
    let places = ["docs/scale/Snakefile", "docs/scale/parallel.sh", "sim/shard/src/recipe/shards.sbatch"];
    for place in places {
        let text = fs::read_to_string(repository().join(place)).unwrap();
        assert!((5..40).contains(&text.lines().count()), "{place}");
    }
}
