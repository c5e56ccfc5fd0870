//! `--method NAME|all`.

use std::str::FromStr;

use hw_model::fit::{Method, UnknownMethod};

/// One method, or all of them.
#[derive(Debug, Clone)]
pub(super) struct Methods(pub Vec<Method>);

impl FromStr for Methods {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        if text == "all" {
            return Ok(Self(Method::ALL.to_vec()));
        }
        let one = |method| Self(vec![method]);
        text.parse().map(one).map_err(|error: UnknownMethod| format!("{error}, or all"))
    }
}
