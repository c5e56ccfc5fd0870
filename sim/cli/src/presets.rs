//! `blysk presets`: what there is to start from.

use std::io::Write;

use clap::{Args as ClapArgs, Subcommand};
use hw_model::design::Design;
use hw_model::presets;

use super::configuration::find_preset;
use super::out::{Out, Outcome};
use super::table::{Cell, Format, Rows};
use analysis::hardware_cost::multipliers;

/// List the presets, or print one as a starting point for a configuration.
///
/// A command that takes --preset NAME also takes --config FILE, with a file that began as one of these.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk presets\n          blysk presets show paper > mine.json")]
pub(super) struct Args {
    #[command(subcommand)]
    command: Option<Command>,
    /// How to print the list.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Subcommand)]
enum Command {
    /// List the presets (the default).
    List {
        /// How to print the list.
        #[arg(long, value_enum, default_value_t)]
        format: Format,
    },
    /// Print a preset as JSON.
    Show {
        /// The name of the preset.
        name: String,
    },
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    match &args.command {
        None => list(args.format, out)?,
        Some(Command::List { format }) => list(*format, out)?,
        Some(Command::Show { name }) => write!(out, "{}", find_preset(name)?.json)?,
    }
    Ok(Outcome::Good)
}

fn list(format: Format, out: &mut Out) -> anyhow::Result<()> {
    let mut rows = Rows::new(&["preset", "latency", "rom_bits", "multipliers", "what it is"]);
    for preset in presets::ALL {
        let design = Design::new(preset.config()?)?;
        rows.push(vec![
            Cell::from(preset.name),
            Cell::Integer(design.datapath().latency() as i64),
            Cell::Integer(design.rom().bits() as i64),
            Cell::from(sizes(&design)),
            Cell::from(design.config().description.clone()),
        ]);
    }
    rows.print(out, format, 6)
}

/// The operand widths of every multiplier.
fn sizes(design: &Design) -> String {
    let sizes: Vec<String> = multipliers(design).iter().map(ToString::to_string).collect();
    sizes.join(" ")
}
