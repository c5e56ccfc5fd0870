//! Shared helpers of the integration tests.

pub mod answers;
pub mod bench;
pub mod cli;
pub mod comparison;
pub mod configurations;
pub mod fuzz;
pub mod naive;
pub mod reference;
pub mod rtl;
pub mod save_file;
pub mod waves;
