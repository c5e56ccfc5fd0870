//! `blysk completions`: what a shell offers when a command line is typed.

use std::io::Write;

use clap::{Args as ClapArgs, Command};
use clap_complete::{Shell, generate};

use super::out::{Out, Outcome};

/// Print completions of the command line for a shell.
///
/// They are made from the command itself, with every subcommand, option and value. `make install` puts those of bash,
/// fish and zsh where these look for them.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk completions bash > ~/.local/share/bash-completion/completions/blysk")]
pub(super) struct Args {
    /// The shell.
    shell: Shell,
}

pub(super) fn run(args: &Args, mut command: Command, out: &mut Out) -> anyhow::Result<Outcome> {
    // `generate` panics where its writer fails, so it gets one that cannot.
    let mut text = Vec::new();
    generate(args.shell, &mut command, "blysk", &mut text);
    out.write_all(&text)?;
    Ok(Outcome::Good)
}
