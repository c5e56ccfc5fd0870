//! The `blysk` command: see `blysk --help`.

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
