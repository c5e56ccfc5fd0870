//! `blysk check`: what a designer's own simulation answered, against the vectors it was given.

use std::fs;
use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args as ClapArgs;
use hw_model::design::Design;
use vectors::text_file::{self, REGISTER_LOG, TextReader};
use vectors::{check, verify};

use super::bar::Bar;
use super::out::{Out, Outcome};
use sim::agreement::{Agreement, Disagreement, compare};

/// Judge what your own simulation answered to test vectors.
///
/// The log is a CSV file with a line for each vector: columns intensity, and optionally index (else the
/// lines are in the order of the vectors), status, and any register that vectors.csv has a column for,
/// such as front_end.region. All but the index are bits in hex, with or without 0x.
///
/// Prints PASS (status 0), or FAIL with the first vector that differs and where it departs (status 1).
///
/// With --registers it judges what the testbench of `blysk rtl` prints for +registers=N: every register
/// of every cycle, against the clocked pipeline with the same inputs.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk check --vectors vectors --log dut.csv")]
pub(super) struct Args {
    /// The directory that `blysk vectors` wrote.
    #[arg(long, value_name = "DIR")]
    vectors: PathBuf,
    /// The log of the simulation.
    #[arg(long, value_name = "FILE", required_unless_present = "registers")]
    log: Option<PathBuf>,
    /// A log of every register of every cycle instead; - is standard input.
    #[arg(long, value_name = "FILE", conflicts_with = "log")]
    registers: Option<PathBuf>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    match (&args.log, &args.registers) {
        (_, Some(registers)) => check_registers(&args.vectors, registers, out),
        (Some(log), None) => check_answers(&args.vectors, log, out),
        // clap asks for one of them.
        (None, None) => bail!("give --log or --registers"),
    }
}

/// Every register of every cycle, for the configuration that the vectors are for.
fn check_registers(vectors: &Path, log: &Path, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = Design::new(verify(vectors)?.manifest.configuration)?;
    let compared = if log == Path::new("-") {
        compare(design.datapath(), TextReader::new(io::stdin().lock(), REGISTER_LOG))
    } else {
        let text = text_file::open(log, REGISTER_LOG)?;
        let bar = Bar::counting(fs::metadata(log).ok().map(|log| log.len()), "bytes");
        compare(design.datapath(), BufReader::new(bar.reading(text)))
    };
    match compared {
        Ok(agreement) => {
            let Agreement { cycles, registers, results, stalls, bubbles, resets } = agreement;
            writeln!(out, "{results} results, {stalls} stalls, {bubbles} bubbles, {resets} resets")?;
            writeln!(out, "PASS {cycles} cycles, {registers} registers compared")?;
            Ok(Outcome::Good)
        }
        Err(difference @ Disagreement::Differs { .. }) => {
            writeln!(out, "FAIL {difference}")?;
            Ok(Outcome::Fails)
        }
        Err(error) => Err(error).with_context(|| format!("{}", log.display())),
    }
}

fn check_answers(vectors: &Path, log: &Path, out: &mut Out) -> anyhow::Result<Outcome> {
    let verdict = check(vectors, log)?;
    writeln!(out, "{verdict}")?;
    Ok(if verdict.holds() { Outcome::Good } else { Outcome::Fails })
}
