//! `blysk man`: the manual pages, made from the command itself.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args as ClapArgs, Command};
use clap_mangen::Man;

use super::out::{Out, Outcome};
use super::output;

/// Write the manual pages: blysk.1, and one for every subcommand.
///
/// They say what --help says, for `man blysk` and `man blysk-report`. `make install` puts them where man looks for
/// them; to read one from its file, `man -l man/blysk-report.1`.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk man --out man")]
pub(super) struct Args {
    /// The directory; it is made where it does not exist.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

pub(super) fn run(args: &Args, mut command: Command, out: &mut Out) -> anyhow::Result<Outcome> {
    // Without the command `help`, which repeats all others.
    command = command.disable_help_subcommand(true);
    command.build();
    let pages = pages(&command)?;
    let mut set = output::set(&args.out, "man", &[], pages.iter().map(|(name, _)| name))?;
    for (name, text) in &pages {
        set.write(name, text)?;
    }
    set.commit()?;
    writeln!(out, "{}: {} pages; begin with blysk.1", args.out.display(), pages.len())?;
    Ok(Outcome::Good)
}

/// The pages of a command and all below it, each with its file name.
fn pages(command: &Command) -> anyhow::Result<Vec<(String, Vec<u8>)>> {
    let page = Man::new(command.clone());
    let (name, mut text) = (page.get_filename(), Vec::new());
    page.render(&mut text)?;
    let mut all = vec![(name, text)];
    for below in command.get_subcommands() {
        all.extend(pages(below)?);
    }
    Ok(all)
}
