//! `make mutants`: do the emitted vectors catch wrong RTL?
//!
//! `mutants PRESET…`; with none named, every preset. Writes `results/mutants/<preset>.csv` (every
//! mutant, and what each bundle's testbench found) and `matrix.csv` (the kill matrix, class by class).

use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;

use blysk_tests::rtl::mutants::proof::Judgement;
use blysk_tests::rtl::mutants::{
    Bench, DISTANT_ROWS, HANDSHAKE, NETLIST, Outcome, class, edits, netlist, own_sources, preset,
    rom,
};
use blysk_tests::rtl::simulators::{self, Simulator, repository};
use blysk_tests::rtl::{Failure, failed};
use hw_model::design::Design;
use rayon::prelude::*;
use vectors::faults::{Compact, Fault, Workers};
use vectors::{Bundle, Strategy};

/// Netlist mutations of each preset, and the seed that chooses them and the distant rows.
const MUTATIONS: usize = 500;
const SEED: u64 = 1;
/// How long a question of a proof of equivalence may take, in seconds.
const PROOF_SECONDS: u32 = 60;
/// Vectors of the default bundle.
const VECTORS: u64 = 4096;

fn main() -> ExitCode {
    let named: Vec<String> = std::env::args().skip(1).collect();
    let all = hw_model::presets::ALL.map(|preset| preset.name.to_owned());
    let presets = if named.is_empty() { all.to_vec() } else { named };
    match run(&presets) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
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
        write(&results.join(format!("{name}.csv")), &mutants)?;
        good &= judge(name, &mutants);
        matrix.add(name, &mutants);
    }
    matrix.write(&results.join("matrix.csv"))?;
    println!("Every mutant and the kill matrix are in {}.", results.display());
    Ok(good)
}

/// A mutant with what became of it in both bundles.
struct Mutant {
    class: &'static str,
    name: String,
    by_default: Option<String>,
    by_compact: Option<String>,
    known: Known,
}

/// What is known of a mutant beside what the vectors find.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Known {
    /// Nothing: it should be killed.
    Nothing,
    /// Why it may survive.
    Equivalent(&'static str),
    /// An input that shows it: the address, and the bits of x.
    Visible(u64, u64),
}

impl std::fmt::Display for Known {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Nothing => f.write_str("an escape, not shown to be equivalent"),
            Self::Equivalent(why) => f.write_str(why),
            Self::Visible(address, x) => {
                write!(f, "an escape: address {address} with x = 0x{x:x} shows it")
            }
        }
    }
}

impl From<Judgement> for Known {
    fn from(judgement: Judgement) -> Self {
        match judgement {
            Judgement::Equivalent(why) => Self::Equivalent(why),
            Judgement::Visible { address, x } => Self::Visible(address, x),
            Judgement::Open => Self::Nothing,
        }
    }
}

impl Mutant {
    /// True for what the compact set is made to catch.
    fn is_of_model(&self) -> bool {
        ![NETLIST, DISTANT_ROWS].contains(&self.class)
    }

    /// Why it survives where it does: what kills it in the other bundle, or what is known of it.
    fn why(&self) -> String {
        match (&self.by_default, &self.by_compact, self.known) {
            (None, Some(by), Known::Nothing) => {
                format!("an escape: the compact set kills it ({by})")
            }
            (Some(by), None, Known::Nothing) => {
                format!("an escape: the default bundle kills it ({by})")
            }
            (.., known) => known.to_string(),
        }
    }

    fn fate(&self, killed_by: Option<&String>) -> &'static str {
        match (killed_by, self.known) {
            (Some(_), _) => "killed",
            (None, Known::Equivalent(_)) => "equivalent",
            (None, _) => "escaped",
        }
    }
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
        println!("{}: choosing vectors", self.name);
        let default = self.bundle(Strategy::Mixed)?;
        let smallest = self.bundle(Strategy::Compact)?;
        let equivalent: Vec<Fault> =
            smallest.compact().into_iter().flat_map(Compact::equivalent).collect();
        let (default, smallest) =
            (self.bench("default", &default)?, self.bench("compact", &smallest)?);
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

    fn rom(
        &self,
        default: &Bench,
        smallest: &Bench,
        equivalent: &[Fault],
    ) -> Result<Vec<Mutant>, Failure> {
        let faults = rom::faults(self.design, SEED);
        println!("{}: {} wrong ROMs", self.name, faults.len());
        let by_default = rom::run(default, self.verilator, self.design, &faults)?;
        let by_compact = rom::run(smallest, self.verilator, self.design, &faults)?;
        let known = faults.iter().map(|wrong| {
            let proved = wrong.fault().is_some_and(|fault| equivalent.contains(&fault));
            (wrong.class(), by_inputs(proved))
        });
        Ok(merge(known, by_default, by_compact))
    }

    /// Each edit is compiled on its own, in Icarus, which compiles fastest.
    fn edits(
        &self,
        default: &Bench,
        smallest: &Bench,
        equivalent: &[Fault],
    ) -> Result<Vec<Mutant>, Failure> {
        let edits = edits::edits(self.design.datapath());
        println!("{}: {} wrong lines", self.name, edits.len());
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
        println!("{}: {MUTATIONS} netlist mutations, seed {SEED}", self.name);
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
        println!("{}: judging the survivors", self.name);
        let datapath = self.design.datapath();
        let (directory, seconds) = (&default.directory, PROOF_SECONDS);
        let judged = netlist::judge(directory, datapath, &list, &survivors, seconds)?;
        let known =
            judged.into_iter().map(|judged| (NETLIST, judged.map_or(Known::Nothing, Known::from)));
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

/// How many of the wrong ones were killed.
#[derive(Clone, Copy, Default)]
struct Rate {
    killed: u64,
    all: u64,
}

impl Rate {
    fn of<'a>(
        mutants: impl Iterator<Item = &'a Mutant>,
        by: fn(&Mutant) -> Option<&String>,
    ) -> Self {
        mutants.filter(|mutant| mutant.fate(by(mutant)) != "equivalent").fold(
            Self::default(),
            |Self { killed, all }, mutant| Self {
                killed: killed + u64::from(by(mutant).is_some()),
                all: all + 1,
            },
        )
    }

    fn percent(self) -> f64 {
        100.0 * self.killed as f64 / self.all.max(1) as f64
    }
}

impl std::fmt::Display for Rate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(&format!("{} of {} ({:.2} %)", self.killed, self.all, self.percent()))
    }
}

/// Prints the rates and the survivors; false where a bundle catches too little.
fn judge(preset: &str, mutants: &[Mutant]) -> bool {
    let by_default: fn(&Mutant) -> Option<&String> = |mutant| mutant.by_default.as_ref();
    let by_compact: fn(&Mutant) -> Option<&String> = |mutant| mutant.by_compact.as_ref();
    println!("{preset}: wrong ones killed, by class");
    println!("  {:<18} {:<26} the compact set", "", format!("{VECTORS} default vectors"));
    let mut classes: Vec<&str> = mutants.iter().map(|mutant| mutant.class).collect();
    classes.sort_unstable();
    classes.dedup();
    for class in classes {
        let members = || mutants.iter().filter(|mutant| mutant.class == class);
        let (default, compact) = (Rate::of(members(), by_default), Rate::of(members(), by_compact));
        println!("  {class:<18} {default:<26} {compact}");
    }
    let whole = Rate::of(mutants.iter(), by_default);
    let of_model = || mutants.iter().filter(|mutant| mutant.is_of_model());
    let model = Rate::of(of_model(), by_compact);
    println!("  {ALL:<18} {whole:<26} {}", Rate::of(mutants.iter(), by_compact));
    println!("  {:<18} {:<26} {model}", "the fault model", Rate::of(of_model(), by_default));
    for mutant in mutants.iter().filter(|m| m.by_default.is_none() || m.by_compact.is_none()) {
        let place = match (&mutant.by_default, &mutant.by_compact) {
            (None, None) => "both bundles",
            (None, Some(_)) => "the default bundle",
            _ => "the compact set",
        };
        println!("  {} survives {place}: {}", mutant.name, mutant.why());
    }
    whole.all > 0 && whole.percent() >= 99.0 && model.all > 0 && model.killed == model.all
}

fn write(path: &Path, mutants: &[Mutant]) -> Result<(), Failure> {
    let written = || -> csv::Result<()> {
        let mut csv = csv::Writer::from_path(path)?;
        csv.write_record(["class", "mutant", "default", "by", "compact", "by", "why"])?;
        for mutant in mutants {
            let (default, compact) = (mutant.by_default.as_ref(), mutant.by_compact.as_ref());
            let survives = default.is_none() || compact.is_none();
            let why = if survives { mutant.why() } else { String::new() };
            csv.write_record([
                mutant.class,
                &mutant.name,
                mutant.fate(default),
                default.map_or("", String::as_str),
                mutant.fate(compact),
                compact.map_or("", String::as_str),
                &why,
            ])?;
        }
        csv.flush()?;
        Ok(())
    };
    written().map_err(|error| Failure(format!("cannot write {}: {error}", path.display())))
}

/// All classes together.
const ALL: &str = "all";

/// How many of each class met each fate, by preset and bundle.
#[derive(Default)]
struct Matrix {
    cells: BTreeMap<(String, &'static str, &'static str), BTreeMap<&'static str, u64>>,
}

impl Matrix {
    fn add(&mut self, preset: &str, mutants: &[Mutant]) {
        for mutant in mutants {
            for (bundle, by) in [("default", &mutant.by_default), ("compact", &mutant.by_compact)] {
                for class in [mutant.class, ALL] {
                    let cell = self.cells.entry((preset.to_owned(), class, bundle)).or_default();
                    *cell.entry(mutant.fate(by.as_ref())).or_default() += 1;
                }
            }
        }
    }

    fn write(&self, path: &Path) -> Result<(), Failure> {
        let written = || -> csv::Result<()> {
            let mut csv = csv::Writer::from_path(path)?;
            csv.write_record([
                "preset",
                "class",
                "bundle",
                "killed",
                "equivalent",
                "escaped",
                "killed_percent",
            ])?;
            for ((preset, class, bundle), fates) in &self.cells {
                let count = |fate| fates.get(fate).copied().unwrap_or(0);
                let (killed, escaped) = (count("killed"), count("escaped"));
                let rate = Rate { killed, all: killed + escaped };
                // Where all are equivalent there is nothing to kill.
                let percent =
                    if rate.all == 0 { String::new() } else { format!("{:.2}", rate.percent()) };
                csv.write_record([
                    preset,
                    *class,
                    *bundle,
                    &killed.to_string(),
                    &count("equivalent").to_string(),
                    &escaped.to_string(),
                    &percent,
                ])?;
            }
            csv.flush()?;
            Ok(())
        };
        written().map_err(|error| Failure(format!("cannot write {}: {error}", path.display())))
    }
}
