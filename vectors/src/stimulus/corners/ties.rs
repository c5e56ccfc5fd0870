//! How far a line's rounding is from a tie.
//!
//! A line drops d bits; it is a tie when they are exactly 2^(d−1). The lines keep only the rounded
//! result, so the sum before the rounding is computed again by the same line with every bit kept.

use hw_model::datapath::front_end::{FrontEnd, Region, Variable};
use hw_model::datapath::stage::{Fractions, MultiplyAdd};
use hw_model::datapath::{Datapath, Signals};
use hw_model::registers::Register;
use hw_model::rounding::Rounding;

/// A line that rounds.
#[derive(Debug, Clone, Copy)]
pub enum Line {
    /// u = (1 − x)·2^e.
    Variable { front_end: FrontEnd, up: u32, drop: u32 },
    /// A multiply-add with all its bits, of which the real one drops `drop`.
    MultiplyAdd { register: Register, degree: usize, exact: MultiplyAdd, drop: u32 },
    /// The quotient, of which a guard bit and a sticky bit are dropped.
    Quotient,
}

/// Every line of the data path that rounds, the one nearest to the output first.
pub fn lines(datapath: &Datapath) -> Vec<Line> {
    let mut lines = Vec::new();
    for (index, line) in datapath.stages().iter().enumerate().rev() {
        let fractions = stage_fractions(datapath, index + 1);
        lines.extend(exact_line(Register::T(index + 1), datapath.degree(), line, fractions));
    }
    if let Some(divider) = datapath.divider() {
        lines.insert(lines.len().min(1), Line::Quotient);
        let fractions = datapath.formats().tail.map(|formats| Fractions {
            multiplicand: formats.b.fraction_bits(),
            variable: datapath.formats().input.fraction_bits(),
            addend: formats.a.fraction_bits(),
            result: 0,
        });
        lines.extend(exact_line(Register::Divisor, 0, &divider.divisor, fractions));
    }
    let front_end = datapath.front_end();
    if let Some(Variable::U { up, drop, .. }) = front_end.variable
        && drop > 0
    {
        lines.push(Line::Variable { front_end: *front_end, up, drop });
    }
    lines
}

fn stage_fractions(datapath: &Datapath, stage: usize) -> Option<Fractions> {
    let formats = datapath.formats().polynomial.as_ref()?;
    Some(Fractions {
        multiplicand: formats.multiplicand(stage).fraction_bits(),
        variable: formats.v.fraction_bits(),
        addend: formats.addend(stage).fraction_bits(),
        result: 0,
    })
}

/// None where nothing is dropped.
fn exact_line(register: Register, degree: usize, line: &MultiplyAdd, fractions: Option<Fractions>) -> Option<Line> {
    let (fractions, drop) = (fractions?, line.dropped_bits());
    let result = (fractions.multiplicand + fractions.variable).max(fractions.addend);
    let whole = Fractions { result, ..fractions };
    let exact = MultiplyAdd::aligned(whole, line.subtracts(), Rounding::Floor);
    (drop > 0).then_some(Line::MultiplyAdd { register, degree, exact, drop })
}

impl Line {
    /// The register that takes the rounded result.
    pub const fn register(&self) -> Register {
        match self {
            Self::Variable { .. } => Register::V,
            Self::MultiplyAdd { register, .. } => *register,
            Self::Quotient => Register::Intensity,
        }
    }

    /// The part of the pipeline the line belongs to.
    pub fn region(&self) -> Region {
        match self.register() {
            Register::Intensity | Register::Divisor => Region::Tail,
            _ => Region::Polynomial,
        }
    }

    /// The distance from a tie, in units of the result: 0 for a tie, at most ½. `last` is what the
    /// last rank holds.
    pub fn distance(&self, last: &Signals) -> f64 {
        match self {
            Self::Variable { front_end, up, drop } => {
                let row = &last.row;
                let segment = front_end.segment_of(row, last.x);
                let (start, shift) = (front_end.start(row, segment), row.shift(segment));
                from_half(i128::from(start - last.x) << (shift + up), *drop)
            }
            Self::MultiplyAdd { register, degree, exact, drop } => {
                let operands = operands(*register, *degree, last);
                let [multiplicand, variable, addend] = operands.map(i128::from);
                from_half(exact.apply(multiplicand, variable, addend), *drop)
            }
            Self::Quotient => {
                let division = &last.division;
                let beyond = division.remainder as f64 / division.divisor as f64;
                // The quotient has one bit beyond the output's: odd means half and a little more.
                let odd = division.digits & 1 == 1;
                (if odd { beyond } else { 1.0 - beyond }) / 2.0
            }
        }
    }
}

fn operands(register: Register, degree: usize, last: &Signals) -> [i64; 3] {
    let [multiplicand, variable, addend] = match register {
        Register::T(stage) => {
            let before = if stage == 1 { Register::C(0, degree) } else { Register::T(stage - 1) };
            [before, Register::V, Register::C(0, degree - stage)]
        }
        _ => [Register::TailB, Register::TailX, Register::TailA],
    };
    [last.get(multiplicand), last.get(variable), last.get(addend)]
}

/// |low `drop` bits − half|, in units of 2^drop.
fn from_half(value: i128, drop: u32) -> f64 {
    let dropped = value & ((1 << drop) - 1);
    (dropped - (1 << (drop - 1))).abs() as f64 / f64::from(drop).exp2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use hw_model::design::Design;
    use hw_model::presets;
    use hw_model::rounding::round_shift;

    /// The sum that is computed again must be the one the data path rounded.
    #[test]
    fn the_sum_before_the_rounding_gives_the_register() {
        let mut compared = 0;
        for preset in presets::ALL {
            let design = Design::new(preset.config().unwrap()).unwrap();
            let rounding = design.config().rounding;
            for address in [0, 1, 63, 200] {
                for i in 0..64 {
                    let x = design.config().input.one() / 64 * i + 12_345 * i;
                    let last = design.datapath().evaluate(address, x);
                    for line in lines(design.datapath()) {
                        let Line::MultiplyAdd { register, degree, exact, drop } = line else { continue };
                        if line.region() != last.region {
                            continue;
                        }
                        let [a, v, c] = operands(register, degree, &last).map(i128::from);
                        let wanted = last.get(register);
                        let got = round_shift(exact.apply(a, v, c), drop, rounding);
                        assert_eq!(got, i128::from(wanted), "{} {register} {x}", preset.name);
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 500, "{compared}");
    }
}
