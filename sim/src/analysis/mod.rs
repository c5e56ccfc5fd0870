//! What can be said of a method and of a configuration: approximation, hardware errors, the claims of
//! \[Rom\], stiff and extreme cases.

pub mod approximation;
pub mod claims;
pub mod error_report;
pub mod hardware_claim;
pub mod pareto;
pub mod reference_product;
pub mod refine;
pub mod sizing;
pub mod stability;
pub mod sweep;
