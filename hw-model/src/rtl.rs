//! The data path in SystemVerilog, file for file: what `hw-model/rtl/` holds, as text.
//!
//! | Rust                       | RTL                                          |
//! |----------------------------|----------------------------------------------|
//! | `rounding.rs`              | `blysk_round_shift.sv`                       |
//! | `rom.rs`                   | `blysk_rom.sv`                               |
//! | `datapath/front_end.rs`    | `blysk_front_end.sv`                         |
//! | `datapath/stage.rs`        | `blysk_stage.sv`                             |
//! | `datapath/tail.rs`         | `blysk_tail.sv`, `blysk_tail_digits.sv`      |
//! | `datapath/clamp.rs`        | `blysk_clamp.sv`                             |
//! | `datapath/ranks.rs`        | `blysk.sv`, `blysk_delay.sv`                 |
//! | handshake of the simulator | `blysk_handshake.sv`, `blysk_ready_slice.sv` |
//! | no arithmetic: other names | `blysk_axis.sv`                              |
//!
//! Widths and constants of one configuration are in a package that is generated beside them.

/// A source file: its name, and its text.
pub type Source = (&'static str, &'static str);

macro_rules! source {
    ($name:literal) => {
        ($name, include_str!(concat!("../rtl/", $name)))
    };
}

/// The name of the top module.
pub const TOP: &str = "blysk";

/// The file of the package of a configuration, which is generated.
pub const PACKAGE: &str = "blysk_pkg.sv";

/// The file of the testbench, which is generated.
pub const TESTBENCH: &str = "blysk_tb.sv";

/// The pipeline with the names of AXI4-Stream, around the top module.
pub const WRAPPER: Source = source!("blysk_axis.sv");

/// Every source file of the pipeline, in an order in which each names only what stands before it.
pub const SOURCES: [Source; 11] = [
    source!("blysk_round_shift.sv"),
    source!("blysk_delay.sv"),
    source!("blysk_handshake.sv"),
    source!("blysk_ready_slice.sv"),
    source!("blysk_rom.sv"),
    source!("blysk_front_end.sv"),
    source!("blysk_stage.sv"),
    source!("blysk_tail_digits.sv"),
    source!("blysk_tail.sv"),
    source!("blysk_clamp.sv"),
    source!("blysk.sv"),
];
