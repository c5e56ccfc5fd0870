//! How a report becomes files: tables as CSV, all of it as JSON, charts as SVG and PNG.

use plot::{Chart, PlotError};
use serde::Serialize;
use thiserror::Error;
use vectors::output_text;
use vectors::whole_file::{OutputError, OutputSet};

/// Why a report was not written, or a table of one not read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FilesError {
    /// A file.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A table that does not become CSV, or is none.
    #[error("{name}: {cause}")]
    Csv {
        /// The file.
        name: String,
        /// What is wrong.
        cause: csv::Error,
    },
    /// A report that does not become JSON.
    #[error("{name}: {cause}")]
    Json {
        /// The file.
        name: String,
        /// What is wrong.
        cause: serde_json::Error,
    },
    /// A chart that cannot be drawn.
    #[error("{name}: {cause}")]
    Plot {
        /// The picture.
        name: String,
        /// What is wrong.
        cause: PlotError,
    },
}

/// Rows as the text of the table `name`.
///
/// # Errors
/// When a row is no flat record.
pub fn table<T: Serialize>(name: &str, rows: &[T]) -> Result<Vec<u8>, FilesError> {
    output_text::csv(rows).map_err(|cause| FilesError::Csv { name: name.to_owned(), cause })
}

/// A value as the text of the JSON file `name`.
///
/// # Errors
/// When it has no JSON.
pub fn json<T: Serialize + ?Sized>(name: &str, value: &T) -> Result<String, FilesError> {
    output_text::json(value).map_err(|cause| FilesError::Json { name: name.to_owned(), cause })
}

/// Adds the chart to `set`, as `name.png` and `name.svg`.
pub(super) fn picture(set: &mut OutputSet, name: &str, chart: &Chart) -> Result<(), FilesError> {
    let plot = |cause| FilesError::Plot { name: name.to_owned(), cause };
    let (svg, png) = chart.to_svg_and_png().map_err(plot)?;
    set.write(&format!("{name}.png"), png)?;
    set.write(&format!("{name}.svg"), svg)?;
    Ok(())
}
