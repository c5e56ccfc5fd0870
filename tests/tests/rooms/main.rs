//! The rooms of docs/ARCHITECTURE.md: which crate knows which, which library is named where, and no circle of files.

mod crates;
mod files;
