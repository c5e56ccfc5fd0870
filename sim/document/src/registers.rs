//! Every register: where it stands, what it can hold, and why it is as wide as it is.

use hw_model::datapath::RankRegister;
use hw_model::format::QFormat;

use super::facts::{Facts, Held, Known};
use super::reasons::Reasons;
use super::table::Table;
use super::words::value;

/// A register in a row of ranks that say the same of it.
struct Entry {
    register: RankRegister,
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
            let open = entries.iter_mut().rfind(|entry| entry.register.register == register.register);
            let held = facts.held(rank, &register);
            match open {
                Some(entry) if !register.computed => entry.last = rank,
                // Quotient bits come in rank by rank; what is known stays the same.
                Some(entry) if entry.last + 1 == rank && entry.held.same(&held) => entry.last = rank,
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
            format!("`{}`", register.name()),
            span(first, last),
            format.to_string(),
            format.width().to_string(),
            format!("{} … {}", minus(held.least), held.greatest),
            numbers(&held, format),
            known.to_owned(),
            reasons.rounded(first, register.register),
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
