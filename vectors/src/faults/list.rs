//! Which faults a data path can have.

use hw_model::datapath::front_end::Variable;
use hw_model::datapath::{Datapath, Status};
use hw_model::registers::Register;
use hw_model::rom::Place;
use hw_model::rounding::Rounding;

use super::fault::{Defect, Fault, FieldFault, Logic, is_data};

/// The faults of one row: each stored field one unit up and one down, where its format holds that.
/// At most twice the fields.
#[must_use]
pub fn field_faults(datapath: &Datapath, address: u32) -> Vec<FieldFault> {
    let Some(row) = datapath.rom().row(address) else {
        return Vec::new();
    };
    let fields = datapath.rom().layout().fields().iter();
    let stored = fields.filter(|field| matches!(field.place, Place::Stored { .. }));
    let steps = stored.flat_map(|field| [1, -1].map(|step| (field, step)));
    steps
        .filter(|(field, step)| field.format.holds((row.get(field.name) + step).into()))
        .map(|(field, step)| FieldFault { address, field: field.name, step })
        .collect()
}

/// Every fault that is not one of a single row: swapped rows, rounding, registers, logic.
#[must_use]
pub fn pipeline_faults(datapath: &Datapath) -> Vec<Fault> {
    let depth = datapath.rom().depth() as u32;
    let mut faults: Vec<Fault> = logic(datapath).into_iter().map(Fault::Logic).collect();
    for line in rounding_lines(datapath) {
        let mode = line_mode(datapath, line);
        let others = Rounding::ALL.into_iter().filter(|&other| Some(other) != mode);
        faults.extend(others.map(|other| Fault::Rounding(line, other)));
    }
    faults.extend(registers(datapath));
    faults.extend((0..depth.saturating_sub(1)).map(Fault::Swap));
    faults
}

/// The lines that drop bits, by the registers that take what they round.
fn rounding_lines(datapath: &Datapath) -> Vec<Register> {
    let mut lines = Vec::new();
    if matches!(datapath.front_end().variable, Some(Variable::U { drop: 1.., .. })) {
        lines.push(Register::V);
    }
    for (stage, line) in (1..).zip(datapath.stages()) {
        if line.dropped_bits() > 0 {
            lines.push(Register::T(stage));
        }
    }
    if let Some(divider) = datapath.divider() {
        if divider.divisor.dropped_bits() > 0 {
            lines.push(Register::Divisor);
        }
        lines.push(Register::Intensity);
    }
    lines
}

fn line_mode(datapath: &Datapath, line: Register) -> Option<Rounding> {
    match line {
        Register::V => datapath.front_end().rounding(),
        Register::T(stage) => datapath.stages().get(stage - 1).map(|line| line.rounding()),
        Register::Divisor => datapath.divider().map(|divider| divider.divisor.rounding()),
        _ => datapath.divider().map(|divider| divider.rounding),
    }
}

/// Both defects of every computed data register; a register of one bit has no bit to spare.
fn registers(datapath: &Datapath) -> Vec<Fault> {
    let mut faults = Vec::new();
    for rank in 1..datapath.rank_count() {
        for held in datapath.registers(rank).iter().filter(|held| held.computed) {
            let register = held.register;
            if !is_data(register) {
                continue;
            }
            if held.format.width() > 1 {
                faults.push(Fault::Register(rank, register, Defect::Short));
            }
            faults.push(Fault::Register(rank, register, Defect::LowBitStuck));
        }
    }
    faults
}

/// The mistakes in choices that this data path makes.
fn logic(datapath: &Datapath) -> Vec<Logic> {
    let input = datapath.formats().input;
    let mut list = Vec::new();
    if datapath.degree() > 0 {
        list.extend([Logic::CutExclusive, Logic::RegionsSwapped]);
        list.extend([Logic::NoClampBelow, Logic::NoClampAbove, Logic::NoFlag(Status::CLAMPED)]);
    }
    if datapath.rom().layout().field(Register::Shift(0)).is_some() {
        list.extend([Logic::ShiftMore(0), Logic::ShiftLess]);
    }
    for segment in 1..datapath.segment_count() {
        list.extend([Logic::HandOverExclusive(segment), Logic::ShiftMore(segment)]);
    }
    if datapath.divider().is_some() {
        list.extend([Logic::NoQuotientClamp, Logic::DigitMissing]);
    }
    if input.max_bits() > datapath.front_end().greatest {
        list.extend([Logic::NoInputClamp, Logic::NoFlag(Status::ABOVE_ONE)]);
    }
    if input.is_signed() {
        list.extend([Logic::NegativeAsUnsigned, Logic::NoFlag(Status::FACING_AWAY)]);
    }
    list.push(Logic::NoFlag(Status::NO_WORD));
    if datapath.front_end().guarded {
        list.push(Logic::NoFlag(Status::OUT_OF_DOMAIN));
    }
    list
}
