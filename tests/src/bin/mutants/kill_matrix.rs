//! What was killed, counted: by class, by bundle, and each survivor with its reason.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use blysk_tests::rtl::Failure;

use super::VECTORS;
use super::mutant::Mutant;

/// How many of the wrong ones were killed.
#[derive(Clone, Copy, Default)]
struct Rate {
    killed: u64,
    all: u64,
}

impl Rate {
    fn of<'a>(mutants: impl Iterator<Item = &'a Mutant>, by: fn(&Mutant) -> Option<&String>) -> Self {
        mutants.filter(|mutant| mutant.fate(by(mutant)) != "equivalent").fold(
            Self::default(),
            |Self { killed, all }, mutant| Self { killed: killed + u64::from(by(mutant).is_some()), all: all + 1 },
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
pub(crate) fn judge(preset: &str, mutants: &[Mutant]) -> bool {
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

/// Writes every mutant with what became of it, as CSV.
pub(crate) fn write(out: impl Write, mutants: &[Mutant]) -> csv::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
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
}

/// All classes together.
const ALL: &str = "all";

/// How many of each class met each fate, by preset and bundle.
#[derive(Default)]
pub(crate) struct Matrix {
    cells: BTreeMap<(String, &'static str, &'static str), BTreeMap<&'static str, u64>>,
}

impl Matrix {
    pub fn add(&mut self, preset: &str, mutants: &[Mutant]) {
        for mutant in mutants {
            for (bundle, by) in [("default", &mutant.by_default), ("compact", &mutant.by_compact)] {
                for class in [mutant.class, ALL] {
                    let cell = self.cells.entry((preset.to_owned(), class, bundle)).or_default();
                    *cell.entry(mutant.fate(by.as_ref())).or_default() += 1;
                }
            }
        }
    }

    pub fn write(&self, path: &Path) -> Result<(), Failure> {
        let written = || -> csv::Result<()> {
            let mut csv = csv::Writer::from_path(path)?;
            csv.write_record(["preset", "class", "bundle", "killed", "equivalent", "escaped", "killed_percent"])?;
            for ((preset, class, bundle), fates) in &self.cells {
                let count = |fate| fates.get(fate).copied().unwrap_or(0);
                let (killed, escaped) = (count("killed"), count("escaped"));
                let rate = Rate { killed, all: killed + escaped };
                // Where all are equivalent there is nothing to kill.
                let percent = if rate.all == 0 { String::new() } else { format!("{:.2}", rate.percent()) };
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
