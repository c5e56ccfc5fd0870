//! The pipeline with its ROM's words in the source (`blysk rtl --rom-in-source`).

use hw_model::design::Design;
use vectors::Strategy;
use vectors::rtl::Emission;

use super::simulators::{Simulator, yosys_reads};
use super::workspace::emit_as;
use super::{Failure, failed, readers};

/// Every vector in every simulator, and the readers. Gives the vectors of a run.
///
/// # Errors
/// With the first verdict that is none, or what a reader says.
pub fn check(design: &Design, count: u64, simulators: &[Simulator]) -> Result<u64, Failure> {
    let emission = Emission { rom_in_source: true, ..Emission::default() };
    let emitted = emit_as(design, "in_source", &emission, (Strategy::Mixed, count))?;
    yosys_reads(&emitted.directory)?;
    readers::check(&emitted.directory)?;
    for simulator in simulators {
        let verdict = simulator.run(&emitted.directory, "+seed=1")?;
        if verdict.last != format!("PASS {} vectors", emitted.vectors) {
            return failed(format!("{}: the ROM in the source: {}", simulator.name, verdict.last));
        }
        if !simulator.is_icarus() {
            simulator.lint(&emitted.directory)?;
        }
    }
    Ok(emitted.vectors)
}
