//! The data path of one configuration as a block diagram: the parts it keeps, and the widths between.

use hw_model::datapath::Datapath;
use hw_model::datapath::formats::PolynomialFormats;
use hw_model::datapath::front_end::Variable;
use hw_model::datapath::stage::MultiplyAdd;
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::quantise::decimal;
use hw_model::registers::{MAX_SEGMENTS, Register};
use hw_model::rom::Place;

use super::layout::{BOX, Column, LANE, Lanes, PORTS, X_HEIGHT, columns, lanes, wire};
use super::named::Part;
use super::words::line_formula;
use plot::canvas::{Anchor, Canvas, Point, colour, hop};

/// Numbers of segments in words.
const COUNTS: [&str; MAX_SEGMENTS + 1] = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight"];

const TITLE: f64 = 14.0;
const NORMAL: f64 = 12.0;
pub(super) const SMALL: f64 = 10.5;
/// Width of the mark of a register.
const REGISTER: f64 = 6.0;

/// A picture under way, with what it is drawn from.
pub(super) struct Picture<'a> {
    pub(super) canvas: Canvas,
    pub(super) datapath: &'a Datapath,
    pub(super) columns: Vec<Column>,
    pub(super) lanes: Lanes,
    /// What runs above the lanes, from the top.
    above: Vec<Above>,
}

/// What the ROM sends along above the lanes.
#[derive(Clone, Copy)]
enum Above {
    Field(Register),
    NoWord,
}

/// Draws the block diagram of a design as SVG.
pub(super) fn block(design: &Design) -> String {
    let datapath = design.datapath();
    let has = |name: &Register| datapath.rom().layout().field(*name).is_some();
    let mut order: Vec<Register> = Vec::new();
    if datapath.degree() > 0 {
        order.extend((0..=datapath.degree()).map(|power| Register::C(0, power)));
        order.push(Register::Cut);
        for segment in (1..datapath.segment_count()).rev() {
            order.extend([Register::HandOver(segment), Register::Shift(segment)]);
        }
        order.push(Register::Shift(0));
    } else {
        order.extend([Register::TailB, Register::TailA]);
    }
    let fields = order.iter().copied().filter(has).map(Above::Field);
    let above: Vec<Above> = fields.chain([Above::NoWord]).collect();
    let mut picture = Picture {
        canvas: Canvas::new(),
        datapath,
        columns: columns(datapath),
        lanes: lanes(datapath, above.len()),
        above,
    };
    let title = format!("Data path of configuration {}", design.config().name);
    picture.ranks(&title);
    picture.head();
    if let Some(formats) = &datapath.formats().polynomial {
        picture.polynomial(datapath.stages(), formats);
    }
    if let Some(formats) = &datapath.formats().tail {
        picture.tail(formats);
    }
    picture.end();
    picture.handshake();
    let width = picture.last().right() + PORTS;
    let size = (width, picture.lanes.handshake + 64.0);
    let words = "Boxes are logic with the registers it ends in; marks on wires are registers that carry a \
                 value along. Numbers are widths in bits.";
    picture.canvas.finish(size, &title, words)
}

impl Picture<'_> {
    /// Draws a part, whose element in the SVG names the registers that it stands for.
    pub(super) fn named(&mut self, part: Part, draw: impl FnOnce(&mut Self)) {
        self.canvas.open(&part.names(self.datapath));
        draw(self);
        self.canvas.close();
    }

    pub(super) fn last(&self) -> Column {
        self.columns[self.columns.len() - 1]
    }

    /// The column that a rank stands in.
    pub(super) fn of_rank(&self, rank: usize) -> Column {
        let found = self.columns.iter().find(|column| column.last >= rank);
        found.copied().unwrap_or_else(|| self.last())
    }

    /// The column of a stage of the polynomial.
    fn of_stage(&self, stage: usize) -> Column {
        self.of_rank(self.datapath.rank_of(Register::T(stage)))
    }

    /// The columns between the ROM's and a later one.
    fn passed(&self, target: &Column) -> Vec<Column> {
        let columns = self.columns.iter().skip(1);
        columns.filter(|column| column.last < target.first).copied().collect()
    }

    /// How many ranks the part of a column has, where it is more than one.
    pub(super) fn ranks_in(column: &Column) -> Option<String> {
        (column.ranks() > 1).then(|| format!("{} ranks", column.ranks()))
    }

    /// The title, and a dashed line where each rank's registers stand.
    fn ranks(&mut self, title: &str) {
        self.canvas.text((0.0, 14.0), title, Anchor::Start, TITLE);
        for column in &self.columns {
            let x = column.right() - REGISTER / 2.0;
            self.canvas.dashes(&[(x, 48.0), (x, self.lanes.handshake)], colour::FAINT);
            let words = if column.ranks() == 1 {
                format!("rank {}", column.first)
            } else {
                format!("ranks {} … {}", column.first, column.last)
            };
            self.canvas.quiet((column.right(), 42.0), &words, Anchor::End, NORMAL);
        }
    }

    /// A box that ends in registers, with lines of words in its middle.
    pub(super) fn part(&mut self, (x, y): Point, (width, height): Point, fill: &str, words: &[String]) {
        self.canvas.rectangle((x, y), (width, height), fill);
        self.canvas.block((x + width - REGISTER, y), (REGISTER, height), colour::REGISTER);
        let middle = y + height / 2.0 - 7.5 * (words.len() as f64 - 1.0) + 4.0;
        for (index, line) in words.iter().enumerate() {
            let size = if index == 0 { NORMAL } else { SMALL };
            let place = (x + (width - REGISTER) / 2.0, middle + 15.0 * index as f64);
            self.canvas.text(place, line, Anchor::Middle, size);
        }
    }

    /// The registers of a column on a wire; how many, where it is more than one.
    pub(super) fn carried(&mut self, column: &Column, y: f64) {
        let x = column.right() - REGISTER;
        self.canvas.block((x, y - 7.0), (REGISTER, 14.0), colour::REGISTER);
        if column.ranks() > 1 {
            let words = format!("× {}", column.ranks());
            self.canvas.text((x - 4.0, y - 4.0), &words, Anchor::End, SMALL);
        }
    }

    /// A wire from the end of a column, with words above and below it.
    pub(super) fn wire(&mut self, from: f64, to: f64, y: f64, above: &str, below: &str) {
        self.canvas.arrow(&[(from, y), (to, y)]);
        self.canvas.text((from + 5.0, y - 5.0), above, Anchor::Start, SMALL);
        self.canvas.quiet((from + 5.0, y + 13.0), below, Anchor::Start, SMALL);
    }

    /// ROM, register of x, front end, and the wires of the ROM's fields.
    fn head(&mut self) {
        let (fetch, front) = (self.columns[0], self.columns[1]);
        let (rom, formats) = (self.datapath.rom(), self.datapath.formats());
        let top = wire(&self.lanes, 0) - 20.0;
        let size = format!("{} × {} bits", rom.depth(), rom.layout().word_width());
        let height = self.lanes.rom_foot - top;
        let words: Vec<String> = ["ROM".to_owned(), size].into_iter().chain(Self::ranks_in(&fetch)).collect();
        self.named(Part::Rom, |picture| picture.part((fetch.left, top), (BOX, height), colour::GREEN, &words));
        let address = format!("address_i ({})", rom.address_width());
        self.port_in(top + height / 2.0, &address, "");
        let x = self.lanes.x;
        let words = ["x".to_owned()];
        self.named(Part::Input, |picture| picture.part((fetch.left, x), (BOX, X_HEIGHT), colour::GREY, &words));
        let port = format!("x_i ({})", formats.input.width());
        self.port_in(x + X_HEIGHT / 2.0, &port, &formats.input.to_string());
        let words: Vec<String> = self.front_end_words().into_iter().chain(Self::ranks_in(&front)).collect();
        let place = (front.left, self.lanes.polynomial);
        let height = self.lanes.foot - self.lanes.polynomial;
        self.named(Part::FrontEnd, |picture| picture.part(place, (BOX, height), colour::GREY, &words));
        self.named(Part::Input, |picture| picture.x_wire(&fetch, &front, x + X_HEIGHT / 2.0));
        for (index, above) in self.above.clone().into_iter().enumerate() {
            let y = wire(&self.lanes, index);
            match above {
                Above::Field(name) => self.named(self.wire_of(name), |picture| picture.field(name, y)),
                // To the box that takes in most, on the left: it is the lowest of its wires.
                Above::NoWord => self.named(Part::Only(Register::Status), |picture| {
                    picture.above(y, "no_word (1)", &front, -36.0);
                }),
            }
        }
    }

    fn x_wire(&mut self, fetch: &Column, front: &Column, y: f64) {
        let label = format!("x ({})", self.datapath.formats().input.width());
        if y < self.lanes.foot {
            self.wire(fetch.right(), front.left, y, &label, "");
        } else {
            let x = front.centre();
            let mut points = vec![(fetch.right(), y), (x, y)];
            // Over the wires of A and B, which it has nothing to do with; from the lowest up.
            for crossed in self.tail_rows().into_iter().rev() {
                if let Place::Stored { .. } = crossed.place {
                    points.extend(hop((x, crossed.y)));
                }
            }
            points.push((x, self.lanes.foot));
            self.canvas.arrow(&points);
            self.canvas.text((fetch.right() + 5.0, y - 5.0), &label, Anchor::Start, SMALL);
        }
    }

    fn front_end_words(&self) -> Vec<String> {
        let mut words = vec!["front end".to_owned(), "clamp to [0, 1]".to_owned()];
        match self.datapath.front_end().variable {
            Some(Variable::U { drop, .. }) => {
                words.push("x ≥ cut ?".to_owned());
                if self.datapath.segment_count() > 1 {
                    words.push("x ≥ hand_over ?".to_owned());
                    words.push("u = (start − x)·2^e".to_owned());
                } else {
                    words.push("u = (1 − x)·2^e".to_owned());
                }
                if drop > 0 {
                    words.push(format!("drops {drop} bits"));
                }
            }
            Some(Variable::X) => words.push("x ≥ cut ?".to_owned()),
            None => words.push("x < 0 ?".to_owned()),
        }
        words
    }

    /// What the wire of a field stands for.
    fn wire_of(&self, name: Register) -> Part {
        match name {
            Register::C(_, power) if self.datapath.segment_count() > 1 && self.datapath.is_carried(power) => {
                Part::Coefficients(power)
            }
            name => Part::Only(name),
        }
    }

    /// A field of the ROM word on its way above the lanes.
    fn field(&mut self, name: Register, y: f64) {
        let Some(field) = self.datapath.rom().layout().field(name).copied() else { return };
        // The column that takes it in, and where on the box's top.
        let degree = self.datapath.degree();
        let segments = self.datapath.segment_count();
        // Of the wires to one box an upper one goes further to the right, so that they do not cross.
        let step = 12.0 / (segments.max(2) - 1) as f64;
        let of_segment = |segment: usize| 12.0 + 2.0 * step * (segment as f64 - 1.0);
        let front = self.columns[1];
        let (target, beside) = match name {
            Register::Cut => (front, 36.0),
            Register::Shift(0) => (front, 0.0),
            Register::HandOver(segment) => (front, of_segment(segment) + step),
            Register::Shift(segment) => (front, of_segment(segment)),
            Register::C(_, power) if power == degree => (self.of_stage(1), -24.0),
            Register::C(_, power) if power + 1 == degree => (self.of_stage(1), 24.0),
            Register::C(_, power) => (self.of_stage(degree - power), 0.0),
            Register::TailA => (self.of_rank(self.datapath.rank_of(Register::Divisor)), -24.0),
            Register::TailB => (self.of_rank(self.datapath.rank_of(Register::Divisor)), 24.0),
            _ => (self.of_stage(degree), 0.0),
        };
        // The further segments' go with the first's.
        let together = matches!(self.wire_of(name), Part::Coefficients(_));
        let (x, top) = (target.centre() + beside, self.lanes.polynomial);
        match field.place {
            Place::Constant { .. } | Place::Stored { .. } if together => {
                let count = COUNTS[segments];
                let label = format!("{name} of {count} segments ({})", field.format.width());
                self.above(y, &label, &target, beside);
                for column in self.passed(&target) {
                    self.carried(&column, y);
                }
            }
            Place::Stored { .. } => {
                self.above(y, &labelled(name.name(), field.format), &target, beside);
                for column in self.passed(&target) {
                    self.carried(&column, y);
                }
            }
            Place::Constant { bits } => {
                self.canvas.arrow(&[(x, y), (x, top)]);
                let label = constant(name, bits, field.format);
                self.canvas.text((x - 6.0, y + 6.0), &label, Anchor::End, SMALL);
            }
        }
    }

    /// A wire from the ROM to the top of a box.
    fn above(&mut self, y: f64, label: &str, target: &Column, beside: f64) {
        let from = self.columns[0].right();
        let x = target.centre() + beside;
        self.canvas.arrow(&[(from, y), (x, y), (x, self.lanes.polynomial)]);
        self.canvas.text((from + 5.0, y - 5.0), label, Anchor::Start, SMALL);
    }

    fn polynomial(&mut self, stages: &[MultiplyAdd], formats: &PolynomialFormats) {
        let top = self.lanes.polynomial;
        let y = top + LANE / 2.0;
        let degree = formats.degree();
        for (stage, (line, &format)) in (1..).zip(stages.iter().zip(formats.t())) {
            let column = self.of_stage(stage);
            let words =
                [format!("stage {stage}"), line_formula(stage, degree, line.subtracts()), dropped(line.dropped_bits())];
            let words: Vec<String> = words.into_iter().chain(Self::ranks_in(&column)).collect();
            self.named(Part::Stage(stage), |picture| {
                picture.part((column.left, top), (BOX, LANE), colour::BLUE, &words);
            });
            let next = if stage < degree { self.of_stage(stage + 1) } else { self.last() }.left;
            let name = Register::T(stage).name();
            self.named(Part::Only(Register::T(stage)), |picture| {
                picture.wire(column.right(), next, y, &labelled(name, format), &format.to_string());
            });
            self.named(Part::Only(Register::V), |picture| picture.variable(stage < degree, column));
        }
        self.named(Part::Only(Register::V), |picture| picture.variable_wire(formats));
        // The last result waits for the quotient.
        for column in self.columns.clone() {
            if column.first > self.of_stage(degree).last && column.last < self.datapath.rank_count() - 1 {
                self.carried(&column, y);
            }
        }
    }

    /// The wire of the variable below the stages.
    fn variable_wire(&mut self, formats: &PolynomialFormats) {
        let (v, front) = (self.lanes.variable, self.columns[1]);
        let variable = if self.datapath.front_end().variable == Some(Variable::X) { "v = x" } else { "v = u" };
        let end = self.of_stage(formats.degree()).centre();
        self.canvas.line(&[(front.right(), v), (end, v)], colour::INK, 1.2);
        let place = (front.right() + 5.0, v);
        let words = labelled(variable, formats.v);
        self.canvas.text((place.0, place.1 - 5.0), &words, Anchor::Start, SMALL);
        self.canvas.quiet((place.0, place.1 + 13.0), &formats.v.to_string(), Anchor::Start, SMALL);
    }

    /// The variable goes up into a stage, and on through the registers of its rank.
    fn variable(&mut self, goes_on: bool, column: Column) {
        let v = self.lanes.variable;
        self.canvas.arrow(&[(column.centre(), v), (column.centre(), self.lanes.polynomial + LANE)]);
        if goes_on {
            self.canvas.block((column.centre() - 2.5, v - 2.5), (5.0, 5.0), colour::INK);
            self.carried(&column, v);
        }
    }

    /// Region and status along the lanes, the clamp, and the ports behind it.
    fn end(&mut self) {
        let (front, last) = (self.columns[1], self.last());
        let y = self.lanes.region;
        self.named(Part::Choice, |picture| {
            picture.canvas.arrow(&[(front.right(), y), (last.left, y)]);
            let words = "region (2), status (4)";
            picture.canvas.text((front.right() + 5.0, y + 13.0), words, Anchor::Start, SMALL);
        });
        let middle = self.columns.len() - 1;
        for column in self.columns.clone().into_iter().take(middle).skip(2) {
            self.carried(&column, y);
        }
        let top = self.lanes.polynomial;
        let height = self.lanes.foot - top;
        let mut words = vec!["clamp".to_owned()];
        if self.datapath.degree() > 0 {
            words.push(format!("t{} to [0, 1]", self.datapath.degree()));
        }
        if self.datapath.divider().is_some() {
            words.push("round quotient".to_owned());
        }
        words.push("choose by region".to_owned());
        self.named(Part::Clamp, |picture| picture.part((last.left, top), (BOX, height), colour::GREY, &words));
        let output = self.datapath.formats().output;
        let out = |offset: f64| top + height * offset;
        let port = format!("intensity_o ({})", output.width());
        self.port_out(out(0.3), &port, &output.to_string());
        self.port_out(out(0.75), "status_o (4)", "");
    }

    fn handshake(&mut self) {
        let (left, right) = (self.columns[0].left, self.last().right());
        let y = self.lanes.handshake;
        self.canvas.rectangle((left, y), (right - left, 60.0), colour::GREY);
        // A valid flag stands in each rank; several ranks of a column have several.
        for column in self.columns.clone() {
            self.carried(&column, y + 40.0);
        }
        let words = "handshake: a valid flag for each rank; load[k] loads every register of rank k";
        self.canvas.text((left.midpoint(right), y + 20.0), words, Anchor::Middle, NORMAL);
        self.port_in(y + 20.0, "in_valid_i", "");
        self.port_out(y + 20.0, "out_valid_o", "");
        self.canvas.arrow(&[(left, y + 50.0), (0.0, y + 50.0)]);
        self.canvas.text((0.0, y + 44.0), "in_ready_o", Anchor::Start, SMALL);
        self.canvas.arrow(&[(right + PORTS, y + 50.0), (right, y + 50.0)]);
        self.canvas.text((right + 12.0, y + 44.0), "out_ready_i", Anchor::Start, SMALL);
    }

    fn port_in(&mut self, y: f64, name: &str, format: &str) {
        self.canvas.arrow(&[(0.0, y), (self.columns[0].left, y)]);
        self.canvas.text((0.0, y - 5.0), name, Anchor::Start, SMALL);
        self.canvas.quiet((0.0, y + 13.0), format, Anchor::Start, SMALL);
    }

    fn port_out(&mut self, y: f64, name: &str, format: &str) {
        let from = self.last().right();
        self.canvas.arrow(&[(from, y), (from + PORTS, y)]);
        self.canvas.text((from + 6.0, y - 5.0), name, Anchor::Start, SMALL);
        self.canvas.quiet((from + 6.0, y + 13.0), format, Anchor::Start, SMALL);
    }
}

pub(super) fn constant(name: Register, bits: i64, format: QFormat) -> String {
    format!("{name} = {} (constant)", decimal(bits, format))
}

pub(super) fn labelled(name: &str, format: QFormat) -> String {
    format!("{name} ({})", format.width())
}

pub(super) fn dropped(bits: u32) -> String {
    if bits == 0 { "exact".to_owned() } else { format!("drops {bits} bits") }
}
