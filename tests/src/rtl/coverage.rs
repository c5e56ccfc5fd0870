//! Line and toggle coverage of the emitted RTL under its default bundle, by Verilator, beside the model's own.
//!
//! A point of Verilator's is a line or branch that is executed, or a bit of a signal that rises or falls. Many bits of
//! wires cannot change, as a width is the configuration's and a value is not: what can is taken from a long run of
//! random cycles after the bundle's own run. The default bundle must reach nearly all of it; what it does not reach is
//! listed, in `coverage.txt` beside the RTL.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use sim::coverage::Coverage;
use vectors::{Bundle, Strategy};

use super::simulators::{Simulator, verilator};
use super::workspace::Emitted;
use super::{Failure, failed};

/// The share of the points within reach that the default bundle reaches.
const LEAST: f64 = 0.99;
/// Random cycles of the long run.
const CYCLES: u64 = 200_000;

/// What the default bundle reaches.
#[derive(Debug, Clone, Copy)]
pub struct Shares {
    /// Lines and branches, and how many of them are within reach.
    pub lines: (usize, usize),
    /// Rises and falls of single bits, and how many of them are within reach.
    pub toggles: (usize, usize),
    /// Points that nothing reaches.
    pub beyond: usize,
    /// The model's share of the register bits that can change.
    pub registers: f64,
}

/// Measures the coverage of a directory of emitted RTL in the simulator, which must be the newer Verilator.
///
/// # Errors
/// When there are no points, when the bundle reaches too few of them, or when it cannot be measured.
pub fn check(emitted: &Emitted<'_>, simulator: &Simulator) -> Result<Shares, Failure> {
    let bundle = points(emitted, simulator, "+seed=1")?;
    let random = points(emitted, simulator, &format!("+registers={CYCLES}"))?;
    if bundle.len() != random.len() || bundle.is_empty() {
        return failed(format!("Verilator has {} points in one run and {} in another", bundle.len(), random.len()));
    }
    let reached = |of: &BTreeMap<String, u64>, point: &str| of.get(point).is_some_and(|count| *count > 0);
    let within: Vec<&String> =
        bundle.keys().filter(|point| reached(&bundle, point) || reached(&random, point)).collect();
    let share = |toggles: bool| {
        let of_kind = within.iter().filter(|point| is_toggle(point) == toggles);
        let (met, all): (Vec<_>, Vec<_>) =
            (of_kind.clone().filter(|point| reached(&bundle, point)).collect(), of_kind.collect());
        (met.len(), all.len())
    };
    let (lines, toggles) = (share(false), share(true));
    list(&emitted.directory, &bundle, &within)?;
    for (met, all) in [lines, toggles] {
        if all == 0 || (met as f64) < LEAST * all as f64 {
            return failed(format!("the default bundle reaches {met} of {all} points; coverage.txt lists the others"));
        }
    }
    let registers = registers(emitted)?;
    Ok(Shares { lines, toggles, beyond: bundle.len() - within.len(), registers })
}

/// The model's coverage of the same vectors.
fn registers(emitted: &Emitted<'_>) -> Result<f64, Failure> {
    let bundle = Bundle::new(emitted.design, Strategy::Mixed, emitted.vectors, 1, "make rtl");
    let bundle = bundle.map_err(|error| Failure(error.to_string()))?;
    let coverage = Coverage::of(emitted.design, &bundle.samples().collect::<Vec<_>>(), 1);
    Ok(coverage.share())
}

fn is_toggle(point: &str) -> bool {
    point.starts_with("v_toggle")
}

/// Builds and runs the testbench with these options, and gives every point of the RTL with its count.
fn points(emitted: &Emitted<'_>, simulator: &Simulator, options: &str) -> Result<BTreeMap<String, u64>, Failure> {
    let directory = &emitted.directory;
    let file = directory.join("coverage.dat");
    let _ = std::fs::remove_file(&file);
    let (program, _) = verilator();
    let mut make = simulator.make(directory, "verilator");
    make.arg(format!("VERILATOR={} --coverage-line --coverage-toggle", program.display()));
    make.args(["BUILD=build-coverage", &format!("ARGUMENTS={options}")]);
    let output = make.output().map_err(|error| Failure(format!("cannot run make: {error}")))?;
    let said = String::from_utf8_lossy(&output.stdout);
    // A run of random cycles has no verdict, and so make ends badly.
    if !said.lines().any(|line| line.starts_with("PASS ") || line.starts_with("R-END ")) {
        let tail: Vec<&str> = said.lines().rev().take(5).collect();
        return failed(format!("coverage: {}{}", tail.join("\n"), String::from_utf8_lossy(&output.stderr)));
    }
    let text = std::fs::read_to_string(&file).map_err(|error| Failure(format!("{}: {error}", file.display())))?;
    Ok(text.lines().filter_map(point).filter(|(point, _)| !point.contains("blysk_tb.sv")).collect())
}

/// A point of `coverage.dat`: `C '…' count`, where each field of the quoted text has its letter between \x01 and \x02.
fn point(line: &str) -> Option<(String, u64)> {
    let (fields, count) = line.strip_prefix("C '")?.rsplit_once("' ")?;
    let fields: BTreeMap<&str, &str> = fields.split('\x01').filter_map(|field| field.split_once('\x02')).collect();
    let field = |name| fields.get(name).copied().unwrap_or_default();
    let place = format!("{}:{}:{}", field("f"), field("l"), field("n"));
    let name = format!("{} {place} {} {}", field("page"), field("h"), field("o"));
    Some((name, count.trim().parse().ok()?))
}

/// Every point that the bundle does not reach, and whether anything does.
fn list(directory: &Path, bundle: &BTreeMap<String, u64>, within: &[&String]) -> Result<(), Failure> {
    let mut text = String::new();
    for (point, _) in bundle.iter().filter(|(_, count)| **count == 0) {
        let reach = if within.binary_search(&point).is_ok() { "missed " } else { "beyond " };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{reach}{point}");
    }
    std::fs::write(directory.join("coverage.txt"), text).map_err(|error| Failure(error.to_string()))
}
