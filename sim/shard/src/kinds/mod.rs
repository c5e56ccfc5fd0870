//! The kinds of work that can be cut.
//!
//! | kind | a piece is | merged is |
//! |---|---|---|
//! | errors | 2^18 consecutive x of one exponent | the files of `blysk report --exhaustive` |
//! | certify, hardware | the same | the certificate of `blysk certify --config` |
//! | rtl | 2^21 consecutive x of one exponent | counts of results and differences, exponent by exponent |
//! | program | one run | a table, and what each run prints |
//! | certify, exponents | one method at one exponent in one region | the certificate of `blysk certify --exponents` |
//! | certify, every exponent | one method | the certificate of `blysk certify --all-real-n` |

mod claims;
mod digest;
mod errors;
mod program;
mod rows;
mod rtl;

use crate::error::ShardError;
use crate::job::{CertifyWork, ErrorWork, Job, Work};
use crate::kind::Kind;
use crate::place::Place;
use claims::{AtExponents, EveryExponent};
pub(crate) use digest::digest;
use errors::{Purpose, Sweep};
use program::Program;
use rtl::Rtl;

/// Makes the kind of a job ready, whose configurations stand in it. Programs that it runs are in the place of the plan.
///
/// # Errors
/// When no hardware can be made of its configuration, or a value is out of range.
pub fn of(job: &Job, place: Place<'_>) -> Result<Box<dyn Kind>, ShardError> {
    Ok(match &job.work {
        Work::Errors(work @ ErrorWork { configuration, .. }) => {
            Box::new(Sweep::new(configuration.design()?, Purpose::Report(work.options()))?)
        }
        Work::Program(work) => Box::new(Program::new(work)?),
        Work::Rtl(work) => Box::new(Rtl::new(work, place)?),
        Work::Certify(CertifyWork::Hardware(configuration)) => {
            Box::new(Sweep::new(configuration.design()?, Purpose::Certificate)?)
        }
        Work::Certify(CertifyWork::Exponents { methods, exponents, levels }) => {
            Box::new(AtExponents::new(methods, exponents, *levels))
        }
        Work::Certify(CertifyWork::EveryExponent { methods, levels }) => {
            Box::new(EveryExponent::new(methods, *levels)?)
        }
    })
}
