//! `blysk check`: what a designer's own simulation answered, against the vectors it was given.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args as ClapArgs;
use hw_model::datapath::Status;
use hw_model::quantise::decimal;
use vectors::answers::{Failure, Field, Got};
use vectors::table::hex;
use vectors::{Verdict, check};

use super::{Out, Outcome};

/// Judge what your own simulation answered to test vectors.
///
/// The log is a CSV file with a line for each vector: columns intensity, and optionally index (else the
/// lines are in the order of the vectors), status, and any register that vectors.csv has a column for,
/// such as front_end.region. All but the index are bits in hex, with or without 0x.
///
/// Prints PASS (status 0), or FAIL with the first vector that differs and where it departs (status 1).
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk check --vectors vectors --log dut.csv")]
pub(super) struct Args {
    /// The directory that `blysk vectors` wrote.
    #[arg(long, value_name = "DIR")]
    vectors: PathBuf,
    /// The log of the simulation.
    #[arg(long, value_name = "FILE")]
    log: PathBuf,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let verdict = check(&args.vectors, &args.log)?;
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
    let with = |status: Status, (flag, _): (Status, &str)| {
        status.with(flag, bits & i64::from(flag.bits()) != 0)
    };
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
        writeln!(
            out,
            "Columns of registers in the log, such as front_end.region, would tell where."
        )?;
    }
    Ok(())
}
