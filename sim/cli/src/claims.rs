//! `blysk claims`: the claims of the paper, judged.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::{Args as ClapArgs, ValueEnum};

use super::out::{Out, Outcome};
use super::output;
use super::table::{Cell, Format, Rows, write_folded};
use analysis::claims::{Claim, claims};
use analysis::report::claims::page;
use vectors::output_text::json;

/// Judge the claims of the paper: what holds, for which exponents, and what is misprinted.
///
/// Every number is computed in this run. The exponent from which a claim fails is found by bisection over the
/// integers. With --out, the directory gets claims.csv, claims.json and claims.md. Exit status: 0 when
/// every claim could be judged, whatever became of it; 2 for an error.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk claims\n          \
                        blysk claims --claim relative-error\n          \
                        blysk claims --format csv\n          \
                        blysk claims --out results/claims")]
pub(super) struct Args {
    /// Only this claim, with the numbers it was judged by.
    #[arg(long, value_name = "NAME")]
    claim: Option<String>,
    /// Write the claims to this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// How to print the claims.
    #[arg(long, value_enum, default_value_t)]
    format: Shape,
}

/// How claims are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Shape {
    /// For people, at most 100 columns wide.
    #[default]
    Table,
    /// Comma-separated values with a header: one line for each claim, or for each number of --claim.
    Csv,
    /// An array of objects.
    Json,
    /// A page, as docs/CLAIMS.md.
    Markdown,
}

/// The files of `--out`.
const FILES: [&str; 3] = ["claims.csv", "claims.json", "claims.md"];

/// What docs/CLAIMS.md is made by.
const COMMAND: &str = "blysk claims --format markdown";

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let set = args.out.as_deref().map(|out| output::set(out, "claims", &[], FILES)).transpose()?;
    let mut claims = claims()?;
    if let Some(name) = &args.claim {
        let names: Vec<&str> = claims.iter().map(|claim| claim.id).collect();
        if !names.contains(&name.as_str()) {
            bail!("--claim {name}: there is no such claim; there are {}", names.join(", "));
        }
        claims.retain(|claim| claim.id == name);
    }
    if let Some(mut set) = set {
        let mut csv = Vec::new();
        all(&claims).csv(&mut csv)?;
        let [table, object, text] = FILES;
        set.write(table, csv)?;
        set.write(object, json(&claims)?)?;
        set.write(text, page(&claims, COMMAND)?)?;
        set.commit()?;
    }
    print(&claims, args, out)?;
    if let (Some(directory), Shape::Table) = (&args.out, args.format) {
        writeln!(out, "\nwritten to {}: {}", directory.display(), FILES.join(", "))?;
    }
    Ok(Outcome::Good)
}

fn print(claims: &[Claim], args: &Args, out: &mut Out) -> anyhow::Result<()> {
    let one = claims.first().filter(|_| args.claim.is_some());
    match (args.format, one) {
        (Shape::Table, Some(claim)) => details(claim, out),
        (Shape::Table, None) => overview(claims, out),
        (Shape::Csv, Some(claim)) => evidence(claim).csv(out),
        (Shape::Csv, None) => all(claims).csv(out),
        (Shape::Json, _) => Ok(out.write_all(json(claims)?.as_bytes())?),
        (Shape::Markdown, _) => Ok(out.write_all(page(claims, COMMAND)?.as_bytes())?),
    }
}

/// One claim to a paragraph: a table of four columns would fold each cell many times.
fn overview(claims: &[Claim], out: &mut Out) -> anyhow::Result<()> {
    for claim in claims {
        writeln!(out, "{:<26}{}", claim.id, claim.verdict.to_string().to_uppercase())?;
        write_folded(out, &format!("  {} ({})", claim.claim, claim.source))?;
        write_folded(out, &format!("  -> {}", claim.computed))?;
        writeln!(out)?;
    }
    writeln!(out, "The numbers behind one of them: blysk claims --claim NAME")?;
    Ok(())
}

fn details(claim: &Claim, out: &mut Out) -> anyhow::Result<()> {
    write_folded(out, claim.claim)?;
    writeln!(out, "\nwhere        {}", claim.source)?;
    writeln!(out, "verdict      {}", claim.verdict)?;
    writeln!(out, "holds for    {}", claim.holds_for)?;
    if let Some(n) = claim.fails_from {
        writeln!(out, "fails from   n = {n}")?;
    }
    writeln!(out)?;
    evidence(claim).print(out, Format::Table, 7)
}

fn evidence(claim: &Claim) -> Rows {
    let mut rows = Rows::new(&["computed", "n", "value", "allowed", "unit"]);
    for row in &claim.evidence {
        rows.push(vec![
            row.what.clone().into(),
            row.n.map_or(Cell::None, Cell::Exponent),
            row.value.into(),
            row.limit.into(),
            row.unit.into(),
        ]);
    }
    rows
}

fn all(claims: &[Claim]) -> Rows {
    let columns = ["claim", "says", "source", "verdict", "holds_for", "fails_from", "computed", "command"];
    let mut rows = Rows::new(&columns);
    for claim in claims {
        rows.push(vec![
            claim.id.into(),
            claim.claim.into(),
            claim.source.into(),
            claim.verdict.to_string().into(),
            claim.holds_for.clone().into(),
            claim.fails_from.map_or(Cell::None, |n| Cell::Exponent(n as f64)),
            claim.computed.clone().into(),
            claim.command.clone().into(),
        ]);
    }
    rows
}
