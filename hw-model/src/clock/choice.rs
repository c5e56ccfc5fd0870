//! The fewest ranks of registers that reach a clock.

use thiserror::Error;

use crate::datapath::Datapath;
use crate::handshake::{Handshake, ReadySlice};
use crate::pipelining::Pipelining;

use super::delays::Delays;
use super::paths::{Path, longest, paths};

/// Ranks that a data path can have, and the quotient bits of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Ranks {
    /// The ranks beyond the least, with a register slice or none.
    pipelining: Pipelining,
    /// Quotient bits that the divider finds in a clock cycle.
    quotient_bits: u32,
}

/// Why ranks do not follow from a clock.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ClockError {
    /// There is no such table of delays.
    #[error("{0}")]
    Table(String),
    /// No ranks reach the clock.
    #[error(
        "{wanted} MHz cannot be reached on {device}: ask for {} or less. What limits is {}, with {:.1} ns",
        // Rounded down, so that it can be asked for.
        (greatest.mhz() * 10.0).floor() / 10.0, greatest.words(), greatest.ns
    )]
    Unreached {
        /// The clock that was asked for, in MHz.
        wanted: f64,
        /// The device.
        device: String,
        /// The longest path where ranks stand wherever they shorten one.
        greatest: Path,
    },
}

/// Gives the data path the fewest ranks with which no path is longer than the clock allows, and of these the ones with
/// the fewest bits of registers. `most_quotient_bits` are found in a cycle at the most.
///
/// # Errors
/// The longest path that is left with as many ranks as there can be, where that is too long.
pub(crate) fn fewest(datapath: &mut Datapath, most_quotient_bits: u32, delays: &Delays, mhz: f64) -> Result<(), Path> {
    let mut best: Option<((usize, u64), Ranks)> = None;
    let mut shortest: Option<Path> = None;
    for ranks in all(datapath, most_quotient_bits) {
        if datapath.set_ranks(ranks.pipelining, ranks.quotient_bits).is_err() {
            continue;
        }
        let Some(path) = longest(paths(datapath, delays)) else { continue };
        if path.mhz() >= mhz {
            let cost = (datapath.latency(), datapath.register_bits());
            if best.is_none_or(|(known, _)| cost < known) {
                best = Some((cost, ranks));
            }
        }
        if shortest.as_ref().is_none_or(|known| path.ns < known.ns) {
            shortest = Some(path);
        }
    }
    let chosen = best.filter(|(_, ranks)| datapath.set_ranks(ranks.pipelining, ranks.quotient_bits).is_ok());
    chosen.map(drop).ok_or_else(|| shortest.unwrap_or_default())
}

/// Every choice of ranks.
fn all(datapath: &Datapath, most_quotient_bits: u32) -> impl Iterator<Item = Ranks> + use<> {
    let flags = [false, true];
    // Where nothing collapses, no ready leads through the ranks.
    let slices: &[_] = match datapath.control().handshake {
        Handshake::ValidReady => &[None, Some(ReadySlice::Output)],
        Handshake::Enable | Handshake::None => &[None],
    };
    let most = if datapath.divider().is_some() { most_quotient_bits } else { 1 };
    let of_lines = flags.into_iter().flat_map(move |operands| {
        (0..=2).flat_map(move |product| flags.into_iter().map(move |sum| (operands, product, sum)))
    });
    let of_head = move || flags.into_iter().flat_map(move |rom| (0..=1).map(move |front_end| (rom, front_end)));
    of_lines.flat_map(move |(operands, product, sum)| {
        of_head().flat_map(move |(rom, front_end)| {
            slices.iter().flat_map(move |&ready_slice| {
                (1..=most).map(move |quotient_bits| Ranks {
                    pipelining: Pipelining { rom, front_end, operands, product, sum, ready_slice },
                    quotient_bits,
                })
            })
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::Device;
    use crate::design::Design;

    /// No choice with less latency, or as much and fewer bits, reaches the clock: looked at one by one.
    #[test]
    fn nothing_that_reaches_the_clock_is_less() {
        for (preset, device, mhz) in [
            ("compact", "ecp5", 90.0),
            ("precise", "ecp5", 110.0),
            ("schlick", "ecp5", 90.0),
            ("compact", "up5k", 30.0),
        ] {
            let delays = Device::Named(device.to_owned()).delays().unwrap();
            let design = Design::preset(preset).unwrap();
            let mut chosen = design.datapath().clone();
            fewest(&mut chosen, 2, &delays, mhz).unwrap();
            let fast = |datapath: &Datapath| longest(paths(datapath, &delays)).unwrap().mhz() >= mhz;
            assert!(fast(&chosen), "{preset}");
            assert!(chosen.latency() > design.datapath().latency(), "{preset} has more ranks than the least");
            let cost = |datapath: &Datapath| (datapath.latency(), datapath.register_bits());
            let mut other = design.datapath().clone();
            let mut looked_at = 0;
            for ranks in all(design.datapath(), 2) {
                if other.set_ranks(ranks.pipelining, ranks.quotient_bits).is_ok() {
                    assert!(!fast(&other) || cost(&other) >= cost(&chosen), "{preset}: {ranks:?}");
                    looked_at += 1;
                }
            }
            assert!(looked_at > 50, "{preset}");
        }
    }

    #[test]
    fn what_limits_is_named() {
        let delays = Device::Named("ecp5".to_owned()).delays().unwrap();
        let mut datapath = Design::preset("compact").unwrap().datapath().clone();
        let limit = fewest(&mut datapath, 2, &delays, 1000.0).unwrap_err();
        // As fast as it says, and no faster.
        assert!(fewest(&mut datapath, 2, &delays, limit.mhz() * 0.999).is_ok());
        assert!(fewest(&mut datapath, 2, &delays, limit.mhz() * 1.001).is_err());
        let device = "ecp5".to_owned();
        let said = ClockError::Unreached { wanted: 1000.0, device, greatest: limit.clone() }.to_string();
        assert!(said.contains(&limit.words()) && !limit.parts.is_empty(), "{said}");
    }
}
