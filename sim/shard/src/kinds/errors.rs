//! Error statistics of a configuration, for a report or for a certificate.
//!
//! What is kept of a row is the greatest of each error with the first x where it is. The greatest of numbers, and the
//! first of equal ones, is the same however the numbers were grouped: no sum of real numbers is taken anywhere.

use std::ops::Range;

use analysis::error_report::{Options, pieces, report_of, sweep_piece};
use analysis::hardware_claim::{OPTIONS, claim_of};
use analysis::pieces::Pieces;
use analysis::sweep::{Peak, RowErrors};
use bounds::certify::certificate::{Certificate, Claim};
use bounds::certify::hardware::points;
use hw_model::design::Design;

use super::rows::{check_rows, fits};
use crate::error::ShardError;
use crate::kind::Kind;
use crate::merged::Merged;
use crate::part::{Part, RowPart};

/// Pieces of a thread between two checkpoints, at least: tenths of a second.
const STEP: u64 = 16;

/// No error is greater, as a fraction of full intensity: hardware, ROM and x^n lie in [0, 1], and the rational tail
/// of a real row may be a little above.
const GREATEST_ERROR: f64 = 2.0;

/// What the errors are measured for.
pub(super) enum Purpose {
    /// A report with a bound.
    Report(Options),
    /// A certificate of the configuration.
    Certificate,
}

/// The errors of every representable x of every row.
pub(super) struct Sweep {
    design: Design,
    pieces: Pieces,
    purpose: Purpose,
}

impl Sweep {
    pub(super) fn new(design: Design, purpose: Purpose) -> Result<Self, ShardError> {
        if matches!(purpose, Purpose::Certificate) {
            points(&design)?;
        }
        Ok(Self { pieces: pieces(&design), design, purpose })
    }
}

impl Kind for Sweep {
    fn pieces(&self) -> u64 {
        self.pieces.count()
    }

    fn step(&self) -> u64 {
        STEP
    }

    fn fits(&self, pieces: u64) -> Result<(), ShardError> {
        fits(&self.design, &self.pieces, pieces)
    }

    fn measure(&self, piece: u64) -> Result<Part, ShardError> {
        let piece = self.pieces.at(piece);
        Ok(Part::Errors(RowPart { address: piece.address, errors: sweep_piece(&self.design, piece) }))
    }

    fn join(&self, parts: &mut Vec<Part>, next: Part) {
        if let (Some(Part::Errors(last)), Part::Errors(next)) = (parts.last_mut(), &next)
            && last.address == next.address
        {
            last.errors = last.errors.and(next.errors);
            return;
        }
        parts.push(next);
    }

    fn check(&self, pieces: &Range<u64>, parts: &[Part]) -> Result<(), String> {
        check_rows(&self.pieces, pieces, parts, |part, (first, last)| {
            let Part::Errors(RowPart { address, errors }) = part else { return None };
            Some((*address, errors.samples, check_peaks(errors, first, last).err()))
        })
    }

    fn merged(&self, parts: Vec<Part>) -> Result<Merged, ShardError> {
        let rows: Vec<RowErrors> = parts
            .into_iter()
            .map(|part| match part {
                Part::Errors(part) => Ok(part.errors),
                _ => Err(ShardError::Kind),
            })
            .collect::<Result<_, _>>()?;
        let design = &self.design;
        match self.purpose {
            Purpose::Report(options) => {
                let report = report_of(design, options, &rows)?;
                Ok(Merged::Errors { design: Box::new(design.clone()), report })
            }
            Purpose::Certificate => {
                let claim = claim_of(design, &report_of(design, OPTIONS, &rows)?)?;
                Ok(Merged::Certificate(Box::new(Certificate::new(Claim::Hardware(Box::new(claim))))))
            }
        }
    }
}

/// Errors in their range, at an x of the part; an error of 0 is nowhere.
fn check_peaks(errors: &RowErrors, first: i64, last: i64) -> Result<(), String> {
    let peaks = [
        ("coefficient", errors.coefficient),
        ("datapath", errors.datapath),
        ("implementation", errors.implementation),
        ("epicentre", errors.epicentre),
        ("full_range", errors.full_range),
    ];
    for (name, Peak { error, x }) in peaks {
        if !(0.0..=GREATEST_ERROR).contains(&error) {
            return Err(format!("the {name} error is {error}; errors are 0 to {GREATEST_ERROR}"));
        }
        let somewhere = if error == 0.0 { x == 0 } else { (first..=last).contains(&x) };
        if !somewhere {
            return Err(format!("the {name} error is at x = {x}; the pieces have x from {first} to {last}"));
        }
    }
    Ok(())
}
