//! Every x of every exponent through the verilated RTL, against the golden model.
//!
//! What is kept of a row is two counts and the first x that differs: sums of integers.

use std::ops::Range;
use std::path::PathBuf;

use analysis::pieces::Pieces;
use hw_model::design::Design;
use vectors::checksum::Checksum;

use super::digest::digest;
use super::rows::{check_rows, fits};
use crate::error::ShardError;
use crate::job::{JobError, RtlWork};
use crate::kind::Kind;
use crate::merged::{Merged, RtlReport, RtlRow};
use crate::part::{Part, RtlPart};
use crate::place::Place;
use crate::rtl::compare;

/// x of a piece: tenths of a second in a simulator, so that starting the simulator takes no time to speak of.
const LENGTH: i64 = 1 << 21;
/// Pieces of a thread between two checkpoints, at least.
const STEP: u64 = 2;

/// The RTL of a configuration beside the model.
pub(super) struct Rtl {
    design: Design,
    pieces: Pieces,
    directory: PathBuf,
    program: PathBuf,
    built: Checksum,
}

impl Rtl {
    pub(super) fn new(work: &RtlWork, place: Place<'_>) -> Result<Self, ShardError> {
        let design = work.configuration.design()?;
        if !design.config().domain.is_empty() {
            return Err(JobError::Range {
                field: "rtl.configuration",
                value: "hardware with a domain, which answers below it with a flag that this comparison does not know"
                    .to_owned(),
                wanted: "use a configuration without a domain",
            }
            .into());
        }
        let built = work.program.clone().ok_or(ShardError::NotBuilt)?;
        let (directory, program) = (place.rtl(), place.program());
        Ok(Self { pieces: Pieces::new(&design, LENGTH), design, directory, program, built })
    }
}

impl Kind for Rtl {
    fn pieces(&self) -> u64 {
        self.pieces.count()
    }

    fn step(&self) -> u64 {
        STEP
    }

    fn fits(&self, pieces: u64) -> Result<(), ShardError> {
        fits(&self.design, &self.pieces, pieces)
    }

    /// The harness is the one that was built for the plan.
    fn ready(&self) -> Result<(), ShardError> {
        let found = digest(&self.program)?;
        if found == self.built {
            return Ok(());
        }
        Err(ShardError::OtherProgram { path: self.program.clone(), wanted: self.built.sha256.clone() })
    }

    fn measure(&self, piece: u64) -> Result<Part, ShardError> {
        let piece = self.pieces.at(piece);
        let counts = compare(&self.program, &self.directory, self.design.datapath(), piece)?;
        Ok(Part::Rtl(RtlPart { address: piece.address, counts }))
    }

    fn join(&self, parts: &mut Vec<Part>, next: Part) {
        if let (Some(Part::Rtl(last)), Part::Rtl(next)) = (parts.last_mut(), &next)
            && last.address == next.address
        {
            last.counts = last.counts.and(next.counts);
            return;
        }
        parts.push(next);
    }

    fn check(&self, pieces: &Range<u64>, parts: &[Part]) -> Result<(), String> {
        check_rows(&self.pieces, pieces, parts, |part, (first, last)| {
            let Part::Rtl(RtlPart { address, counts }) = part else { return None };
            let place = counts.first_different;
            let wrong = match place {
                _ if counts.different > counts.compared => Some("more differences than results".to_owned()),
                Some(x) if !(first..=last).contains(&x) => {
                    Some(format!("the first difference is at x = {x}; the pieces have x from {first} to {last}"))
                }
                _ if place.is_some() != (counts.different > 0) => {
                    Some(format!("{} differences, and the first of them at {place:?}", counts.different))
                }
                _ => None,
            };
            Some((*address, counts.compared, wrong))
        })
    }

    fn merged(&self, parts: Vec<Part>) -> Result<Merged, ShardError> {
        let exponents = self.design.rom().exponents();
        let row = |(part, n): (Part, f64)| match part {
            Part::Rtl(RtlPart { counts, .. }) => Ok(RtlRow {
                n,
                compared: counts.compared,
                different: counts.different,
                first_different: counts.first_different,
            }),
            _ => Err(ShardError::Kind),
        };
        let rows = parts.into_iter().zip(exponents.iter()).map(row).collect::<Result<Vec<_>, _>>()?;
        Ok(Merged::Rtl(RtlReport::new(self.design.config().name.clone(), rows)))
    }
}
