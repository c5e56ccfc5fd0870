//! `--preset NAME` and `--config FILE`.

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow, bail};
use clap::Args;
use hw_model::config::{Config, ConfigError};
use hw_model::design::Design;
use hw_model::names;
use hw_model::presets;
use vectors::text_file::{self, CONFIGURATION, decimal_comma};

/// The options that choose a configuration: a preset's name or a file.
#[derive(Args)]
#[group(required = true, multiple = false)]
pub(super) struct Configuration {
    /// A preset; `blysk presets` lists them.
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// A configuration as JSON; `blysk presets show NAME` prints one to start from.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

/// Which configuration, for a command that may do without one.
#[derive(Clone, Args)]
#[group(multiple = false)]
pub(super) struct MaybeConfiguration {
    /// A preset; `blysk presets` lists them.
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// A configuration as JSON; `blysk presets show NAME` prints one to start from.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

impl MaybeConfiguration {
    /// The hardware of the configuration, where there is one.
    pub(super) fn design(&self) -> anyhow::Result<Option<Design>> {
        self.stated().map(|stated| stated.design()).transpose()
    }

    /// The configuration, where there is one.
    pub(super) fn config(&self) -> anyhow::Result<Option<Config>> {
        Ok(self.stated().map(|stated| stated.load()).transpose()?.map(|(config, _)| config))
    }

    /// The option as it would be typed; nothing where there is none.
    pub(super) fn option(&self) -> String {
        self.stated().map_or_else(String::new, |stated| stated.option())
    }

    /// The files that it is read from.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.config.iter().cloned().collect()
    }

    /// The configuration, where the user states one.
    fn stated(&self) -> Option<Configuration> {
        let Self { preset, config } = self.clone();
        (preset.is_some() || config.is_some()).then_some(Configuration { preset, config })
    }
}

impl Configuration {
    /// The hardware of the configuration.
    pub(super) fn design(&self) -> anyhow::Result<Design> {
        let (config, origin) = self.load()?;
        Design::new(config).with_context(|| origin)
    }

    /// The files that it is read from.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.config.iter().cloned().collect()
    }

    /// The option as it would be typed, for the headers of generated files.
    pub(super) fn option(&self) -> String {
        match (&self.preset, &self.config) {
            (Some(name), _) => format!("--preset {}", names::shell(name)),
            (None, Some(path)) => format!("--config {}", names::shell(path)),
            (None, None) => String::new(),
        }
    }

    fn load(&self) -> anyhow::Result<(Config, String)> {
        match (&self.preset, &self.config) {
            (Some(name), _) => {
                let preset = find_preset(name)?;
                Ok((preset.config()?, format!("preset {name}")))
            }
            (None, Some(path)) => Ok((load_config(path)?, path.display().to_string())),
            // clap demands one of the two.
            (None, None) => bail!("say --preset NAME or --config FILE"),
        }
    }
}

/// The configuration in a file.
pub(super) fn load_config(path: &Path) -> anyhow::Result<Config> {
    let shown = path.display();
    let text = text_file::read(path, CONFIGURATION)?;
    Config::from_json(&text).map_err(|error| {
        let place = place(&error, &text).map_or_else(String::new, |text| format!(", at `{text}`"));
        let hint = match &error {
            ConfigError::Json(error) => decimal_comma(&text, error),
            _ => None,
        };
        match hint {
            Some(hint) => anyhow!("{shown}{place}: {error}{hint}"),
            None => anyhow::Error::from(error).context(format!("{shown}{place}")),
        }
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

/// The preset of this name.
pub(super) fn find_preset(name: &str) -> anyhow::Result<presets::Preset> {
    presets::find(name).with_context(|| {
        let names: Vec<&str> = presets::ALL.iter().map(|preset| preset.name).collect();
        format!("there is no preset {name:?}; the presets are {}", names.join(", "))
    })
}
