//! Why there is no page.

use thiserror::Error;

/// Why a page was not made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PageError {
    /// The template was not filled in.
    #[error("a page cannot be filled in: {0}")]
    Template(#[from] askama::Error),
    /// A plot has values that JSON cannot hold.
    #[error("plot \"{title}\" cannot be written into a page: {cause}")]
    Plot {
        /// The title of the chart.
        title: String,
        /// What is wrong with its values.
        cause: serde_json::Error,
    },
}
