//! Which configuration a request is about.

use hw_model::config::Config;
use hw_model::design::{Design, DesignError};
use hw_model::presets;
use serde::{Deserialize, Serialize};
use vectors::case::{DEFAULT_COUNT, DEFAULT_SEED, Strategy, options};
use vectors::configuration_file;
use vectors::limits::{MOST_SERVED_ROWS, MOST_SERVED_TEXT};

use crate::refusal::Refusal;

/// A preset, or a text.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Configuration {
    /// The name of a preset.
    Preset(String),
    /// A configuration as JSON.
    Text(String),
}

/// The name of a pasted configuration in messages, and of its file beside the RTL.
pub(crate) const PASTED: &str = "configuration.json";

impl Configuration {
    /// The hardware of the configuration.
    ///
    /// # Errors
    /// When there is none; the sentence is that of the `blysk` command.
    pub(crate) fn design(&self) -> Result<Design, Refusal> {
        let origin = match self {
            Self::Preset(name) => format!("preset {name}"),
            Self::Text(_) => PASTED.to_owned(),
        };
        let config = configuration_file::parse(self.text()?, &origin)?;
        within_limits(&config)?;
        Design::new(config).map_err(|error| Refusal::unusable(format!("{origin}: {error}")))
    }

    /// The configuration as JSON.
    ///
    /// # Errors
    /// When there is no such preset, or the text is longer than a configuration.
    pub(crate) fn text(&self) -> Result<&str, Refusal> {
        match self {
            Self::Preset(name) => match presets::find(name) {
                Some(preset) => Ok(preset.json),
                None => Err(Refusal::unusable(DesignError::NoPreset { name: name.clone() })),
            },
            Self::Text(text) if text.len() > MOST_SERVED_TEXT => Err(Refusal::unusable(format!(
                "{PASTED} has {} bytes; the page takes at most {MOST_SERVED_TEXT}, and blysk --config takes more",
                text.len()
            ))),
            Self::Text(text) => Ok(text),
        }
    }

    /// The command that writes the hardware, but for the place it goes to.
    pub(crate) fn rtl_command(&self) -> String {
        let chosen = options(Strategy::default(), DEFAULT_COUNT, DEFAULT_SEED);
        match self {
            Self::Preset(name) => format!("blysk rtl --preset {name} {chosen}"),
            Self::Text(_) => format!("blysk rtl --config {PASTED} {chosen}"),
        }
    }
}

/// Fitting takes a time for each segment of each row.
fn within_limits(config: &Config) -> Result<(), Refusal> {
    let rows = config.exponents.len() * config.segments;
    if rows <= MOST_SERVED_ROWS {
        return Ok(());
    }
    let segments = if config.segments == 1 { String::new() } else { format!(" of {} segments", config.segments) };
    Err(Refusal::too_much(format!(
        "{} exponents{segments} are more than the page takes; {} exponents would fit, and the blysk command takes all",
        config.exponents.len(),
        MOST_SERVED_ROWS / config.segments
    )))
}
