//! What can be said of a method and of a configuration: approximation, hardware errors, searches for better hardware,
//! work against precision, the claims of \[Rom\], stiff and extreme cases; and the files and figures that say it.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

pub mod approximation;
pub mod budget;
pub mod claims;
pub mod error_report;
pub mod hardware_claim;
pub mod hardware_cost;
pub mod pareto;
pub mod pieces;
mod reference_product;
pub mod refine;
#[cfg(feature = "figures")]
pub mod report;
pub mod sizing;
pub mod source;
pub mod stability;
pub mod sweep;
