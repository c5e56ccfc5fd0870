//! The longest paths of a data path, part by part, with ranks of registers where a configuration puts them.

use crate::datapath::Datapath;
use crate::datapath::front_end::Variable;
use crate::handshake::{Handshake, ReadySlice};
use crate::pipelining::Pipelining;
use crate::registers::Register;
use crate::rom::Place;

use super::delays::Delays;

/// What lies between two ranks of registers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Path {
    /// The parts that it leads through, in their order.
    pub parts: Vec<String>,
    /// How long it takes, in nanoseconds, registers at both ends included.
    pub ns: f64,
}

impl Path {
    /// The clock that it allows, in MHz.
    #[must_use]
    pub fn mhz(&self) -> f64 {
        1e3 / self.ns
    }

    /// In words: `multiplier of stage 1, sum of stage 1`.
    #[must_use]
    pub fn words(&self) -> String {
        self.parts.join(", ")
    }
}

/// A path that is being laid: parts are added until a register ends it.
struct Trail<'a> {
    delays: &'a Delays,
    done: Vec<Path>,
    parts: Vec<String>,
    ns: f64,
}

impl Trail<'_> {
    fn part(&mut self, name: impl Into<String>, ns: f64) {
        if ns > 0.0 {
            self.parts.push(name.into());
            self.ns += ns;
        }
    }

    /// A register, where there is one.
    fn register(&mut self, there: bool) {
        if there && !self.parts.is_empty() {
            let ns = self.delays.register + std::mem::take(&mut self.ns);
            self.done.push(Path { parts: std::mem::take(&mut self.parts), ns });
        }
    }
}

/// Every path of a data path, in the order of the ranks that they end in.
#[must_use]
pub fn paths(datapath: &Datapath, delays: &Delays) -> Vec<Path> {
    let pipelining = datapath.pipelining();
    let mut trail = Trail { delays, done: Vec::new(), parts: Vec::new(), ns: 0.0 };
    head(datapath, pipelining, &mut trail);
    for line in 1..=datapath.degree() {
        multiply_add(datapath, pipelining, line, &mut trail);
    }
    if let Some(divider) = datapath.divider() {
        multiply_add(datapath, pipelining, 0, &mut trail);
        digits(datapath, divider.digits_per_stage, &mut trail);
    }
    clamp(datapath, &mut trail);
    ready(datapath, pipelining, &mut trail);
    trail.done
}

/// The longest of them.
#[must_use]
pub fn longest(paths: Vec<Path>) -> Option<Path> {
    paths.into_iter().max_by(|a, b| a.ns.total_cmp(&b.ns))
}

/// From the ROM's memory to the variable.
fn head(datapath: &Datapath, pipelining: &Pipelining, trail: &mut Trail<'_>) {
    let delays = trail.delays;
    let segments = datapath.segment_count() as u32;
    let x = datapath.tail_x_format().width();
    trail.part("the ROM's memory", delays.memory(pipelining.rom));
    trail.register(pipelining.rom);
    let subtraction = match datapath.front_end().variable {
        Some(Variable::U { .. }) => delays.adder(x),
        _ => 0.0,
    };
    let cut = pipelining.front_end > 0;
    // The subtraction stands beside the comparisons, where what x is taken from does not wait for them: with one
    // segment it is 1, and before a rank there is one subtraction for each segment.
    let beside = cut || segments == 1;
    trail.part("comparisons of x", (delays.adder(x) + delays.lut).max(if beside { subtraction } else { 0.0 }));
    trail.register(cut);
    let choice = f64::from(segments.next_power_of_two().trailing_zeros()) * delays.lut;
    trail.part("choice of the segment", choice);
    if !beside {
        trail.part("subtraction of x", subtraction);
    }
    let (shift, rounding) = shift(datapath);
    trail.part("shift", f64::from(shift) * delays.lut);
    trail.part(
        "rounding of v",
        if rounding { delays.adder(datapath.formats().polynomial.map_or(1, |p| p.v.width())) } else { 0.0 },
    );
    // Zero where another part answers.
    trail.part("gate of v", delays.lut);
    trail.register(true);
}

/// Levels of the shift, and whether it is rounded.
fn shift(datapath: &Datapath) -> (u32, bool) {
    let Some(Variable::U { drop, .. }) = datapath.front_end().variable else { return (0, false) };
    let fields = datapath.rom().layout().fields();
    let stored = fields.iter().find(|field| field.name == Register::Shift(0));
    let bits =
        stored.filter(|field| matches!(field.place, Place::Stored { .. })).map_or(0, |field| field.format.width());
    (bits, drop > 0)
}

/// A stage of the polynomial, or the divisor's for line 0.
fn multiply_add(datapath: &Datapath, pipelining: &Pipelining, line: usize, trail: &mut Trail<'_>) {
    let Some([multiplicand, variable, result]) = datapath.line_widths(line) else { return };
    let delays = trail.delays;
    let of = |part: &str| match line {
        0 => format!("{part} of the divisor"),
        _ => format!("{part} of stage {line}"),
    };
    let pieces_end = pipelining.product > 1;
    let product_ends = pipelining.product > 0 && delays.pieces(multiplicand, variable) == 1;
    trail.part(of("multiplier"), delays.partial_products(multiplicand, pieces_end || product_ends));
    trail.register(pieces_end);
    trail.part(of("sum of the pieces"), delays.sum_of_pieces(multiplicand, variable));
    trail.register(pipelining.product > 0);
    trail.part(of("sum"), delays.adder(multiplicand + variable));
    trail.register(pipelining.sum);
    trail.part(of("rounding"), delays.adder(result));
    trail.register(true);
}

/// A rank of quotient bits: each compares, subtracts and chooses.
fn digits(datapath: &Datapath, quotient_bits: u32, trail: &mut Trail<'_>) {
    let delays = trail.delays;
    let divisor = datapath.formats().tail.map_or(1, |tail| tail.divisor.width());
    let each = delays.adder(divisor) + delays.lut;
    trail.part(format!("{quotient_bits} quotient bits"), f64::from(quotient_bits) * each);
    trail.register(true);
}

/// The last rank.
fn clamp(datapath: &Datapath, trail: &mut Trail<'_>) {
    let delays = trail.delays;
    let polynomial = datapath.formats().polynomial.map_or(0, |formats| formats.last().width());
    let quotient = datapath.formats().tail.map_or(0, |formats| formats.digits.width());
    trail.part("clamp", delays.adder(polynomial.max(quotient)) + 2.0 * delays.lut);
    trail.register(true);
}

/// From the ports or the valid flags of all ranks, or from what is known of them a cycle ahead, to the enables.
fn ready(datapath: &Datapath, pipelining: &Pipelining, trail: &mut Trail<'_>) {
    let delays = trail.delays;
    let ranks = datapath.rank_count() as u32;
    // Four inputs a level.
    let levels = f64::from((ranks + 1).next_power_of_two().trailing_zeros().div_ceil(2));
    if datapath.control().handshake != Handshake::ValidReady {
        trail.part("enables of a rank", delays.lut + delays.enable);
    } else if pipelining.ready_slice == Some(ReadySlice::Output) {
        trail.part("ready, a cycle ahead", (1.0 + levels) * delays.lut);
        trail.register(true);
        trail.part("enables of a rank", delays.lut + delays.enable);
    } else {
        trail.part("ready through all ranks to their enables", (1.0 + levels) * delays.lut + delays.enable);
    }
    trail.register(true);
}
