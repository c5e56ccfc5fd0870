//! A block of samples of one exponent at a time: the same lines, without the ranks.
//!
//! The coefficients are hoisted out of the loop, each line runs over an array, and regions are
//! selected instead of branched on, so that a compiler can put several samples in one instruction.

use multiversion::multiversion;

use crate::registers::Register;
use crate::rom::Row;
use crate::rounding::{Lane, Rounding};

use super::compose::{Anything, Composed, Cubics, Known, Lines, RoundedCubics};
use super::front_end::Region;
use super::keep::{Damage, Keep, Registers};
use super::parts::Datapath;

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

    fn samples(&mut self) -> Samples<'_, Region> {
        Samples { intensities: &mut self.intensities, beside: &mut self.regions }
    }
}

/// Where the answers of a block go: slices as long as that of the x.
struct Samples<'a, B> {
    intensities: &'a mut [i64],
    beside: &'a mut [B],
}

/// What is told of a sample beside its intensity.
trait Beside: Copy {
    fn of<L: Copy>(composed: &Composed<L>) -> Self;
}

impl Beside for Region {
    #[inline(always)]
    fn of<L: Copy>(composed: &Composed<L>) -> Self {
        composed.entered.region
    }
}

/// The status port.
impl Beside for u8 {
    #[inline(always)]
    fn of<L: Copy>(composed: &Composed<L>) -> Self {
        composed.status.bits()
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
            narrow_block(self, row, xs, block.samples());
        } else {
            Lines::of(self).evaluate::<i128, _, _>(row, xs, block.samples(), &Registers::WHOLE);
        }
    }

    /// Evaluates every x at one address: the intensity port and the status port of each, into slices of the same
    /// length as `xs` (what is longer is left as it is). An address without a word gives intensity 0 and the flag.
    pub fn answer_block(&self, address: u32, xs: &[i64], intensities: &mut [i64], status: &mut [u8]) {
        let Some(row) = self.rom.row(address) else {
            return self.answer_without_word(address, xs, intensities, status);
        };
        let samples = Samples { intensities, beside: status };
        if self.narrow {
            narrow_answers(self, row, xs, samples);
        } else {
            Lines::of(self).evaluate::<i128, _, _>(row, xs, samples, &Registers::WHOLE);
        }
    }

    /// The same where the address has no word: rare, so one request after the other.
    fn answer_without_word(&self, address: u32, xs: &[i64], intensities: &mut [i64], status: &mut [u8]) {
        let (logic, mut flight) = (self.logic(), self.flight());
        for ((&x, intensity), status) in xs.iter().zip(intensities).zip(status) {
            logic.enter(self, address, x, &mut flight);
            (*intensity, *status) = (flight.intensity(), flight.status().bits());
        }
    }

    /// Evaluates every x with a row that need not be one of the ROM's, only in its formats, and with a
    /// register that may be damaged. What does not fit its register wraps there. The polynomial's answers
    /// are those before the [`clamp`](fn@super::clamp::clamp), so that its flag can be told as well.
    pub fn evaluate_row(&self, row: &Row, damage: Option<&Damage>, xs: &[i64], block: &mut Block) {
        block.clear(xs.len());
        if self.narrow {
            narrow_row(self, row, damage, xs, block.samples());
        } else {
            let registers = Registers::trimmed(self, damage);
            Lines::of(self).evaluate::<i128, _, _>(row, xs, block.samples(), &registers);
        }
    }
}

/// The block in the narrow lane, compiled once for each vector width named here; the first that the
/// machine has is chosen at run time. Integers give the same bits in all of them.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn narrow_block(datapath: &Datapath, row: &Row, xs: &[i64], samples: Samples<Region>) {
    Lines::of(datapath).evaluate::<i64, _, _>(row, xs, samples, &Registers::WHOLE);
}

/// The same with the status beside each intensity.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn narrow_answers(datapath: &Datapath, row: &Row, xs: &[i64], samples: Samples<u8>) {
    Lines::of(datapath).evaluate::<i64, _, _>(row, xs, samples, &Registers::WHOLE);
}

/// The same with trimmed registers.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn narrow_row(datapath: &Datapath, row: &Row, damage: Option<&Damage>, xs: &[i64], samples: Samples<Region>) {
    let registers = Registers::trimmed(datapath, damage);
    Lines::of(datapath).evaluate::<i64, _, _>(row, xs, samples, &registers);
}

impl Lines {
    /// Chooses what is known of the lines.
    #[inline(always)]
    fn evaluate<L: Lane, R: Keep<L>, B: Beside>(self, row: &Row, xs: &[i64], to: Samples<B>, keep: &Registers<R>) {
        match (self.are_cubics(), self.rounding()) {
            (true, Some(Rounding::Floor)) => self.chunks::<L, RoundedCubics<false>, R, B>(row, xs, to, keep),
            (true, Some(Rounding::NearestUp)) => self.chunks::<L, RoundedCubics<true>, R, B>(row, xs, to, keep),
            (true, _) => self.chunks::<L, Cubics, R, B>(row, xs, to, keep),
            (false, _) => self.chunks::<L, Anything, R, B>(row, xs, to, keep),
        }
    }

    #[inline(always)]
    fn chunks<L: Lane, K: Known, R: Keep<L>, B: Beside>(
        self,
        row: &Row,
        xs: &[i64],
        to: Samples<B>,
        keep: &Registers<R>,
    ) {
        let lines = K::lines(self);
        let outputs = to.intensities.chunks_mut(LANES).zip(to.beside.chunks_mut(LANES));
        let mut regions = [Region::Zero; LANES];
        for (xs, (intensities, beside)) in xs.chunks(LANES).zip(outputs) {
            let mut any_tail = false;
            let places = intensities.iter_mut().zip(beside).zip(&mut regions);
            for (&x, ((intensity, beside), region)) in xs.iter().zip(places) {
                let composed = lines.compose::<L, K, R>(row, L::from_bits(x), keep);
                *beside = B::of(&composed);
                *region = composed.entered.region;
                any_tail |= *region == Region::Tail;
                *intensity = match *region {
                    Region::Polynomial if !R::WHOLE => composed.polynomial.to_bits(),
                    _ => composed.intensity.to_bits(),
                };
            }
            if any_tail {
                lines.tails_of_row::<L, R>(row, xs, &regions, intensities, keep);
            }
        }
    }

    #[inline(always)]
    fn tails_of_row<L: Lane, R: Keep<L>>(
        &self,
        row: &Row,
        xs: &[i64],
        regions: &[Region],
        intensities: &mut [i64],
        keep: &Registers<R>,
    ) {
        let Some(divider) = &self.divider else { return };
        let [a, b] = [Register::TailA, Register::TailB].map(|name| L::from_bits(row.get(name)));
        let operands = |index: usize| {
            let x = self.front_end.clamp_input(L::from_bits(xs[index]));
            [keep.tail_x.keep(self.front_end.tail_x(x, regions[index])), a, b]
        };
        let count = xs.len().min(LANES);
        let divisions = divider.divide::<L, L, R, LANES>(count, operands, self.output_one, keep, |_, _| {});
        let answers = regions.iter().zip(intensities).zip(divisions.quotients());
        for ((&region, intensity), quotient) in answers {
            *intensity = if region == Region::Tail { quotient.to_bits() } else { *intensity };
        }
    }
}
