//! What was left out: every part before and after, and why it could go.

use hw_model::datapath::Datapath;
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::rom::Place;
use serde::Serialize;

use super::derive::AskedRow;
use hw_model::registers::Register;
use hw_model::stated::{Hardware, ORDER, name, of_design};

/// A part, before and after.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// What it is, with its unit.
    pub part: String,
    /// How much of it the source has.
    pub before: u64,
    /// In the specialised hardware.
    pub after: u64,
    /// Why it could go, or why it stays.
    pub why: String,
}

/// The table of the two.
#[must_use]
pub fn left_out(source: &Design, specialised: &Design, rows: &[AskedRow]) -> Vec<LeftOut> {
    let both = [source, specialised];
    let mut list = Vec::new();
    let mut add = |part: &str, of: &dyn Fn(&Design) -> u64, why: String| {
        let [before, after] = both.map(of);
        list.push(LeftOut { part: part.to_owned(), before, after, why });
    };
    let rom = |design: &Design| design.rom().depth() as u64;
    let shared = rows.iter().any(|row| row.serving != row.demand.exponent);
    let of = if shared { "rows that serve the scene:" } else { "the scene has" };
    add("ROM words", &rom, format!("{of} n = {}", specialised.rom().exponents()));
    let address = |design: &Design| u64::from(design.rom().address_width());
    add("address bits", &address, "for every word, and one more for \"no word\"".to_owned());
    let hardware = |design: &Design| Hardware::of(design, &of_design(design));
    add("ROM bits", &|design| hardware(design).rom_bits, "words times the bits of a word".to_owned());
    add("divider ranks", &|design| divider_ranks(design.datapath()), tail_reason(source, specialised, rows));
    add("compare t3 with 1", &|design| compares(design.datapath()), clamp_reason(source, specialised));
    add("multipliers", &|design| multipliers(design), multiplier_reason(source, specialised));
    let bits = |design: &Design| hardware(design).multiplier_bits;
    add("multiplier bits", &bits, "both operands' widths, multiplied, summed".to_owned());
    let registers = |design: &Design| design.datapath().register_bits();
    add("register bits", &registers, "of all ranks, as the vectors have them".to_owned());
    let latency = |design: &Design| design.datapath().latency() as u64;
    add("latency, cycles", &latency, "the longer of polynomial and divider".to_owned());
    let input = |design: &Design| u64::from(design.config().input.width());
    let outside = if specialised.datapath().front_end().guarded {
        "stay: an x outside must be seen to be refused"
    } else {
        "stay: the same x comes in"
    };
    add("x bits", &input, outside.to_owned());
    let output = |design: &Design| u64::from(design.config().output.width());
    add("intensity bits", &output, output_reason(source, specialised));
    list.extend(formats(source, specialised));
    list
}

/// The registers that can be stated, by their formats.
fn formats(source: &Design, specialised: &Design) -> Vec<LeftOut> {
    let [before, after] = [source, specialised].map(of_design);
    let width = |format: Option<QFormat>| u64::from(format.map_or(0, QFormat::width));
    let row = |register: Register| {
        let (was, is) = (before[register]?, after[register]);
        let why = match is {
            None => "its part is left out".to_owned(),
            Some(is) if is == was => format!("stays {was}"),
            Some(is) => format!("{was} to {is}: what rows and domain take"),
        };
        let part = format!("width of {}", name(register));
        Some(LeftOut { part, before: width(Some(was)), after: width(is), why })
    };
    ORDER.into_iter().filter_map(row).collect()
}

fn divider_ranks(datapath: &Datapath) -> u64 {
    datapath.divider_ranks() as u64
}

fn compares(datapath: &Datapath) -> u64 {
    u64::from(datapath.last_exceeds_one())
}

/// A multiplier for each line whose multiplicand has two bits or more that are not known; one bit is an AND.
fn multipliers(design: &Design) -> u64 {
    let datapath = design.datapath();
    let formats = datapath.formats();
    let needed = |name: Register, format: QFormat| {
        let known = datapath.rom().layout().field(name).map(|field| field.place);
        let power = matches!(known, Some(Place::Constant { bits }) if bits.count_ones() <= 1);
        u64::from(!power && format.width() > 1)
    };
    let polynomial = formats.polynomial.as_ref().map_or(0, |f| {
        let later = (2..=f.degree()).map(|stage| u64::from(f.multiplicand(stage).width() > 1));
        needed(Register::C(0, f.degree()), f.multiplicand(1)) + later.sum::<u64>()
    });
    polynomial + formats.tail.as_ref().map_or(0, |f| needed(Register::TailB, f.b))
}

/// Status, region, handshake and all.
fn tail_reason(source: &Design, specialised: &Design, rows: &[AskedRow]) -> String {
    if source.datapath().divider().is_none() {
        return "there was none".to_owned();
    }
    if specialised.datapath().divider().is_none() {
        return "no x of the domain lies below its row's cut".to_owned();
    }
    let ulp = source.config().input.ulp();
    let below = rows.iter().filter(|row| row.least < row.cut);
    let said = below.map(|row| {
        let [least, cut] = [row.least, row.cut].map(|bits| bits as f64 * ulp);
        format!("n = {} asks x from {least:.5}, its cut is {cut:.5}", row.demand.exponent)
    });
    let said: Vec<String> = said.take(2).collect();
    if said.is_empty() { "it alone answers".to_owned() } else { format!("stays: {}", said.join("; ")) }
}

fn clamp_reason(source: &Design, specialised: &Design) -> String {
    let [before, after] = [source, specialised].map(|design| compares(design.datapath()));
    match (before, after) {
        (0, _) => "there was none".to_owned(),
        (_, 0) => "t3 never passes 1 at any x of the domain".to_owned(),
        _ => "stays: formats or values of t3 pass 1".to_owned(),
    }
}

fn multiplier_reason(source: &Design, specialised: &Design) -> String {
    if multipliers(source) == multipliers(specialised) {
        return "every line keeps its own".to_owned();
    }
    let mut gone = Vec::new();
    let [before, after] = [source, specialised].map(|design| design.datapath().formats());
    if before.tail.is_some() && after.tail.is_none() {
        gone.push("the divider's");
    }
    if after.polynomial.as_ref().is_some_and(|f| f.multiplicand(1).width() == 1) {
        gone.push("c3·v, as c3 has one bit");
    }
    if after.tail.as_ref().is_some_and(|f| f.b.width() == 1) {
        gone.push("B·x, as B has one bit");
    }
    format!("without {}", if gone.is_empty() { "those by constants".to_owned() } else { gone.join(", ") })
}

fn output_reason(source: &Design, specialised: &Design) -> String {
    let [before, after] = [source, specialised].map(|design| design.config().output);
    if before == after {
        "stay: the same bits go out".to_owned()
    } else {
        format!("{before} to {after}, as codes allow")
    }
}
