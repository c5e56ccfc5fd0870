//! `blysk serve`: the golden model in a browser.

use std::io::{IsTerminal, Write};
use std::process::{Command, Stdio};

use clap::{Args as ClapArgs, ValueEnum};
use serve::{Limits, Server, Start};

use super::bar;
use super::configuration::{MaybeConfiguration, Stated};
use super::out::{Out, Outcome};
use super::signals;

/// Show the golden model in a browser: every register of a highlight, error curves, other widths, the clock by hand.
///
/// The command prints the address of a page on this machine (127.0.0.1 alone) and answers it until it is stopped with
/// Ctrl-C. On the page you choose a preset or paste a configuration, move n and x, and see every register of every rank
/// as bits, the error against x^n, and what another width would do, with its RTL as a zip; or you drive valid and ready
/// and watch the ranks fill and stall. The model answers every number.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk serve\n          \
                        blysk serve --preset compact --port 8000\n          \
                        blysk serve --config mine.json --port 0 --open no")]
pub(super) struct Args {
    #[command(flatten)]
    configuration: MaybeConfiguration,
    /// The port; 0 is a free one.
    #[arg(long, value_name = "PORT", default_value_t = 8064)]
    port: u16,
    /// Whether to open the page in this desktop's browser; where nothing is said, if standard output is a terminal.
    #[arg(long, value_enum)]
    open: Option<Open>,
}

/// Whether the page is opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Open {
    /// By the program that opens addresses.
    Yes,
    /// By you.
    No,
}

/// The preset that the page opens with unless it is told: what the paper describes.
const FIRST: &str = "paper";

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let start = match args.configuration.stated()? {
        Some(Stated::Preset(name)) => Start::Preset(name),
        Some(Stated::Text(text)) => Start::Text(text),
        None => Start::Preset(FIRST.to_owned()),
    };
    let server = Server::bind(args.port, start, Limits::default())?;
    let address = server.address();
    // From here on a signal ends the server, and the server the command.
    let signals = signals::handed_over();
    bar::end();
    writeln!(out, "{address}  (Ctrl-C stops the server)")?;
    out.flush()?;
    if args.open.map_or_else(|| std::io::stdout().is_terminal(), |open| open == Open::Yes) {
        open(&address);
    }
    let signal = server.run(move || signals.recv().ok())?;
    Ok(signal.map_or(Outcome::Good, Outcome::Stopped))
}

/// Opens an address in the browser. Where there is none, the address that was printed does as well.
fn open(address: &str) {
    let program = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    let mut opener = Command::new(program);
    let _ = opener.arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
}
