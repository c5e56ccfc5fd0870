//! What can be said of a configuration: approximation, hardware errors.

pub mod approximation;
pub mod sweep;
