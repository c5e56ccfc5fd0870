//! What the files beside the modules are called.

/// What `make waves` writes; the scope of the pipeline in it.
pub(super) const WAVES: &str = "waves.vcd";
pub(super) const SCOPE: &str = "blysk_tb.dut";
/// What GTKWave shows of it.
pub const SAVE_FILE: &str = "waves.gtkw";
/// Every computed register of every vector, for the testbench.
pub const STAGES: &str = "stages.mem";
/// The exponent of each ROM word, as the bits of an IEEE double, for messages of the testbench.
pub const EXPONENTS: &str = "exponents.mem";

/// The Makefile that runs the testbench.
pub const MAKEFILE: &str = "Makefile";
/// The FuseSoC core file.
pub const CORE: &str = "blysk.core";

/// The IP-XACT component of the AXI4-Stream module.
pub const IP_XACT: &str = "blysk_axis.xml";
/// The VHDL component and an entity that instantiates it.
pub const VHDL: &str = "blysk.vhd";
/// The manifest of Bender, the package manager for hardware.
pub const BENDER: &str = "Bender.yml";
/// The clock, for tools that read SDC.
pub const SDC: &str = "blysk.sdc";
/// The recipe for Vivado.
pub const VIVADO: &str = "vivado.tcl";
/// The recipe for Quartus.
pub const QUARTUS: &str = "quartus.tcl";

/// The files beside the modules whose names may begin with the prefix.
pub(super) const DESCRIPTIONS: [&str; 7] = [CORE, IP_XACT, VHDL, BENDER, SDC, VIVADO, QUARTUS];
