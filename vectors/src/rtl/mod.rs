//! The hardware as files: RTL, package, testbench, and what runs them.

mod package;

pub use package::package;
