//! `blysk clock`: what lies between the ranks of a pipeline on a device, and the clock that it allows.

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use clap::Args as ClapArgs;
use hw_model::clock::{Clock, Delays, Device, longest, paths};
use hw_model::design::Design;
use hw_model::pipelining::Pipelining;
use vectors::configuration_file;

use super::configuration::Configuration;
use super::out::{Out, Outcome};
use super::table::{Cell, Format, Rows, write_folded};

/// Estimate what each rank of registers takes on a device, and the clock that the longest path allows.
///
/// With --mhz it looks for the fewest ranks that reach that clock, and prints them as a configuration states them.
/// The delays are fitted to placements; docs/SYNTHESIS.md has estimates beside measured clocks.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk clock --preset compact --device ecp5 --mhz 120")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: Configuration,
    /// The device: ecp5, up5k, or a JSON file with its delays in nanoseconds.
    #[arg(long, value_name = "NAME|FILE", default_value = "ecp5")]
    device: String,
    /// The clock to reach, in MHz.
    #[arg(long, value_name = "MHZ", allow_negative_numbers = true)]
    mhz: Option<f64>,
    /// How to print the paths.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let device = device(&args.device)?;
    let delays = delays(&args.device)?;
    let mut design = args.configuration.design()?;
    if let Some(mhz) = args.mhz {
        let mut config = design.config().clone();
        (config.pipelining, config.clock) = (Pipelining::default(), Some(Clock { mhz, device }));
        config.check().context("--mhz")?;
        design = Design::new(config)?;
    }
    let datapath = design.datapath();
    let found = paths(datapath, &delays);
    let mut rows = Rows::new(&["through", "ns", "MHz"]);
    for path in &found {
        rows.push(vec![Cell::from(path.words()), Cell::Real(path.ns), Cell::Real(path.mhz())]);
    }
    let Some(longest) = longest(found) else { return Ok(Outcome::Good) };
    if args.format == Format::Table {
        let words = format!(
            "{} on {}: about {:.1} MHz, latency {} cycles. The longest path leads through {}.",
            design.config().name,
            args.device,
            longest.mhz(),
            datapath.latency(),
            longest.words()
        );
        write_folded(out, &words)?;
        if args.mhz.is_some() {
            let stated = serde_json::to_string(datapath.pipelining())?;
            writeln!(out, "\"pipelining\": {stated}")?;
            if let Some(divider) = datapath.divider() {
                writeln!(out, "\"quotient_bits_per_stage\": {}", divider.digits_per_stage)?;
            }
        }
        writeln!(out)?;
    }
    rows.print(out, args.format, 4)?;
    Ok(Outcome::Good)
}

/// What the parts of a device take: of `--device`, checked.
pub(super) fn delays(text: &str) -> anyhow::Result<Delays> {
    let delays = device(text)?.delays().map_err(anyhow::Error::msg).context("--device")?;
    delays.check().map_err(anyhow::Error::msg).with_context(|| format!("--device {text}"))?;
    Ok(delays)
}

/// A table that comes with Blysk, or one in a file.
pub(super) fn device(text: &str) -> anyhow::Result<Device> {
    Ok(match delays_file(text) {
        Some(path) => Device::Table(configuration_file::delays(&path)?),
        None => Device::Named(text.to_owned()),
    })
}

/// The file of a table of delays, where `--device` names one and not a table that comes with Blysk.
pub(super) fn delays_file(text: &str) -> Option<PathBuf> {
    let path = PathBuf::from(text);
    (Device::names().all(|name| name != text) && path.exists()).then_some(path)
}
