//! Two configurations in one design, each with names of its own (`blysk rtl --prefix`).
//!
//! They are elaborated together and answer their vectors side by side, each with its own image of the ROM, in Icarus
//! and in both Verilators; Yosys reads them together.

use std::path::Path;
use std::process::Command;

use hw_model::design::Design;
use hw_model::rtl::{PACKAGE, SOURCES};
use vectors::Strategy;
use vectors::rtl::Modules;

use super::simulators::{Simulator, fresh};
use super::workspace::emit_as;
use super::{Failure, failed};

/// What each of the two has in the testbench.
const ONE: &str = include_str!("two_in_one.sv");
/// Vectors of each.
const VECTORS: u64 = 512;

fn failure(error: impl std::fmt::Display) -> Failure {
    Failure(error.to_string())
}

/// The directory of both, with a testbench and a Makefile.
///
/// # Errors
/// When it cannot be written.
fn emit(designs: [(&str, &Design); 2]) -> Result<(std::path::PathBuf, String), Failure> {
    let directory = fresh("two_in_one")?;
    std::fs::create_dir_all(&directory).map_err(failure)?;
    let mut sources = Vec::new();
    let mut body = String::new();
    for (prefix, design) in designs {
        let modules = Modules::new(prefix, None).map_err(failure)?;
        let name = format!("two_in_one_{prefix}");
        let emitted = emit_as(design, &name, &modules.clone().into(), (Strategy::Mixed, VECTORS))?;
        let rtl = [PACKAGE].into_iter().chain(SOURCES.map(|(name, _)| name)).map(|name| modules.file(name));
        let images = [format!("{prefix}_rom.mem")];
        let rtl: Vec<String> = rtl.collect();
        for name in rtl.iter().chain(&images) {
            std::fs::copy(emitted.directory.join(name), directory.join(name)).map_err(failure)?;
        }
        for name in ["stimulus.mem", "expected.mem"] {
            let to = directory.join(format!("{prefix}_{name}"));
            std::fs::copy(emitted.directory.join(name), to).map_err(failure)?;
        }
        sources.extend(rtl);
        body += &ONE.replace("{{vectors}}", &emitted.vectors.to_string()).replace("{{p}}", prefix);
    }
    let [first, second] = designs.map(|(prefix, _)| prefix);
    let testbench = format!(
        "`timescale 1ns / 1ps\nmodule both_tb;\n  logic clk = 1'b0;\n  logic rst = 1'b1;\n  integer cycles = 0;\n\
         always #5 clk = !clk;\n{body}\n  always @(posedge clk) begin\n    cycles <= cycles + 1;\n    \
         if (cycles == 3) rst <= 1'b0;\n    \
         if ({first}_answered == {first}_VECTORS && {second}_answered == {second}_VECTORS) begin\n      \
         $display(\"PASS %0d vectors\", {first}_VECTORS + {second}_VECTORS);\n      $finish;\n    \
         end else if (cycles > 100000) begin\n      $display(\"FAIL no answer\");\n      $finish;\n    end\n  end\n\
         endmodule\n"
    );
    let sources = sources.join(" ");
    let makefile = format!(
        "icarus:\n\tmkdir -p $(BUILD)\n\t$(IVERILOG) -g2012 -Wall -Wno-timescale -s both_tb -o $(BUILD)/both.vvp \
         {sources} both_tb.sv\n\t$(VVP) -n $(BUILD)/both.vvp\n\
         verilator:\n\t$(VERILATOR) --binary --timing -CFLAGS -fcoroutines -Wno-fatal -Wno-WIDTH -Wno-TIMESCALEMOD \
         -MAKEFLAGS CFG_CXXFLAGS_PCH_I=-include --top-module both_tb --Mdir $(BUILD) -o both_tb {sources} both_tb.sv \
         > /dev/null\n\t$(BUILD)/both_tb | grep -v '^- '\n"
    );
    std::fs::write(directory.join("both_tb.sv"), testbench).map_err(failure)?;
    std::fs::write(directory.join("Makefile"), makefile).map_err(failure)?;
    Ok((directory, sources))
}

/// Runs the two, named by their prefixes, in every simulator, and reads them with Yosys. Gives the vectors of a run.
///
/// # Errors
/// When one does not answer as the model does, or a tool takes the names of one for those of the other.
pub fn check(designs: [(&str, &Design); 2], simulators: &[Simulator]) -> Result<u64, Failure> {
    let (directory, sources) = emit(designs)?;
    for simulator in simulators {
        let verdict = simulator.run(&directory, "")?;
        if verdict.last != format!("PASS {} vectors", 2 * VECTORS) {
            return failed(format!("{}: two configurations in one design: {}", simulator.name, verdict.last));
        }
    }
    yosys(&directory, &sources, designs.map(|(prefix, _)| prefix))?;
    Ok(2 * VECTORS)
}

fn yosys(directory: &Path, sources: &str, [first, second]: [&str; 2]) -> Result<(), Failure> {
    let ports = "clk_i(clk), .rst_i(clk), .in_valid_i(clk), .out_ready_i(clk), .address_i(0), .x_i(0)";
    let top = format!("module both(input clk); {first} a(.{ports}); {second} b(.{ports}); endmodule\n");
    std::fs::write(directory.join("both.sv"), top).map_err(failure)?;
    let script = format!("read_verilog -sv {sources} both.sv; hierarchy -check -top both; proc; check -assert");
    let output = Command::new("yosys").args(["-q", "-p", &script]).current_dir(directory).output().map_err(failure)?;
    if output.status.success() {
        return Ok(());
    }
    failed(format!("Yosys, two configurations in one design: {}", String::from_utf8_lossy(&output.stderr)))
}
