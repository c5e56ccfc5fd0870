//! What the descriptions have in common: which files there are, and what they are called.

use hw_model::rtl::{PACKAGE, SOURCES, WRAPPER};

use crate::manifest::ROM;
use crate::rtl::emission::Emission;
use crate::rtl::sources::Sources;

/// Package and pipeline under their own names, in an order in which each names only what stands before it.
pub(super) fn pipeline(sources: &Sources<'_>) -> Vec<String> {
    let names = SOURCES.iter().map(|(name, _)| *name);
    std::iter::once(PACKAGE).chain(names).map(|name| sources.modules.file(name)).collect()
}

/// The pipeline, and the module with AXI4-Stream ports.
pub(super) fn with_axis(sources: &Sources<'_>) -> Vec<String> {
    pipeline(sources).into_iter().chain([sources.modules.file(WRAPPER.0)]).collect()
}

/// The image that the parameter `ROM_FILE` names where nothing else is said; none where the words stand in the source.
pub(super) fn image(sources: &Sources<'_>, emission: &Emission) -> Option<String> {
    (!emission.rom_in_source).then(|| sources.modules.rom_image().unwrap_or_else(|| ROM.to_owned()))
}

/// The name of a module: that of its file without the end.
pub(super) fn module(sources: &Sources<'_>, file: &str) -> String {
    sources.modules.file(file).trim_end_matches(".sv").to_owned()
}
