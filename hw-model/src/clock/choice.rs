//! The fewest ranks of registers that reach a clock.

use thiserror::Error;

use crate::datapath::Datapath;
use crate::handshake::{Handshake, ReadySlice};
use crate::pipelining::Pipelining;

use super::delays::Delays;
use super::paths::{Path, longest, paths};

/// Ranks that a data path can have, and the quotient bits of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ranks {
    /// The ranks beyond the least, with a register slice or none.
    pub pipelining: Pipelining,
    /// Quotient bits that the divider finds in a clock cycle.
    pub quotient_bits: u32,
}

/// No ranks reach the clock.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "{wanted} MHz cannot be reached on {device}: ask for {} or less. What limits is {}, with {:.1} ns",
    greatest.mhz().floor(), greatest.words(), greatest.ns
)]
pub struct Unreached {
    /// The clock that was asked for, in MHz.
    pub wanted: f64,
    /// The device.
    pub device: String,
    /// The longest path where ranks stand wherever they shorten one.
    pub greatest: Path,
}

/// The data path with the fewest ranks with which no path is longer than the clock allows, and of these the ones with
/// the fewest bits of registers. `most_quotient_bits` are found in a cycle at the most.
///
/// # Errors
/// The longest path that is left with as many ranks as there can be, where that is too long.
pub fn fewest(datapath: &Datapath, most_quotient_bits: u32, delays: &Delays, mhz: f64) -> Result<Datapath, Path> {
    let mut best: Option<((usize, u64), Datapath)> = None;
    let mut shortest: Option<Path> = None;
    for ranks in all(datapath, most_quotient_bits) {
        let Ok(candidate) = datapath.with_ranks(&ranks) else { continue };
        let Some(path) = longest(paths(&candidate, delays)) else { continue };
        if path.mhz() >= mhz {
            let cost = (candidate.latency(), candidate.register_bits());
            if best.as_ref().is_none_or(|(known, _)| cost < *known) {
                best = Some((cost, candidate));
            }
        }
        if shortest.as_ref().is_none_or(|known| path.ns < known.ns) {
            shortest = Some(path);
        }
    }
    best.map(|(_, datapath)| datapath).ok_or_else(|| shortest.unwrap_or_default())
}

/// Every choice of ranks.
fn all(datapath: &Datapath, most_quotient_bits: u32) -> impl Iterator<Item = Ranks> {
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
