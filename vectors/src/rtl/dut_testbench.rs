//! Writes the testbench of a module of another latency, or with other ports, from its template.

use askama::Template;
use hw_model::format::QFormat;

use super::dut_ports::DutPorts;
use super::emission::Dut;
use super::sources::Sources;
use super::testbench::Number;

/// The text of `blysk_tb.sv` for a module that is not as the pipeline is.
#[must_use]
pub fn dut_testbench(sources: &Sources<'_>, dut: &Dut) -> String {
    let datapath = sources.design.datapath();
    let formats = datapath.formats();
    let ports = &dut.ports;
    let latency = dut.latency.map_or(datapath.latency(), |latency| latency as usize);
    let has_status = ports.has("status_o");
    let of_status = |text: &'static str| if has_status { text } else { "" };
    let testbench = DutTestbench {
        configuration: &sources.design.config().name,
        command: sources.command,
        dut: sources.modules.dut(),
        assumptions: ports.assumptions(latency),
        vectors: sources.vectors,
        depth: datapath.rom().depth(),
        latency,
        address: Number::of(QFormat::field(datapath.rom().address_width())),
        x: Number::of(formats.input),
        intensity: Number::of(formats.output),
        status_width: datapath.status_width(),
        has: Has::of(ports),
        name: Names::of(ports),
        wires: ports.wires(),
        connections: ports.connections().join(",\n    "),
        log_status: of_status(",status"),
        log_format: of_status(",%h"),
        log_value: of_status(", status"),
    };
    // The template writes to a String, which cannot fail.
    testbench.render().unwrap_or_default() + "\n"
}

#[derive(Template)]
#[template(path = "dut_tb.sv", escape = "none")]
struct DutTestbench<'a> {
    configuration: &'a str,
    command: &'a str,
    dut: &'a str,
    assumptions: Vec<String>,
    vectors: u64,
    depth: usize,
    latency: usize,
    address: Number,
    x: Number,
    intensity: Number,
    status_width: u32,
    has: Has,
    name: Names,
    wires: Vec<String>,
    connections: String,
    log_status: &'static str,
    log_format: &'static str,
    log_value: &'static str,
}

/// Which ports there are, as constants of Verilog.
struct Has {
    reset: &'static str,
    in_ready: &'static str,
    out_valid: &'static str,
    out_ready: &'static str,
    status: &'static str,
}

impl Has {
    fn of(ports: &DutPorts) -> Self {
        let bit = |port| if ports.has(port) { "1'b1" } else { "1'b0" };
        Self {
            reset: bit("rst_i"),
            in_ready: bit("in_ready_o"),
            out_valid: bit("out_valid_o"),
            out_ready: bit("out_ready_i"),
            status: bit("status_o"),
        }
    }
}

/// What messages call the ports; of the reset, the question to ask.
struct Names {
    clock: String,
    reset: String,
    in_valid: String,
    in_ready: String,
    out_valid: String,
    out_ready: String,
    intensity: String,
    status: String,
}

impl Names {
    fn of(ports: &DutPorts) -> Self {
        Self {
            clock: ports.shown("clk_i"),
            reset: ports.reset(),
            in_valid: ports.shown("in_valid_i"),
            in_ready: ports.shown("in_ready_o"),
            out_valid: ports.shown("out_valid_o"),
            out_ready: ports.shown("out_ready_i"),
            intensity: ports.shown("intensity_o"),
            status: ports.shown("status_o"),
        }
    }
}
