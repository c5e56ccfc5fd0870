//! What faulty hardware answers: the data path, with what one rank takes in exchanged.

use hw_model::datapath::front_end::{FrontEnd, Region};
use hw_model::datapath::tail::Division;
use hw_model::datapath::{Datapath, Signals, Status};
use hw_model::format::QFormat;
use hw_model::registers::Register;
use hw_model::rounding::Rounding;

use super::fault::{Defect, Fault, Logic, is_data, place};
use crate::case::Case;
use crate::reference::Expected;

/// A data path, and what its registers hold of a value that does not fit.
#[derive(Debug)]
pub struct Model<'a> {
    datapath: &'a Datapath,
    /// The same in the wide lane, where values that do not fit have room until they wrap.
    wide: Datapath,
    /// The computed data registers of each rank.
    registers: Vec<Vec<(Register, QFormat)>>,
}

/// Hardware with one fault.
#[derive(Debug)]
pub struct Faulty<'a> {
    model: &'a Model<'a>,
    fault: Fault,
    rank: usize,
    /// The data path with a part exchanged, for faults of a line.
    altered: Option<Datapath>,
}

impl<'a> Model<'a> {
    /// The model of a data path.
    #[must_use]
    pub fn new(datapath: &'a Datapath) -> Self {
        let of_rank = |rank| {
            let computed = datapath.registers(rank).into_iter().filter(|held| held.computed);
            let known = computed.filter(|held| is_data(held.register));
            known.map(|held| (held.register, held.format)).collect()
        };
        Self {
            datapath,
            wide: datapath.clone().in_wide_lane(),
            registers: (0..datapath.rank_count()).map(of_rank).collect(),
        }
    }

    /// The hardware with this fault.
    #[must_use]
    pub fn faulty(&'a self, fault: Fault) -> Faulty<'a> {
        let rank = self.rank_of(fault);
        Faulty { model: self, fault, rank, altered: self.altered(fault) }
    }

    /// The rank that takes in something else.
    fn rank_of(&self, fault: Fault) -> usize {
        let last = self.datapath.rank_count() - 1;
        match fault {
            Fault::Field(_) | Fault::Swap(_) => 0,
            Fault::Register(rank, ..) => rank,
            Fault::Rounding(line, _) => match line {
                Register::V | Register::T(_) | Register::Divisor => self.datapath.rank_of(line),
                _ => last,
            },
            Fault::Logic(logic) => match logic {
                Logic::NoClampBelow | Logic::NoClampAbove | Logic::NoQuotientClamp | Logic::NoFlag(_) => last,
                // The divider's first rank has the divisor, the first quotient bits come in the next.
                Logic::DigitMissing => self.datapath.rank_of(Register::Divisor) + self.digit_stages() as usize,
                // In a cut front end it is chosen behind the comparisons.
                Logic::ShiftMore(_) | Logic::ShiftLess => self.datapath.rank_of(Register::V),
                _ => self.datapath.rank_of(Register::Region),
            },
        }
    }

    fn digit_stages(&self) -> u32 {
        self.datapath.divider().map_or(0, |divider| divider.digit_stages())
    }

    fn altered(&self, fault: Fault) -> Option<Datapath> {
        match fault {
            // A rounding carry at most beyond the right value: the lane has room for that.
            Fault::Rounding(line, mode) => rounded(self.datapath.clone(), line, mode),
            Fault::Logic(Logic::NoInputClamp) => {
                let front_end = *self.datapath.front_end();
                let greatest = self.datapath.formats().input.max_bits();
                Some(self.wide.clone().with_front_end(FrontEnd { greatest, ..front_end }))
            }
            // A unit beyond the cut may be less than a unit of the ROM's.
            Fault::Logic(Logic::CutExclusive) => {
                let front_end = FrontEnd { cut_up: 0, ..*self.datapath.front_end() };
                Some(self.wide.clone().with_front_end(front_end))
            }
            _ => None,
        }
    }

    /// What fits the registers of a rank.
    fn trim(&self, rank: usize, signals: &mut Signals) {
        for &(register, format) in &self.registers[rank] {
            if let Some(bits) = place(register, signals) {
                *bits = format.from_word(*bits as u64);
            }
        }
    }
}

fn rounded(datapath: Datapath, line: Register, mode: Rounding) -> Option<Datapath> {
    let (front_end, divider) = (*datapath.front_end(), datapath.divider().copied());
    match line {
        Register::V => Some(datapath.with_front_end(front_end.rounded_by(mode))),
        Register::T(stage) => {
            let line = datapath.stages().get(stage - 1)?.rounded_by(mode);
            Some(datapath.with_stage(stage - 1, line))
        }
        Register::Divisor => {
            let mut divider = divider?;
            divider.divisor = divider.divisor.rounded_by(mode);
            Some(datapath.with_divider(divider))
        }
        _ => {
            let mut divider = divider?;
            divider.rounding = mode;
            Some(datapath.with_divider(divider))
        }
    }
}

impl Faulty<'_> {
    /// The fault that this hardware has.
    #[must_use]
    pub const fn fault(&self) -> Fault {
        self.fault
    }

    /// The rank where it acts: what stands before it is right.
    #[must_use]
    pub const fn rank(&self) -> usize {
        self.rank
    }

    /// The data path without the fault.
    #[must_use]
    pub const fn datapath(&self) -> &Datapath {
        self.model.datapath
    }

    /// The data path with a line exchanged, where the fault is one of a line.
    #[must_use]
    pub const fn altered(&self) -> Option<&Datapath> {
        self.altered.as_ref()
    }

    /// The format of a register of the faulty rank.
    #[must_use]
    pub fn format(&self, register: Register) -> Option<QFormat> {
        let registers = &self.model.registers[self.rank];
        registers.iter().find(|(known, _)| *known == register).map(|&(_, format)| format)
    }

    /// What the ports show.
    #[must_use]
    pub fn answer(&self, case: Case) -> Expected {
        let passage = self.model.datapath.passage(case.address, case.x);
        expected(&self.last(&passage))
    }

    /// True when the ports show something else than the golden model, which went through `passage`:
    /// what each of its ranks holds, first to last.
    #[must_use]
    pub fn is_killed(&self, passage: &[Signals]) -> bool {
        // Most inputs do not meet the fault, and nothing needs to be computed behind it.
        let begun = self.takes_in(passage);
        passage.get(self.rank) != Some(&begun) && passage.last().map(expected) != Some(expected(&self.rest(begun)))
    }

    fn last(&self, passage: &[Signals]) -> Signals {
        self.rest(self.takes_in(passage))
    }

    fn rest(&self, begun: Signals) -> Signals {
        (self.rank + 1..self.model.datapath.rank_count()).fold(begun, |held, rank| {
            let mut next = self.model.wide.advance(rank, &held);
            self.model.trim(rank, &mut next);
            next
        })
    }

    /// What the faulty rank holds.
    fn takes_in(&self, passage: &[Signals]) -> Signals {
        let mut held = passage[self.rank];
        match self.fault {
            Fault::Field(fault) => {
                if held.address == fault.address {
                    held.row.set(fault.field, held.row.get(fault.field) + fault.step);
                }
                return held;
            }
            Fault::Swap(address) => {
                if held.address == address || held.address == address + 1 {
                    held.row = self.model.datapath.row(2 * address + 1 - held.address);
                }
                return held;
            }
            Fault::Register(_, register, defect) => self.damage(register, defect, &mut held),
            Fault::Rounding(..) => {
                held = self.path().advance(self.rank, &passage[self.rank - 1]);
            }
            Fault::Logic(logic) => self.choose(logic, &passage[self.rank - 1], &mut held),
        }
        self.model.trim(self.rank, &mut held);
        held
    }

    fn path(&self) -> &Datapath {
        self.altered.as_ref().unwrap_or(&self.model.wide)
    }

    fn damage(&self, register: Register, defect: Defect, held: &mut Signals) {
        let Some(format) = self.format(register) else { return };
        let Some(bits) = place(register, held) else { return };
        *bits = match defect {
            Defect::LowBitStuck => *bits & !1,
            Defect::Short => narrower(format).map_or(0, |format| format.from_word(*bits as u64)),
        };
    }

    fn choose(&self, logic: Logic, before: &Signals, held: &mut Signals) {
        let path = self.path();
        match logic {
            Logic::CutExclusive => {
                let cut = self.model.datapath.front_end().cut(&before.row);
                self.with_field(Register::Cut, cut + 1, before, held);
            }
            Logic::ShiftMore(segment) => {
                let shift = Register::Shift(segment);
                self.with_field(shift, before.row.get(shift) + 1, before, held);
            }
            Logic::ShiftLess => {
                let shift = Register::Shift(0);
                self.with_field(shift, (before.row.get(shift) - 1).max(0), before, held);
            }
            Logic::HandOverExclusive(segment) => {
                let hand_over = path.front_end().hand_over(&before.row, segment);
                if held.region == Region::Polynomial && held.x == hand_over && hand_over > 0 {
                    if self.chooses_later() {
                        held.beyond |= 1 << (segment - 1);
                    } else {
                        held.row = before.row.in_segment(segment);
                        held.v = 0;
                    }
                }
            }
            Logic::NoInputClamp => *held = path.advance(self.rank, before),
            Logic::NegativeAsUnsigned => {
                let x = path.formats().input.to_word(before.x) as i64;
                *held = path.advance(self.rank, &Signals { x, ..*before });
            }
            Logic::RegionsSwapped => self.swap_regions(before, held),
            Logic::NoClampBelow if held.region == Region::Polynomial => {
                held.intensity = last(before, path).min(held.intensity);
            }
            Logic::NoClampAbove if held.region == Region::Polynomial => {
                held.intensity = last(before, path).max(held.intensity);
            }
            Logic::NoQuotientClamp if held.region == Region::Tail => {
                if let Some(divider) = path.divider() {
                    held.intensity = divider.finish(wide(before), i64::MAX.into()) as i64;
                }
            }
            Logic::NoFlag(flag) => held.status = held.status.without(flag),
            Logic::DigitMissing => self.omit_digit(before, held),
            Logic::NoClampBelow | Logic::NoClampAbove | Logic::NoQuotientClamp => {}
        }
    }

    /// The rank, with a field of the row as the logic takes it; in the row itself it stays.
    fn with_field(&self, field: Register, bits: i64, before: &Signals, held: &mut Signals) {
        let mut row = before.row;
        row.set(field, bits);
        *held = self.path().advance(self.rank, &Signals { row, ..*before });
        held.row.set(field, before.row.get(field));
    }

    fn swap_regions(&self, before: &Signals, held: &mut Signals) {
        let front_end = self.model.datapath.front_end();
        // Neither is a matter of the cut.
        if [Status::NO_WORD, Status::FACING_AWAY].iter().any(|flag| held.status.contains(*flag)) {
            return;
        }
        let other = if front_end.tail { Region::Tail } else { Region::Zero };
        held.region = match held.region {
            Region::Polynomial => other,
            region if region == other => Region::Polynomial,
            region => region,
        };
        let (x, row) = (i128::from(held.x), &before.row);
        let segment = match held.region {
            Region::Polynomial => front_end.segment_of(row, held.x),
            _ => 0,
        };
        if self.chooses_later() {
            held.beyond = if segment > 0 { 1 << (segment - 1) } else { 0 };
            return;
        }
        let (start, shift) = (front_end.start(row, segment).into(), row.shift(segment));
        held.row = row.in_segment(segment);
        held.v = front_end.variable(x, held.region, start, shift) as i64;
        held.tail_x = front_end.tail_x(held.x, held.region);
    }

    /// True where the front end is cut: the rank that compares x does not choose the segment yet.
    fn chooses_later(&self) -> bool {
        let datapath = self.model.datapath;
        datapath.rank_of(Register::Region) < datapath.rank_of(Register::V)
    }

    /// The last rank of quotient bits, with one less.
    fn omit_digit(&self, before: &Signals, held: &mut Signals) {
        let Some(divider) = self.model.datapath.divider() else { return };
        let done = (divider.digit_stages() - 1) * divider.digits_per_stage;
        let count = divider.digit_count - done - 1;
        let division = (0..count).fold(wide(before), |division, _| divider.digit(division));
        held.division = Division {
            divisor: division.divisor as i64,
            remainder: division.remainder as i64,
            digits: division.digits as i64,
        };
    }
}

/// What the last stage gave.
fn last(signals: &Signals, path: &Datapath) -> i64 {
    signals.get(Register::T(path.degree()))
}

fn wide(signals: &Signals) -> Division<i128> {
    let Division { divisor, remainder, digits } = signals.division;
    Division { divisor: divisor.into(), remainder: remainder.into(), digits: digits.into() }
}

/// A format of one bit less at the top; none where it has only one.
pub(super) fn narrower(format: QFormat) -> Option<QFormat> {
    let (integer, fraction) = (format.integer_bits() - 1, format.fraction_bits());
    let narrower = match format.is_signed() {
        true => QFormat::signed(integer, fraction),
        false => QFormat::unsigned(integer, fraction),
    };
    narrower.ok()
}

fn expected(last: &Signals) -> Expected {
    Expected { intensity: last.intensity, status: last.status.bits() }
}
