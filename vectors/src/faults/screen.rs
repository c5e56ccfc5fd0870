//! Which of many x a fault may be seen at, by blocks: for the faults that survive everything cheap, on
//! every input there is.
//!
//! A screen leaves out only x at which the ports cannot differ. Faults whose hardware the block engine can
//! run are compared with the right one; a missing clamp can only be seen where there is something to
//! clamp. What is left is judged one by one ([`super::Faulty::is_killed`]).

use hw_model::datapath::clamp::clamp;
use hw_model::datapath::front_end::Region;
use hw_model::datapath::{Block, Damage, Datapath, Status};
use hw_model::registers::Register;
use hw_model::rom::Row;

use super::evaluate::{Faulty, narrower};
use super::fault::{Defect, Fault, Logic};

/// What the output ports show of one sample of a block, as [`Datapath::evaluate_row`] gives it: the
/// intensity, and whether the polynomial was clamped.
fn shown(block: &Block, index: usize, one: i64) -> (i64, bool) {
    let answer = block.intensities[index];
    match block.regions[index] {
        Region::Polynomial => (clamp(answer, one), clamp(answer, one) != answer),
        // The divider's quotient is clamped without a flag, and already is.
        _ => (answer, false),
    }
}

/// Calls `differs` with the index of each sample that the ports show differently.
pub fn compare(right: &Block, wrong: &Block, one: i64, mut differs: impl FnMut(usize)) {
    let both = right.intensities.iter().zip(&wrong.intensities);
    for (index, (a, b)) in both.enumerate() {
        if a != b && shown(right, index, one) != shown(wrong, index, one) {
            differs(index);
        }
    }
}

/// A row's x, chunk by chunk, under the right hardware.
#[derive(Debug, Default)]
pub struct Screen {
    right: Block,
    wrong: Block,
}

impl Screen {
    /// Takes in a chunk of x, increasing.
    pub fn take(&mut self, datapath: &Datapath, row: &Row, xs: &[i64]) {
        datapath.evaluate_row(row, None, xs, &mut self.right);
    }

    /// The x of the chunk at which the fault may be seen.
    pub fn suspects(&mut self, faulty: &Faulty<'_>, row: &Row, xs: &[i64]) -> Vec<i64> {
        let datapath = faulty.datapath();
        if !is_met(faulty.fault(), datapath, row, xs) {
            return Vec::new();
        }
        let mut suspects = Vec::new();
        match faulty.fault() {
            Fault::Rounding(..) => {
                let path = faulty.altered().unwrap_or(datapath);
                path.evaluate_row(row, None, xs, &mut self.wrong);
            }
            Fault::Register(rank, register, defect) if keeps_in_blocks(register) => {
                let damage = damage(faulty, rank, register, defect);
                datapath.evaluate_row(row, damage.as_ref(), xs, &mut self.wrong);
            }
            Fault::Logic(logic) => match self.clamps(datapath, logic) {
                Some(indices) => return indices.into_iter().map(|index| xs[index]).collect(),
                None => return xs.to_vec(),
            },
            _ => return xs.to_vec(),
        }
        let one = datapath.output_one();
        compare(&self.right, &self.wrong, one, |index| suspects.push(xs[index]));
        suspects
    }

    /// Where there is something to clamp; none for logic of another kind.
    fn clamps(&self, datapath: &Datapath, logic: Logic) -> Option<Vec<usize>> {
        let (region, least) = match logic {
            Logic::NoClampAbove | Logic::NoClampBelow | Logic::NoFlag(Status::CLAMPED) => {
                (Region::Polynomial, datapath.output_one() + 1)
            }
            // A quotient that was clamped shows 1.
            Logic::NoQuotientClamp => (Region::Tail, datapath.output_one()),
            _ => return None,
        };
        let answers = self.right.intensities.iter().zip(&self.right.regions).enumerate();
        let outside =
            answers.filter(|&(_, (&answer, &answered_by))| answered_by == region && (answer >= least || answer < 0));
        Some(outside.map(|(index, _)| index).collect())
    }
}

/// True for the registers of the least pipeline, which the block engine has; the output's is judged one by one.
const fn keeps_in_blocks(register: Register) -> bool {
    use Register::{Digits, Divisor, Remainder, T, TailX, V};
    matches!(register, V | T(_) | TailX | Divisor | Remainder | Digits)
}

fn damage(faulty: &Faulty<'_>, rank: usize, register: Register, defect: Defect) -> Option<Damage> {
    let format = faulty.format(register)?;
    let (format, low_bit_stuck) = match defect {
        Defect::Short => (narrower(format)?, false),
        Defect::LowBitStuck => (format, true),
    };
    Some(Damage { rank, register, format, low_bit_stuck })
}

/// False where no x of the chunk reaches the part of the pipeline that the fault sits in.
fn is_met(fault: Fault, datapath: &Datapath, row: &Row, xs: &[i64]) -> bool {
    let (Some(&low), Some(&high)) = (xs.first(), xs.last()) else { return false };
    let cut = match datapath.degree() {
        0 => i64::MAX,
        _ => datapath.front_end().cut(row),
    };
    match fault {
        Fault::Rounding(register, _) | Fault::Register(_, register, _) => match register {
            Register::V | Register::T(_) | Register::Distance(_) => high >= cut,
            Register::Partial(1.., _) | Register::Product(1..) | Register::Sum(1..) => high >= cut,
            Register::Intensity if matches!(fault, Fault::Register(..)) => true,
            _ => low < cut,
        },
        _ => true,
    }
}
