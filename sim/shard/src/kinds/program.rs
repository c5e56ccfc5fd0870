//! Runs of a program of one's own, which the plan knows by its digest: mutants, or whatever else prints its findings.
//!
//! The program must print the same for the same arguments, whatever the machine.

use std::ops::Range;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use vectors::checksum::Checksum;

use super::digest::digest;
use super::rows::count;
use crate::error::ShardError;
use crate::job::ProgramWork;
use crate::kind::Kind;
use crate::merged::{Merged, ProgramRow};
use crate::part::{MOST_PRINTED, Part, Printed};

/// The runs of a program.
pub(super) struct Program {
    path: PathBuf,
    built: Checksum,
    runs: Vec<Vec<String>>,
}

impl Program {
    pub(super) fn new(work: &ProgramWork) -> Result<Self, ShardError> {
        let built = work.digest.clone().ok_or(ShardError::NotBuilt)?;
        Ok(Self { path: work.path.clone(), built, runs: work.runs.clone() })
    }
}

impl Kind for Program {
    fn pieces(&self) -> u64 {
        self.runs.len() as u64
    }

    fn step(&self) -> u64 {
        1
    }

    fn ready(&self) -> Result<(), ShardError> {
        let found = digest(&self.path)?;
        if found == self.built {
            return Ok(());
        }
        Err(ShardError::OtherProgram { path: self.path.clone(), wanted: self.built.sha256.clone() })
    }

    fn measure(&self, piece: u64) -> Result<Part, ShardError> {
        let arguments = &self.runs[piece as usize];
        let failed =
            |what: String| ShardError::Program { path: self.path.clone(), arguments: arguments.join(" "), what };
        let output = Command::new(&self.path)
            .args(arguments)
            .stdin(Stdio::null())
            .stderr(Stdio::inherit())
            .output()
            .map_err(|error| failed(format!("cannot be run: {error}")))?;
        let status = output.status.code().ok_or_else(|| failed(format!("was killed ({})", output.status)))?;
        let text = String::from_utf8(output.stdout).map_err(|_| failed("printed what is not UTF-8".to_owned()))?;
        if text.len() > MOST_PRINTED {
            return Err(failed(format!("printed {} bytes, and {MOST_PRINTED} are kept", text.len())));
        }
        Ok(Part::Printed(Printed { status, text }))
    }

    fn check(&self, pieces: &Range<u64>, parts: &[Part]) -> Result<(), String> {
        count(pieces, parts)?;
        for part in parts {
            match part {
                Part::Printed(Printed { status, text }) if (0..=255).contains(status) && text.len() <= MOST_PRINTED => {
                }
                Part::Printed(Printed { status, .. }) => {
                    return Err(format!("status {status}: it is 0 to 255, with at most {MOST_PRINTED} bytes printed"));
                }
                _ => return Err("a part is not of the kind of the job".to_owned()),
            }
        }
        Ok(())
    }

    fn merged(&self, parts: Vec<Part>) -> Result<Merged, ShardError> {
        let row = |(part, arguments): (Part, &Vec<String>)| match part {
            Part::Printed(printed) => Ok(ProgramRow { arguments: arguments.clone(), printed }),
            _ => Err(ShardError::Kind),
        };
        Ok(Merged::Printed(parts.into_iter().zip(&self.runs).map(row).collect::<Result<_, _>>()?))
    }
}
