//! The registers of each rank: what it holds, in which format, and whether it computes it or carries it on.

use crate::format::QFormat;
use crate::pipelining::LineStep;
use crate::registers::Register;
use crate::rom::Place;

use super::formats::{PolynomialFormats, TailFormats};
use super::front_end::Variable;
use super::parts::Datapath;
use super::signals::RankRegister;

impl Datapath {
    /// The registers of a rank, in the order of traces and vectors. Constants take none.
    #[must_use]
    pub fn registers(&self, rank: usize) -> Vec<RankRegister> {
        let last = self.rank_count() - 1;
        let compare = self.pipelining.compare_rank();
        let mut list = List { registers: Vec::new() };
        if rank == last {
            list.add(Register::Intensity, self.formats.output, true);
        } else {
            if rank < compare {
                self.input_registers(rank, &mut list);
            } else if rank < self.pipelining.front_end_rank() {
                self.compared_registers(&mut list);
            }
            if let Some(formats) = &self.formats.polynomial {
                self.polynomial_registers(rank, formats, &mut list);
            }
            if let Some(formats) = &self.formats.tail {
                self.tail_registers(rank, formats, &mut list);
            }
            if rank >= compare {
                list.add(Register::Region, QFormat::field(2), rank == compare);
            }
        }
        let computed = rank == 0 || rank == compare || rank == last;
        list.add(Register::Status, QFormat::field(self.status_width()), computed);
        list.registers
    }

    fn input_registers(&self, rank: usize, list: &mut List) {
        list.add(Register::X, self.formats.input, rank == 0);
        self.field(list, Register::Cut, rank == 0);
        self.field(list, Register::Shift(0), rank == 0);
        for segment in 1..self.segment_count() {
            self.field(list, Register::HandOver(segment), rank == 0);
            self.field(list, Register::Shift(segment), rank == 0);
        }
    }

    /// What a cut front end knows of x before it chooses.
    fn compared_registers(&self, list: &mut List) {
        let centred = matches!(self.front_end.variable, Some(Variable::U { .. }));
        if !centred || self.divider.is_some() {
            list.add(Register::X, self.tail_x_format(), true);
        }
        for segment in 0..self.segment_count() {
            self.field(list, Register::Shift(segment), false);
        }
        for segment in (0..self.segment_count()).filter(|_| centred) {
            if let Some(format) = self.distance_format(segment) {
                list.add(Register::Distance(segment), format, true);
            }
        }
        if self.segment_count() > 1 {
            list.add(Register::Beyond, QFormat::field(self.segment_count() as u32 - 1), true);
        }
    }

    fn polynomial_registers(&self, rank: usize, formats: &PolynomialFormats, list: &mut List) {
        let degree = formats.degree();
        let front_end = self.pipelining.front_end_rank();
        for power in (0..=degree).rev() {
            // Each waits for the multiply-add that takes it in.
            if rank < self.read_by(Register::C(0, power)) {
                self.coefficient(list, rank, power);
            }
        }
        if rank < front_end {
            for segment in 1..self.segment_count() {
                for power in (0..=degree).rev() {
                    self.field(list, Register::C(segment, power), rank == 0);
                }
            }
        }
        if (front_end..self.read_by(Register::V)).contains(&rank) {
            list.add(Register::V, formats.v, rank == front_end);
        }
        if let Some((stage, step)) = self.polynomial_step(rank) {
            self.line_registers(stage, step, list);
        }
        for (stage, &format) in (1..).zip(formats.t()) {
            let computed = self.rank_of(Register::T(stage));
            if (computed..self.read_by(Register::T(stage))).contains(&rank) {
                list.add(Register::T(stage), format, rank == computed);
            }
        }
    }

    /// Products or sum of a multiply-add, in the rank that computes them: the next step reads them.
    fn line_registers(&self, line: usize, step: LineStep, list: &mut List) {
        let registers: Vec<Register> = match step {
            LineStep::Partial => self.pieces(line).map(|piece| Register::Partial(line, piece.part)).collect(),
            LineStep::Product => vec![Register::Product(line)],
            LineStep::Sum => vec![Register::Sum(line)],
            LineStep::Operands | LineStep::Result => Vec::new(),
        };
        for register in registers {
            if let Some(format) = self.line_format(register) {
                list.add(register, format, true);
            }
        }
    }

    fn tail_registers(&self, rank: usize, formats: &TailFormats, list: &mut List) {
        for field in [Register::TailA, Register::TailB] {
            if rank < self.read_by(field) {
                self.field(list, field, rank == 0);
            }
        }
        let front_end = self.pipelining.front_end_rank();
        if (front_end..self.read_by(Register::TailX)).contains(&rank) {
            list.add(Register::TailX, self.tail_x_format(), rank == front_end);
        }
        if let Some(step) = self.divisor_step(rank) {
            self.line_registers(0, step, list);
        }
        if let Some(index) = rank.checked_sub(self.rank_of(Register::Divisor)) {
            let steps = self.divider.map_or(0, |divider| divider.digit_stages() as usize);
            let working = index <= steps;
            // After the last quotient bits nothing reads the divisor.
            if index < steps {
                list.add(Register::Divisor, formats.divisor, index == 0);
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

    /// 1 − x lies in [0, 1]; hand-over − x may be less, for an x that another segment answers. None where 63 bits do
    /// not hold it.
    pub(super) fn distance_format(&self, segment: usize) -> Option<QFormat> {
        let one = i128::from(self.front_end.one);
        let least = if segment == 0 { 0 } else { -one };
        QFormat::for_range(least, one, self.formats.input.fraction_bits()).ok()
    }

    fn field(&self, list: &mut List, register: Register, computed: bool) {
        if let Some(field) = self.rom.layout().field(register)
            && matches!(field.place, Place::Stored { .. })
        {
            list.add(register, field.format, computed);
        }
    }

    /// A coefficient of the first segment up to the front end, that of the answering segment from there on.
    fn coefficient(&self, list: &mut List, rank: usize, power: usize) {
        let register = Register::C(0, power);
        let front_end = self.pipelining.front_end_rank();
        if rank < front_end {
            self.field(list, register, rank == 0);
        } else if self.is_carried(power)
            && let Some(field) = self.rom.layout().field(register)
        {
            list.add(register, field.format, rank == front_end && self.segment_count() > 1);
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
