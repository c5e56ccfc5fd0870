//! A configuration as somebody wrote it: a file, or a text; and what is said of one that is refused.

use std::path::{Path, PathBuf};

use hw_model::clock::Delays;
use hw_model::config::{Config, ConfigError};
use thiserror::Error;

use crate::text_file::{self, CONFIGURATION, TextError, decimal_comma};

/// Why a text is no configuration.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ConfigurationError {
    /// The file cannot be read, or is no text.
    #[error(transparent)]
    Text(#[from] TextError),
    /// A table of delays is refused.
    #[error("{}: {cause}; a table of delays has register, rom, lut, add, carry, multiply, enable in nanoseconds, and \
             multiplier_bits", path.display())]
    Delays {
        /// The path of the table.
        path: PathBuf,
        /// What is wrong, with its line and column.
        cause: serde_json::Error,
    },
    /// The text is refused.
    #[error("{origin}: {error}{hint}")]
    Refused {
        /// Where the text comes from, and where in it the error stands.
        origin: String,
        /// What is wrong, and what would be right.
        error: ConfigError,
        /// What the writer may have meant.
        hint: String,
    },
}

/// The configuration in a file.
///
/// # Errors
/// When the file cannot be read, or holds no configuration.
pub fn read(path: &Path) -> Result<Config, ConfigurationError> {
    parse(&text(path)?, &path.display().to_string())
}

/// The text of a file of a configuration, which stands alone: with the table of delays that it names by a file.
///
/// # Errors
/// When a file cannot be read.
pub fn text(path: &Path) -> Result<String, ConfigurationError> {
    let text = text_file::read(path, CONFIGURATION)?;
    Ok(with_delays(&text, path)?.unwrap_or(text))
}

/// The table of delays in a file.
///
/// # Errors
/// When the file cannot be read, or holds no such table.
pub fn delays(path: &Path) -> Result<Delays, ConfigurationError> {
    let text = text_file::read(path, CONFIGURATION)?;
    serde_json::from_str(&text).map_err(|cause| ConfigurationError::Delays { path: path.to_owned(), cause })
}

/// The text of a configuration whose clock names a file of delays, with the table in the place of its name; none where
/// it names no file. The name counts from the directory of the configuration.
fn with_delays(text: &str, path: &Path) -> Result<Option<String>, ConfigurationError> {
    let Ok(mut value) = serde_json::from_str::<serde_json::Value>(text) else { return Ok(None) };
    let Some(device) = value.pointer_mut("/clock/device") else { return Ok(None) };
    let Some(name) = device.as_str().filter(|name| name.ends_with(".json")) else { return Ok(None) };
    let file = path.parent().unwrap_or(Path::new("")).join(name);
    let table = delays(&file)?;
    let refused = |cause| ConfigurationError::Delays { path: file.clone(), cause };
    *device = serde_json::to_value(table).map_err(refused)?;
    serde_json::to_string_pretty(&value).map(Some).map_err(refused)
}

/// The configuration in a text; `name` says in messages where the text comes from.
///
/// # Errors
/// When the text is no configuration.
pub fn parse(text: &str, name: &str) -> Result<Config, ConfigurationError> {
    Config::from_json(text).map_err(|error| {
        let place = place(&error, text).map_or_else(String::new, |text| format!(", at `{text}`"));
        let hint = match &error {
            ConfigError::Json(error) => decimal_comma(text, error).unwrap_or_default(),
            _ => String::new(),
        };
        ConfigurationError::Refused { origin: format!("{name}{place}"), error, hint }
    })
}

/// The text before an error of the JSON, on its line: a value that is refused does not know the name of
/// its field.
fn place<'a>(error: &ConfigError, text: &'a str) -> Option<&'a str> {
    const MOST: usize = 60;
    let ConfigError::Json(error) = error else { return None };
    let line = text.lines().nth(error.line().checked_sub(1)?)?;
    let before = line.get(..error.column()).unwrap_or(line).trim();
    let (start, _) = before.char_indices().rev().take(MOST).last()?;
    Some(&before[start..])
}
