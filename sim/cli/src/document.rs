//! `blysk document`: the hardware designers' reference.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, bail};
use clap::Args as ClapArgs;
use hw_model::design::Design;
use hw_model::names;
use hw_model::presets;

use super::configuration::{find_preset, load_config};
use super::out::{Out, Outcome};
use super::output;
use document::{COMMON, Subject, stage};

/// Write the hardware designers' reference: ports, ROM map, registers, lines, timing.
///
/// Each configuration gets a page in Markdown with a block diagram and timing diagrams as SVG, good
/// enough to build the pipeline from; README.md says what all have in common. The same command writes
/// the same bytes.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk document --preset compact --out hardware\n          \
                        blysk document --config mine.json --out hardware\n          \
                        blysk document --all-presets --out docs/hardware")]
pub(super) struct Args {
    #[command(flatten)]
    subject: Choice,
    /// The directory; it is made where it does not exist.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

#[derive(ClapArgs)]
#[group(required = true, multiple = false)]
struct Choice {
    /// A preset; `blysk presets` lists them.
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// A configuration as JSON; `blysk presets show NAME` prints one to start from.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Write a page for every preset.
    #[arg(long)]
    all_presets: bool,
}

impl Choice {
    /// Each configuration, with the option that chooses it.
    fn designs(&self) -> anyhow::Result<Vec<(Design, String)>> {
        let design = |config, origin: String| Design::new(config).with_context(|| origin);
        let preset = |preset: presets::Preset| {
            let made = design(preset.config()?, format!("preset {}", preset.name))?;
            Ok((made, format!("--preset {}", names::shell(preset.name))))
        };
        match (&self.preset, &self.config) {
            (Some(name), _) => Ok(vec![preset(find_preset(name)?)?]),
            (None, Some(path)) => {
                let shown = path.display().to_string();
                let option = format!("--config {}", names::shell(path));
                Ok(vec![(design(load_config(path)?, shown)?, option)])
            }
            (None, None) if self.all_presets => presets::ALL.into_iter().map(preset).collect(),
            // clap demands one of the three.
            (None, None) => bail!("say --preset NAME, --config FILE or --all-presets"),
        }
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let designs = args.subject.designs()?;
    let subjects: Vec<Subject<'_>> = designs.iter().map(|(design, option)| Subject { design, option }).collect();
    let chosen = match subjects.as_slice() {
        [only] if !args.subject.all_presets => only.option,
        _ => "--all-presets",
    };
    // The place is left out: the files are the same wherever they stand.
    let command = format!("blysk document {chosen}");
    let inputs: Vec<PathBuf> = args.subject.config.iter().cloned().collect();
    let mut set = output::set(&args.out, "document", &inputs, [COMMON])?;
    let files = stage(&subjects, &command, &mut set)?;
    set.commit()?;
    let place = args.out.display();
    writeln!(out, "{place}: {files} files; begin with {COMMON}")?;
    Ok(Outcome::Good)
}
