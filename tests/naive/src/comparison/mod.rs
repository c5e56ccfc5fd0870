//! The golden model against the naive one, and against what it promises of itself.

mod rom;

use std::fmt;

use hw_model::datapath::{Block, RankRegister};
use hw_model::design::{Design, RealRow};
use hw_model::format::QFormat;
use hw_model::registers::Register;
use num_bigint::BigInt;

use crate::Naive;

pub use rom::rom;

/// The kinds of difference between the naive model and the golden one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A register holds something other than the naive model says.
    Differs,
    /// A register holds bits its format does not.
    Overflows,
    /// A block gives something other than the ranks of registers.
    Block,
    /// The error is greater than the bound that was proved for the row.
    Bound,
    /// A ROM integer is not the rounded real coefficient, or the cut is not the least x.
    Rom,
    /// The golden model panicked.
    Panic,
}

/// One complaint, with everything needed to see it again.
#[derive(Debug, Clone)]
pub struct Complaint {
    /// The kind of difference.
    pub kind: Kind,
    /// Where, and the two values.
    pub text: String,
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}: {}", self.kind, self.text)
    }
}

fn complain<T>(kind: Kind, text: String) -> Result<T, Complaint> {
    Err(Complaint { kind, text })
}

/// A design beside its naive model.
pub struct Comparison<'a> {
    design: &'a Design,
    naive: Naive<'a>,
    registers: Vec<Vec<RankRegister>>,
    block: Block,
}

impl<'a> Comparison<'a> {
    /// Prepares the comparison of a design.
    #[must_use]
    pub fn new(design: &'a Design) -> Self {
        let datapath = design.datapath();
        Self {
            design,
            naive: Naive::new(design),
            registers: (0..datapath.rank_count()).map(|rank| datapath.registers(rank)).collect(),
            block: Block::default(),
        }
    }

    /// Every input at one address: ranks, registers, block, bound. Returns the number compared.
    ///
    /// # Errors
    /// The first complaint.
    pub fn inputs(&mut self, address: u32, xs: &[i64]) -> Result<u64, Complaint> {
        self.design.datapath().evaluate_block(address, xs, &mut self.block);
        if (self.block.intensities.len(), self.block.regions.len()) != (xs.len(), xs.len()) {
            return complain(Kind::Block, "a block is as long as its inputs".to_owned());
        }
        for (index, &x) in xs.iter().enumerate() {
            let intensity = self.input(address, x)?;
            let region = self.naive.answer(address, x).region;
            let of_block = (self.block.intensities[index], self.block.regions[index].name());
            if of_block != (intensity, region) {
                let text = format!("address {address}, x {x}: block {of_block:?}, ranks {intensity} {region}");
                return complain(Kind::Block, text);
            }
            self.bound(address, x, intensity)?;
        }
        Ok(xs.len() as u64)
    }

    /// One input through the ranks; gives the intensity.
    fn input(&self, address: u32, x: i64) -> Result<i64, Complaint> {
        let passage = self.design.datapath().passage(address, x);
        for (rank, (signals, registers)) in passage.iter().zip(&self.registers).enumerate() {
            for register in registers {
                let bits = register.bits(signals);
                if !register.format.holds(bits.into()) {
                    let text = format!("address {address}, x {x}, rank {rank}: {register:?} holds {bits}");
                    return complain(Kind::Overflows, text);
                }
            }
        }
        let golden = passage.last().copied().unwrap_or_default();
        let naive = self.naive.answer(address, x);
        let mut values = vec![(Register::Intensity, naive.intensity)];
        if let Some(lines) = naive.lines {
            values.push((Register::V, lines.v));
            values.extend((1..).map(Register::T).zip(lines.t));
        }
        values.extend(naive.divisor.map(|divisor| (Register::Divisor, divisor)));
        for (register, naive) in values {
            let golden = golden.get(register);
            if BigInt::from(golden) != naive {
                let text = format!("address {address}, x {x}: {register} is {golden}, naively {naive}");
                return complain(Kind::Differs, text);
            }
        }
        let ports = (golden.region.name(), golden.status.bits());
        if ports != (naive.region, naive.status) {
            let text = format!(
                "address {address}, x {x}: region and status {ports:?}, naively {:?}",
                (naive.region, naive.status)
            );
            return complain(Kind::Differs, text);
        }
        Ok(golden.intensity)
    }

    /// |hardware − real function of the row| against the proved bound.
    ///
    /// The real function is evaluated in f64, so its own rounding is allowed for: Horner's rule has
    /// six operations on terms that add up to `size`, and three rounded coefficients, so 8·2^−53 of
    /// it is more than they can do; the ratio likewise, with `size` what cancels in its denominator.
    /// An output format that does not reach 1 saturates; the real value is held to its greatest.
    fn bound(&self, address: u32, x: i64, intensity: i64) -> Result<(), Complaint> {
        let Some(row) = self.design.rows().get(address as usize) else {
            return Ok(());
        };
        if x < 0 {
            return Ok(());
        }
        let (input, output) = (self.design.config().input, self.design.config().output);
        let one = 1_i64 << input.fraction_bits();
        let s = (one - x.min(one)) as f64 * unit(input);
        let greatest = output.max_bits() as f64 * unit(output);
        let wanted = row.value_at_s(s, x >= row.cut).min(greatest);
        let got = intensity as f64 * unit(output);
        let error = (got - wanted).abs() / unit(output);
        let slack = 8.0 * (-53_f64).exp2() * size(row, s, x >= row.cut) / unit(output);
        let bound = self.design.bounds()[address as usize].total();
        if error > bound + slack {
            let text = format!("n = {}, x {x}: {error} ulp off, bound {bound} ulp (f64 slack {slack:e})", row.exponent);
            return complain(Kind::Bound, text);
        }
        Ok(())
    }
}

/// The sum of the magnitudes that meet in the row's real function at 1 − s.
fn size(row: &RealRow, s: f64, above_cut: bool) -> f64 {
    let segment = row.segments.iter().rev().find(|segment| s > segment.polynomial.start);
    match (segment.or(row.segments.first()), &row.tail) {
        (Some(segment), _) if above_cut => {
            let c = segment.polynomial.c.map(f64::abs);
            let v = (s - segment.polynomial.start).abs();
            // Where v is a difference, s itself is rounded, and moves the value by its slope.
            let moved = if segment.polynomial.start > 0.0 { v + s } else { v };
            c[0] + moved * (c[1] + v * (c[2] + v * (c[3] + v * c[4])))
        }
        (_, Some(rational)) => {
            let terms = rational.at_one.abs() + rational.b.abs() * s;
            1.0 + terms / (rational.at_one + rational.b * s).abs()
        }
        _ => 0.0,
    }
}

fn unit(format: QFormat) -> f64 {
    (-f64::from(format.fraction_bits())).exp2()
}
