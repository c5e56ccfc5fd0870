//! `blysk shard`: work that outgrows one machine.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{Args as ClapArgs, Subcommand};
use shard::job::Job;
use shard::merged::{Merged, RtlReport};
use shard::place::Place;
use shard::plan::Plan;
use shard::run::{Ran, run as run_shard};
use shard::status::{ShardState, State, status};
use shard::{merge, recipe};

use super::bar::Bar;
use super::out::{Out, Outcome};
use super::output;
use super::table::{Cell, Format, Rows, write_folded};
use super::{certify, report};

/// Cut work into shards, run them on any machines, and merge what they found to the bytes of one machine.
///
/// A job is a JSON file: `docs/scale/README.md` has its fields, and recipes for Slurm, Snakemake and GNU parallel. A
/// shard reads the plan and writes one file, whole or not at all. It may be killed and run again: it goes on from its
/// last checkpoint, and a result that is there is not measured twice.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk shard plan job.json --shards 1 --out campaign\n          \
                        blysk shard run campaign --index 0\n          \
                        blysk shard status campaign\n          \
                        blysk shard merge campaign --out merged")]
pub(super) struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Plan(PlanArgs),
    Run(RunArgs),
    Status(StatusArgs),
    Merge(MergeArgs),
}

/// Cut a job into shards: write the directory that all further commands take.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk shard plan job.json --shards 3 --out campaign")]
struct PlanArgs {
    /// The job, a JSON file.
    #[arg(value_name = "JOB.json")]
    job: PathBuf,
    /// How many shards. The merged report does not depend on it.
    #[arg(long, value_name = "K")]
    shards: u32,
    /// The directory of the plan, its results and its checkpoints.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Write shards.sbatch and merge.sbatch too, for Slurm.
    #[arg(long)]
    slurm: bool,
}

/// Run one shard, from its last checkpoint to its end.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk shard run campaign --index 0")]
struct RunArgs {
    /// The directory that `blysk shard plan` wrote.
    #[arg(value_name = "DIR")]
    directory: PathBuf,
    /// The number of the shard, from 0.
    #[arg(long, value_name = "I")]
    index: u32,
    /// Seconds between two checkpoints, at least.
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u64).range(0..=86400))]
    every: u64,
}

/// Tell how far every shard has come. Exit status: 0 when all are done, 1 when not, 2 for an error.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk shard status campaign")]
struct StatusArgs {
    /// The directory that `blysk shard plan` wrote.
    #[arg(value_name = "DIR")]
    directory: PathBuf,
    /// How to print the states; csv and json have every shard.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// Put the results of all shards together, and write the report that one machine would write.
///
/// A gap, a piece that is in two results, and a result of another job or version are refused. Exit status: that of the
/// command which does the same work on one machine.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk shard merge campaign --out merged")]
struct MergeArgs {
    /// The directory that `blysk shard plan` wrote.
    #[arg(value_name = "DIR")]
    directory: PathBuf,
    /// The directory of the report [default: merged, in DIR].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    match &args.command {
        Command::Plan(args) => plan(args, out),
        Command::Run(args) => run_one(args, out),
        Command::Status(args) => states(args, out),
        Command::Merge(args) => merge_all(args, out),
    }
}

fn plan(args: &PlanArgs, out: &mut Out) -> anyhow::Result<Outcome> {
    let place = Place(&args.out);
    let mut job = Job::read(&args.job)?;
    Plan::prepare(&mut job, args.shards, place)?;
    let plan = Plan::new(job, args.shards, place)?;
    plan.write(place)?;
    if args.slurm {
        recipe::write(&plan, place)?;
    }
    let (digest, pieces, shards) = (plan.digest(), plan.pieces(), plan.shards());
    writeln!(out, "job {digest}: {pieces} pieces in {shards} shards")?;
    Ok(Outcome::Good)
}

fn run_one(args: &RunArgs, out: &mut Out) -> anyhow::Result<Outcome> {
    let place = Place(&args.directory);
    let (plan, kind) = Plan::read(place)?;
    let pieces = plan.pieces_of(args.index)?;
    let bar = Bar::counting(Some(pieces.end - pieces.start), "pieces");
    let Ran { pieces, measured, not_believed } =
        run_shard(place, (&plan, &*kind), args.index, Duration::from_secs(args.every), &bar)?;
    bar.finish();
    for why in not_believed {
        write_folded(out, &format!("not believed, and measured again: {why}"))?;
    }
    let (all, now) = (pieces.end - pieces.start, measured.end - measured.start);
    let how = match now {
        0 => "its result is there already".to_owned(),
        _ if now < all => format!("went on from a checkpoint, {now} of {all} pieces measured"),
        _ => format!("{all} pieces measured"),
    };
    writeln!(out, "shard {}: {how}", args.index)?;
    Ok(Outcome::Good)
}

fn states(args: &StatusArgs, out: &mut Out) -> anyhow::Result<Outcome> {
    let states = status(Place(&args.directory))?;
    let done = states.iter().filter(|shard| shard.state == State::Done).count();
    let outcome = if done == states.len() { Outcome::Good } else { Outcome::Fails };
    if args.format != Format::Table {
        rows(&states).print(out, args.format, 17)?;
        return Ok(outcome);
    }
    writeln!(out, "{done} of {} shards are done", states.len())?;
    let rest: Vec<ShardState> = states.into_iter().filter(|shard| shard.state != State::Done).collect();
    if !rest.is_empty() {
        writeln!(out, "to run, as a list for an array of jobs: {}\n", list(&rest))?;
        rows(&rest).print(out, Format::Table, 6)?;
    }
    Ok(outcome)
}

/// The numbers of shards, runs of them with a dash: 0,3-7,9.
fn list(shards: &[ShardState]) -> String {
    let mut runs: Vec<(u32, u32)> = Vec::new();
    for shard in shards {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == shard.index => *last = shard.index,
            _ => runs.push((shard.index, shard.index)),
        }
    }
    let run = |&(first, last): &(u32, u32)| if first == last { first.to_string() } else { format!("{first}-{last}") };
    runs.iter().map(run).collect::<Vec<_>>().join(",")
}

fn rows(states: &[ShardState]) -> Rows {
    let mut rows = Rows::new(&["shard", "pieces", "measured", "state"]);
    for ShardState { index, pieces, state } in states {
        let (measured, said) = match state {
            State::Done => (*pieces, "done".to_owned()),
            State::Begun(measured) => (*measured, "begun".to_owned()),
            State::Waiting => (0, "waiting".to_owned()),
            State::Refused(why) => (0, format!("not believed: {why}")),
        };
        rows.push(vec![
            Cell::Integer((*index).into()),
            Cell::Integer(*pieces as i64),
            Cell::Integer(measured as i64),
            said.into(),
        ]);
    }
    rows
}

fn merge_all(args: &MergeArgs, out: &mut Out) -> anyhow::Result<Outcome> {
    let merged = merge::merge(Place(&args.directory))?;
    let directory = args.out.clone().unwrap_or_else(|| args.directory.join("merged"));
    let mut set = output::set(&directory, merged.command(), &[], merged.names())?;
    merged.write(&mut set)?;
    set.commit()?;
    let outcome = print(&merged, out)?;
    written(&directory, out)?;
    Ok(outcome)
}

fn print(merged: &Merged, out: &mut Out) -> anyhow::Result<Outcome> {
    match merged {
        Merged::Errors { design, report } => report::summarise(design, report, out),
        Merged::Rtl(RtlReport { configuration, compared, different, .. }) => {
            let words = "results of the RTL compared with the model";
            writeln!(out, "{configuration}: {compared} {words}, {different} differences")?;
            Ok(if *different == 0 { Outcome::Good } else { Outcome::Fails })
        }
        Merged::Printed(rows) => {
            let failed = rows.iter().filter(|row| row.printed.status != 0).count();
            writeln!(out, "{} runs, {failed} of them with a status that is not 0", rows.len())?;
            Ok(if failed == 0 { Outcome::Good } else { Outcome::Fails })
        }
        Merged::Certificate(certificate) => {
            certify::print::claim(certificate.claim(), Format::Table, out)?;
            Ok(Outcome::Good)
        }
    }
}

fn written(directory: &Path, out: &mut Out) -> std::io::Result<()> {
    writeln!(out, "\nwritten to {}", directory.display())
}
