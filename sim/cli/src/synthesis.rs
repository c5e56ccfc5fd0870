//! What Yosys makes of a directory of RTL, where there is a Yosys.

use std::process::Command;

use anyhow::{Context, bail};
use hw_model::design::Design;
use hw_model::rtl::{SOURCES, TOP};
use serde_json::Value;
use vectors::rtl::{self, Emission, PACKAGE};
use vectors::whole_file::Scratch;
use vectors::{Bundle, OutputSet, Strategy};

/// What is counted: a name, and the cells with how many of it each is. As `scripts/synth.py` counts for this family.
const COUNTS: [(&str, &[(&str, u64)]); 4] = [
    ("LUTs", &[("LUT4", 1), ("CCU2C", 2)]),
    ("flip-flops", &[("TRELLIS_FF", 1)]),
    ("DSP blocks", &[("MULT18X18D", 1), ("ALU54B", 1)]),
    ("block RAMs", &[("DP16KD", 1)]),
];

/// The names of what is counted.
pub(super) const NAMES: [&str; COUNTS.len()] = [COUNTS[0].0, COUNTS[1].0, COUNTS[2].0, COUNTS[3].0];

/// Synthesises the RTL of a design for an ECP5, and counts.
pub(super) fn counts(design: &Design) -> anyhow::Result<[u64; COUNTS.len()]> {
    let scratch = Scratch::new().context("cannot make a directory for yosys")?;
    let directory = scratch.path();
    let mut set = OutputSet::create(directory)?;
    rtl::stage(&Bundle::new(design, Strategy::Mixed, 1, 1, "")?, &Emission::default(), "", &mut set)?;
    set.commit()?;
    let sources = SOURCES.map(|(name, _)| name).join(" ");
    let script =
        format!("read_verilog -sv {PACKAGE} {sources}; synth_ecp5 -top {TOP}; tee -q -o /dev/stdout stat -json");
    let mut command = Command::new("yosys");
    command.args(["-q", "-p", &script]).current_dir(directory);
    let output = command.output().context("cannot run yosys, which --synth asks for")?;
    let text = String::from_utf8_lossy(&output.stdout);
    if !output.status.success() {
        bail!("yosys: {}", String::from_utf8_lossy(&output.stderr));
    }
    let begin = text.find('{').context("yosys counted nothing")?;
    let mut found = serde_json::Deserializer::from_str(&text[begin..]).into_iter::<Value>();
    let found = found.next().context("yosys counted nothing")?.context("what yosys counted")?;
    let cells = &found["design"]["num_cells_by_type"];
    let of = |&(cell, weight): &(&str, u64)| weight * cells[cell].as_u64().unwrap_or(0);
    Ok(COUNTS.map(|(_, cells)| cells.iter().map(of).sum()))
}
