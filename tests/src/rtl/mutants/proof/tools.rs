//! Runs Yosys, and ABC inside it.

use std::path::Path;
use std::process::{Command, Output};

use crate::rtl::{Failure, failed};

/// What ABC says of two netlists.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Comparison {
    /// Their outputs are the same for all inputs.
    Same,
    /// They differ; for these inputs, by name.
    Differ(Vec<(String, bool)>),
    /// Not decided in time.
    Open,
}

fn run(command: &mut Command) -> Result<Output, Failure> {
    command
        .output()
        .map_err(|error| Failure(format!("cannot run {}: {error}", command.get_program().to_string_lossy())))
}

/// Runs Yosys in a directory.
///
/// # Errors
/// With what it says when it fails.
pub fn yosys(directory: &Path, script: &str) -> Result<(), Failure> {
    let output = run(Command::new("yosys").args(["-q", "-p", script]).current_dir(directory))?;
    if output.status.success() {
        return Ok(());
    }
    failed(String::from_utf8_lossy(&[output.stdout, output.stderr].concat()))
}

/// Compares two netlists of And gates, inputs and outputs by name: ABC's combinational equivalence check.
///
/// # Errors
/// When ABC cannot be run, or gives no verdict for another reason than time.
pub fn compare(directory: &Path, files: [&str; 2], seconds: u32) -> Result<Comparison, Failure> {
    /// What `timeout` exits with when the time was up.
    const TIME_WAS_UP: i32 = 124;
    let check = format!("cec -C 1000000 -T {seconds} {} {}", files[0], files[1]);
    let limit = seconds.to_string();
    let output = run(Command::new("timeout").args([&limit, "yosys-abc", "-c", &check]).current_dir(directory))?;
    if output.status.code() == Some(TIME_WAS_UP) {
        return Ok(Comparison::Open);
    }
    verdict(&String::from_utf8_lossy(&output.stdout))
}

fn verdict(text: &str) -> Result<Comparison, Failure> {
    if text.contains("Networks are equivalent") {
        return Ok(Comparison::Same);
    }
    if text.contains("NOT EQUIVALENT") || text.contains("Verification failed") {
        let pattern = text.lines().find_map(|line| line.strip_prefix("Input pattern:"));
        let inputs = pattern.unwrap_or_default().split_whitespace().filter_map(|input| {
            let (name, value) = input.split_once('=')?;
            Some((name.to_owned(), value == "1"))
        });
        return Ok(Comparison::Differ(inputs.collect()));
    }
    if text.contains("UNDECIDED") || text.contains("undecided") {
        return Ok(Comparison::Open);
    }
    failed(format!("ABC gives no verdict: {text}"))
}

/// The value of an input of several bits.
#[must_use]
pub fn value(inputs: &[(String, bool)], name: &str) -> u64 {
    let bits = inputs.iter().filter_map(|(input, is_one)| {
        let place = input.strip_prefix(name)?.strip_prefix('[')?.strip_suffix(']')?;
        Some(u64::from(*is_one) << place.parse::<u32>().ok()?)
    });
    bits.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_are_read_as_abc_writes_them() {
        let same = "Networks are equivalent after structural hashing.  Time =     0.00 sec\n";
        assert_eq!(verdict(same).unwrap(), Comparison::Same);
        let differ = "Verification failed for at least 1 outputs:  intensity_o[0]\n\
                      Output intensity_o[0]: Value in Network1 = 1. Value in Network2 = 0.\n\
                      Input pattern:  x_i[1]=1 address_i[8]=0 x_i[4]=1 address_i[2]=1\n";
        let Comparison::Differ(inputs) = verdict(differ).unwrap() else { panic!("{differ}") };
        assert_eq!((value(&inputs, "x_i"), value(&inputs, "address_i")), (0b1_0010, 0b100));
        assert_eq!(verdict("Networks are UNDECIDED.  Time = 1 sec\n").unwrap(), Comparison::Open);
        assert!(verdict("Cannot read the file\n").is_err());
    }
}
