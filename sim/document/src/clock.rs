//! What lies between the ranks, on the devices of which Blysk has delays.

use hw_model::clock::{Device, longest, paths};
use hw_model::datapath::Datapath;

use super::table::Table;
use super::words::places;

/// Every path with its estimated time, by device; the longest is marked, and is the clock.
pub(super) fn estimates(datapath: &Datapath) -> Table {
    let mut table = Table::new(&["device", "between two ranks", "ns", "MHz"]);
    for name in Device::names() {
        let Ok(delays) = Device::Named(name.to_owned()).delays() else { continue };
        let found = paths(datapath, &delays);
        let Some(longest) = longest(found.clone()) else { continue };
        for path in found {
            let mark = |text: String| if path == longest { format!("**{text}**") } else { text };
            table.row([format!("`{name}`"), path.words(), mark(places(path.ns, 1)), mark(places(path.mhz(), 0))]);
        }
    }
    table
}
