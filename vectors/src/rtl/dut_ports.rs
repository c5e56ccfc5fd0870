//! The ports of a designer's own module: a map from the pipeline's ports to its own.
//!
//! ```json
//! {"ports": {"clk_i": "clk", "rst_i": "!reset_n", "in_ready_o": null}, "tied": {"scan_enable": 0}}
//! ```
//!
//! A port that the map does not name has the pipeline's name; `tied` has inputs of all zeros or all ones. `!` says that
//! the port is active low, `null` that the module has none. Without `in_ready_o`, `out_ready_i` is an enable, without
//! which nothing moves.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use hw_model::names::{self, NameError};
use serde::Deserialize;
use thiserror::Error;

use crate::text_file::{self, PORT_MAP, TextError};

/// The pipeline's ports, inputs and outputs, and which a module may do without or have active low.
const PORTS: [(&str, Need); 10] = [
    ("clk_i", Need::Always),
    ("rst_i", Need::Flag),
    ("in_valid_i", Need::Flag),
    ("in_ready_o", Need::Flag),
    ("address_i", Need::Always),
    ("x_i", Need::Always),
    ("out_valid_o", Need::Flag),
    ("out_ready_i", Need::Flag),
    ("intensity_o", Need::Always),
    ("status_o", Need::Maybe),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Need {
    /// Every module has it.
    Always,
    /// A module may have none.
    Maybe,
    /// A module may have none, or one that is active low.
    Flag,
}

/// Why a map of ports is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PortMapError {
    /// The file cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// It is no JSON of the right form.
    #[error("{}: {cause}; a map of ports has \"ports\" and \"tied\"", path.display())]
    Json {
        /// The path of the map.
        path: PathBuf,
        /// What is wrong, with its line and column.
        cause: serde_json::Error,
    },
    /// A port, or what it is mapped to.
    #[error("{}: port {port}: {problem}", path.display())]
    Port {
        /// The path of the map.
        path: PathBuf,
        /// The port's name as the map has it.
        port: String,
        /// What is wrong, and what would be right.
        problem: String,
    },
}

/// The ports of a module under test.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DutPorts {
    ports: BTreeMap<&'static str, Option<DutPort>>,
    tied: BTreeMap<String, u64>,
}

/// A port of the module under test.
#[derive(Debug, Clone, PartialEq, Eq)]
struct DutPort {
    name: String,
    active_low: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(default)]
    ports: BTreeMap<String, Option<String>>,
    #[serde(default)]
    tied: BTreeMap<String, u64>,
}

impl Default for DutPorts {
    /// The pipeline's own ports.
    fn default() -> Self {
        let own = |(name, _): (&'static str, Need)| (name, Some(DutPort { name: name.to_owned(), active_low: false }));
        Self { ports: PORTS.into_iter().map(own).collect(), tied: BTreeMap::new() }
    }
}

impl DutPorts {
    /// Reads the map of ports at `path`.
    ///
    /// # Errors
    /// Names the file and the port, what is wrong and what would be right.
    pub fn read(path: &Path) -> Result<Self, PortMapError> {
        Self::parse(&text_file::read(path, PORT_MAP)?, path)
    }

    /// Reads a map of ports; `path` is for messages.
    ///
    /// # Errors
    /// As [`DutPorts::read`].
    pub fn parse(text: &str, path: &Path) -> Result<Self, PortMapError> {
        let written: Written =
            serde_json::from_str(text).map_err(|cause| PortMapError::Json { path: path.to_owned(), cause })?;
        let mut ports = Self { tied: written.tied, ..Self::default() };
        let mut set = || {
            for (port, own) in &written.ports {
                ports.set(port, own.as_deref()).map_err(|problem| (port.clone(), problem))?;
            }
            ports.check()
        };
        set().map_err(|(port, problem)| PortMapError::Port { path: path.to_owned(), port, problem })?;
        Ok(ports)
    }

    fn set(&mut self, port: &str, own: Option<&str>) -> Result<(), String> {
        let Some((name, need)) = PORTS.into_iter().find(|(name, _)| *name == port) else {
            let known: Vec<&str> = PORTS.iter().map(|(name, _)| *name).collect();
            return Err(format!("the pipeline has no such port; its ports are {}", known.join(", ")));
        };
        let port = match own {
            None if need == Need::Always => {
                return Err("a module under test must have it; null is not for it".to_owned());
            }
            None => None,
            Some(own) => {
                let (own, active_low) = own.strip_prefix('!').map_or((own, false), |own| (own, true));
                if active_low && need != Need::Flag {
                    return Err("only a flag can be active low; leave the ! out".to_owned());
                }
                Some(DutPort { name: own.to_owned(), active_low })
            }
        };
        self.ports.insert(name, port);
        Ok(())
    }

    /// That names are names, each once, and that what is there can be tested.
    fn check(&self) -> Result<(), (String, String)> {
        let mut seen = BTreeMap::new();
        let mapped = self.ports.iter().filter_map(|(port, own)| own.as_ref().map(|own| (*port, own.name.as_str())));
        for (port, own) in mapped.chain(self.tied.keys().map(|own| (own.as_str(), own.as_str()))) {
            names::module(own).map_err(|error| (port.to_owned(), port_name(own, &error)))?;
            if let Some(other) = seen.insert(own, port) {
                return Err((port.to_owned(), format!("{own:?} is what {other} is mapped to already")));
            }
        }
        if let Some((own, value)) = self.tied.iter().find(|(_, value)| **value > 1) {
            return Err((own.clone(), format!("it is tied to {value}; tie it to 0 or 1, which all its bits are then")));
        }
        let wrong = |port: &str, problem: &str| Err((port.to_owned(), problem.to_owned()));
        if self.has("out_valid_o") && !self.has("in_valid_i") {
            return wrong(
                "out_valid_o",
                "without in_valid_i every cycle is a request, and out_valid_o must be null too",
            );
        }
        if self.has("in_ready_o") && self.has("out_ready_i") && !self.has("out_valid_o") {
            return wrong("out_valid_o", "where requests and answers wait, an answer must say that it is one");
        }
        if self.has("in_ready_o") && !self.has("in_valid_i") {
            return wrong("in_ready_o", "without in_valid_i nothing can wait; in_ready_o must be null too");
        }
        Ok(())
    }

    /// True where the module has the port.
    #[must_use]
    pub fn has(&self, port: &str) -> bool {
        matches!(self.ports.get(port), Some(Some(_)))
    }

    /// What messages call a port: its own name, after the pipeline's where that is another one.
    pub(super) fn shown(&self, port: &str) -> String {
        match self.ports.get(port) {
            Some(Some(own)) if own.name != port => format!("{port} (port {})", own.name),
            _ => port.to_owned(),
        }
    }

    /// The question to ask about the reset, where nothing comes.
    pub(super) fn reset(&self) -> String {
        match self.ports.get("rst_i") {
            Some(Some(own)) => {
                let level = if own.active_low { "low" } else { "high" };
                format!("is {} active {level}", self.shown("rst_i"))
            }
            _ => "does the module need a reset".to_owned(),
        }
    }

    /// The connections of an instance, a line each, to the testbench's signals.
    pub(super) fn connections(&self) -> Vec<String> {
        let connected = self.ports.iter().filter_map(|(port, own)| {
            let own = own.as_ref()?;
            let signal = signal(port);
            Some(match (own.active_low, is_output(port)) {
                (false, _) => format!(".{}({signal})", own.name),
                (true, false) => format!(".{}(!{signal})", own.name),
                (true, true) => format!(".{}({signal}_low)", own.name),
            })
        });
        connected.chain(self.tied.iter().map(|(own, value)| format!(".{own}('{value})"))).collect()
    }

    /// Signals of the testbench that no port gives as it is.
    pub(super) fn wires(&self) -> Vec<String> {
        let outputs = self.ports.iter().filter(|(port, _)| is_output(port));
        let wire = |(port, own): (&&str, &Option<DutPort>)| {
            let signal = signal(port);
            match own {
                None if *port == "in_ready_o" => vec![format!("assign {signal} = 1'b1;")],
                None => vec![format!("assign {signal} = '0;")],
                Some(own) if own.active_low => {
                    vec![format!("logic {signal}_low;"), format!("assign {signal} = !{signal}_low;")]
                }
                Some(_) => Vec::new(),
            }
        };
        outputs.flat_map(wire).collect()
    }

    /// What the testbench takes for granted, a sentence each.
    pub(super) fn assumptions(&self, latency: usize) -> Vec<String> {
        let waits = match (self.has("in_ready_o"), self.has("out_ready_i")) {
            (true, true) => format!("an answer comes after {latency} cycles, or later where it waits for its receiver"),
            (false, true) => {
                format!("an answer comes after {latency} cycles in which {} is 1", self.shown("out_ready_i"))
            }
            (_, false) => format!("an answer comes after {latency} cycles, without exception"),
        };
        let named = self.ports.iter().filter_map(|(port, own)| match own {
            None => Some(format!("there is no {port}")),
            Some(own) if own.active_low => Some(format!("{port} is {}, active low", own.name)),
            Some(own) if own.name != *port => Some(format!("{port} is {}", own.name)),
            Some(_) => None,
        });
        std::iter::once(waits).chain(named).collect()
    }
}

fn is_output(port: &str) -> bool {
    port.ends_with("_o")
}

/// The testbench's signal of a port.
pub(super) fn signal(port: &str) -> &str {
    port.strip_suffix("_i").or_else(|| port.strip_suffix("_o")).unwrap_or(port)
}

/// As a name of a module is judged, for a port.
fn port_name(own: &str, error: &NameError) -> String {
    format!("{own:?}: {error}").replace("of a module", "of a port").replace("your module", "your port")
}
