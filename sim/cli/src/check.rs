//! `blysk check`: what a designer's own simulation answered, against the vectors it was given.

use std::fs;
use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args as ClapArgs;
use hw_model::datapath::Status;
use hw_model::design::Design;
use hw_model::quantise::decimal;
use vectors::answers::{Failure, Field, Got};
use vectors::table::hex;
use vectors::text_file::{self, REGISTER_LOG, TextReader};
use vectors::{Verdict, check, verify};

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
    let Some(failure) = &verdict.first else {
        writeln!(out, "PASS {} vectors", verdict.vectors)?;
        return Ok(Outcome::Good);
    };
    print_failure(failure, &verdict, out)?;
    print_summary(&verdict, out)?;
    Ok(Outcome::Fails)
}

/// The first vector that fails: what it is, its ports, and where it departs.
fn print_failure(failure: &Failure, verdict: &Verdict, out: &mut Out) -> io::Result<()> {
    let vector = &failure.vector;
    let n = vector.case.exponent.map_or_else(|| "none".to_owned(), |n| n.to_string());
    let (address, x) = (vector.case.address, vector.case.x);
    let x = format!("{} ({})", hex(x, verdict.input), decimal(x, verdict.input));
    write!(out, "FAIL vector {}: n = {n} (address {address}), x = {x}", vector.index)?;
    let Some(line) = failure.line else {
        return writeln!(out, ": no answer");
    };
    writeln!(out, ", line {line} of the log")?;
    for port in failure.fields.iter().filter(|field| !field.is_register()) {
        match port.name.as_str() {
            "status" if port.differs() => writeln!(out, "  {}", told(port, flags))?,
            "status" => {}
            _ => writeln!(out, "  {}", told(port, |bits| decimal(bits, port.format)))?,
        }
    }
    let departs = |field: &&Field| field.is_register() && field.differs();
    if let Some(first) = failure.fields.iter().find(departs) {
        let told = told(first, |bits| decimal(bits, first.format));
        writeln!(out, "  departs first at {told}")?;
    }
    Ok(())
}

/// What a port or register holds and should hold, as bits and as `shown`.
fn told(field: &Field, shown: impl Fn(i64) -> String) -> String {
    let known = |bits| format!("{} ({})", hex(bits, field.format), shown(bits));
    let got = match &field.got {
        Got::Known(bits) => known(*bits),
        Got::Unknown(text) => format!("{text} (unknown bits)"),
    };
    if field.differs() {
        format!("{}: got {got}, expected {}", field.name, known(field.expected))
    } else {
        format!("{}: got {got}, as expected", field.name)
    }
}

/// The flags by name, as in `vectors.csv`.
fn flags(bits: i64) -> String {
    let with = |status: Status, (flag, _): (Status, &str)| status.with(flag, bits & i64::from(flag.bits()) != 0);
    Status::NAMES.into_iter().fold(Status::default(), with).to_string()
}

/// How many vectors fail, by where they depart.
fn print_summary(verdict: &Verdict, out: &mut Out) -> io::Result<()> {
    writeln!(out, "{} of {} vectors fail", verdict.failing(), verdict.vectors)?;
    for (rank, count) in &verdict.departures {
        writeln!(out, "  {count} depart first at {rank}")?;
    }
    if verdict.unanswered > 0 {
        writeln!(out, "  {} have no answer", verdict.unanswered)?;
    }
    if verdict.registers == 0 && !verdict.departures.is_empty() {
        writeln!(out, "Columns of registers in the log, such as front_end.region, would tell where.")?;
    }
    Ok(())
}
