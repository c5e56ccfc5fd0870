//! What can be said of a configuration: approximation, hardware errors, stiff and extreme cases.

pub mod approximation;
pub mod error_report;
pub mod stability;
pub mod sweep;
