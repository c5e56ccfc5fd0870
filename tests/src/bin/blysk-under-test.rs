//! The `blysk` command once more, as a binary of this package.
//!
//! Cargo builds the binaries of a package before its integration tests, but not those of its
//! dependencies: a test that looked for `target/debug/blysk` could be testing last week's command.

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
