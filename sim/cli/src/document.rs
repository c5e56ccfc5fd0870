//! `blysk document`: the hardware designers' reference.

use std::io::Write;
use std::path::PathBuf;

use clap::Args as ClapArgs;

use super::configuration::Configurations;
use super::out::{Out, Outcome};
use super::output;
use document::{COMMON, Form, Subject, stage};

/// Write the hardware designers' reference: ports, ROM map, registers, lines, timing.
///
/// Each configuration gets a page in Markdown with a block diagram and timing diagrams as SVG, good
/// enough to build the pipeline from; README.md says what all have in common. The same command writes
/// the same bytes. With --html each configuration gets all of that as one page to look at, too: NAME.html.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk document --preset compact --out hardware\n          \
                        blysk document --config mine.json --out hardware\n          \
                        blysk document --all-presets --out docs/hardware")]
pub(super) struct Args {
    #[command(flatten)]
    subject: Configurations,
    /// Write NAME.html too: the reference with its diagrams in one file, tables that sort, a diagram that can be asked.
    #[arg(long)]
    html: bool,
    /// The directory; it is made where it does not exist.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let designs = args.subject.designs()?;
    let subjects: Vec<Subject<'_>> = designs.iter().map(|(design, option)| Subject { design, option }).collect();
    // The place is left out: the files are the same wherever they stand.
    let form = if args.html { Form::Html } else { Form::Markdown };
    let command = format!("blysk document {}{}", args.subject.option(), if args.html { " --html" } else { "" });
    let mut set = output::set(&args.out, "document", &args.subject.files(), [COMMON])?;
    let files = stage(&subjects, form, &command, &mut set)?;
    set.commit()?;
    let place = args.out.display();
    writeln!(out, "{place}: {files} files; begin with {COMMON}")?;
    Ok(Outcome::Good)
}
