//! Ports, parameters, status bits, and the ROM.

use hw_model::config::Cut;
use hw_model::datapath::{Datapath, Status};
use hw_model::design::Design;
use hw_model::quantise::decimal;
use hw_model::registers::Register;
use hw_model::rom::Place;
use vectors::rtl::reset_port;

use super::table::Table;
use super::words::{ORDINALS, literal, value};

/// Every port of module `blysk`.
pub(super) fn ports(datapath: &Datapath) -> Table {
    let formats = datapath.formats();
    let mut table = Table::new(&["port", "direction", "width", "format", "meaning"]);
    let mut row = |name: &str, direction: &str, width: u32, format: &str, meaning: &str| {
        let cells = [format!("`{name}`"), direction.to_owned(), width.to_string()];
        let [name, direction, width] = cells;
        table.row([name, direction, width, format.to_owned(), meaning.to_owned()]);
    };
    row("clk_i", "in", 1, "", "clock; everything happens at its rising edge");
    let reset = datapath.control().reset;
    let kind = if reset.is_asynchronous() { "asynchronous" } else { "synchronous" };
    let level = if reset.is_active_low() { "low" } else { "high" };
    row(reset_port::name(&reset), "in", 1, "", &format!("reset, {kind}, active {level}"));
    row("in_valid_i", "in", 1, "", "`address_i` and `x_i` are a request");
    row("in_ready_o", "out", 1, "", "the request is taken at this edge, if there is one");
    let address = datapath.rom().address_width();
    row("address_i", "in", address, "integer", "the ROM word of the exponent n; see the ROM map");
    let (input, output) = (formats.input, formats.output);
    row("x_i", "in", input.width(), &input.to_string(), "x = cos γ");
    row("out_valid_o", "out", 1, "", "`intensity_o` and `status_o` are a result");
    row("out_ready_i", "in", 1, "", "the result is taken at this edge, if there is one");
    row("intensity_o", "out", output.width(), &output.to_string(), "the highlight, near xⁿ, 0 to 1");
    row("status_o", "out", datapath.status_width(), "flags", "see the status bits");
    table
}

/// The bits of the status.
pub(super) fn status(design: &Design) -> Table {
    let input = design.config().input;
    let mut table = Table::new(&["bit", "flag", "set when", "raised in"]);
    for &(flag, name) in design.datapath().status_flags() {
        let (when, rank) = match flag {
            Status::NO_WORD => ("the address has no ROM word; the intensity is 0".to_owned(), "fetch"),
            Status::ABOVE_ONE if input.max_bits() <= input.one() => {
                (format!("never: {input} does not go above 1"), "front end")
            }
            Status::ABOVE_ONE => ("x is above 1; it is taken as 1".to_owned(), "front end"),
            Status::FACING_AWAY if !input.is_signed() => (format!("never: {input} has no sign"), "front end"),
            Status::OUT_OF_DOMAIN => {
                ("x is below the domain of its exponent; the intensity is 0".to_owned(), "front end")
            }
            Status::FACING_AWAY => ("x is negative; the intensity is 0".to_owned(), "front end"),
            _ if design.datapath().degree() == 0 => ("never: there is no polynomial".to_owned(), "clamp"),
            _ => ("the polynomial answers, and was outside [0, 1]".to_owned(), "clamp"),
        };
        table.row([flag.bits().trailing_zeros().to_string(), name.to_owned(), when, rank.to_owned()]);
    }
    table
}

/// The fields of the ROM word.
pub(super) fn rom(design: &Design) -> Table {
    let columns = ["field", "bits of the word", "format", "width", "least", "greatest", "meaning"];
    let mut table = Table::new(&columns);
    let rom = design.rom();
    for field in rom.layout().fields() {
        let bits = || rom.rows().iter().map(|row| row.get(field.name));
        let (least, greatest) = (bits().min().unwrap_or(0), bits().max().unwrap_or(0));
        let place = match field.place {
            Place::Stored { lsb } => format!("{}:{lsb}", lsb + field.format.width() - 1),
            Place::Constant { bits } => {
                format!("constant {} ({})", decimal(bits, field.format), literal(bits, field.format))
            }
        };
        table.row([
            field.name.name().to_owned(),
            place,
            field.format.to_string(),
            field.format.width().to_string(),
            value(least, field.format),
            value(greatest, field.format),
            meaning(field.name, design),
        ]);
    }
    table
}

fn meaning(field: Register, design: &Design) -> String {
    let segments = design.config().segments;
    match field {
        Register::C(_, power) if !design.is_centred() => match power {
            0 => "constant term".to_owned(),
            _ => format!("coefficient of {}", term("x", power)),
        },
        Register::C(0, 0) => "value at x = 1".to_owned(),
        Register::C(0, power) if segments == 1 => {
            let scale = if power == 1 { "−e".to_owned() } else { format!("−{power}e") };
            format!("k{power}·2^({scale}), coefficient of {}", signed(power))
        }
        Register::C(segment, 0) => {
            format!("{} segment: value at {}", ORDINALS[segment], Register::HandOver(segment))
        }
        Register::C(segment, power) => {
            format!("{} segment: coefficient of {}", ORDINALS[segment], signed(power))
        }
        Register::HandOver(segment) => format!(
            "the least x of the {} segment; u of the {} counts from it",
            ORDINALS[segment - 1],
            ORDINALS[segment]
        ),
        Register::Cut => "the least x at which the polynomial answers".to_owned(),
        Register::Shift(0) if design.config().cut == Cut::Balanced => {
            "e, the greatest that keeps u below 1; unsigned".to_owned()
        }
        Register::Shift(0) => "e = ⌊log2 n⌋, unsigned".to_owned(),
        Register::Shift(segment) => format!("e of the {} segment, unsigned", ORDINALS[segment]),
        Register::TailA => "A of x / (A − B·x)".to_owned(),
        Register::TailB => "B of x / (A − B·x)".to_owned(),
        _ => String::new(),
    }
}

/// A power of the variable: u, u², u³, u⁴.
fn term(variable: &str, power: usize) -> String {
    format!("{variable}{}", ["", "", "²", "³", "⁴"][power])
}

/// The same with the sign that the centred form takes it with.
fn signed(power: usize) -> String {
    format!("{}{}", if power % 2 == 1 { "−" } else { "" }, term("u", power))
}

/// Some words, to check a ROM image by.
pub(super) fn words(design: &Design) -> Table {
    let rom = design.rom();
    let mut table = Table::new(&["address", "n", "word, hex"]);
    let digits = rom.layout().word_width().div_ceil(4) as usize;
    let mut addresses = vec![0, rom.depth() / 4, rom.depth() / 2, rom.depth() - 1];
    addresses.dedup();
    for address in addresses {
        let word = rom.layout().pack(&rom.rows()[address]);
        let exponent = design.rows()[address].exponent;
        table.row([address.to_string(), exponent.to_string(), format!("`{word:0digits$x}`")]);
    }
    table
}
