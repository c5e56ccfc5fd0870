//! A block of samples of one exponent at a time: the same lines, without the ranks.
//!
//! The coefficients are hoisted out of the loop, each line runs over an array, and regions are
//! selected instead of branched on, so that a compiler can put several samples in one instruction.

use multiversion::multiversion;

use crate::rom::{FieldName, Row};
use crate::rounding::{Lane, Rounding};

use super::clamp::clamp;
use super::front_end::{FrontEnd, Region};
use super::keep::{Damage, Keep, Registers};
use super::ranks::Datapath;
use super::stage::MultiplyAdd;
use super::tail::{Divider, Division};

/// Samples that go through the lines together.
const LANES: usize = 64;

/// The intensities of a block of samples, and the part that answered each.
#[derive(Debug, Clone, Default)]
pub struct Block {
    /// In the output's unit.
    pub intensities: Vec<i64>,
    /// The part that answered.
    pub regions: Vec<Region>,
}

impl Block {
    fn clear(&mut self, len: usize) {
        self.intensities.clear();
        self.regions.clear();
        self.intensities.resize(len, 0);
        self.regions.resize(len, Region::Zero);
    }
}

impl Datapath {
    /// Evaluates every x at one address into `block`, whose memory is used again. An address without
    /// a word gives zeros.
    pub fn evaluate_block(&self, address: u32, xs: &[i64], block: &mut Block) {
        block.clear(xs.len());
        let Some(row) = self.rom.row(address) else {
            return;
        };
        if self.narrow {
            narrow_block(self, row, xs, block);
        } else {
            Lines::of(self).evaluate::<i128, _>(row, xs, block, &Registers::WHOLE);
        }
    }

    /// Evaluates every x with a row that need not be one of the ROM's, only in its formats, and with a
    /// register that may be damaged. What does not fit its register wraps there. The polynomial's answers
    /// are those before the [`clamp`](fn@super::clamp::clamp), so that its flag can be told as well.
    pub fn evaluate_row(&self, row: &Row, damage: Option<&Damage>, xs: &[i64], block: &mut Block) {
        block.clear(xs.len());
        if self.narrow {
            narrow_row(self, row, damage, xs, block);
        } else {
            let registers = Registers::trimmed(&self.formats, damage);
            Lines::of(self).evaluate::<i128, _>(row, xs, block, &registers);
        }
    }
}

/// The block in the narrow lane, compiled once for each vector width named here; the first that the
/// machine has is chosen at run time. Integers give the same bits in all of them.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn narrow_block(datapath: &Datapath, row: &Row, xs: &[i64], block: &mut Block) {
    Lines::of(datapath).evaluate::<i64, _>(row, xs, block, &Registers::WHOLE);
}

/// The same with trimmed registers.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn narrow_row(
    datapath: &Datapath,
    row: &Row,
    damage: Option<&Damage>,
    xs: &[i64],
    block: &mut Block,
) {
    let registers = Registers::trimmed(&datapath.formats, damage);
    Lines::of(datapath).evaluate::<i64, _>(row, xs, block, &registers);
}

/// What one segment brings to the polynomial.
#[derive(Clone, Copy)]
pub(super) struct Segment<L> {
    pub(super) start: L,
    pub(super) shift: u32,
    /// c0 to c3.
    pub(super) c: [L; 4],
}

impl<L: Lane> Segment<L> {
    /// The first, which counts from 1.
    #[inline(always)]
    pub(super) fn first(row: &Row, one: L) -> Self {
        Self::of(row, FieldName::COEFFICIENTS, one, row.shift())
    }

    /// The second, which counts from where the first hands over.
    #[inline(always)]
    pub(super) fn outer(row: &Row, hand_over: L) -> Self {
        Self::of(row, FieldName::OUTER_COEFFICIENTS, hand_over, row.shift_outer())
    }

    #[inline(always)]
    fn of(row: &Row, names: [FieldName; 4], start: L, shift: u32) -> Self {
        Self { start, shift, c: names.map(|name| L::from_bits(row.get(name))) }
    }
}

/// The lines of a data path, out of their ranks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lines {
    pub(super) front_end: FrontEnd,
    pub(super) stages: Option<[MultiplyAdd; 3]>,
    pub(super) divider: Option<Divider>,
    pub(super) output_one: i64,
}

impl Lines {
    pub(super) fn of(datapath: &Datapath) -> Self {
        Self {
            front_end: datapath.front_end,
            stages: datapath.stages,
            divider: datapath.divider,
            output_one: datapath.output_one,
        }
    }

    /// The same lines, with a mode that the compiler knows: it leaves no choice in the loops.
    #[inline(always)]
    pub(super) fn rounded_by(self, mode: Rounding) -> Self {
        Self {
            front_end: self.front_end.rounded_by(mode),
            stages: self.stages.map(|stages| stages.map(|stage| stage.rounded_by(mode))),
            divider: self.divider.map(|divider| divider.rounded_by(mode)),
            ..self
        }
    }

    #[inline(always)]
    fn evaluate<L: Lane, K: Keep<L>>(
        self,
        row: &Row,
        xs: &[i64],
        block: &mut Block,
        keep: &Registers<K>,
    ) {
        match self.rounding() {
            Some(Rounding::Floor) => {
                self.rounded_by(Rounding::Floor).chunks::<L, K>(row, xs, block, keep);
            }
            Some(Rounding::NearestUp) => {
                self.rounded_by(Rounding::NearestUp).chunks::<L, K>(row, xs, block, keep);
            }
            _ => self.chunks::<L, K>(row, xs, block, keep),
        }
    }

    /// The mode of every line, where they have one in common.
    pub(super) fn rounding(&self) -> Option<Rounding> {
        let front_end = self.front_end.rounding();
        let stages = self.stages.iter().flatten().map(MultiplyAdd::rounding);
        let divider = self.divider.iter().flat_map(|d| [d.rounding, d.divisor.rounding()]);
        let mut modes = front_end.into_iter().chain(stages).chain(divider);
        let first = modes.next()?;
        modes.all(|mode| mode == first).then_some(first)
    }

    #[inline(always)]
    fn chunks<L: Lane, K: Keep<L>>(
        &self,
        row: &Row,
        xs: &[i64],
        block: &mut Block,
        keep: &Registers<K>,
    ) {
        let outputs = block.intensities.chunks_mut(LANES).zip(block.regions.chunks_mut(LANES));
        for (xs, (intensities, regions)) in xs.chunks(LANES).zip(outputs) {
            self.evaluate_lanes::<L, K>(row, xs, intensities, regions, keep);
        }
    }

    #[inline(always)]
    fn evaluate_lanes<L: Lane, K: Keep<L>>(
        &self,
        row: &Row,
        xs: &[i64],
        intensities: &mut [i64],
        regions: &mut [Region],
        keep: &Registers<K>,
    ) {
        let cut = L::from_bits(self.front_end.cut(row));
        let mut any_tail = false;
        for (&x, region) in xs.iter().zip(regions.iter_mut()) {
            *region = self.front_end.region(L::from_bits(x), cut);
            any_tail |= *region == Region::Tail;
        }
        if self.stages.is_some() {
            self.polynomial_lanes::<L, K>(row, xs, regions, intensities, keep);
        }
        if any_tail {
            self.tail_lanes::<L, K>(row, xs, regions, intensities, keep);
        }
    }

    #[inline(always)]
    fn polynomial_lanes<L: Lane, K: Keep<L>>(
        &self,
        row: &Row,
        xs: &[i64],
        regions: &[Region],
        intensities: &mut [i64],
        keep: &Registers<K>,
    ) {
        let Some([stage1, stage2, stage3]) = &self.stages else {
            return;
        };
        let one = L::from_bits(self.output_one);
        let hand_over = L::from_bits(self.front_end.hand_over(row));
        let first = Segment::first(row, L::from_bits(self.front_end.one));
        let second = Segment::outer(row, hand_over);
        for ((&x, &region), intensity) in xs.iter().zip(regions).zip(intensities) {
            let x = self.front_end.clamp_input(L::from_bits(x));
            let outer = self.front_end.is_outer(x, region, hand_over);
            let Segment { start, shift, c: [c0, c1, c2, c3] } = if outer { second } else { first };
            let v = keep.v.keep(self.front_end.variable(x, region, start, shift));
            let t1 = keep.t[0].keep(stage1.apply(c3, v, c2));
            let t2 = keep.t[1].keep(stage2.apply(t1, v, c1));
            let t3 = keep.t[2].keep(stage3.apply(t2, v, c0));
            let answers = region == Region::Polynomial;
            *intensity = match answers {
                true if K::WHOLE => clamp(t3, one).to_bits(),
                true => t3.to_bits(),
                false => 0,
            };
        }
    }

    #[inline(always)]
    fn tail_lanes<L: Lane, K: Keep<L>>(
        &self,
        row: &Row,
        xs: &[i64],
        regions: &[Region],
        intensities: &mut [i64],
        keep: &Registers<K>,
    ) {
        let Some(divider) = &self.divider else { return };
        let a = L::from_bits(row.get(FieldName::TailA));
        let b = L::from_bits(row.get(FieldName::TailB));
        // One array for each register, so that lanes lie side by side.
        let mut divisors = [L::ONE; LANES];
        let mut remainders = [L::ZERO; LANES];
        let mut digits = [L::ZERO; LANES];
        let (keep_remainder, keep_digits) = keep.behind_stage(0);
        for (lane, (&x, &region)) in xs.iter().zip(regions).enumerate() {
            let x = self.front_end.clamp_input(L::from_bits(x));
            let x = keep.tail_x.keep(self.front_end.tail_x(x, region));
            let begun = divider.begin(x, a, b);
            divisors[lane] = keep.divisor.keep(begun.divisor);
            remainders[lane] = keep_remainder.keep(begun.remainder);
            digits[lane] = keep_digits.keep(begun.digits);
        }
        for digit in 0..divider.digit_count {
            divider.digit_of_all(&divisors, &mut remainders, &mut digits);
            if !K::WHOLE && divider.ends_stage(digit) {
                let stage = 1 + digit / divider.digits_per_stage;
                let (keep_remainder, keep_digits) = keep.behind_stage(stage as usize);
                remainders = remainders.map(|remainder| keep_remainder.keep(remainder));
                digits = digits.map(|digits| keep_digits.keep(digits));
            }
        }
        let one = L::from_bits(self.output_one);
        for (lane, (&region, intensity)) in regions.iter().zip(intensities).enumerate() {
            let (divisor, remainder, digits) = (divisors[lane], remainders[lane], digits[lane]);
            let quotient = divider.finish(Division { divisor, remainder, digits }, one).to_bits();
            *intensity = if region == Region::Tail { quotient } else { *intensity };
        }
    }
}
