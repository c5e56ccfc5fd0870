//! The configurations that come with the project: JSON files, compiled in.

use crate::config::{Config, ConfigError};

/// A preset: its name and its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preset {
    /// The name, the same as in the file.
    pub name: &'static str,
    /// The text of its file: a configuration as JSON.
    pub json: &'static str,
}

macro_rules! preset {
    ($name:literal) => {
        Preset { name: $name, json: include_str!(concat!("../presets/", $name, ".json")) }
    };
}

/// Every preset, the paper's first and the baseline last.
pub const ALL: [Preset; 6] = [
    preset!("paper"),
    preset!("blooming"),
    preset!("tangent"),
    preset!("compact"),
    preset!("precise"),
    preset!("schlick"),
];

/// The preset of this name.
#[must_use]
pub fn find(name: &str) -> Option<Preset> {
    ALL.into_iter().find(|preset| preset.name == name)
}

impl Preset {
    /// The configuration.
    ///
    /// # Errors
    /// Never for the presets as shipped (a test parses them all); the type says so to callers that
    /// treat presets and files alike.
    pub fn config(&self) -> Result<Config, ConfigError> {
        Config::from_json(self.json)
    }
}
