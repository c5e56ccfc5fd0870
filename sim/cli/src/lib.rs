//! The `blysk` command line: the only place of this crate that knows clap and opens files.
//!
//! Exit status: 0 done, and what was checked holds; 1 done, and a bound does not hold or an answer is
//! not the expected one; 2 a usage, configuration, input or output error; 130 and 143 SIGINT and SIGTERM.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

mod answers;
mod bar;
mod certify;
mod check;
mod choice;
mod claims;
mod clock;
mod coefficients;
mod completions;
mod configuration;
mod coverage;
mod design;
mod document;
mod evaluate;
mod help;
mod html;
mod man;
mod mesh;
mod methods;
mod out;
mod output;
mod pareto;
mod pareto_page;
mod pareto_tables;
mod picture_size;
mod presets;
mod recordings;
mod refine;
mod render;
mod render_more;
mod report;
mod report_page;
mod report_tables;
mod rom;
mod rtl;
mod scene;
mod scene_import;
mod serve;
mod shard;
mod signals;
mod simulate;
mod specialise;
mod specialise_check;
mod stability;
mod stability_tables;
mod synthesis;
mod table;
mod vectors;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use out::{Out, Outcome};
use table::folded;

/// Bit-accurate, cycle-accurate model of a specular-highlight shading pipeline.
///
/// The pipeline computes cos(γ)^n, the highlight of Phong shading, by a polynomial whose coefficients sit in a ROM.
/// blysk models it bit for bit and cycle for cycle. It measures and proves the error of a configuration, searches for
/// better ones, writes RTL with vectors and a testbench, judges what your own simulation answers, and draws with the
/// result.
#[derive(Parser)]
#[command(name = "blysk", version, max_term_width = 100)]
#[command(after_help = "Start with: blysk presets; blysk report --preset paper --out results\n\
                        `blysk COMMAND --help` says more of a command.")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// The commands. What each does is said at its arguments: a comment here would replace the one there.
#[derive(Subcommand)]
enum Command {
    Report(report::Args),
    Vectors(vectors::Args),
    Rtl(rtl::Args),
    Check(check::Args),
    Certify(certify::Args),
    Simulate(simulate::Args),
    Evaluate(evaluate::Args),
    Serve(serve::Args),
    Claims(claims::Args),
    Coefficients(coefficients::Args),
    Rom(rom::Args),
    Refine(refine::Args),
    Design(design::Args),
    Clock(clock::Args),
    Document(document::Args),
    Stability(stability::Args),
    Pareto(pareto::Args),
    Render(render::Args),
    Mesh(mesh::Args),
    Scene(scene::Args),
    Specialise(specialise::Args),
    Shard(shard::Args),
    Presets(presets::Args),
    Completions(completions::Args),
    Man(man::Args),
}

/// Parses the command line, runs the command, and reports its errors.
#[must_use]
pub fn main() -> ExitCode {
    if let Err(error) = signals::watch() {
        let _ = writeln!(io::stderr(), "error: cannot watch for signals: {error}");
        return ExitCode::from(2);
    }
    let cli = match parsed() {
        Ok(cli) => cli,
        Err(error) => return said(&error),
    };
    let mut out = out::lock();
    bar::begin();
    let result = run(cli.command, &mut out).and_then(|outcome| {
        out.flush()?;
        Ok(outcome)
    });
    bar::end();
    match result {
        Ok(Outcome::Good) => ExitCode::SUCCESS,
        Ok(Outcome::Fails) => ExitCode::from(1),
        Ok(Outcome::Stopped(signal)) => ExitCode::from(signals::status(signal) as u8),
        Err(error) => {
            // Where standard error is closed, the exit status alone tells.
            let _ = writeln!(io::stderr(), "{}", folded(&format!("error: {}", message(&error)), CONTINUED));
            ExitCode::from(2)
        }
    }
}

/// What the next line of an error begins with, where the error is wider than a terminal. Errors are folded in a pipe
/// too, so that what a log has is what was seen.
const CONTINUED: &str = "    ";

fn parsed() -> Result<Cli, clap::Error> {
    let matches = help::grouped(Cli::command()).try_get_matches()?;
    Cli::from_arg_matches(&matches)
}

/// Says why there is nothing to run: help that was asked for, or an error of usage.
fn said(error: &clap::Error) -> ExitCode {
    let text = error.render().to_string();
    let narrow: Vec<String> = text.lines().map(|line| folded(line, CONTINUED)).collect();
    // Where nobody listens any more, the exit status alone tells. Colours are clap's.
    let _ = match narrow.iter().any(|line| line.contains('\n')) {
        true if error.use_stderr() => writeln!(io::stderr(), "{}", narrow.join("\n")),
        true => writeln!(io::stdout(), "{}", narrow.join("\n")),
        false => error.print(),
    };
    ExitCode::from(error.exit_code() as u8)
}

fn run(command: Command, out: &mut Out) -> anyhow::Result<Outcome> {
    match command {
        Command::Report(args) => report::run(&args, out),
        Command::Vectors(args) => vectors::run(&args, out),
        Command::Rtl(args) => rtl::run(&args, out),
        Command::Check(args) => check::run(&args, out),
        Command::Certify(args) => certify::run(&args, out),
        Command::Simulate(args) => simulate::run(&args, out),
        Command::Evaluate(args) => evaluate::run(&args, out),
        Command::Serve(args) => serve::run(&args, out),
        Command::Claims(args) => claims::run(&args, out),
        Command::Coefficients(args) => coefficients::run(&args, out),
        Command::Rom(args) => rom::run(&args, out),
        Command::Refine(args) => refine::run(&args, out),
        Command::Design(args) => design::run(&args, out),
        Command::Clock(args) => clock::run(&args, out),
        Command::Document(args) => document::run(&args, out),
        Command::Stability(args) => stability::run(&args, out),
        Command::Pareto(args) => pareto::run(&args, out),
        Command::Render(args) => render::run(&args, out),
        Command::Mesh(args) => mesh::run(&args, out),
        Command::Scene(args) => scene::run(&args, out),
        Command::Specialise(args) => specialise::run(&args, out),
        Command::Shard(args) => shard::run(&args, out),
        Command::Presets(args) => presets::run(&args, out),
        Command::Completions(args) => completions::run(&args, Cli::command(), out),
        Command::Man(args) => man::run(&args, Cli::command(), out),
    }
}

/// The error and its causes. Many messages end with their cause; it is not said twice.
fn message(error: &anyhow::Error) -> String {
    error.chain().map(ToString::to_string).fold(String::new(), |said, cause| {
        if said.is_empty() {
            cause
        } else if said.contains(&cause) {
            said
        } else {
            format!("{said}: {cause}")
        }
    })
}
