//! Files that are written whole or not at all, alone or as one set.
//!
//! **A set is committed as one.** A set is every file that one command writes into its directory, those of
//! sub-directories too. Until [`OutputSet::commit`] nothing of it is to be seen: contents are in temporary files,
//! hidden and beside the files' places (the same file system, so that a rename is atomic).
//!
//! - A directory that does not exist is built whole under a temporary name and renamed: one atomic step.
//! - In a directory that exists other people's files may stand. It cannot be exchanged as a whole without touching
//!   them, so files get their names one by one, each atomically. What vouches for the set (its *seals*: the list of
//!   its SHA-256, a manifest, a certificate) is removed before the first of them and gets its name after the last. A
//!   power cut between leaves files that nothing vouches for, and every reader refuses those.
//! - A step that fails takes the steps before it back: what was replaced is kept aside until the end. Obstacles (a
//!   directory in the place of a file, a place that must not be written to) are looked for before the first step.
//!
//! A set's list is `<command>.sha256`, one for each command, so that sets may share a directory. `sha256sum --check`
//! reads it, and so does [`check_list`].
//!
//! **A path is followed to where it leads.** Behind a link to a regular file that file is replaced, and the link
//! stays. A pipe or a character device is written through, as is standard output (`-`, or a path that leads to it).
//! Nothing else that is not a regular file is touched, nor a link that leads nowhere.
//!
//! **Nothing is left behind** by an error, an early return, a panic, or a signal that is handled with
//! [`remove_temporaries`]. What cannot be handled leaves `.blysk-` and six characters.

mod commit;
mod descriptors;
mod error;
mod list;
mod set;
mod single;
mod staging;
mod steps;
mod target;
mod temporary;

pub use error::OutputError;
pub use list::{ListError, check_list, list_name};
pub use set::{OutputFile, OutputSet};
pub use single::WholeFile;
pub use staging::{Draft, Staging};
pub use temporary::{Scratch, remove_temporaries};
