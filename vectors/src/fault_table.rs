//! `faults.csv`: every fault of the model, and the first vector that kills it.
//!
//! | column  | holds                                                            |
//! |---------|------------------------------------------------------------------|
//! | fault   | its name ([`crate::faults::Fault`])                              |
//! | outcome | `killed`, or `equivalent`: no input tells it from right hardware |
//! | vector  | the first vector that kills it, counted from 0; empty otherwise  |

use std::io::{self, Write};

use crate::faults::FaultFate;

/// Writes the table.
///
/// # Errors
/// When the writer does.
pub fn write_faults<W: Write>(out: W, verdicts: &[FaultFate]) -> io::Result<W> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record(["fault", "outcome", "vector"])?;
    for FaultFate { fault, killed_by } in verdicts {
        let vector = killed_by.map_or_else(String::new, |index| index.to_string());
        let outcome = if killed_by.is_some() { "killed" } else { "equivalent" };
        csv.write_record([fault.to_string().as_str(), outcome, vector.as_str()])?;
    }
    csv.into_inner().map_err(csv::IntoInnerError::into_error)
}
