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
