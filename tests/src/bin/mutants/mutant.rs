//! A mutant, and what became of it.

use blysk_tests::rtl::mutants::proof::Judgement;
use blysk_tests::rtl::mutants::{DISTANT_ROWS, NETLIST};

/// A mutant with what became of it in both bundles.
pub(crate) struct Mutant {
    pub class: &'static str,
    pub name: String,
    pub by_default: Option<String>,
    pub by_compact: Option<String>,
    pub known: Known,
}

/// What is known of a mutant beside what the vectors find.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Known {
    /// Nothing: it should be killed.
    Nothing,
    /// Why it may survive.
    Equivalent(&'static str),
    /// An input that shows it: the address, and the bits of x.
    Visible(u64, u64),
}

impl std::fmt::Display for Known {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Nothing => f.write_str("an escape, not shown to be equivalent"),
            Self::Equivalent(why) => f.write_str(why),
            Self::Visible(address, x) => {
                write!(f, "an escape: address {address} with x = 0x{x:x} shows it")
            }
        }
    }
}

impl From<Judgement> for Known {
    fn from(judgement: Judgement) -> Self {
        match judgement {
            Judgement::Equivalent(why) => Self::Equivalent(why),
            Judgement::Visible { address, x } => Self::Visible(address, x),
            Judgement::Open => Self::Nothing,
        }
    }
}

impl Mutant {
    /// True for what the compact set is made to catch.
    pub fn is_of_model(&self) -> bool {
        ![NETLIST, DISTANT_ROWS].contains(&self.class)
    }

    /// Why it survives where it does: what kills it in the other bundle, or what is known of it.
    pub fn why(&self) -> String {
        match (&self.by_default, &self.by_compact, self.known) {
            (None, Some(by), Known::Nothing) => {
                format!("an escape: the compact set kills it ({by})")
            }
            (Some(by), None, Known::Nothing) => {
                format!("an escape: the default bundle kills it ({by})")
            }
            (.., known) => known.to_string(),
        }
    }

    pub fn fate(&self, killed_by: Option<&String>) -> &'static str {
        match (killed_by, self.known) {
            (Some(_), _) => "killed",
            (None, Known::Equivalent(_)) => "equivalent",
            (None, _) => "escaped",
        }
    }
}
