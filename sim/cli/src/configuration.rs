//! `--preset NAME`, `--config FILE` and `--all-presets`.

use std::path::PathBuf;

use anyhow::Context;
use clap::{ArgGroup, Args};
use hw_model::config::Config;
use hw_model::design::{Design, DesignError};
use hw_model::names;
use hw_model::presets;
use vectors::configuration_file;

/// The options that choose a configuration, for a command that may do without one.
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

/// The options that choose a configuration, one of which is demanded.
#[derive(Args)]
#[command(group(ArgGroup::new("one").args(["preset", "config"]).required(true)))]
pub(super) struct Configuration {
    #[command(flatten)]
    stated: MaybeConfiguration,
}

/// The options that choose a configuration or every preset, one of which is demanded.
#[derive(Args)]
#[command(group(ArgGroup::new("some").args(["preset", "config", "all_presets"]).required(true)))]
pub(super) struct Configurations {
    #[command(flatten)]
    stated: MaybeConfiguration,
    /// Every preset.
    #[arg(long)]
    pub(super) all_presets: bool,
}

/// A configuration as it is stated.
pub(super) enum Stated {
    /// A preset, by its name.
    Preset(String),
    /// The text of a file.
    Text(String),
}

impl MaybeConfiguration {
    /// The configuration as it is stated, where there is one, once it is known to be one.
    pub(super) fn stated(&self) -> anyhow::Result<Option<Stated>> {
        Ok(match (&self.preset, &self.config) {
            (Some(name), _) => Some(Stated::Preset(find_preset(name)?.name.to_owned())),
            (None, Some(path)) => {
                let text = configuration_file::text(path)?;
                configuration_file::parse(&text, &path.display().to_string())?;
                Some(Stated::Text(text))
            }
            (None, None) => None,
        })
    }

    /// The hardware of the configuration, where there is one.
    pub(super) fn design(&self) -> anyhow::Result<Option<Design>> {
        self.load()?.map(|(config, origin)| Design::new(config).with_context(|| origin)).transpose()
    }

    /// The configuration, where there is one.
    pub(super) fn config(&self) -> anyhow::Result<Option<Config>> {
        Ok(self.load()?.map(|(config, _)| config))
    }

    /// The option as it would be typed, for the headers of generated files; nothing where there is none.
    pub(super) fn option(&self) -> String {
        match (&self.preset, &self.config) {
            (Some(name), _) => preset_option(name),
            (None, Some(path)) => format!("--config {}", names::shell(path)),
            (None, None) => String::new(),
        }
    }

    /// The files that it is read from.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.config.iter().cloned().collect()
    }

    /// The configuration, and what to call it in an error.
    fn load(&self) -> anyhow::Result<Option<(Config, String)>> {
        match (&self.preset, &self.config) {
            (Some(name), _) => Ok(Some((find_preset(name)?.config()?, format!("preset {name}")))),
            (None, Some(path)) => Ok(Some((configuration_file::read(path)?, path.display().to_string()))),
            (None, None) => Ok(None),
        }
    }
}

impl Configuration {
    /// The hardware of the configuration.
    pub(super) fn design(&self) -> anyhow::Result<Design> {
        // clap demands one of the two.
        self.stated.design()?.context("say --preset NAME or --config FILE")
    }

    /// As [`MaybeConfiguration::files`].
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.stated.files()
    }

    /// As [`MaybeConfiguration::option`].
    pub(super) fn option(&self) -> String {
        self.stated.option()
    }
}

impl Configurations {
    /// Each configuration, with the option that chooses it.
    pub(super) fn designs(&self) -> anyhow::Result<Vec<(Design, String)>> {
        if self.all_presets {
            let made = |preset: presets::Preset| {
                let design = Design::new(preset.config()?).with_context(|| format!("preset {}", preset.name))?;
                Ok((design, preset_option(preset.name)))
            };
            return presets::ALL.into_iter().map(made).collect();
        }
        // clap demands one of the three.
        let design = self.stated.design()?.context("say --preset NAME, --config FILE or --all-presets")?;
        Ok(vec![(design, self.stated.option())])
    }

    /// The option as it would be typed.
    pub(super) fn option(&self) -> String {
        if self.all_presets { "--all-presets".to_owned() } else { self.stated.option() }
    }

    /// As [`MaybeConfiguration::files`].
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.stated.files()
    }
}

fn preset_option(name: &str) -> String {
    format!("--preset {}", names::shell(name))
}

/// The preset of this name.
pub(super) fn find_preset(name: &str) -> anyhow::Result<presets::Preset> {
    presets::find(name).ok_or_else(|| DesignError::NoPreset { name: name.to_owned() }.into())
}
