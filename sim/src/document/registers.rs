//! Every register: where it stands, what it can hold, and why it is as wide as it is.

use hw_model::datapath::reach::{PolynomialReach, TailReach};
use hw_model::datapath::{Datapath, Register};
use hw_model::design::{Design, Share};
use hw_model::format::QFormat;

use super::reasons::Reasons;
use super::table::Table;
use super::words::value;

/// What a register can hold.
#[derive(Debug, Clone)]
pub(super) struct Held {
    /// The least value, as the register's bits.
    pub(super) least: i64,
    /// The greatest value, as the register's bits.
    pub(super) greatest: i64,
    /// The exponent of the row that reaches furthest from 0, where one is known.
    pub(super) furthest: Option<f64>,
    /// How the two are known.
    pub(super) known: Known,
}

/// How a range is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Known {
    /// Every value between is allowed by the format or the encoding.
    Format,
    /// Evaluated in integers over every row and every x.
    Exact,
    /// A proved bound, which no input need reach.
    Bound,
}

/// A design with what was found out about it.
pub(super) struct Facts<'a> {
    pub(super) design: &'a Design,
    pub(super) polynomial: Option<PolynomialReach>,
    pub(super) tail: Option<TailReach>,
    pub(super) shares: Vec<Share>,
}

impl<'a> Facts<'a> {
    /// Computes the reach of every register and its share of the error.
    pub(super) fn new(design: &'a Design) -> Self {
        let datapath = design.datapath();
        Self {
            design,
            polynomial: datapath.polynomial_reach(),
            tail: datapath.tail_reach(),
            shares: design.error_shares(),
        }
    }

    fn datapath(&self) -> &'a Datapath {
        self.design.datapath()
    }

    /// What a register holds in a rank that computes it.
    fn held(&self, rank: usize, register: &Register) -> Held {
        let reach = match (register.name, &self.polynomial, &self.tail) {
            ("v", Some(reach), _) => Some(reach.v),
            ("t1", Some(reach), _) => Some(reach.lines[0]),
            ("t2", Some(reach), _) => Some(reach.lines[1]),
            ("t3", Some(reach), _) => Some(reach.lines[2]),
            ("tail_x", _, Some(reach)) => Some(reach.x),
            ("divisor", _, Some(reach)) => Some(reach.divisor),
            ("remainder", _, Some(reach)) if rank == 2 => Some(reach.first_remainder),
            ("digits", _, Some(reach)) if rank == self.last_digits() => Some(reach.quotient),
            _ => None,
        };
        if let Some(reach) = reach {
            let (least, greatest) = (reach.least, reach.greatest);
            let furthest = if greatest.bits >= -least.bits { greatest } else { least };
            let exponent = self.design.rows()[furthest.address as usize].exponent;
            let known = Known::Exact;
            return Held {
                least: least.bits,
                greatest: greatest.bits,
                furthest: Some(exponent),
                known,
            };
        }
        self.of_the_rest(register)
    }

    fn of_the_rest(&self, register: &Register) -> Held {
        let format = register.format;
        let held = |least, greatest, known| Held { least, greatest, furthest: None, known };
        let fields = self.design.rom().layout().fields();
        if let Some(field) = fields.iter().find(|field| field.name.name() == register.name) {
            let bits = || self.design.rom().rows().iter().map(|row| row.get(field.name));
            let ends = bits().min().zip(bits().max());
            return ends.map_or_else(
                || held(format.min_bits(), format.max_bits(), Known::Format),
                |(least, greatest)| held(least, greatest, Known::Exact),
            );
        }
        match (register.name, &self.tail) {
            ("remainder", Some(reach)) => held(0, reach.divisor.greatest.bits - 1, Known::Bound),
            ("region", _) => held(0, self.greatest_region(), Known::Format),
            // Where the polynomial's greatest value was not found, only the clamp's bound is known.
            ("intensity", _) if self.polynomial.is_none() && self.datapath().stages().is_some() => {
                held(0, self.datapath().output_one(), Known::Bound)
            }
            ("intensity", _) => held(0, self.greatest_intensity(), Known::Exact),
            _ => held(format.min_bits(), format.max_bits(), Known::Format),
        }
    }

    fn greatest_region(&self) -> i64 {
        if self.tail.is_some() { 2 } else { 1 }
    }

    /// Both parts rise with what they are made from.
    fn greatest_intensity(&self) -> i64 {
        let datapath = self.datapath();
        let greatest = datapath.front_end().greatest;
        let tail = self.tail.map(|reach| reach.quotient.greatest);
        let tail = tail.and_then(|place| Some((place.address, place.x?)));
        let rows = 0..datapath.rom().depth() as u32;
        let ends = rows.map(|address| (address, greatest)).chain(tail);
        let line = self.polynomial.map(|reach| reach.lines[2].greatest);
        let line = line.and_then(|place| Some((place.address, place.x?)));
        let intensity = |(address, x)| datapath.evaluate(address, x).intensity;
        ends.chain(line).map(intensity).max().unwrap_or(0)
    }

    /// The rank of the last quotient bits.
    pub(super) fn last_digits(&self) -> usize {
        2 + self.datapath().divider().map_or(0, |divider| divider.digit_stages() as usize)
    }
}

/// A register in a row of ranks that say the same of it.
struct Entry {
    register: Register,
    first: usize,
    /// The last rank that carries it along.
    last: usize,
    held: Held,
}

fn entries(facts: &Facts<'_>) -> Vec<Entry> {
    let datapath = facts.datapath();
    let mut entries: Vec<Entry> = Vec::new();
    for rank in 0..datapath.rank_count() {
        for register in datapath.registers(rank) {
            let open = entries.iter_mut().rfind(|entry| entry.register.name == register.name);
            let held = facts.held(rank, &register);
            match open {
                Some(entry) if !register.computed => entry.last = rank,
                // Quotient bits come in rank by rank; what is known stays the same.
                Some(entry) if entry.last + 1 == rank && entry.held.same(&held) => {
                    entry.last = rank
                }
                _ => entries.push(Entry { register, first: rank, last: rank, held }),
            }
        }
    }
    entries
}

impl Held {
    fn same(&self, other: &Self) -> bool {
        (self.least, self.greatest, self.known) == (other.least, other.greatest, other.known)
            && self.known != Known::Exact
    }
}

/// The registers with what they can hold and why they are as wide as they are.
pub(super) fn registers(facts: &Facts<'_>) -> Table {
    let mut table = Table::new(&[
        "register",
        "ranks",
        "format",
        "width",
        "least … greatest, bits",
        "as numbers",
        "known",
        "rounded there",
        "why this width",
    ]);
    let reasons = Reasons::new(facts);
    for Entry { register, first, last, held } in entries(facts) {
        let format = register.format;
        let known = match held.known {
            Known::Format => "encoding",
            Known::Exact => "exact",
            Known::Bound => "bound",
        };
        table.row([
            format!("`{}`", register.name),
            span(first, last),
            format.to_string(),
            format.width().to_string(),
            format!("{} … {}", minus(held.least), held.greatest),
            numbers(&held, format),
            known.to_owned(),
            reasons.rounded(first, register.name),
            reasons.width(first, &register, &held),
        ]);
    }
    table
}

fn span(first: usize, last: usize) -> String {
    if first == last { first.to_string() } else { format!("{first}–{last}") }
}

fn minus(bits: i64) -> String {
    bits.to_string().replace('-', "−")
}

fn numbers(held: &Held, format: QFormat) -> String {
    if format.fraction_bits() == 0 {
        return String::new();
    }
    let range = format!("{} … {}", value(held.least, format), value(held.greatest, format));
    held.furthest.map_or_else(|| range.clone(), |n| format!("{range} (furthest at n = {n})"))
}
