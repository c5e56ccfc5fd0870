//! What another width would do.

use analysis::budget::within_its_bound;
use hw_model::design::{Design, Revision};
use hw_model::format::QFormat;
use hw_model::stated;
use serde::{Deserialize, Serialize};

use crate::configuration::Configuration;
use crate::figures::Figures;
use crate::known::Known;
use crate::refusal::Refusal;

/// Which register, and its other format.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AlterAsk {
    /// Of which hardware.
    pub(crate) configuration: Configuration,
    register: String,
    format: String,
}

/// The hardware as it is, and with the other format.
#[derive(Debug, Serialize)]
pub(crate) struct Altered {
    register: String,
    format_before: String,
    format_after: String,
    before: Figures,
    after: Figures,
    /// Whether what is proved of the altered hardware is within the budget of the configuration.
    within_budget: bool,
    /// The configuration of the altered hardware as JSON, every width stated.
    text: String,
}

impl Altered {
    /// Alters one format, states all others as they are, and measures both.
    ///
    /// # Errors
    /// When there is no such register or format, or the register could overflow: the message says what it needs.
    pub(crate) fn of(known: &Known, ask: &AlterAsk) -> Result<Self, Refusal> {
        let design = &known.design;
        let widths = design.widths();
        let Some((register, present)) = widths.iter().find(|(register, _)| stated::name(*register) == ask.register)
        else {
            let names: Vec<&str> = widths.iter().map(|(register, _)| stated::name(register)).collect();
            let message = format!(
                "there is no register {:?} whose format could be altered; there are {}",
                ask.register,
                names.join(", ")
            );
            return Err(Refusal::unusable(message));
        };
        let format: QFormat = ask.format.trim().parse().map_err(Refusal::unusable)?;
        let revision = Revision { widths: widths.with(register, Some(format)), ..design.revision() };
        let altered = within_its_bound(design, revision).map_err(Refusal::unusable)?;
        Ok(Self {
            register: ask.register.clone(),
            format_before: present.to_string(),
            format_after: format.to_string(),
            before: known.figures()?.clone(),
            after: Figures::of(&altered)?,
            within_budget: budget(&altered) <= budget(design),
            text: altered.config().to_json(),
        })
    }
}

fn budget(design: &Design) -> f64 {
    design.config().error_budget_ulp
}
