//! The package: every width and constant of one configuration.
//!
//! A part that the configuration does not have still has its constants, at their least width: the
//! RTL names them, but builds nothing from them.
//!
//! What there are several of (fields of the ROM, coefficients, stages, segments) has a vector beside its single
//! constants: 32 bits for each, the first at the bottom, so that `C_WIDTH[32*i+:32]` is that of c(i) in a generate
//! loop. Arrays would say it more plainly, but not every tool takes a parameter that is one.

use askama::Template;
use hw_model::config::Form;
use hw_model::datapath::formats::TailFormats;
use hw_model::datapath::front_end::{FrontEnd, Region, Variable};
use hw_model::datapath::stage::MultiplyAdd;
use hw_model::datapath::{Datapath, Status};
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::handshake::{Handshake, ReadySlice};
use hw_model::pipelining::{PIECE, Pipelining};
use hw_model::registers::Register;
use hw_model::rom::{Field, Place};
use hw_model::rounding::Rounding;

/// The number of a rounding mode in the RTL: its place in [`Rounding::ALL`].
#[must_use]
pub const fn rounding_number(mode: Rounding) -> u8 {
    mode as u8
}

/// The name of a rounding mode in the RTL, which `blysk_round_shift.sv` chooses by.
#[must_use]
pub fn rounding_name(mode: Rounding) -> String {
    format!("ROUND_{}", mode.name().to_uppercase())
}

/// The text of `blysk_pkg.sv`.
#[must_use]
pub fn package(design: &Design, command: &str) -> String {
    let datapath = design.datapath();
    let package = Package {
        configuration: &design.config().name,
        command,
        sections: vec![
            rounding_modes(),
            parts(design),
            pipelining(datapath),
            handshake(datapath),
            ports(datapath),
            rom(datapath),
            fields(datapath),
            front_end(datapath),
            polynomial(design),
            tail(datapath),
            encodings(datapath),
        ],
    };
    // The template writes to a String, which cannot fail.
    package.render().unwrap_or_default() + "\n"
}

#[derive(Template)]
#[template(path = "blysk_pkg.sv", escape = "none")]
struct Package<'a> {
    configuration: &'a str,
    command: &'a str,
    sections: Vec<Section>,
}

struct Section {
    title: &'static str,
    constants: Vec<Constant>,
}

struct Constant {
    declaration: String,
    value: String,
    comment: String,
}

impl Section {
    const fn new(title: &'static str) -> Self {
        Self { title, constants: Vec::new() }
    }

    fn integer(mut self, name: impl Into<String>, value: impl Into<i64>) -> Self {
        self.constants.push(Constant {
            declaration: format!("int {}", name.into()),
            value: value.into().to_string(),
            comment: String::new(),
        });
        self
    }

    fn bits(mut self, name: impl Into<String>, width: u32, word: u64) -> Self {
        self.constants.push(Constant {
            declaration: format!("logic [{}:0] {}", width - 1, name.into()),
            value: format!("{width}'h{word:x}"),
            comment: String::new(),
        });
        self
    }

    /// The width of a register, with its format as a comment; one bit where there is none.
    fn width(self, name: &str, format: Option<QFormat>) -> Self {
        let mut section = self.integer(format!("{name}_WIDTH"), format.map_or(1, QFormat::width));
        if let Some(constant) = section.constants.last_mut() {
            constant.comment = format.map_or_else(|| "  // not there".to_owned(), |format| format!("  // {format}"));
        }
        section
    }

    /// Constants for the width of a format and for whether it is signed.
    fn format(self, name: &str, format: Option<QFormat>) -> Self {
        let signed = format.is_some_and(QFormat::is_signed);
        self.width(name, format).integer(format!("{name}_SIGNED"), i64::from(signed))
    }

    /// The places of a multiply-add line.
    fn line(self, name: &str, line: Option<(&MultiplyAdd, u32)>) -> Self {
        let (up, drop, width, mode) = line.map_or(([0; 3], 0, 1, Rounding::Floor), |(line, width)| {
            let up = [line.product_up(), line.addend_up(), line.result_up()];
            (up, line.dropped_bits(), width, line.rounding())
        });
        let [product, addend, result] = up;
        self.integer(format!("{name}_PRODUCT_UP"), product)
            .integer(format!("{name}_ADDEND_UP"), addend)
            .integer(format!("{name}_RESULT_UP"), result)
            .integer(format!("{name}_DROP"), drop)
            .integer(format!("{name}_SUM_WIDTH"), width)
            .rounding(name, mode)
    }

    /// The mode of a line.
    fn rounding(self, name: &str, mode: Rounding) -> Self {
        let mut section = self.integer(format!("{name}_ROUNDING"), rounding_number(mode));
        if let Some(constant) = section.constants.last_mut() {
            constant.value = rounding_name(mode);
        }
        section
    }

    /// A vector of the section's integers of these names, or of numbers: 32 bits each, the first at the bottom. The
    /// numbers stand there themselves: linters have something against names in a concatenation.
    fn vector(mut self, name: &str, elements: impl IntoIterator<Item = String>) -> Self {
        let number = |element: String| {
            let declaration = format!("int {element}");
            let known = self.constants.iter().find(|known| known.declaration == declaration);
            format!("32'd{}", known.map_or(&element, |known| &known.value))
        };
        let mut elements: Vec<String> = elements.into_iter().map(number).collect();
        elements.reverse();
        self.constants.push(Constant {
            declaration: format!("logic [{}:0] {name}", 32 * elements.len().max(1) - 1),
            value: concatenation(&elements),
            comment: String::new(),
        });
        self
    }
}

/// `{a, b, c}`, eight in a line.
fn concatenation(elements: &[String]) -> String {
    let lines: Vec<String> = elements.chunks(8).map(|line| line.join(", ")).collect();
    match lines.as_slice() {
        [] => "'0".to_owned(),
        [line] => format!("{{{line}}}"),
        lines => format!("{{\n    {}}}", lines.join(",\n    ")),
    }
}

fn rounding_modes() -> Section {
    Rounding::ALL.into_iter().fold(Section::new("Rounding modes"), |section, mode| {
        section.integer(rounding_name(mode), rounding_number(mode))
    })
}

fn parts(design: &Design) -> Section {
    let datapath = design.datapath();
    Section::new("What the configuration keeps")
        .integer("HAS_POLYNOMIAL", i64::from(datapath.degree() > 0))
        .integer("HAS_TAIL", i64::from(datapath.divider().is_some()))
        .integer("CENTRED", i64::from(design.config().form == Form::Centred))
        .integer("DEGREE", degree(datapath) as i64)
        .integer("SEGMENTS", datapath.segment_count() as i64)
        .integer("RANKS", datapath.rank_count() as i64)
}

fn pipelining(datapath: &Datapath) -> Section {
    let Pipelining { rom, front_end, operands, product, sum, ready_slice } = *datapath.pipelining();
    Section::new("Ranks of registers beyond the least")
        .integer("ROM_RANKS", i64::from(rom))
        .integer("FRONT_END_RANKS", front_end)
        .integer("OPERAND_RANKS", i64::from(operands))
        .integer("PRODUCT_RANKS", product)
        .integer("PRODUCT_PIECE", PIECE)
        .integer("SUM_RANKS", i64::from(sum))
        .integer("INPUT_SLICE", i64::from(ready_slice == Some(ReadySlice::Input)))
        .integer("OUTPUT_SLICE", i64::from(ready_slice == Some(ReadySlice::Output)))
}

fn handshake(datapath: &Datapath) -> Section {
    let control = datapath.control();
    let name = |kind: Handshake| format!("HANDSHAKE_{}", kind.name().to_uppercase());
    let kinds = Section::new("Handshake and reset");
    let numbered = (0_i64..).zip(Handshake::ALL);
    let mut section = numbered.fold(kinds, |section, (number, kind)| section.integer(name(kind), number));
    section = section.integer("HANDSHAKE", 0);
    if let Some(constant) = section.constants.last_mut() {
        constant.value = name(control.handshake);
    }
    section
        .integer("RESET_ACTIVE_LOW", i64::from(control.reset.is_active_low()))
        .integer("RESET_ASYNCHRONOUS", i64::from(control.reset.is_asynchronous()))
        .integer("READY_IN_RESET", i64::from(control.reset.ready))
}

/// The degree; 1 where there is no polynomial, whose constants are named all the same.
fn degree(datapath: &Datapath) -> usize {
    datapath.degree().max(1)
}

fn ports(datapath: &Datapath) -> Section {
    let formats = datapath.formats();
    let (input, output) = (formats.input, formats.output);
    let front_end = datapath.front_end();
    let x = datapath.tail_x_format().width();
    let exceeds = input.max_bits() > front_end.greatest;
    Section::new("Ports, and x clamped to [0, 1]")
        .integer("ADDRESS_WIDTH", datapath.rom().address_width())
        .format("INPUT", Some(input))
        .integer("INPUT_FRACTION", input.fraction_bits())
        .integer("INPUT_EXCEEDS_ONE", i64::from(exceeds))
        .integer("X_WIDTH", x)
        .bits("X_GREATEST", x, front_end.greatest as u64)
        .width("OUTPUT", Some(output))
        .bits("OUTPUT_GREATEST", output.width(), datapath.output_one() as u64)
}

fn rom(datapath: &Datapath) -> Section {
    let rom = datapath.rom();
    let depth = rom.depth() as u64;
    let index_width = depth.next_power_of_two().trailing_zeros().max(1);
    Section::new("ROM")
        .integer("ROM_DEPTH", depth as i64)
        .integer("ROM_INDEX_WIDTH", index_width)
        .integer("ROM_WIDTH", rom.layout().word_width().max(1))
}

/// The fields of a word, one after the other, as the ROM module gives them: stored ones and constants.
fn fields(datapath: &Datapath) -> Section {
    let fields = datapath.rom().layout().fields();
    let mut section = Section::new("ROM fields");
    let mut place = 0;
    let mut constants = Vec::new();
    for Field { name, format, place: kept } in fields {
        let upper = name.name().to_uppercase();
        let (stored, lsb, constant) = match *kept {
            Place::Stored { lsb } => (1, lsb, 0),
            Place::Constant { bits } => (0, 0, format.to_word(bits)),
        };
        section = match name {
            Register::C(..) | Register::TailA | Register::TailB => section.format(&upper, Some(*format)),
            _ => section.width(&upper, Some(*format)),
        };
        section = section
            .integer(format!("{upper}_STORED"), stored)
            .integer(format!("{upper}_LSB"), lsb)
            .bits(format!("{upper}_CONSTANT"), format.width(), constant)
            .integer(format!("{upper}_PLACE"), place);
        constants.push(format!("{upper}_CONSTANT"));
        place += format.width();
    }
    let names: Vec<String> = fields.iter().map(|field| field.name.name().to_uppercase()).collect();
    let all = |suffix: &str| names.iter().map(|name| format!("{name}_{suffix}")).collect::<Vec<_>>();
    constants.reverse();
    section = not_there(datapath, section)
        .integer("FIELDS", fields.len() as i64)
        .integer("FIELDS_WIDTH", place)
        .vector("FIELD_WIDTH", all("WIDTH"))
        .vector("FIELD_STORED", all("STORED"))
        .vector("FIELD_CHOSEN", fields.iter().map(|field| i64::from(is_chosen(field)).to_string()))
        .vector("FIELD_LSB", all("LSB"))
        .vector("FIELD_PLACE", all("PLACE"));
    section.constants.push(Constant {
        declaration: format!("logic [{}:0] FIELD_CONSTANT", place - 1),
        value: concatenation(&constants),
        comment: String::new(),
    });
    by_segment(datapath, section)
}

/// True for a field of the word that is read behind the comparisons of x.
fn is_chosen(field: &Field) -> bool {
    let compared = matches!(field.name, Register::Cut | Register::HandOver(_));
    matches!(field.place, Place::Stored { .. }) && !compared
}

/// The constants of fields that the RTL names and the word does not have.
fn not_there(datapath: &Datapath, section: Section) -> Section {
    let named = (0..=degree(datapath)).map(|power| Register::C(0, power));
    let named = named.chain([Register::Cut, Register::TailA, Register::TailB]);
    let missing = named.filter(|&name| datapath.rom().layout().field(name).is_none());
    missing.fold(section, |section, name| {
        let upper = name.name().to_uppercase();
        let section = match name {
            Register::Cut => section.width(&upper, None),
            _ => section.format(&upper, None),
        };
        section.integer(format!("{upper}_STORED"), 0).integer(format!("{upper}_PLACE"), 0)
    })
}

/// Where the fields of each coefficient and of each segment are.
fn by_segment(datapath: &Datapath, section: Section) -> Section {
    let (degree, segments) = (degree(datapath), datapath.segment_count());
    let layout = datapath.rom().layout();
    let of = |register: Register, suffix: &str, otherwise: &str| match layout.field(register) {
        Some(_) => format!("{}_{suffix}", register.name().to_uppercase()),
        None => otherwise.to_owned(),
    };
    let powers = |suffix: &'static str| (0..=degree).map(move |power| format!("C{power}_{suffix}")).collect::<Vec<_>>();
    let places =
        (0..segments).flat_map(|segment| (0..=degree).map(move |power| of(Register::C(segment, power), "PLACE", "0")));
    let shift = |suffix: &'static str, otherwise: &'static str| {
        (0..segments).map(move |segment| of(Register::Shift(segment), suffix, otherwise))
    };
    let hand_over = |suffix: &'static str, otherwise: &'static str| {
        (0..segments).map(move |segment| match segment {
            0 => otherwise.to_owned(),
            _ => of(Register::HandOver(segment), suffix, otherwise),
        })
    };
    section
        .vector("C_WIDTH", powers("WIDTH"))
        .vector("C_SIGNED", powers("SIGNED"))
        .vector("C_PLACE", places)
        .vector("SHIFT_WIDTHS", shift("WIDTH", "1"))
        .vector("SHIFT_PLACES", shift("PLACE", "0"))
        .vector("HAND_OVER_WIDTHS", hand_over("WIDTH", "1"))
        .vector("HAND_OVER_PLACES", hand_over("PLACE", "0"))
}

fn front_end(datapath: &Datapath) -> Section {
    let x = datapath.tail_x_format().width();
    let formats = datapath.formats();
    let width = |format: Option<QFormat>| format.map_or(1, QFormat::width);
    let FrontEnd { cut_up, hand_over_up, .. } = *datapath.front_end();
    let layout = datapath.rom().layout();
    let shifts = (0..datapath.segment_count()).map(|k| layout.field(Register::Shift(k)));
    let shift = shifts.map(|field| width(field.map(|field| field.format))).max().unwrap_or(1);
    let (up, drop) = match datapath.front_end().variable {
        Some(Variable::U { up, drop, .. }) => (up, drop),
        Some(Variable::X) | None => (0, 0),
    };
    Section::new("Front end")
        .integer("CUT_UP", cut_up)
        .integer("CUT_COMPARE_WIDTH", x.max(width(formats.cut) + cut_up))
        .integer("HAND_OVER_UP", hand_over_up)
        .integer("HAND_OVER_COMPARE_WIDTH", x.max(width(formats.hand_over) + hand_over_up))
        .integer("SHIFT_COMMON_WIDTH", shift + 1)
        .integer("U_UP", up)
        .integer("U_DROP", drop)
        .rounding("U", datapath.front_end().rounding().unwrap_or(Rounding::Floor))
}

fn polynomial(design: &Design) -> Section {
    let datapath = design.datapath();
    let formats = datapath.formats().polynomial;
    let degree = degree(datapath);
    let mut section = Section::new("Polynomial");
    for power in (0..=degree).rev() {
        let carried = datapath.degree() > 0 && datapath.is_carried(power);
        section = section.integer(format!("C{power}_CARRIED"), i64::from(carried));
    }
    section = section.width("V", formats.as_ref().map(|f| f.v));
    for stage in 1..=degree {
        let of_stage = formats.as_ref().map(|f| f.t()[stage - 1]);
        section = section.format(&format!("T{stage}"), of_stage);
    }
    section = section.integer("POLYNOMIAL_EXCEEDS_ONE", i64::from(datapath.last_exceeds_one()));
    for stage in 1..=degree {
        let line = datapath.stages().get(stage - 1).zip(formats.as_ref()).map(|(line, formats)| {
            let (multiplicand, addend) = (formats.multiplicand(stage), formats.addend(stage));
            (line, line.lane_bits(multiplicand.width(), formats.v.width(), addend.width()))
        });
        section = section.line(&format!("T{stage}"), line);
    }
    let powers = (0..=degree).map(|power| format!("C{power}_CARRIED"));
    section = section.vector("C_CARRIED", powers);
    // T0 is the highest coefficient: what the first stage multiplies.
    for suffix in ["WIDTH", "SIGNED"] {
        let stages = (1..=degree).map(|stage| format!("T{stage}_{suffix}"));
        let highest = formats.as_ref().map(|f| f.multiplicand(1));
        let first = match suffix {
            "WIDTH" => highest.map_or(1, QFormat::width),
            _ => highest.is_some_and(QFormat::is_signed).into(),
        };
        let all = std::iter::once(first.to_string()).chain(stages);
        section = section.vector(&format!("T_{suffix}"), all);
    }
    for suffix in ["PRODUCT_UP", "ADDEND_UP", "RESULT_UP", "DROP", "SUM_WIDTH"] {
        let stages = (1..=degree).map(|stage| format!("T{stage}_{suffix}"));
        let all = std::iter::once("0".to_owned()).chain(stages);
        section = section.vector(&format!("T_{suffix}"), all);
    }
    let mode = |stage: usize| datapath.stages().get(stage - 1).map_or(0, |line| rounding_number(line.rounding()));
    let modes = std::iter::once(0).chain((1..=degree).map(mode)).map(|mode| mode.to_string());
    section
        .vector("T_ROUNDING", modes)
        .integer("POLYNOMIAL_WIDTH", formats.as_ref().map_or(1, |f| f.last().width()))
        .integer("POLYNOMIAL_SIGNED", i64::from(formats.is_some_and(|f| f.last().is_signed())))
}

fn tail(datapath: &Datapath) -> Section {
    let divider = datapath.divider();
    let formats = datapath.formats().tail;
    let of = |get: fn(&TailFormats) -> QFormat| formats.as_ref().map(get);
    let line = divider.zip(formats.as_ref()).map(|(divider, formats)| {
        let x = datapath.tail_x_format().width();
        let line = &divider.divisor;
        (line, line.lane_bits(formats.b.width(), x, formats.a.width()))
    });
    Section::new("Tail")
        .width("DIVISOR", of(|f| f.divisor))
        .width("DIGITS", of(|f| f.digits))
        .line("DIVISOR", line)
        .integer("DIVIDEND_UP", divider.map_or(0, |d| d.dividend_up))
        .integer("DIGIT_STAGES", divider.map_or(0, |d| d.digit_stages()))
        .integer("QUOTIENT_BITS_PER_STAGE", divider.map_or(1, |d| d.digits_per_stage))
        .rounding("QUOTIENT", divider.map_or(Rounding::Floor, |d| d.rounding))
}

fn encodings(datapath: &Datapath) -> Section {
    const REGION_WIDTH: u32 = 2;
    let mut section = Section::new("Regions, and the bits of the status").integer("REGION_WIDTH", REGION_WIDTH);
    for region in [Region::Zero, Region::Polynomial, Region::Tail] {
        let name = format!("REGION_{}", region.name().to_uppercase());
        section = section.bits(name, REGION_WIDTH, region as u64);
    }
    section = section.integer("STATUS_WIDTH", datapath.status_width());
    // A domain's flag is the last bit, which the front end finds by the width: a package without one has no name for
    // it.
    let flags = datapath.status_flags().iter().filter(|(flag, _)| *flag != Status::OUT_OF_DOMAIN);
    flags.fold(section, |section, &(flag, name)| {
        section.integer(format!("STATUS_{}", name.to_uppercase()), flag.bits().trailing_zeros())
    })
}
