//! The divider in the block diagram, and the wires that feed it.

use hw_model::datapath::formats::TailFormats;
use hw_model::format::QFormat;
use hw_model::registers::Register;
use hw_model::rom::Place;

use super::block::{Picture, SMALL, constant, dropped, labelled};
use super::layout::{BOX, Column, LANE, WIRE};
use super::named::Part;
use plot::canvas::{Anchor, colour};

/// A field of the tail on its way below the lanes.
pub(super) struct TailRow {
    pub(super) name: Register,
    pub(super) format: QFormat,
    pub(super) place: Place,
    pub(super) y: f64,
    /// Where on the divisor's foot, from its middle.
    pub(super) beside: f64,
}

impl Picture<'_> {
    /// The divider's boxes and wires.
    pub(super) fn tail(&mut self, formats: &TailFormats) {
        let Some(divider) = self.datapath.divider().copied() else { return };
        let (top, front) = (self.lanes.tail, self.columns[1]);
        let y = top + LANE / 2.0;
        let divided = self.datapath.rank_of(Register::Divisor);
        let divisor = self.of_rank(divided);
        let words = ["divisor".to_owned(), "D = A − B·x".to_owned(), dropped(divider.divisor.dropped_bits())];
        let words: Vec<String> = words.into_iter().chain(Self::ranks_in(&divisor)).collect();
        self.named(Part::Divisor, |picture| picture.part((divisor.left, top), (BOX, LANE), colour::ORANGE, &words));
        let x = self.datapath.tail_x_format();
        self.named(Part::Only(Register::TailX), |picture| {
            picture.wire(front.right(), divisor.left, y, &labelled("tail_x", x), &x.to_string());
        });
        if self.datapath.degree() > 0 {
            self.tail_wires(&divisor);
        }
        let last_rank = divided + divider.digit_stages() as usize;
        let (first, last) = (self.of_rank(divided + 1), self.of_rank(last_rank));
        let (bits, ranks) = (divider.digit_count, divider.digit_stages());
        let words = [
            "quotient bits".to_owned(),
            format!("{bits} bits, {} a rank", divider.digits_per_stage),
            format!("{ranks} rank{}", if ranks == 1 { "" } else { "s" }),
        ];
        let width = last.right() - first.left;
        self.named(Part::Digits, |picture| picture.part((first.left, top), (width, LANE), colour::ORANGE, &words));
        let (d, digits) = (formats.divisor.width(), formats.digits.width());
        let both = format!("D ({d}), rem ({d})");
        let digits = format!("digits ({digits})");
        let (from, to) = (last.right(), self.last().left);
        self.named(Part::Digits, |picture| {
            picture.wire(divisor.right(), first.left, y, &both, &digits);
            picture.wire(from, to, y, &format!("rem ({d})"), &digits);
        });
        for column in self.columns.clone() {
            if column.first > last_rank && column.last < self.datapath.rank_count() - 1 {
                self.carried(&column, y);
            }
        }
    }

    /// A and B where they run below the lanes.
    pub(super) fn tail_rows(&self) -> Vec<TailRow> {
        if self.datapath.degree() == 0 {
            return Vec::new();
        }
        // Of the wires to one box a lower one goes further to the right, so that they do not cross.
        let rows = [(Register::TailA, 0.0, -24.0), (Register::TailB, WIRE, 24.0)];
        let layout = self.datapath.rom().layout();
        let row = |(name, below, beside)| {
            let field = layout.field(name)?;
            let y = self.lanes.tail_row + below;
            Some(TailRow { name, format: field.format, place: field.place, y, beside })
        };
        rows.into_iter().filter_map(row).collect()
    }

    /// A and B, from the ROM below everything to the divisor.
    fn tail_wires(&mut self, divisor: &Column) {
        let (fetch, front) = (self.columns[0], self.columns[1]);
        let foot = self.lanes.tail + LANE;
        for TailRow { name, format, place, y, beside } in self.tail_rows() {
            let x = divisor.centre() + beside;
            match place {
                Place::Stored { .. } => self.named(Part::Only(name), |picture| {
                    picture.canvas.arrow(&[(fetch.right(), y), (x, y), (x, foot)]);
                    let label = labelled(name.name(), format);
                    picture.canvas.text((fetch.right() + 5.0, y - 5.0), &label, Anchor::Start, SMALL);
                    picture.carried(&front, y);
                }),
                Place::Constant { bits } => {
                    self.canvas.arrow(&[(x, y), (x, foot)]);
                    let label = constant(name, bits, format);
                    self.canvas.text((x + 6.0, y + 4.0), &label, Anchor::Start, SMALL);
                }
            }
        }
    }
}
