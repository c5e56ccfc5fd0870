//! Which x kill which fault of a row, many x at a time.

use hw_model::datapath::{Block, Datapath};
use hw_model::registers::Register;
use hw_model::rom::Row;

use super::fault::FieldFault;
use super::list::field_faults;
use super::screen::compare;

/// A set of a row's faults: bit k is the k-th of [`RowFaults::faults`].
pub type Mask = u128;

// Each field up and down.
const _: () = assert!(2 * Register::ROM_COUNT < Mask::BITS as usize);

/// The faults of one row, and what its hardware answers under each of them.
#[derive(Debug)]
pub struct RowFaults<'a> {
    datapath: &'a Datapath,
    golden: Row,
    faults: Vec<FieldFault>,
    rows: Vec<Row>,
    right: Block,
    wrong: Block,
}

impl<'a> RowFaults<'a> {
    /// The faults of the row at an address.
    #[must_use]
    pub fn new(datapath: &'a Datapath, address: u32) -> Self {
        let golden = datapath.row(address);
        let faults = field_faults(datapath, address);
        let faulty = |fault: &FieldFault| {
            let mut row = golden;
            row.set(fault.field, row.get(fault.field) + fault.step);
            row
        };
        let rows = faults.iter().map(faulty).collect();
        Self { datapath, golden, faults, rows, right: Block::default(), wrong: Block::default() }
    }

    /// The faults of the row's stored fields, in the order of the fields.
    #[must_use]
    pub fn faults(&self) -> &[FieldFault] {
        &self.faults
    }

    /// The set of all of them.
    #[must_use]
    pub fn all(&self) -> Mask {
        (1 << self.faults.len()) - 1
    }

    /// The set of those of one field.
    #[must_use]
    pub fn of_field(&self, field: Register) -> Mask {
        let bits = self.faults.iter().enumerate().filter(|(_, fault)| fault.field == field);
        bits.fold(0, |set, (bit, _)| set | 1 << bit)
    }

    /// For each x, the faults of `wanted` that it kills. Chunks of neighbouring x are fast: a part
    /// of the pipeline that none of them reaches is not evaluated.
    pub fn killed(&mut self, xs: &[i64], wanted: Mask, masks: &mut Vec<Mask>) {
        masks.clear();
        masks.resize(xs.len(), 0);
        let (Some(&low), Some(&high)) = (xs.iter().min(), xs.iter().max()) else { return };
        let met: Vec<usize> = (0..self.faults.len())
            .filter(|&fault| wanted >> fault & 1 == 1 && self.is_met(self.faults[fault], low, high))
            .collect();
        if met.is_empty() {
            return;
        }
        self.datapath.evaluate_row(&self.golden, None, xs, &mut self.right);
        for fault in met {
            self.datapath.evaluate_row(&self.rows[fault], None, xs, &mut self.wrong);
            let one = self.datapath.output_one();
            compare(&self.right, &self.wrong, one, |index| masks[index] |= 1 << fault);
        }
    }

    /// True when some x of `low..=high` may reach the part of the pipeline that the field belongs to.
    fn is_met(&self, fault: FieldFault, low: i64, high: i64) -> bool {
        let front_end = self.datapath.front_end();
        let cut = match self.datapath.degree() {
            0 => i64::MAX,
            _ => front_end.cut(&self.golden),
        };
        match fault.field {
            Register::Cut => {
                let place = 1 << front_end.cut_up;
                low - place < cut && cut - place <= high
            }
            Register::TailA | Register::TailB => low < cut,
            Register::C(segment @ 1.., _) | Register::Shift(segment @ 1..) => {
                high >= cut && low < front_end.hand_over(&self.golden, segment)
            }
            _ => high >= cut,
        }
    }
}
