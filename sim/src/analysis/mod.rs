//! What can be said of a method and of a configuration: approximation, hardware errors, the claims of \[Rom\].

pub mod approximation;
pub mod claims;
pub mod error_report;
pub mod sweep;
