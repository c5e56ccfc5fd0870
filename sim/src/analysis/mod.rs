//! What can be said of a configuration: approximation, hardware errors.

pub mod approximation;
pub mod error_report;
pub mod sweep;
