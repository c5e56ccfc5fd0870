//! The reset's port by the level at which it resets: `rst_i`, or `rst_ni` where that is 0.

use hw_model::handshake::Reset;
use hw_model::rtl::{TOP, WRAPPER};

/// Its name in the sources of the project, and where it is active high.
const HIGH: &str = "rst_i";
/// Where it is active low.
const LOW: &str = "rst_ni";

/// The name of the port.
#[must_use]
pub const fn name(reset: &Reset) -> &'static str {
    if reset.is_active_low() { LOW } else { HIGH }
}

/// A source of the project with the port under its name: that of the pipeline itself, and the wrapper, which connects
/// it. Inside the pipeline the reset is active high everywhere.
#[must_use]
pub(super) fn named(file: &str, text: &str, reset: &Reset) -> String {
    if !reset.is_active_low() {
        return text.to_owned();
    }
    if file == WRAPPER.0 {
        return text.replace(".rst_i(!aresetn)", ".rst_ni(aresetn)");
    }
    if file.strip_suffix(".sv") != Some(TOP) {
        return text.to_owned();
    }
    // Connections of modules inside, which begin with a dot, keep theirs.
    let mut parts = text.split(HIGH);
    let mut renamed = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        renamed += if renamed.ends_with('.') { HIGH } else { LOW };
        renamed += part;
    }
    renamed
}

/// A description of the pipeline from outside, with the port under its name.
#[must_use]
pub(super) fn everywhere(text: &str, reset: &Reset) -> String {
    if reset.is_active_low() { text.replace(HIGH, LOW) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use hw_model::handshake::Level;
    use hw_model::rtl::SOURCES;

    use super::*;

    #[test]
    fn the_port_alone_has_the_other_name() {
        let reset = Reset { active: Level::Low, ..Reset::default() };
        for (file, text) in SOURCES.into_iter().chain([WRAPPER]) {
            let renamed = named(file, text, &reset);
            let expected = match file {
                "blysk.sv" => 3,
                "blysk_axis.sv" => 1,
                _ => 0,
            };
            assert_eq!(renamed.matches(LOW).count(), expected, "{file}");
            assert_eq!(named(file, text, &Reset::default()), text);
        }
    }
}
