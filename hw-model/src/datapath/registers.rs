//! The registers of each rank: what it holds, in which format, and whether it computes it or carries it on.

use crate::format::QFormat;
use crate::registers::Register;
use crate::rom::Place;

use super::formats::{PolynomialFormats, TailFormats};
use super::parts::{Datapath, HEAD_RANKS};
use super::signals::RankRegister;

impl Datapath {
    /// The registers of a rank, in the order of traces and vectors. Constants take none.
    #[must_use]
    pub fn registers(&self, rank: usize) -> Vec<RankRegister> {
        let last = self.rank_count() - 1;
        let mut list = List { registers: Vec::new() };
        if rank == last {
            list.add(Register::Intensity, self.formats.output, true);
        } else {
            if rank == 0 {
                self.input_registers(&mut list);
            }
            if let Some(formats) = &self.formats.polynomial {
                self.polynomial_registers(rank, formats, &mut list);
            }
            if let Some(formats) = &self.formats.tail {
                self.tail_registers(rank, formats, &mut list);
            }
            if rank >= 1 {
                list.add(Register::Region, QFormat::field(2), rank == 1);
            }
        }
        let computed = rank <= 1 || rank == last;
        list.add(Register::Status, QFormat::field(self.status_width()), computed);
        list.registers
    }

    fn input_registers(&self, list: &mut List) {
        list.add(Register::X, self.formats.input, true);
        self.field(list, Register::Cut, true);
        self.field(list, Register::Shift(0), true);
        for segment in 1..self.segment_count() {
            self.field(list, Register::HandOver(segment), true);
            self.field(list, Register::Shift(segment), true);
        }
    }

    fn polynomial_registers(&self, rank: usize, formats: &PolynomialFormats, list: &mut List) {
        let degree = formats.degree();
        for power in (0..=degree).rev() {
            // The two highest meet in stage 1, each other in the stage after: it waits until then.
            let stage = (degree - power).max(1);
            if rank < HEAD_RANKS + stage - 1 {
                self.coefficient(list, rank, power);
            }
        }
        if rank == 0 {
            for segment in 1..self.segment_count() {
                for power in (0..=degree).rev() {
                    self.field(list, Register::C(segment, power), true);
                }
            }
        }
        let done = (rank + 1).saturating_sub(HEAD_RANKS);
        if rank > 0 && done < degree {
            list.add(Register::V, formats.v, rank == 1);
        }
        if let Some(&format) = formats.t().get(done.min(degree).wrapping_sub(1)) {
            list.add(Register::T(done.min(degree)), format, done <= degree);
        }
    }

    fn tail_registers(&self, rank: usize, formats: &TailFormats, list: &mut List) {
        if rank < HEAD_RANKS {
            self.field(list, Register::TailA, rank == 0);
            self.field(list, Register::TailB, rank == 0);
        }
        if rank == 1 {
            list.add(Register::TailX, self.tail_x_format(), true);
        }
        if rank >= HEAD_RANKS {
            let steps = self.divider.map_or(0, |divider| divider.digit_stages() as usize);
            let working = rank <= HEAD_RANKS + steps;
            // After the last quotient bits nothing reads the divisor.
            if rank < HEAD_RANKS + steps {
                list.add(Register::Divisor, formats.divisor, rank == HEAD_RANKS);
            }
            list.add(Register::Remainder, formats.divisor, working);
            list.add(Register::Digits, formats.digits, working);
        }
    }

    /// The divider's x is clamped to [0, 1], so a sign bit of the input is not carried.
    #[must_use]
    pub fn tail_x_format(&self) -> QFormat {
        let fraction = self.formats.input.fraction_bits();
        QFormat::for_range(0, self.front_end.greatest.into(), fraction).unwrap_or(self.formats.input)
    }

    fn field(&self, list: &mut List, register: Register, computed: bool) {
        if let Some(field) = self.rom.layout().field(register)
            && matches!(field.place, Place::Stored { .. })
        {
            list.add(register, field.format, computed);
        }
    }

    /// A coefficient of the first segment in rank 0, that of the answering segment from rank 1 on.
    fn coefficient(&self, list: &mut List, rank: usize, power: usize) {
        let register = Register::C(0, power);
        if rank == 0 {
            self.field(list, register, true);
        } else if self.is_carried(power)
            && let Some(field) = self.rom.layout().field(register)
        {
            list.add(register, field.format, rank == 1 && self.segment_count() > 1);
        }
    }

    /// True where the coefficient of v^power takes a register behind the front end: it is not the same constant in
    /// every row and segment.
    #[must_use]
    pub fn is_carried(&self, power: usize) -> bool {
        let place = |segment| {
            let field = self.rom.layout().field(Register::C(segment, power));
            field.map(|field| field.place)
        };
        let first = place(0);
        matches!(first, Some(Place::Stored { .. })) || (1..self.segment_count()).any(|segment| place(segment) != first)
    }
}

struct List {
    registers: Vec<RankRegister>,
}

impl List {
    fn add(&mut self, register: Register, format: QFormat, computed: bool) {
        self.registers.push(RankRegister { register, format, computed });
    }
}
