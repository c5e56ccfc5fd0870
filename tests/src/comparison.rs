//! The golden model against the naive one, and against what it promises of itself.

use std::fmt;

use hw_model::config::{Cut, Form};
use hw_model::datapath::{Block, Register};
use hw_model::design::{Design, Outer, RealRow};
use hw_model::fit::minimax::{self, Range};
use hw_model::format::QFormat;
use hw_model::rom::{FieldName, Row};
use hw_model::rounding::Rounding;
use num_bigint::BigInt;

use crate::naive::{Exact, Naive};

/// What went wrong.
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
    /// What went wrong.
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
    registers: Vec<Vec<Register>>,
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
                let text = format!(
                    "address {address}, x {x}: block {of_block:?}, ranks {intensity} {region}"
                );
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
                let bits = (register.bits)(signals);
                if !register.format.holds(bits.into()) {
                    let text =
                        format!("address {address}, x {x}, rank {rank}: {register:?} holds {bits}");
                    return complain(Kind::Overflows, text);
                }
            }
        }
        let golden = passage.last().copied().unwrap_or_default();
        let naive = self.naive.answer(address, x);
        let mut values = vec![("intensity", golden.intensity, naive.intensity)];
        if let Some(lines) = naive.lines {
            values.extend([
                ("v", golden.v, lines.v),
                ("t1", golden.t1, lines.t1),
                ("t2", golden.t2, lines.t2),
                ("t3", golden.t3, lines.t3),
            ]);
        }
        values.extend(naive.divisor.map(|divisor| ("divisor", golden.division.divisor, divisor)));
        for (name, golden, naive) in values {
            if BigInt::from(golden) != naive {
                let text = format!("address {address}, x {x}: {name} is {golden}, naively {naive}");
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
            let text = format!(
                "n = {}, x {x}: {error} ulp off, bound {bound} ulp (f64 slack {slack:e})",
                row.exponent
            );
            return complain(Kind::Bound, text);
        }
        Ok(())
    }
}

/// The sum of the magnitudes that meet in the row's real function at 1 − s.
fn size(row: &RealRow, s: f64, above_cut: bool) -> f64 {
    match (&row.polynomial, &row.tail) {
        (Some(_), _) if above_cut && row.outer.is_some_and(|outer| s > outer.segment.start) => {
            let c = row.outer.map_or([0.0; 4], |outer| outer.segment.c.map(f64::abs));
            let v = s - row.outer.map_or(0.0, |outer| outer.segment.start);
            // s itself is rounded, and moves the value by its slope.
            c[0] + (v + s) * (c[1] + v * (c[2] + v * c[3]))
        }
        (Some(cubic), _) if above_cut => {
            let k = &cubic.centred;
            1.0 + s * (k.k1.abs() + s * (k.k2.abs() + s * k.k3.abs()))
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

/// The ROM integers follow from the real rows: each coefficient is rounded to the nearest (a tie to
/// the even one), the cut is the least x that is not below 1 − s, the shift is ⌊log2 n⌋.
///
/// # Errors
/// The first field that does not.
pub fn rom(design: &Design) -> Result<(), Complaint> {
    for (real, row) in design.rows().iter().zip(design.rom().rows()) {
        // Counted up, because a logarithm may round up to the next integer.
        let shift = (1..64).take_while(|&e| 2_f64.powi(e) <= real.exponent).count() as i32;
        let fitted = design.config().cut == Cut::Balanced || design.config().segments == 2;
        let shift = if fitted { real.shift as i32 } else { shift };
        if fitted {
            segments(design, real, row)?;
        }
        let mut wanted = Vec::new();
        if let Some(cubic) = &real.polynomial {
            let coefficients = match design.config().form {
                Form::Power => {
                    let k = &cubic.power;
                    [k.d, k.c, k.b, k.a]
                }
                Form::Centred => {
                    let k = &cubic.centred;
                    let scale = |power: i32| 2_f64.powi(-power * shift);
                    [1.0, k.k1 * scale(1), k.k2 * scale(2), k.k3 * scale(3)]
                }
            };
            let names = [FieldName::C0, FieldName::C1, FieldName::C2, FieldName::C3];
            for (name, value) in names.into_iter().zip(coefficients) {
                wanted.push((name, Exact::of_f64(value)));
            }
            if design.config().form == Form::Centred {
                wanted.push((FieldName::Shift, Exact::of_bits(shift, 0)));
            }
        }
        if let Some(rational) = &real.tail {
            wanted.push((FieldName::TailA, Exact::of_f64(rational.a)));
            wanted.push((FieldName::TailB, Exact::of_f64(rational.b)));
        }
        for (name, value) in wanted {
            let fraction =
                design.rom().layout().field(name).map_or(0, |field| field.format.fraction_bits());
            let bits = value.into_register(fraction, Rounding::NearestEven)
                + steps_of(design, real.exponent, name);
            if bits != BigInt::from(row.get(name)) {
                let text = format!(
                    "n = {}: ROM field {name} is {}, the real number rounds to {bits}",
                    real.exponent,
                    row.get(name)
                );
                return complain(Kind::Rom, text);
            }
        }
        if let Some(Outer { segment, shift }) = &real.outer {
            let scale = |power: i32| 2_f64.powi(-power * *shift as i32);
            for (power, name) in FieldName::OUTER_COEFFICIENTS.into_iter().enumerate() {
                let value = Exact::of_f64(segment.c[power] * scale(power as i32));
                let fraction =
                    design.rom().layout().field(name).map_or(0, |f| f.format.fraction_bits());
                let steps = steps_of(design, real.exponent, name);
                if value.into_register(fraction, Rounding::NearestEven) + steps
                    != BigInt::from(row.get(name))
                {
                    let text =
                        format!("n = {}: ROM field {name} is {}", real.exponent, row.get(name));
                    return complain(Kind::Rom, text);
                }
            }
        }
        if let Some(first) = first_presented(design, real.exponent) {
            if first != BigInt::from(row.get(FieldName::Cut)) {
                let text = format!("n = {}: the domain does not begin at {first}", real.exponent);
                return complain(Kind::Rom, text);
            }
        } else if !fitted {
            cut(design, real, row.get(FieldName::Cut))?;
        }
    }
    Ok(())
}

/// Cut and hand-over are the least x that are not below the ends of the fitted segments, and each segment is
/// moved up as far as keeps it below 1.
/// The first x of an exponent's domain, which stands in the place of the cut.
fn first_presented(design: &Design, exponent: f64) -> Option<BigInt> {
    let config = design.config();
    let presented = config.domain.iter().find(|presented| presented.n == exponent)?;
    let fraction = config.input.fraction_bits();
    Some(Exact::of_f64(presented.least).into_register(fraction, Rounding::Floor))
}

/// What the configuration moves a field by, beyond rounding.
fn steps_of(design: &Design, exponent: f64, name: FieldName) -> i32 {
    let steps = design.config().coefficient_steps.iter().find(|steps| steps.n == exponent);
    let field = steps.and_then(|steps| steps.moved().find(|&(field, _)| field == name));
    field.map_or(0, |(_, steps)| steps)
}

fn segments(design: &Design, real: &RealRow, row: &Row) -> Result<(), Complaint> {
    let config = design.config();
    let range = if config.cut == Cut::Balanced { Range::Balanced } else { Range::Level(config.q) };
    let count = config.segments as usize;
    let fitted = minimax::segments(real.exponent, count, range)
        .map_err(|error| Complaint { kind: Kind::Rom, text: error.to_string() })?;
    let least_x = |s: f64| {
        -(Exact::of_f64(s) - Exact::of_bits(1, 0))
            .into_register(config.input.fraction_bits(), Rounding::Floor)
    };
    let last = *fitted.ends.last().expect("a fit has a segment");
    let first = if count == 2 && fitted.further.is_empty() { last / 2.0 } else { fitted.ends[0] };
    let cut = first_presented(design, real.exponent).unwrap_or_else(|| least_x(last));
    let mut wanted = vec![(FieldName::Cut, cut)];
    if count == 2 {
        wanted.push((FieldName::HandOver, least_x(first)));
    }
    for (name, wanted) in wanted {
        if wanted != BigInt::from(row.get(name)) {
            let text = format!("n = {}: {name} is {}, not {wanted}", real.exponent, row.get(name));
            return complain(Kind::Rom, text);
        }
    }
    let start = 1.0 - row.get(FieldName::HandOver) as f64 * config.input.ulp();
    let lengths = [(FieldName::Shift, first), (FieldName::ShiftOuter, last - start)];
    for (name, length) in lengths.into_iter().take(count).filter(|_| config.form == Form::Centred) {
        let (reach, most) = (length * 2_f64.powi(row.get(name) as i32), 1.0 - 1.0 / 128.0);
        let kept = reach <= most || row.get(name) == 0;
        if !kept || (reach * 2.0 <= most && row.get(name) < 62) {
            let text = format!(
                "n = {}: {name} {} brings {length} to {reach}",
                real.exponent,
                row.get(name)
            );
            return complain(Kind::Rom, text);
        }
    }
    Ok(())
}

fn cut(design: &Design, real: &RealRow, got: i64) -> Result<(), Complaint> {
    let config = design.config();
    let Some(cubic) = &real.polynomial else {
        return Ok(());
    };
    // Only where the multipliers are narrow.
    let greatest_u =
        if config.multiplier_operand_bits.is_some() { 2.0 - 1.0 / 128.0 } else { f64::INFINITY };
    let s = match config.cut {
        Cut::Epicentre | Cut::Balanced => real.epicentre,
        Cut::Minimum => cubic
            .centred
            .first_minimum()
            .unwrap_or(1.0)
            .min(greatest_u / f64::from(real.shift).exp2())
            .clamp(real.epicentre, 1.0),
    };
    // Half an output ulp, and where the arithmetic here cannot tell a value from it.
    let nothing = config.output.ulp() * (0.5 + 1e-9);
    let value = |s| cubic.centred.value_at_s(s);
    // A Q as small as that ends the epicentre where there is nothing to show already.
    let s = if value(real.epicentre) < nothing { real.epicentre } else { s };
    if config.cut == Cut::Minimum && value(s) < nothing && s > real.epicentre {
        return cut_at_nothing(design, real, got, s);
    }
    // The least integer that is not below (1 − s)·2^fraction: minus the floor of minus it.
    let below = Exact::of_f64(s) - Exact::of_bits(1, 0);
    let wanted = -below.into_register(config.input.fraction_bits(), Rounding::Floor);
    if wanted != BigInt::from(got) {
        let text = format!("n = {}: the cut is {got}, not {wanted}", real.exponent);
        return complain(Kind::Rom, text);
    }
    Ok(())
}

/// A polynomial that falls to half an output ulp is cut there: at the cut it is that much or more, at
/// the next x below it is not, unless that lies beyond the lowest s already. (The slope times a few f64 ulp is what the arithmetic here may be off.)
fn cut_at_nothing(design: &Design, real: &RealRow, got: i64, lowest: f64) -> Result<(), Complaint> {
    let config = design.config();
    let half = config.output.ulp() / 2.0;
    let value = |x: i64| {
        let s = 1.0 - x as f64 * config.input.ulp();
        let off = 1e-14 * size(real, s, true);
        (real.polynomial.map_or(0.0, |cubic| cubic.centred.value_at_s(s)), off)
    };
    let ((at, slack), (below, _)) = (value(got), value(got - 1));
    let next_s = 1.0 - (got - 1) as f64 * config.input.ulp();
    if at < half - slack || (next_s <= lowest && below > half + slack) {
        let text = format!(
            "n = {}: the cut {got} is not where the polynomial has fallen to {half}: {at} there, \
             {below} below it",
            real.exponent
        );
        return complain(Kind::Rom, text);
    }
    Ok(())
}
