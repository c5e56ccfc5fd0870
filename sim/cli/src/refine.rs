//! `blysk refine`: better ROM integers.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::{Args as ClapArgs, ValueEnum};
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::exponents::Exponents;
use hw_model::registers::Register;

use super::bar::Bar;
use super::configuration::Configuration;
use super::out::{Out, Outcome};
use super::output;
use super::rom::addresses;
use super::table::{Cell, Format, Rows, digits, write_folded};
use analysis::refine::{Found, Options, Range, Refined, refine, samples};

/// Search the neighbouring ROM integers for those with the least error through the data path.
///
/// Row by row, and segment by segment, the integers of the coefficients are judged by the pipeline's own
/// arithmetic at every representable x of the range, against the correctly rounded x^n, until no neighbour
/// within --reach is better. The configuration that --out writes has the steps from the rounded coefficients in
/// `coefficient_steps`, and states its widths, so that the steps keep their meaning. A summary is printed, and with
/// --rows a table of the greatest error before and after, the greatest error of the method with real coefficients, and
/// the differences between these in output ulp; csv and json are that table. All 256 rows of preset precise take half
/// a minute of one core.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk refine --preset compact --exponents 64,128 --out refined.json\n          \
                        blysk refine --config mine.json --format csv")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: Configuration,
    /// Write the configuration with the steps to this file; - is standard output, which then has nothing else.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Search only the rows of these exponents.
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    exponents: Option<Exponents>,
    /// The x over which the error is to be least.
    #[arg(long, value_enum, default_value_t)]
    range: Over,
    /// No coefficient moves farther than this, in units of its last place; 0 measures and moves nothing.
    #[arg(
        long,
        default_value_t = 32,
        allow_negative_numbers = true,
        value_name = "STEPS",
        value_parser = clap::value_parser!(i32).range(0..=256)
    )]
    reach: i32,
    /// Print a row for each exponent and segment below the summary.
    #[arg(long)]
    rows: bool,
    /// How to print what was found.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum Over {
    /// What the method is fitted to: the epicentre, or all of a fitted range.
    #[default]
    Fitted,
    /// Every x that the polynomial answers.
    Polynomial,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = args.configuration.design()?;
    if design.datapath().degree() == 0 {
        bail!("method {} has no polynomial whose coefficients could move", design.config().method);
    }
    let addresses = addresses(&design, args.exponents.as_ref())?;
    let range = match args.range {
        Over::Fitted => Range::Fitted,
        Over::Polynomial => Range::Polynomial,
    };
    let options = Options { range, reach: args.reach };
    let samples = samples(&design, &addresses, options)?;
    // Begun before the work, so that an unwritable place is found at once.
    let file = output::file(args.out.as_ref(), &args.configuration.files())?;
    let bar = Bar::new(Some(samples));
    let refined = refine(&design, &addresses, options, &bar)?;
    bar.finish();
    if output::fill(file, refined.config().to_json())? {
        return Ok(Outcome::Good);
    }
    let rows = || rows(&refined.found, design.config().output.ulp());
    if args.format != Format::Table {
        rows().print(out, args.format, 6)?;
    } else {
        summary(&design, &refined, out)?;
        at_the_reach(&refined, args.reach, out)?;
        if args.rows {
            writeln!(out)?;
            rows().print(out, args.format, 6)?;
        }
        if let Some(path) = &args.out {
            writeln!(out, "\nwritten to {}", path.display())?;
        }
    }
    Ok(Outcome::Good)
}

fn rows(found: &[Found], ulp: f64) -> Rows {
    let mut rows =
        Rows::new(&["n", "segment", "samples", "before", "after", "method", "gap_before", "gap_after", "steps"]);
    for piece in found {
        rows.push(vec![
            Cell::Exponent(piece.n),
            Cell::Integer(piece.segment.into()),
            Cell::Integer(piece.samples as i64),
            Cell::Real(piece.before),
            Cell::Real(piece.after),
            Cell::Real(piece.method),
            Cell::Real((piece.before - piece.method) / ulp),
            Cell::Real((piece.after - piece.method) / ulp),
            steps(piece).into(),
        ]);
    }
    rows
}

/// `c3-1 c2+4`, of those that are moved.
fn steps(piece: &Found) -> String {
    let named = piece.steps.iter().enumerate().rev();
    let moved = named.filter(|&(_, steps)| *steps != 0);
    moved.map(|(power, steps)| format!("{}{steps:+}", Register::C(0, power))).collect::<Vec<_>>().join(" ")
}

/// Rows that might go on if they were let.
fn at_the_reach(refined: &Refined, reach: i32, out: &mut Out) -> anyhow::Result<()> {
    let stopped = |piece: &&Found| piece.steps.iter().any(|step| step.abs() == reach);
    let count = refined.found.iter().filter(stopped).count();
    if reach > 0 && count > 0 {
        let text = format!("{count} stopped at --reach {reach}: with a greater one there may be better");
        write_folded(out, &text)?;
    }
    Ok(())
}

/// The worst of all, before and after, and what the budget had to become.
fn summary(design: &Design, refined: &Refined, out: &mut Out) -> anyhow::Result<()> {
    let ulp = design.config().output.ulp();
    let worst = |of: fn(&Found) -> f64| {
        let first = refined.found.first();
        first.map(|first| refined.found.iter().fold(first, |w, p| if of(p) > of(w) { p } else { w }))
    };
    let mean =
        |of: fn(&Found) -> f64| refined.found.iter().map(of).sum::<f64>() / refined.found.len().max(1) as f64 / ulp;
    let (Some(before), Some(after)) = (worst(|p| p.before), worst(|p| p.after)) else {
        return Ok(());
    };
    let (first, second) = (digits(before.before, 6), digits(after.after, 6));
    let moved = refined.found.iter().filter(|p| p.after < p.before).count();
    write_folded(
        out,
        &format!(
            "worst {first} at n = {}, after {second} at n = {}; mean gap to the method {:.3} ulp, after \
             {:.3} ulp; {moved} of {} better",
            before.n,
            after.n,
            mean(|p| p.before - p.method),
            mean(|p| p.after - p.method),
            refined.found.len(),
        ),
    )?;
    let budget = |config: &Config| config.error_budget_ulp;
    let (was, is) = (budget(design.config()), budget(refined.config()));
    if is > was {
        write_folded(
            out,
            &format!(
                "error_budget_ulp is {is} instead of {was}: with its steps a row is proved to be so far from the \
                 real polynomial, though nearer to x^n"
            ),
        )?;
    }
    Ok(())
}
