//! The names of registers as C has texts.

use std::ffi::CString;
use std::sync::Arc;

/// The name of a register, and its path in the RTL.
pub(crate) struct Names {
    pub name: CString,
    pub path: CString,
}

/// The names of every register, in the order of the model's probes.
pub(crate) fn names(model: &model::Model) -> Arc<[Names]> {
    // No name has a zero byte in it; if one had, it would be empty.
    let text = |text: &str| CString::new(text).unwrap_or_default();
    model.probes().iter().map(|probe| Names { name: text(&probe.name), path: text(&probe.path) }).collect()
}
