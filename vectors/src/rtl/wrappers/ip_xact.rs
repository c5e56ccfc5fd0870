//! The IP-XACT component (IEEE 1685-2014) of the module with AXI4-Stream ports.

use askama::Template;
use hw_model::datapath::Datapath;
use hw_model::rtl::WRAPPER;

use super::parts::{image, module, with_axis};
use crate::rtl::emission::Emission;
use crate::rtl::sources::Sources;

/// The text of the component.
#[must_use]
pub fn ip_xact(sources: &Sources<'_>, emission: &Emission) -> String {
    let datapath = sources.design.datapath();
    let component = Component {
        command: escaped(sources.command),
        configuration: &sources.design.config().name,
        version: env!("CARGO_PKG_VERSION"),
        module: module(sources, WRAPPER.0),
        latency: datapath.latency(),
        interfaces: [
            Interface::of(
                "s_axis",
                "slave",
                "Requests: x in the lowest bytes of tdata, the address in those above",
                &[],
            ),
            Interface::of("m_axis", "master", "Results: the intensity in tdata, the status in tuser", &["TUSER"]),
        ],
        ports: ports(datapath),
        files: with_axis(sources),
        image: image(sources, emission),
    };
    // The template writes to a String, which cannot fail.
    component.render().unwrap_or_default() + "\n"
}

#[derive(Template)]
#[template(path = "component.xml", escape = "none")]
struct Component<'a> {
    command: String,
    configuration: &'a str,
    version: &'a str,
    module: String,
    latency: usize,
    interfaces: [Interface; 2],
    ports: Vec<Port>,
    files: Vec<String>,
    image: Option<String>,
}

struct Interface {
    name: &'static str,
    mode: &'static str,
    description: &'static str,
    /// Names in the abstraction definition, and of the module's ports.
    ports: Vec<(String, String)>,
}

impl Interface {
    fn of(name: &'static str, mode: &'static str, description: &'static str, more: &[&str]) -> Self {
        let pair = |logical: &&str| ((*logical).to_owned(), format!("{name}_{}", logical.to_lowercase()));
        let ports = ["TVALID", "TREADY", "TDATA"].iter().chain(more).map(pair).collect();
        Self { name, mode, description, ports }
    }
}

struct Port {
    name: &'static str,
    direction: &'static str,
    /// The highest bit of a vector.
    left: Option<u32>,
}

/// The ports of `blysk_axis.sv`.
fn ports(datapath: &Datapath) -> Vec<Port> {
    let formats = datapath.formats();
    let bytes = |width: u32| width.div_ceil(8) * 8;
    let request = bytes(formats.input.width()) + bytes(datapath.rom().address_width());
    let flag = |name, direction| Port { name, direction, left: None };
    let vector = |name, direction, width: u32| Port { name, direction, left: Some(width - 1) };
    vec![
        flag("aclk", "in"),
        flag("aresetn", "in"),
        flag("s_axis_tvalid", "in"),
        flag("s_axis_tready", "out"),
        vector("s_axis_tdata", "in", request),
        flag("m_axis_tvalid", "out"),
        flag("m_axis_tready", "in"),
        vector("m_axis_tdata", "out", bytes(formats.output.width())),
        vector("m_axis_tuser", "out", datapath.status_width()),
    ]
}

/// A text as it may stand in an element.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
