//! `make rtl`: every preset's RTL in every simulator, against the model.
//!
//! Vectors with stalls, bubbles and resets; random cycles in which every register is compared; a small
//! configuration exhaustively; a corrupted vector and planted faults, which must be found. The emitted Makefile's
//! targets are run in Icarus 11, 12 and 13 as they are typed; slang, Verible and Surelog read RTL and testbench. Yosys
//! counts the parts of each netlist, and FuseSoC runs the core file. Ends with what was compared, and fails when
//! anything differs or nothing was compared.
//!
//! With `--covering`, for `make test`: the presets that have every part of the RTL between them ([`COVERING`]), one
//! example, one scene and all small configurations; every planted fault.

use std::io::BufReader;
use std::process::{ExitCode, Stdio};

use blysk_tests::rtl::coverage::{self, Shares};
use blysk_tests::rtl::faults::{FAULTS, Fault};
use blysk_tests::rtl::simulators::{self, Simulator};
use blysk_tests::rtl::workspace::{Emitted, copy, emit};
use blysk_tests::rtl::wrappers;
use blysk_tests::rtl::{Failure, failed};
use blysk_tests::rtl::{axis, fusesoc, in_source, netlist_parts, readers, rom_image, specialised, two_in_one, waves};
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::handshake::Handshake;
use hw_model::presets;
use rayon::prelude::*;
use sim::agreement::compare;
use vectors::Strategy;
use vectors::rtl::Modules;

/// Random cycles in which every register of a preset is compared.
const VERILATOR_CYCLES: u64 = 1_000_000;
/// And of a scene's hardware: the same RTL with parts left out.
const SCENE_CYCLES: u64 = 100_000;
/// Icarus is slower, and shows unknown values.
const ICARUS_CYCLES: u64 = 20_000;
/// Vectors of each preset.
const VECTORS: u64 = 4096;

/// The presets that `--covering` simulates. Between them: both forms, the divider, one segment and two, stored shifts.
/// The older Verilator reads the first of them alone.
const COVERING: [&str; 3] = ["paper", "compact", "precise"];

/// Every address with every x: 8-bit x, 16 exponents, signed so that all regions occur. And the few vectors of
/// a compact set, which must meet stalls, bubbles and resets all the same.
const SMALL: [(&str, Strategy, &str); 11] = [
    ("small", Strategy::Exhaustive, include_str!("../../../docs/examples/small.json")),
    ("small_compact", Strategy::Compact, include_str!("../../../docs/examples/small.json")),
    (
        "small_tail",
        Strategy::Exhaustive,
        r#"{"name": "small_tail", "method": "hermite", "exponents": "1..=16", "input": "UQ1.7",
            "output": "UQ0.8", "form": "power", "tail": "rational", "rounding": "toward_zero",
            "error_budget_ulp": 2, "quotient_bits_per_stage": 3}"#,
    ),
    // A domain: x below it is refused.
    (
        "small_domain",
        Strategy::Exhaustive,
        r#"{"name": "small_domain", "method": "hermite", "exponents": "2,5,16", "input": "Q2.7",
            "output": "UQ1.8", "form": "centred", "error_budget_ulp": 2, "domain":
            [{"n": 2, "least": 0.75}, {"n": 5, "least": 0.9}, {"n": 16, "least": 0.97}]}"#,
    ),
    // Cut and hand-over have fewer bits than x.
    (
        "small_ends",
        Strategy::Exhaustive,
        r#"{"name": "small_ends", "method": "minimax", "exponents": "1,2,5,16,40", "input": "UQ1.8",
            "output": "UQ1.8", "cut": "balanced", "segments": 2, "widths":
            {"cut": "UQ1.6", "hand_over": "UQ1.3"}}"#,
    ),
    // Every segment that there can be, of the least degree; and the greatest degree in the power form.
    (
        "small_lines",
        Strategy::Exhaustive,
        r#"{"name": "small_lines", "method": "minimax", "degree": 1, "segments": 8,
            "exponents": "1,2,5,16,40", "input": "Q2.9", "output": "UQ1.8", "cut": "balanced",
            "rounding": "nearest_even"}"#,
    ),
    (
        "small_quartic",
        Strategy::Exhaustive,
        r#"{"name": "small_quartic", "method": "minimax", "degree": 4, "exponents": "1,2.5,7",
            "input": "UQ1.9", "output": "UQ1.7", "form": "power", "tail": "rational",
            "rounding": "floor", "error_budget_ulp": 3}"#,
    ),
    // Ranks of registers in every place, with one segment and with eight, and with a divider in both forms.
    (
        "small_deep",
        Strategy::Exhaustive,
        r#"{"name": "small_deep", "method": "hermite", "exponents": "1..=16", "input": "Q2.6",
            "output": "UQ1.7", "cut": "minimum", "rounding": "nearest_even", "pipelining":
            {"rom": true, "front_end": 1, "operands": true, "product": 1, "sum": true}}"#,
    ),
    (
        "small_lines_deep",
        Strategy::Exhaustive,
        r#"{"name": "small_lines_deep", "method": "minimax", "degree": 2, "segments": 8,
            "exponents": "1,2,5,16,40", "input": "Q2.9", "output": "UQ1.8", "cut": "balanced",
            "rounding": "toward_zero", "error_budget_ulp": 2, "pipelining":
            {"front_end": 1, "product": 1}}"#,
    ),
    (
        "small_tail_deep",
        Strategy::Exhaustive,
        r#"{"name": "small_tail_deep", "method": "hermite", "exponents": "1..=16", "input": "UQ1.7",
            "output": "UQ0.8", "form": "power", "tail": "rational", "rounding": "toward_zero",
            "error_budget_ulp": 2, "quotient_bits_per_stage": 1, "pipelining":
            {"rom": true, "front_end": 1, "operands": true, "product": 1, "sum": true}}"#,
    ),
    (
        "small_wait_deep",
        Strategy::Exhaustive,
        r#"{"name": "small_wait_deep", "method": "hermite", "exponents": "1..=16", "input": "Q2.7",
            "output": "UQ0.8", "form": "centred", "tail": "rational", "rounding": "floor",
            "error_budget_ulp": 3, "quotient_bits_per_stage": 8, "pipelining":
            {"rom": true, "operands": true, "sum": true}}"#,
    ),
];

/// A register slice at each end, every other handshake, and resets of all kinds: every address with every x, and random
/// cycles.
const CONTROLLED: [(&str, &str); 4] = [
    (
        "small_sliced",
        r#"{"name": "small_sliced", "method": "hermite", "exponents": "1..=16", "input": "Q2.6",
            "output": "UQ1.7", "cut": "minimum", "pipelining":
            {"rom": true, "product": 1, "ready_slice": "output"}, "reset": {"active": "low"}}"#,
    ),
    (
        "small_sliced_input",
        r#"{"name": "small_sliced_input", "method": "hermite", "exponents": "1..=16", "input": "Q2.6",
            "output": "UQ1.7", "cut": "minimum", "pipelining": {"ready_slice": "input"},
            "reset": {"kind": "asynchronous", "ready": true}}"#,
    ),
    (
        "small_enable",
        r#"{"name": "small_enable", "method": "hermite", "exponents": "1..=16", "input": "Q2.6",
            "output": "UQ1.7", "cut": "minimum", "handshake": "enable",
            "reset": {"kind": "asynchronous", "active": "low"}}"#,
    ),
    (
        "small_free",
        r#"{"name": "small_free", "method": "hermite", "exponents": "1..=16", "input": "Q2.6",
            "output": "UQ1.7", "cut": "minimum", "handshake": "none", "reset": {"ready": true}}"#,
    ),
];

/// Other degrees, numbers of segments and ranks than the presets have, compared like a preset.
const EXAMPLES: [(&str, &str); 4] = [
    ("parabolas", include_str!("../../../docs/examples/parabolas.json")),
    ("quartics", include_str!("../../../docs/examples/quartics.json")),
    ("compact_deep", include_str!("../../../docs/examples/compact_deep.json")),
    ("precise_deep", include_str!("../../../docs/examples/precise_deep.json")),
];

/// Scenes whose own hardware is compared like a preset: one that never leaves the epicentre, one of small exponents.
const SCENES: [&str; 2] = ["close_up", "low_exponents"];

/// Its c3 is 0 for every n, so it has a multiplier less. Only its netlist is looked at.
const TWO_MULTIPLIERS: &str = r#"{"name": "quadratic", "method": "quadratic", "exponents": "1..=16",
    "input": "UQ1.15", "output": "UQ1.8"}"#;

/// The pipeline beside a divider in one top module: another form, another depth.
const CENTRED: &str = include_str!("../../../docs/examples/compact_12_bit.json");

/// What was compared.
#[derive(Clone, Copy, Default)]
struct Totals {
    vectors: u64,
    cycles: u64,
    registers: u64,
    runs: u64,
}

impl std::ops::Add for Totals {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            vectors: self.vectors + other.vectors,
            cycles: self.cycles + other.cycles,
            registers: self.registers + other.registers,
            runs: self.runs + other.runs,
        }
    }
}

/// What is simulated.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Extent {
    Everything,
    Covering,
}

impl Extent {
    fn from_arguments() -> Result<Self, Failure> {
        let arguments: Vec<String> = std::env::args().skip(1).collect();
        match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
            [] => Ok(Self::Everything),
            ["--covering"] => Ok(Self::Covering),
            _ => failed(format!("cosimulate takes --covering or nothing, not {}", arguments.join(" "))),
        }
    }

    fn has_preset(self, name: &str) -> bool {
        self == Self::Everything || COVERING.contains(&name)
    }

    /// The simulators of a preset, scene or example.
    fn simulators(self, name: &str, all: &[Simulator]) -> Vec<Simulator> {
        if self == Self::Everything || name == COVERING[0] { all.to_vec() } else { without_older(all) }
    }

    /// Requests that each of two pipelines gets through AXI4-Stream.
    fn stream_results(self) -> u64 {
        if self == Self::Everything { 50_000 } else { 2_000 }
    }

    /// Of a list of scenes or examples.
    fn of<T>(self, list: &[T]) -> &[T] {
        if self == Self::Everything { list } else { &list[..1] }
    }
}

/// Icarus and the newer Verilator: the older one takes as long as both.
fn without_older(simulators: &[Simulator]) -> Vec<Simulator> {
    [&simulators[..1], &simulators[2..]].concat()
}

fn main() -> ExitCode {
    match Extent::from_arguments().and_then(run) {
        Ok(totals) if totals.vectors > 0 && totals.registers > 0 => {
            println!(
                "0 mismatches: {} runs, {} vectors, {} cycles, {} registers and results compared",
                totals.runs, totals.vectors, totals.cycles, totals.registers
            );
            ExitCode::SUCCESS
        }
        Ok(_) => {
            eprintln!("error: nothing was compared");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(extent: Extent) -> Result<Totals, Failure> {
    let simulators = simulators::all()?;
    let names: Vec<&str> = simulators.iter().map(|simulator| simulator.name.as_str()).collect();
    let releases = simulators::icarus_releases()?;
    println!("{}", names.join(", "));
    println!("{:<14} {:<18} {:>9} {:>10} {:>13}", "preset", "simulator", "vectors", "cycles", "compared");
    let presets = presets::ALL.par_iter().map(|preset| {
        let design = design(preset.json)?;
        // Planted faults want the RTL of every preset.
        let emitted = emit(&design, preset.name, Strategy::Mixed, VECTORS)?;
        if !extent.has_preset(preset.name) {
            return Ok(Totals::default());
        }
        if preset.name == "compact" {
            fusesoc::check(&emitted)?;
            fusesoc::check_dut(&design)?;
        }
        let simulators = extent.simulators(preset.name, &simulators);
        let total = everything(&emitted, preset.name, &simulators, Some(VERILATOR_CYCLES))?;
        flows(&emitted, preset.name, &releases)?;
        if extent == Extent::Everything {
            covered(&emitted, preset.name, &simulators)?;
        }
        Ok(total)
    });
    let scenes = extent.of(&SCENES).par_iter().map(|scene| {
        let design = specialised::of_paper(scene)?;
        let emitted = emit(&design, scene, Strategy::Mixed, VECTORS)?;
        everything(&emitted, scene, &extent.simulators(scene, &simulators), Some(SCENE_CYCLES))
    });
    let examples = extent.of(&EXAMPLES).par_iter().map(|&(name, json)| {
        let design = design(json)?;
        let emitted = emit(&design, name, Strategy::Mixed, VECTORS)?;
        everything(&emitted, name, &extent.simulators(name, &simulators), Some(SCENE_CYCLES))
    });
    let small = SMALL.par_iter().map(|&(name, strategy, json)| {
        let design = design(json)?;
        let emitted = emit(&design, name, strategy, 0)?;
        everything(&emitted, name, &without_older(&simulators), None)
    });
    let controlled = CONTROLLED.par_iter().map(|&(name, json)| {
        let design = design(json)?;
        let emitted = emit(&design, name, Strategy::Exhaustive, 0)?;
        in_control(&emitted, name, &without_older(&simulators))
    });
    let total: Totals = presets
        .chain(scenes)
        .chain(examples)
        .chain(small)
        .chain(controlled)
        .collect::<Result<Vec<_>, _>>()?
        .into_iter()
        .fold(Totals::default(), |sum, part| sum + part);
    let quadratic = design(TWO_MULTIPLIERS)?;
    parts(&emit(&quadratic, "quadratic", Strategy::Mixed, 1)?, "quadratic")?;
    let schlick = presets::find("schlick").map_or_else(|| failed("no preset schlick"), |preset| design(preset.json))?;
    let together = two_in_one::check([("bright", &quadratic), ("dull", &schlick)], &simulators)?;
    println!("{:<14} two configurations in one design {together:>20} vectors", "--prefix");
    let results = axis::check([("bright", &design(CENTRED)?), ("dull", &schlick)], extent.stream_results())?;
    println!("{:<14} two configurations through AXI4-Stream {results:>14} results", "--prefix");
    let in_source = in_source::check(&schlick, VECTORS, &simulators)?;
    println!("{:<14} {in_source:>53} vectors", "--rom-in-source");
    planted(&simulators[0])?;
    Ok(total)
}

fn parts(emitted: &Emitted<'_>, name: &str) -> Result<(), Failure> {
    let (multipliers, flip_flops) = netlist_parts::check(emitted)?;
    println!("{name:<14} netlist (Yosys): {multipliers} multipliers, {flip_flops} flip-flops");
    Ok(())
}

fn design(json: &str) -> Result<Design, Failure> {
    let config = Config::from_json(json).map_err(|error| Failure(error.to_string()))?;
    Design::new(config).map_err(|error| Failure(error.to_string()))
}

fn everything(
    emitted: &Emitted<'_>,
    name: &str,
    simulators: &[Simulator],
    random_cycles: Option<u64>,
) -> Result<Totals, Failure> {
    simulators::yosys_reads(&emitted.directory)?;
    readers::check(&emitted.directory).map_err(|error| Failure(format!("{name}: {error}")))?;
    wrappers::check(&emitted.directory, &Modules::default()).map_err(|error| Failure(format!("{name}: {error}")))?;
    let pass = wrappers::verilog_2005(&emitted.directory, emitted.design.datapath(), emitted.vectors);
    pass.map_err(|error| Failure(format!("{name}: {error}")))?;
    parts(emitted, name)?;
    let mut totals = Totals::default();
    for (index, simulator) in simulators.iter().enumerate() {
        let part = vectors(emitted, name, simulator)?;
        control(emitted, name, simulator)?;
        totals = totals + part;
        if !simulator.is_icarus() {
            simulator.lint(&emitted.directory)?;
        }
        if name == "small" {
            let images = rom_image::check(emitted, simulator)?;
            println!("{name:<14} {:<18} {images:>9} wrong ROM images", simulator.name);
        }
        // Icarus ends at once where Verilator goes on to the end of the time step.
        if index <= 1 {
            let waves = waves::compare(emitted, simulator)?;
            println!("{name:<14} waves (VCD, FST) {:>22} {:>13}", waves.edges, waves.values);
            totals.registers += waves.values;
        }
        // The long run is in the first Verilator; the others show that it is the same there.
        if let Some(long) = random_cycles {
            let cycles = if index == 1 { long } else { ICARUS_CYCLES };
            totals = totals + registers(emitted, name, simulator, cycles)?;
        }
    }
    Ok(totals)
}

/// What stands around the ranks: vectors with stalls, bubbles and resets, and random cycles with every register.
fn in_control(emitted: &Emitted<'_>, name: &str, simulators: &[Simulator]) -> Result<Totals, Failure> {
    simulators::yosys_reads(&emitted.directory)?;
    readers::check(&emitted.directory).map_err(|error| Failure(format!("{name}: {error}")))?;
    let each = |simulator: &Simulator| {
        control(emitted, name, simulator)?;
        Ok(vectors(emitted, name, simulator)? + registers(emitted, name, simulator, ICARUS_CYCLES)?)
    };
    simulators.iter().map(each).try_fold(Totals::default(), |sum, part: Result<Totals, Failure>| Ok(sum + part?))
}

/// `make icarus`, `control` and `waves`, as they are typed.
fn flows(emitted: &Emitted<'_>, name: &str, releases: &[Simulator]) -> Result<(), Failure> {
    for release in releases {
        let flow = release.flow(&emitted.directory);
        flow.map_err(|Failure(text)| Failure(format!("{name}, {text}")))?;
    }
    let names: Vec<&str> = releases.iter().map(|release| release.name.as_str()).collect();
    println!("{name:<14} make icarus, control, waves: {}", names.join(", "));
    Ok(())
}

/// What the default bundle reaches of the RTL.
fn covered(emitted: &Emitted<'_>, name: &str, simulators: &[Simulator]) -> Result<(), Failure> {
    let Some(newer) = simulators.last() else { return failed("no Verilator to measure coverage with") };
    let shares = coverage::check(emitted, newer).map_err(|error| Failure(format!("{name}: {error}")))?;
    let Shares { lines, toggles, beyond, registers } = shares;
    println!(
        "{name:<14} coverage: lines {} of {}, toggles {} of {}, {beyond} points beyond reach; registers {:.2} %",
        lines.0,
        lines.1,
        toggles.0,
        toggles.1,
        100.0 * registers
    );
    Ok(())
}

/// All vectors, once with and once without stalls, bubbles and resets.
fn vectors(emitted: &Emitted<'_>, name: &str, simulator: &Simulator) -> Result<Totals, Failure> {
    let mut totals = Totals::default();
    for plusargs in ["+seed=1", "+plain"] {
        let verdict = simulator.run(&emitted.directory, plusargs)?;
        if verdict.last != format!("PASS {} vectors", emitted.vectors) {
            return failed(format!("{name}, {}: {}", simulator.name, verdict.last));
        }
        totals = totals
            + Totals {
                vectors: emitted.vectors,
                cycles: verdict.count(" cycles"),
                registers: verdict.count(" values compared"),
                runs: 1,
            };
    }
    show(name, simulator, &totals);
    Ok(totals)
}

/// A corrupted vector must be found, in the answer's register or in an entry of the slice behind it.
fn control(emitted: &Emitted<'_>, name: &str, simulator: &Simulator) -> Result<(), Failure> {
    let verdict = simulator.run(&emitted.directory, "+expected=negative_control.mem")?;
    let wanted = format!("FAIL vector {}: ", emitted.control);
    let shown = ["clamp.intensity is ", "output_slice.spare is ", "output_slice.head is "];
    if verdict.last.starts_with(&wanted) && shown.iter().any(|register| verdict.last.contains(register)) {
        return Ok(());
    }
    failed(format!(
        "{name}, {}: the corrupted vector {} was not found: {}",
        simulator.name, emitted.control, verdict.last
    ))
}

/// Random cycles, every register of which is compared with the clocked pipeline's.
fn registers(emitted: &Emitted<'_>, name: &str, simulator: &Simulator, cycles: u64) -> Result<Totals, Failure> {
    let mut command = simulator.testbench(&emitted.directory);
    command.arg(format!("+registers={cycles}")).stdout(Stdio::piped());
    let mut child = command.spawn().map_err(|error| Failure(format!("cannot run {}: {error}", simulator.name)))?;
    let Some(output) = child.stdout.take() else {
        return failed("no output to compare");
    };
    let agreement = compare(emitted.design.datapath(), BufReader::with_capacity(1 << 20, output))
        .map_err(|error| Failure(format!("{name}, {}: {error}", simulator.name)))?;
    let status = child.wait().map_err(|error| Failure(error.to_string()))?;
    if !status.success() || agreement.cycles != cycles {
        return failed(format!(
            "{name}, {}: {} of {cycles} random cycles were compared",
            simulator.name, agreement.cycles
        ));
    }
    for (what, count) in [("bubble", agreement.bubbles), ("reset", agreement.resets), ("result", agreement.results)] {
        if count < cycles / 1000 {
            return failed(format!("{name}: only {count} cycles with a {what} in {cycles}"));
        }
    }
    // Without a handshake nothing waits.
    let stalls_are_right = match emitted.design.datapath().control().handshake {
        Handshake::ValidReady | Handshake::Enable => agreement.stalls >= cycles / 1000,
        Handshake::None => agreement.stalls == 0,
    };
    if !stalls_are_right {
        return failed(format!("{name}: {} cycles with a stall in {cycles}", agreement.stalls));
    }
    let totals = Totals { vectors: 0, cycles, registers: agreement.registers, runs: 1 };
    show(name, simulator, &totals);
    Ok(totals)
}

fn show(name: &str, simulator: &Simulator, totals: &Totals) {
    let Totals { vectors, cycles, registers, .. } = totals;
    println!("{name:<14} {:<18} {vectors:>9} {cycles:>10} {registers:>13}", simulator.name);
}

/// Every planted fault must be reported, and named.
fn planted(simulator: &Simulator) -> Result<(), Failure> {
    println!("planted faults, in {}:", simulator.name);
    let verdicts: Vec<Result<String, Failure>> =
        FAULTS.par_iter().enumerate().map(|(index, fault)| find(simulator, index, fault)).collect();
    for (fault, verdict) in FAULTS.iter().zip(&verdicts) {
        match verdict {
            Ok(verdict) => println!("  {} ({}): {}", fault.name, fault.preset, brief(verdict)),
            Err(failure) => println!("  error: {failure}"),
        }
    }
    let good = verdicts.iter().filter(|verdict| verdict.is_ok()).count();
    let counts = format!("{good} of {} planted faults were reported with their stage", FAULTS.len());
    println!("{counts}");
    if good < FAULTS.len() { failed(counts) } else { Ok(()) }
}

fn find(simulator: &Simulator, index: usize, fault: &Fault) -> Result<String, Failure> {
    let preset = simulators::repository().join("target/rtl").join(fault.preset);
    let directory = copy(&preset, &format!("fault-{index}"))?;
    fault.plant(&directory)?;
    let verdict = simulator.run(&directory, "+seed=1")?;
    if verdict.passed() {
        return failed(format!("the planted fault \"{}\" was not found", fault.name));
    }
    if !verdict.last.contains(fault.named) {
        return failed(format!(
            "the planted fault \"{}\" should be in {}, and was reported as: {}",
            fault.name, fault.named, verdict.last
        ));
    }
    Ok(verdict.last)
}

/// What follows the vector's own description.
fn brief(verdict: &str) -> &str {
    verdict.split_once(", cycle ").map_or(verdict, |(_, rest)| rest)
}
