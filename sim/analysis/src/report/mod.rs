//! The files and figures of a report.

pub mod certificate_figure;
pub mod claims;
mod figures;
pub mod files;
pub mod pareto;
pub mod pareto_figures;
pub mod stability;
pub mod written;

pub use written::FilesError;
