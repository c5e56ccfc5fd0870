//! What the results of all shards make together, and its files.

use analysis::error_report::ErrorReport;
use analysis::report::{files, written};
use bounds::certify::certificate::Certificate;
use hw_model::design::Design;
use serde::Serialize;
use vectors::OutputSet;

use crate::error::ShardError;
use crate::part::Printed;

/// The merged report of a job.
#[derive(Debug, Clone)]
pub enum Merged {
    /// Of the errors of a configuration.
    Errors {
        /// The hardware.
        design: Box<Design>,
        /// The report, as `blysk report --exhaustive` has it.
        report: ErrorReport,
    },
    /// Of a certification.
    Certificate(Box<Certificate>),
    /// Of RTL beside the model.
    Rtl(RtlReport),
    /// Of runs of a program.
    Printed(Vec<ProgramRow>),
}

/// A run of a program with what it printed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramRow {
    /// The arguments of the run.
    pub arguments: Vec<String>,
    /// What it printed.
    pub printed: Printed,
}

/// A line of `runs.csv`.
#[derive(Serialize)]
struct RunLine {
    run: usize,
    arguments: String,
    status: i32,
    bytes: usize,
}

/// How RTL and model agree, exponent by exponent.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RtlReport {
    /// The name of the configuration.
    pub configuration: String,
    /// Results compared, all exponents together.
    pub compared: u64,
    /// Results that differ, all exponents together.
    pub different: u64,
    /// One for each exponent.
    pub rows: Vec<RtlRow>,
}

/// How RTL and model agree at one exponent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RtlRow {
    /// The exponent.
    pub n: f64,
    /// Results compared.
    pub compared: u64,
    /// Results that differ.
    pub different: u64,
    /// The first x whose result differs, as bits in the input format.
    pub first_different: Option<i64>,
}

impl RtlReport {
    /// The report of these rows.
    #[must_use]
    pub fn new(configuration: String, rows: Vec<RtlRow>) -> Self {
        let sum = |of: fn(&RtlRow) -> u64| rows.iter().map(of).sum();
        Self { configuration, compared: sum(|row| row.compared), different: sum(|row| row.different), rows }
    }
}

/// The name of a merged certificate.
pub const CERTIFICATE: &str = "certificate.json";
/// The names of the report of RTL beside the model.
pub const RTL: [&str; 2] = ["exhaustive.csv", "exhaustive.json"];

/// The table of runs.
const RUNS: &str = "runs.csv";

/// What the run of this number printed.
fn run_name(number: usize) -> String {
    format!("run-{number:05}.txt")
}

impl Merged {
    /// Adds the files of the report to a set: the same bytes as one machine's command writes.
    ///
    /// # Errors
    /// When a file cannot be made or written.
    pub fn write(&self, set: &mut OutputSet) -> Result<(), ShardError> {
        match self {
            Self::Errors { design, report } => {
                files::write(set, design, report, files::exponent_of_curves(design))?;
            }
            Self::Rtl(report) => {
                let [csv, json] = RTL;
                set.write(csv, written::table(csv, &report.rows)?)?;
                set.write(json, written::json(json, report)?)?;
            }
            Self::Printed(rows) => {
                let line = |(run, row): (usize, &ProgramRow)| {
                    let ProgramRow { arguments, printed: Printed { status, text } } = row;
                    RunLine { run, arguments: arguments.join(" "), status: *status, bytes: text.len() }
                };
                let lines: Vec<RunLine> = rows.iter().enumerate().map(line).collect();
                set.write(RUNS, written::table(RUNS, &lines)?)?;
                for (number, row) in rows.iter().enumerate() {
                    set.write(&run_name(number), &row.printed.text)?;
                }
            }
            Self::Certificate(certificate) => set.write(CERTIFICATE, certificate.to_json())?,
        }
        Ok(())
    }

    /// The names of the files.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Errors { .. } => files::names().collect(),
            Self::Rtl(_) => RTL.map(str::to_owned).to_vec(),
            Self::Printed(rows) => std::iter::once(RUNS.to_owned()).chain((0..rows.len()).map(run_name)).collect(),
            Self::Certificate(_) => vec![CERTIFICATE.to_owned()],
        }
    }

    /// The command that writes the same on one machine, by whose name the list of the files goes.
    #[must_use]
    pub const fn command(&self) -> &'static str {
        match self {
            Self::Errors { .. } => "report",
            Self::Certificate(_) => "certify",
            Self::Rtl(_) => "exhaustive",
            Self::Printed(_) => "runs",
        }
    }
}
