//! The registers of each rank: what it holds, in which format, and whether it computes it or carries it on.

use crate::format::QFormat;
use crate::rom::{FieldName, Place};

use super::formats::{PolynomialFormats, TailFormats};
use super::ranks::{Datapath, HEAD_RANKS};
use super::signals::{Register, Signals};

impl Datapath {
    /// The registers of a rank, in the order of traces and vectors. Constants take none.
    #[must_use]
    pub fn registers(&self, rank: usize) -> Vec<Register> {
        let last = self.rank_count() - 1;
        let mut list = List { registers: Vec::new() };
        if rank == last {
            list.add("intensity", self.formats.output, true, |s| s.intensity);
        } else {
            self.input_registers(rank, &mut list);
            if let Some(formats) = &self.formats.polynomial {
                self.polynomial_registers(rank, formats, &mut list);
            }
            if let Some(formats) = &self.formats.tail {
                self.tail_registers(rank, formats, &mut list);
            }
            if rank >= 1 {
                list.add("region", QFormat::field(2), rank == 1, |s| s.region as i64);
            }
        }
        let computed = rank <= 1 || rank == last;
        list.add("status", QFormat::field(self.status_width()), computed, |s| {
            s.status.bits().into()
        });
        list.registers
    }

    fn input_registers(&self, rank: usize, list: &mut List) {
        if rank == 0 {
            list.add("x", self.formats.input, true, |s| s.x);
            self.field(list, FieldName::Cut, true, |s| s.row.get(FieldName::Cut));
            self.field(list, FieldName::Shift, true, |s| s.row.get(FieldName::Shift));
            self.field(list, FieldName::HandOver, true, |s| s.row.get(FieldName::HandOver));
            self.field(list, FieldName::ShiftOuter, true, |s| s.row.get(FieldName::ShiftOuter));
        }
    }

    fn polynomial_registers(&self, rank: usize, formats: &PolynomialFormats, list: &mut List) {
        // c3 and c2 meet in stage 1, c1 in stage 2, c0 in stage 3.
        if rank < HEAD_RANKS {
            self.coefficient(list, rank, FieldName::C3, |s| s.row.get(FieldName::C3));
            self.coefficient(list, rank, FieldName::C2, |s| s.row.get(FieldName::C2));
        }
        if rank < HEAD_RANKS + 1 {
            self.coefficient(list, rank, FieldName::C1, |s| s.row.get(FieldName::C1));
        }
        if rank < HEAD_RANKS + 2 {
            self.coefficient(list, rank, FieldName::C0, |s| s.row.get(FieldName::C0));
        }
        if rank == 0 {
            self.field(list, FieldName::C3Outer, true, |s| s.row.get(FieldName::C3Outer));
            self.field(list, FieldName::C2Outer, true, |s| s.row.get(FieldName::C2Outer));
            self.field(list, FieldName::C1Outer, true, |s| s.row.get(FieldName::C1Outer));
            self.field(list, FieldName::C0Outer, true, |s| s.row.get(FieldName::C0Outer));
        }
        match rank {
            0 => {}
            1 => list.add("v", formats.v, true, |s| s.v),
            2 => {
                list.add("v", formats.v, false, |s| s.v);
                list.add("t1", formats.t1, true, |s| s.t1);
            }
            3 => {
                list.add("v", formats.v, false, |s| s.v);
                list.add("t2", formats.t2, true, |s| s.t2);
            }
            _ => list.add("t3", formats.t3, rank == 4, |s| s.t3),
        }
    }

    fn tail_registers(&self, rank: usize, formats: &TailFormats, list: &mut List) {
        if rank < HEAD_RANKS {
            self.field(list, FieldName::TailA, rank == 0, |s| s.row.get(FieldName::TailA));
            self.field(list, FieldName::TailB, rank == 0, |s| s.row.get(FieldName::TailB));
        }
        if rank == 1 {
            list.add("tail_x", self.tail_x_format(), true, |s| s.tail_x);
        }
        if rank >= HEAD_RANKS {
            let steps = self.divider.map_or(0, |divider| divider.digit_stages() as usize);
            let working = rank <= HEAD_RANKS + steps;
            // After the last quotient bits no rank uses the divisor.
            if rank < HEAD_RANKS + steps {
                list.add("divisor", formats.divisor, rank == HEAD_RANKS, |s| s.division.divisor);
            }
            list.add("remainder", formats.divisor, working, |s| s.division.remainder);
            list.add("digits", formats.digits, working, |s| s.division.digits);
        }
    }

    /// The divider's x is clamped to [0, 1], so a sign bit of the input is not carried.
    #[must_use]
    pub fn tail_x_format(&self) -> QFormat {
        let fraction = self.formats.input.fraction_bits();
        QFormat::for_range(0, self.front_end.greatest.into(), fraction)
            .unwrap_or(self.formats.input)
    }

    fn field(&self, list: &mut List, name: FieldName, computed: bool, bits: fn(&Signals) -> i64) {
        if let Some(field) = self.rom.layout().field(name)
            && matches!(field.place, Place::Stored { .. })
        {
            list.add(name.name(), field.format, computed, bits);
        }
    }

    /// A coefficient: in rank 0 the first segment's, from rank 1 on the answering segment's.
    fn coefficient(
        &self,
        list: &mut List,
        rank: usize,
        name: FieldName,
        bits: fn(&Signals) -> i64,
    ) {
        if rank == 0 {
            self.field(list, name, true, bits);
        } else if self.is_carried(name)
            && let Some(field) = self.rom.layout().field(name)
        {
            list.add(name.name(), field.format, rank == 1 && self.has_two_segments(), bits);
        }
    }

    /// True where a coefficient takes a register behind the front end: it is not the same constant in
    /// every row and segment.
    #[must_use]
    pub fn is_carried(&self, name: FieldName) -> bool {
        let place = |name| self.rom.layout().field(name).map(|field| field.place);
        let outer = FieldName::COEFFICIENTS
            .into_iter()
            .zip(FieldName::OUTER_COEFFICIENTS)
            .find(|&(inner, _)| inner == name)
            .and_then(|(_, outer)| place(outer));
        match (place(name), outer) {
            (Some(Place::Constant { .. }) | None, None) => false,
            (Some(Place::Constant { bits }), Some(Place::Constant { bits: outer })) => {
                bits != outer
            }
            _ => true,
        }
    }
}

struct List {
    registers: Vec<Register>,
}

impl List {
    fn add(
        &mut self,
        name: &'static str,
        format: QFormat,
        computed: bool,
        bits: fn(&Signals) -> i64,
    ) {
        self.registers.push(Register { name, format, computed, bits });
    }
}
