//! What the command says to mistakes: status 2, a message that names what is wrong and what would be
//! right, no result on standard output, no panic, and the directory as it was.
//!
//! `Bench::refused` checks all of that; here are the mistakes.

mod answers;
mod configurations;
mod names;
mod options;
mod places;
mod scenes;
mod searches;
mod sizes;
mod stimulus;
mod text;

use blysk_tests::cli::SMALL;

/// The small configuration with one piece of its text replaced.
fn edited(from: &str, to: &str) -> String {
    let edited = SMALL.replace(from, to);
    assert_ne!(edited, SMALL, "{from:?} is not in the configuration");
    edited
}
