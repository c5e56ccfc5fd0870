//! What a configuration does not use is not in its netlist, and what the reference counts is.

use std::path::Path;
use std::process::Command;

use hw_model::datapath::Datapath;
use hw_model::datapath::front_end::Variable;
use hw_model::handshake::ReadySlice;
use hw_model::registers::Register;
use hw_model::rom::Place;

use super::workspace::Emitted;
use super::{Failure, failed};

/// Where Yosys writes what it counts.
const COUNTS: &str = "parts";

/// Something to be counted: what it is, how Yosys selects it, and how many there must be.
type Part = (&'static str, &'static str, u64);

/// Parts of the sources as they are elaborated: nothing is optimised away yet, so a part that is
/// instantiated and not used is found.
fn elaborated(datapath: &Datapath) -> Vec<Part> {
    let stages = datapath.degree() as u64;
    let divider = datapath.divider();
    let tails = u64::from(divider.is_some());
    let digit_stages = divider.map_or(0, |divider| u64::from(divider.digit_stages()));
    vec![
        ("blysk_stage", "t:*blysk_stage", stages + tails),
        ("blysk_tail", "t:*blysk_tail", tails),
        ("blysk_tail_digits", "t:*blysk_tail_digits", digit_stages),
    ]
}

/// Cells of the flattened netlist, unused ones removed.
fn flat(datapath: &Datapath) -> Vec<Part> {
    let formats = datapath.formats();
    let polynomial = formats.polynomial.as_ref();
    let clamps_x = formats.input.max_bits() > datapath.front_end().greatest;
    let clamps_polynomial = datapath.last_exceeds_one();
    let digits = datapath.divider().map_or(0, |divider| u64::from(divider.digit_count));
    let shift = matches!(datapath.front_end().variable, Some(Variable::U { .. }))
        && (0..datapath.segment_count()).any(|segment| constant(datapath, Register::Shift(segment)).is_none());
    let greater = [clamps_x, clamps_polynomial, digits > 0];
    vec![
        ("comparisons >= (cut, quotient bits)", "t:$ge", u64::from(polynomial.is_some()) + digits),
        ("comparisons > (x, polynomial, quotient)", "t:$gt", greater.into_iter().map(u64::from).sum::<u64>()),
        ("shifts by e", "t:$shl", u64::from(shift)),
    ]
}

/// Flip-flops, bit by bit, as the sources declare them: the registers of every rank and its valid flag, and those of a
/// register slice.
fn flip_flops(datapath: &Datapath) -> Part {
    let width = |rank, name, width: u32| {
        // Of the status rank 0 has what it knows: no_word.
        if (rank, name) == (0, Register::Status) { 1 } else { u64::from(width) }
    };
    let ranks = 0..datapath.rank_count();
    let bits = ranks.map(|rank| {
        let registers = datapath.registers(rank).into_iter();
        1 + registers.map(|held| width(rank, held.register, held.format.width())).sum::<u64>()
    });
    ("flip-flops", "t:$_*DFF*", bits.sum::<u64>() + u64::from(slice_bits(datapath)))
}

/// Both entries of a register slice with their flags, and what each rank does in the next cycle where that is known.
fn slice_bits(datapath: &Datapath) -> u32 {
    let formats = datapath.formats();
    match datapath.control().slice {
        None => 0,
        Some(ReadySlice::Input) => 2 * (1 + datapath.rom().address_width() + formats.input.width()),
        Some(ReadySlice::Output) => {
            2 * (1 + datapath.status_width() + formats.output.width()) + datapath.rank_count() as u32
        }
    }
}

/// A multiplier for each line whose multiplicand is not known: 0 and powers of two take none, nor does one bit
/// without a sign.
fn multipliers(datapath: &Datapath) -> Part {
    let one_bit = |field| {
        let field = datapath.rom().layout().field(field);
        field.is_some_and(|field| field.format.width() == 1 && !field.format.is_signed())
    };
    let needed = |field| !one_bit(field) && constant(datapath, field).is_none_or(|bits| bits.count_ones() > 1);
    let degree = datapath.degree();
    // A product in pieces has one for each of them.
    let of_line = |line| {
        let registers = datapath.registers(datapath.rank_of(Register::Partial(line, 0))).into_iter();
        let pieces = registers.filter(|held| matches!(held.register, Register::Partial(of, _) if of == line));
        pieces.count().max(1) as u64
    };
    let first = (degree > 0 && needed(Register::C(0, degree))).then_some(1);
    let tail = datapath.divider().and_then(|_| needed(Register::TailB).then_some(0));
    let lines = first.into_iter().chain(2..=degree).chain(tail);
    ("multipliers", "t:$mul", lines.map(of_line).sum())
}

/// The bits of a field that is the same in every row.
fn constant(datapath: &Datapath, field: Register) -> Option<i64> {
    match datapath.rom().layout().field(field)?.place {
        Place::Constant { bits } => Some(bits),
        Place::Stored { .. } => None,
    }
}

/// Lets Yosys count, and compares. Returns multipliers and flip-flops.
///
/// # Errors
/// With every part of which there are more or fewer than the design needs.
pub fn check(emitted: &Emitted<'_>) -> Result<(u64, u64), Failure> {
    let datapath = emitted.design.datapath();
    let files = hw_model::rtl::SOURCES.map(|(name, _)| name).join(" ");
    let (multipliers, flip_flops) = (multipliers(datapath), flip_flops(datapath));
    let steps = [
        (format!("read_verilog -sv blysk_pkg.sv {files}; hierarchy -top blysk; proc"), elaborated(datapath)),
        ("flatten; opt_clean -purge".to_owned(), flat(datapath)),
        // Constants are folded for this one: a product with 0 is no multiplier.
        ("opt_expr; opt_clean -purge".to_owned(), vec![multipliers]),
        // Back to the sources, as folding also merges and drops registers.
        (
            format!(
                "design -reset; read_verilog -sv blysk_pkg.sv {files}; hierarchy -top blysk; proc; \
                 flatten; opt_clean -purge; simplemap t:$*dff*"
            ),
            vec![flip_flops],
        ),
    ];
    let script: Vec<String> = steps
        .iter()
        .flat_map(|(commands, parts)| {
            let counts = parts.iter().map(|(_, select, _)| format!("tee -q -a {COUNTS} select -count {select}"));
            std::iter::once(commands.clone()).chain(counts)
        })
        .collect();
    let parts: Vec<Part> = steps.into_iter().flat_map(|(_, parts)| parts).collect();
    let found = count(&emitted.directory, &script.join("; "))?;
    if found.len() != parts.len() {
        return failed(format!("Yosys counted {} of {} parts", found.len(), parts.len()));
    }
    let wrong: Vec<String> = parts
        .iter()
        .zip(&found)
        .filter(|((_, _, wanted), found)| wanted != *found)
        .map(|((what, _, wanted), found)| format!("{found} {what}, not {wanted}"))
        .collect();
    if !wrong.is_empty() {
        return failed(format!("{}: {}", emitted.directory.display(), wrong.join("; ")));
    }
    Ok((multipliers.2, flip_flops.2))
}

fn count(directory: &Path, script: &str) -> Result<Vec<u64>, Failure> {
    let path = directory.join(COUNTS);
    // Yosys adds to it.
    std::fs::write(&path, "").map_err(|error| Failure(error.to_string()))?;
    let output = Command::new("yosys").args(["-q", "-p", script]).current_dir(directory).output();
    let output = output.map_err(|error| Failure(format!("cannot run yosys: {error}")))?;
    if !output.status.success() {
        return failed(String::from_utf8_lossy(&[output.stdout, output.stderr].concat()));
    }
    let text = std::fs::read_to_string(&path).map_err(|error| Failure(error.to_string()))?;
    let number = |line: &str| line.strip_suffix(" objects.")?.trim().parse().ok();
    Ok(text.lines().filter_map(number).collect())
}
