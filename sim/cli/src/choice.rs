//! Which vectors a bundle has: by a strategy, or by a list of the user's own.

use std::io;
use std::path::{Path, PathBuf};

use clap::{Args as ClapArgs, ValueEnum};
use hw_model::design::Design;
use hw_model::names;
use rayon::prelude::*;
use vectors::case::{DEFAULT_COUNT, DEFAULT_SEED, options};
use vectors::evaluate::{Csv, Dialect, Hex, questions};
use vectors::faults::Workers;
use vectors::limits::MAX_VECTORS;
use vectors::progress::Progress;
use vectors::stimulus_file::parse_stimulus;
use vectors::text_file::{self, QUESTIONS, STIMULUS, TextReader};
use vectors::{Bundle, Case, Strategy};

use super::bar::{self, Bar};
use super::output::is_standard_output;

/// The options that choose vectors.
#[derive(ClapArgs)]
pub(super) struct Choice {
    /// How vectors are chosen: mixed, compact (as few as show every fault), corners, even, random or exhaustive
    /// (every address with every x).
    #[arg(long, default_value_t)]
    strategy: Strategy,
    /// How many vectors; compact and exhaustive settle that themselves.
    #[arg(long, default_value_t = DEFAULT_COUNT)]
    count: u64,
    /// Seed of the random vectors, and of the wrong word of the negative control.
    #[arg(long, default_value_t = DEFAULT_SEED)]
    seed: u64,
    /// Your own list of cases instead, in its order; - is standard input.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["strategy", "count"])]
    cases: Option<PathBuf>,
    /// How the list is written.
    #[arg(long, value_enum, default_value_t, requires = "cases", value_name = "FORMAT")]
    cases_format: CasesFormat,
}

/// How a list of cases is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum CasesFormat {
    /// CSV with the columns n (or address) and x (or x_bits), as `blysk evaluate` reads it.
    #[default]
    Csv,
    /// Words {address, x} in hex, as in stimulus.mem.
    Hex,
    /// A stimulus of `blysk simulate`: the request of every cycle with valid = 1 is a case.
    Stimulus,
}

impl Choice {
    /// The strategy, which is [`Strategy::List`] with a list.
    pub(super) const fn strategy(&self) -> Strategy {
        if self.cases.is_some() { Strategy::List } else { self.strategy }
    }

    /// The options as they would be typed, for the headers of generated files.
    pub(super) fn options(&self) -> String {
        let Self { strategy, count, seed, .. } = self;
        match &self.cases {
            Some(path) => format!("--cases {}{} --seed {seed}", names::shell(path), self.cases_format.option()),
            None => options(*strategy, *count, *seed),
        }
    }

    /// The files that the vectors are read from.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.cases.iter().filter(|path| !is_standard_output(path)).cloned().collect()
    }

    /// The vectors of a design; `command` is what the files say they were made by.
    pub(super) fn bundle<'a>(&self, design: &'a Design, command: &str) -> anyhow::Result<Bundle<'a>> {
        Ok(match &self.cases {
            Some(path) => Bundle::of_cases(design, &self.read(design, path)?, self.seed, command)?,
            None => Bundle::with_workers(design, self.strategy, self.count, self.seed, command, &Threads)?,
        })
    }

    fn read(&self, design: &Design, path: &Path) -> anyhow::Result<Vec<Case>> {
        let datapath = design.datapath();
        match self.cases_format {
            CasesFormat::Csv => ask(&mut Csv::new(datapath), path),
            CasesFormat::Hex => ask(&mut Hex::new(datapath), path),
            CasesFormat::Stimulus => {
                let (rom, input) = (datapath.rom(), datapath.formats().input);
                let lines = if is_standard_output(path) {
                    parse_stimulus(standard_input(), standard_input_name(), rom, input)
                } else {
                    parse_stimulus(text_file::open(path, STIMULUS)?, path, rom, input)
                }?;
                Ok(lines.iter().filter(|line| line.valid).map(|line| line.case).collect())
            }
        }
    }
}

impl CasesFormat {
    const fn option(self) -> &'static str {
        match self {
            Self::Csv => "",
            Self::Hex => " --cases-format hex",
            Self::Stimulus => " --cases-format stimulus",
        }
    }
}

fn ask(dialect: &mut impl Dialect, path: &Path) -> anyhow::Result<Vec<Case>> {
    Ok(if is_standard_output(path) {
        let from = TextReader::new(standard_input(), QUESTIONS);
        questions(dialect, (standard_input_name(), from), MAX_VECTORS)
    } else {
        questions(dialect, (path, text_file::open(path, QUESTIONS)?), MAX_VECTORS)
    }?)
}

/// Standard input; who types at a terminal is not shown for how long the command has waited.
fn standard_input() -> io::Stdin {
    bar::end();
    io::stdin()
}

fn standard_input_name() -> &'static Path {
    Path::new("standard input")
}

/// Every core, with a progress bar on standard error where that is a terminal.
struct Threads;

impl Workers for Threads {
    fn run<T: Send>(&self, count: u32, job: impl Fn(u32) -> T + Sync) -> Vec<T> {
        let bar = Bar::counting(Some(count.into()), "rows");
        let results = (0..count)
            .into_par_iter()
            .map(|index| {
                let result = job(index);
                bar.advance(1);
                result
            })
            .collect();
        bar.finish();
        results
    }
}
