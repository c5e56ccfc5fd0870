//! `make mutants`: do the emitted vectors catch wrong RTL?
//!
//! `mutants PRESET…`; with none named, every preset. Writes `results/mutants/<preset>.csv` (every
//! mutant, and what each bundle's testbench found) and `matrix.csv` (the kill matrix, class by class).
//! `mutants --table PRESET` prints the table of one preset and writes no file: a piece of work for `blysk shard`.

mod kill_matrix;
mod mutant;

use std::fs::File;
use std::process::ExitCode;

use blysk_tests::rtl::mutants::{Bench, HANDSHAKE, NETLIST, Outcome, class, edits, netlist, own_sources, preset, rom};
use blysk_tests::rtl::simulators::{self, Simulator, repository};
use blysk_tests::rtl::{Failure, failed};
use hw_model::design::Design;
use rayon::prelude::*;
use vectors::faults::{Compact, Fault, Workers};
use vectors::{Bundle, Strategy};

use kill_matrix::{Matrix, judge, write};
use mutant::{Known, Mutant};

/// Netlist mutations of each preset, and the seed that chooses them and the distant rows.
const MUTATIONS: usize = 500;
const SEED: u64 = 1;
/// How long a question of a proof of equivalence may take, in seconds.
const PROOF_SECONDS: u32 = 60;
/// Vectors of the default bundle.
const VECTORS: u64 = 4096;

fn main() -> ExitCode {
    let named: Vec<String> = std::env::args().skip(1).collect();
    if let [option, name] = named.as_slice()
        && option == "--table"
    {
        return status(table(name));
    }
    let all = hw_model::presets::ALL.map(|preset| preset.name.to_owned());
    let presets = if named.is_empty() { all.to_vec() } else { named };
    status(run(&presets))
}

fn status(result: Result<bool, Failure>) -> ExitCode {
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints the table of one preset.
fn table(name: &str) -> Result<bool, Failure> {
    let simulators = simulators::all()?;
    let (icarus, verilator) = (&simulators[0], &simulators[1]);
    let mutants = Campaign { name, design: &preset(name)?, icarus, verilator }.run()?;
    write(std::io::stdout().lock(), &mutants).map_err(|error| Failure(error.to_string()))?;
    Ok(!mutants.is_empty())
}

fn run(presets: &[String]) -> Result<bool, Failure> {
    let simulators = simulators::all()?;
    let (icarus, verilator) = (&simulators[0], &simulators[1]);
    let results = repository().join("results/mutants");
    std::fs::create_dir_all(&results).map_err(|error| Failure(error.to_string()))?;
    let mut matrix = Matrix::default();
    let mut good = true;
    for name in presets {
        let mutants = Campaign { name, design: &preset(name)?, icarus, verilator }.run()?;
        let path = results.join(format!("{name}.csv"));
        let written = || -> csv::Result<()> { write(File::create(&path)?, &mutants) };
        written().map_err(|error| Failure(format!("cannot write {}: {error}", path.display())))?;
        good &= judge(name, &mutants);
        matrix.add(name, &mutants);
    }
    matrix.write(&results.join("matrix.csv"))?;
    println!("Every mutant and the kill matrix are in {}.", results.display());
    Ok(good)
}

const BY_INPUTS: &str = "every input gives the same answer (the model, exhaustively)";

struct Campaign<'a> {
    name: &'a str,
    design: &'a Design,
    icarus: &'a Simulator,
    verilator: &'a Simulator,
}

struct Cores;

impl Workers for Cores {
    fn run<T: Send>(&self, count: u32, job: impl Fn(u32) -> T + Sync) -> Vec<T> {
        (0..count).into_par_iter().map(&job).collect()
    }
}

impl Campaign<'_> {
    fn run(&self) -> Result<Vec<Mutant>, Failure> {
        eprintln!("{}: choosing vectors", self.name);
        let default = self.bundle(Strategy::Mixed)?;
        let smallest = self.bundle(Strategy::Compact)?;
        let equivalent: Vec<Fault> = smallest.compact().into_iter().flat_map(Compact::equivalent).collect();
        let (default, smallest) = (self.bench("default", &default)?, self.bench("compact", &smallest)?);
        let mut mutants = self.rom(&default, &smallest, &equivalent)?;
        mutants.extend(self.edits(&default, &smallest, &equivalent)?);
        mutants.extend(self.netlist(&default, &smallest)?);
        Ok(mutants)
    }

    fn bundle(&self, strategy: Strategy) -> Result<Bundle<'_>, Failure> {
        Bundle::with_workers(self.design, strategy, VECTORS, 1, "make mutants", &Cores)
            .map_err(|error| Failure(error.to_string()))
    }

    fn bench(&self, kind: &str, bundle: &Bundle<'_>) -> Result<Bench, Failure> {
        let bench = Bench::new(&format!("mutants-{}-{kind}", self.name), bundle)?;
        bench.build(self.verilator, &own_sources())?;
        let place = bench.place("right", &[])?;
        match bench.run(self.verilator, &place, &[])? {
            None => Ok(bench),
            Some(found) => failed(format!("{}: the right RTL fails: {found}", self.name)),
        }
    }

    fn rom(&self, default: &Bench, smallest: &Bench, equivalent: &[Fault]) -> Result<Vec<Mutant>, Failure> {
        let faults = rom::faults(self.design, SEED);
        eprintln!("{}: {} wrong ROMs", self.name, faults.len());
        let by_default = rom::run(default, self.verilator, self.design, &faults)?;
        let by_compact = rom::run(smallest, self.verilator, self.design, &faults)?;
        let known = faults.iter().map(|wrong| {
            let proved = wrong.fault().is_some_and(|fault| equivalent.contains(&fault));
            (wrong.class(), by_inputs(proved))
        });
        Ok(merge(known, by_default, by_compact))
    }

    /// Each edit is compiled on its own, in Icarus, which compiles fastest.
    fn edits(&self, default: &Bench, smallest: &Bench, equivalent: &[Fault]) -> Result<Vec<Mutant>, Failure> {
        let edits = edits::edits(self.design.datapath());
        eprintln!("{}: {} wrong lines", self.name, edits.len());
        let run = |bench: &Bench| -> Result<Vec<Outcome>, Failure> {
            edits.par_iter().map(|edit| bench.run_edit(self.icarus, edit)).collect()
        };
        let known = edits.iter().map(|edit| {
            let proved = edit.fault.is_some_and(|fault| equivalent.contains(&fault));
            (edit.fault.map_or(HANDSHAKE, class), by_inputs(proved))
        });
        Ok(merge(known, run(default)?, run(smallest)?))
    }

    fn netlist(&self, default: &Bench, smallest: &Bench) -> Result<Vec<Mutant>, Failure> {
        eprintln!("{}: {MUTATIONS} netlist mutations, seed {SEED}", self.name);
        let mut found = Vec::new();
        let mut list = Vec::new();
        for bench in [default, smallest] {
            list = netlist::mutate(&bench.directory, MUTATIONS, SEED)?;
            bench.clear(self.verilator)?;
            bench.build(self.verilator, &netlist::sources())?;
            found.push(netlist::run(bench, self.verilator, &list)?);
        }
        let by_compact = found.pop().unwrap_or_default();
        let by_default = found.pop().unwrap_or_default();
        let survivors: Vec<bool> = by_default
            .iter()
            .zip(&by_compact)
            .map(|(default, compact)| default.killed_by.is_none() && compact.killed_by.is_none())
            .collect();
        eprintln!("{}: judging the survivors", self.name);
        let datapath = self.design.datapath();
        let (directory, seconds) = (&default.directory, PROOF_SECONDS);
        let judged = netlist::judge(directory, datapath, &list, &survivors, seconds)?;
        let known = judged.into_iter().map(|judged| (NETLIST, judged.map_or(Known::Nothing, Known::from)));
        Ok(merge(known, by_default, by_compact))
    }
}

const fn by_inputs(proved: bool) -> Known {
    if proved { Known::Equivalent(BY_INPUTS) } else { Known::Nothing }
}

/// `known` of each mutant is its class, and what is known of it.
fn merge(
    known: impl Iterator<Item = (&'static str, Known)>,
    by_default: Vec<Outcome>,
    by_compact: Vec<Outcome>,
) -> Vec<Mutant> {
    let outcomes = by_default.into_iter().zip(by_compact).zip(known);
    outcomes
        .map(|((default, compact), (class, known))| Mutant {
            class,
            name: default.name,
            by_default: default.killed_by,
            by_compact: compact.killed_by,
            known,
        })
        .collect()
}
