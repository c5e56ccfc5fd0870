//! The RTL in real simulators.

pub mod axis;
pub mod coverage;
pub mod faults;
pub mod fusesoc;
pub mod in_source;
pub mod mutants;
pub mod netlist_parts;
pub mod readers;
pub mod replay;
pub mod rom_image;
pub mod simulators;
pub mod source_text;
pub mod specialised;
pub mod two_in_one;
pub mod waves;
pub mod workspace;
pub mod wrappers;

use std::fmt;
use std::process::ExitCode;

/// A run that did not do what it must, in words.
#[derive(Debug)]
pub struct Failure(pub String);

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Failure {}

/// The exit status of a program that ended so; a failure is printed.
pub fn ended(result: Result<(), Failure>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// A failure with this text.
pub fn failed<T>(text: impl Into<String>) -> Result<T, Failure> {
    Err(Failure(text.into()))
}
