//! The package: every width and constant of one configuration.
//!
//! A part that the configuration does not have still has its constants, at their least width: the
//! RTL names them, but builds nothing from them.

use askama::Template;
use hw_model::config::Form;
use hw_model::datapath::formats::{PolynomialFormats, TailFormats};
use hw_model::datapath::front_end::{FrontEnd, Region, Variable};
use hw_model::datapath::stage::MultiplyAdd;
use hw_model::datapath::{Datapath, Status};
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::rom::{FieldName, Place};
use hw_model::rounding::Rounding;

/// The number of a rounding mode in the RTL, as at the top of `blysk_round_shift.sv`.
#[must_use]
pub const fn rounding_number(mode: Rounding) -> u8 {
    match mode {
        Rounding::Floor => 0,
        Rounding::NearestUp => 1,
        Rounding::NearestEven => 2,
        Rounding::TowardZero => 3,
    }
}

/// The text of `blysk_pkg.sv`.
#[must_use]
pub fn package(design: &Design, command: &str) -> String {
    let datapath = design.datapath();
    let package = Package {
        configuration: &design.config().name,
        command,
        sections: vec![
            parts(design),
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
            constant.comment = format
                .map_or_else(|| "  // not there".to_owned(), |format| format!("  // {format}"));
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
        let (up, drop, width, mode) =
            line.map_or(([0; 3], 0, 1, Rounding::Floor), |(line, width)| {
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
            constant.comment = format!("  // {mode}");
        }
        section
    }
}

fn parts(design: &Design) -> Section {
    let datapath = design.datapath();
    Section::new("What the configuration keeps")
        .integer("HAS_POLYNOMIAL", i64::from(datapath.stages().is_some()))
        .integer("HAS_TAIL", i64::from(datapath.divider().is_some()))
        .integer("CENTRED", i64::from(design.config().form == Form::Centred))
        .integer("SEGMENTS", if datapath.has_two_segments() { 2 } else { 1 })
        .integer("RANKS", datapath.rank_count() as i64)
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

fn fields(datapath: &Datapath) -> Section {
    let layout = datapath.rom().layout();
    FieldName::ALL.into_iter().fold(Section::new("ROM fields"), |section, name| {
        let field = layout.field(name);
        let upper = name.name().to_uppercase();
        let width = field.map_or(1, |field| field.format.width());
        let (stored, lsb, constant) = match field.map(|field| (field.place, field.format)) {
            Some((Place::Stored { lsb }, _)) => (1, lsb, 0),
            Some((Place::Constant { bits }, format)) => (0, 0, format.to_word(bits)),
            None => (0, 0, 0),
        };
        let format = field.map(|field| field.format);
        let section = match name {
            FieldName::C3
            | FieldName::C2
            | FieldName::C1
            | FieldName::C0
            | FieldName::TailA
            | FieldName::TailB => section.format(&upper, format),
            // No sign, or the first segment's.
            _ => section.width(&upper, format),
        };
        section
            .integer(format!("{upper}_STORED"), stored)
            .integer(format!("{upper}_LSB"), lsb)
            .bits(format!("{upper}_CONSTANT"), width, constant)
    })
}

fn front_end(datapath: &Datapath) -> Section {
    let x = datapath.tail_x_format().width();
    let formats = datapath.formats();
    let width = |format: Option<QFormat>| format.map_or(1, QFormat::width);
    let FrontEnd { cut_up, hand_over_up, .. } = *datapath.front_end();
    let shift = width(formats.shift).max(width(formats.shift_outer));
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
    let of = |get: fn(&PolynomialFormats) -> QFormat| formats.as_ref().map(get);
    let carried = |section: Section, name: FieldName| {
        let name_carried = format!("{}_CARRIED", name.name().to_uppercase());
        section.integer(name_carried, i64::from(datapath.is_carried(name)))
    };
    let mut section = FieldName::COEFFICIENTS
        .into_iter()
        .rev()
        .fold(Section::new("Polynomial"), carried)
        .width("V", of(|f| f.v))
        .format("T1", of(|f| f.t1))
        .format("T2", of(|f| f.t2))
        .format("T3", of(|f| f.t3))
        .integer("T3_EXCEEDS_ONE", i64::from(datapath.t3_exceeds_one()));
    for (index, name) in ["T1", "T2", "T3"].into_iter().enumerate() {
        let line = datapath.stages().zip(formats.as_ref()).map(|(stages, formats)| {
            let [c0, c1, c2, c3] = formats.coefficients;
            let (multiplicand, addend) = [(c3, c2), (formats.t1, c1), (formats.t2, c0)][index];
            let line = &stages[index];
            (line, line.lane_bits(multiplicand.width(), formats.v.width(), addend.width()))
        });
        section = section.line(name, line);
    }
    section
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
    let mut section =
        Section::new("Regions, and the bits of the status").integer("REGION_WIDTH", REGION_WIDTH);
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
