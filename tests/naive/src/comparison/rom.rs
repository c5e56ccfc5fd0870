//! The ROM against the real rows it was made from, in exact arithmetic.

use hw_model::config::{Cut, Form};
use hw_model::design::{Design, RealRow};
use hw_model::fit::minimax::{self, Range};
use hw_model::highlight::Centred;
use hw_model::registers::Register;
use hw_model::rom::Row;
use hw_model::rounding::Rounding;
use num_bigint::BigInt;

use super::{Complaint, Kind, complain, size};
use crate::Exact;

/// The ROM integers follow from the real rows: each coefficient is rounded to the nearest (a tie to
/// the even one), the cut is the least x that is not below 1 − s, the shift is ⌊log2 n⌋.
///
/// # Errors
/// The first field that does not.
pub fn rom(design: &Design) -> Result<(), Complaint> {
    for (real, row) in design.rows().iter().zip(design.rom().rows()) {
        // Counted up, because a logarithm may round up to the next integer.
        let shift = (1..64).take_while(|&e| 2_f64.powi(e) <= real.exponent).count() as i32;
        let config = design.config();
        let fitted = config.cut == Cut::Balanced || config.segments > 1;
        if fitted {
            segments(design, real, row)?;
        }
        let mut wanted = Vec::new();
        for (index, segment) in real.segments.iter().enumerate() {
            let shift = if fitted { segment.shift as i32 } else { shift };
            for power in 0..=config.degree {
                let value = match config.form {
                    Form::Power => real.power[power],
                    Form::Centred => segment.polynomial.c[power] * 2_f64.powi(-(power as i32) * shift),
                };
                wanted.push((Register::C(index, power), Exact::of_f64(value)));
            }
            if config.form == Form::Centred {
                wanted.push((Register::Shift(index), Exact::of_bits(shift, 0)));
            }
        }
        if let Some(rational) = &real.tail {
            wanted.push((Register::TailA, Exact::of_f64(rational.a)));
            wanted.push((Register::TailB, Exact::of_f64(rational.b)));
        }
        for (name, value) in wanted {
            let fraction = design.rom().layout().field(name).map_or(0, |field| field.format.fraction_bits());
            let bits = value.into_register(fraction, Rounding::NearestEven) + steps_of(design, real.exponent, name);
            if bits != BigInt::from(row.get(name)) {
                let text = format!(
                    "n = {}: ROM field {name} is {}, the real number rounds to {bits}",
                    real.exponent,
                    row.get(name)
                );
                return complain(Kind::Rom, text);
            }
        }
        if let Some(first) = first_presented(design, real.exponent) {
            if first != end(design, row, Register::Cut) {
                let text = format!("n = {}: the domain does not begin at {first}", real.exponent);
                return complain(Kind::Rom, text);
            }
        } else if !fitted {
            cut(design, real, row)?;
        }
    }
    Ok(())
}

/// An end of a segment in the ROM, in the unit of x.
fn end(design: &Design, row: &Row, name: Register) -> BigInt {
    let format = design.rom().layout().field(name).map_or(design.config().input, |f| f.format);
    Exact::of_bits(row.get(name), format.fraction_bits())
        .into_register(design.config().input.fraction_bits(), Rounding::Floor)
}

/// An end in the unit of x, as the stated format has it: the cut rounded down, the hand-over to the nearest (a tie to
/// the even one).
fn stated_end(design: &Design, name: Register, exact: BigInt) -> BigInt {
    let widths = &design.config().widths;
    let (stated, mode) = match name {
        Register::Cut => (widths[Register::Cut], Rounding::Floor),
        _ => (widths[Register::HandOver(1)], Rounding::NearestEven),
    };
    let Some(format) = stated else { return exact };
    let input = design.config().input.fraction_bits();
    let stated = Exact::of_bits(exact, input).into_register(format.fraction_bits(), mode);
    Exact::of_bits(stated, format.fraction_bits()).into_register(input, Rounding::Floor)
}

/// The first x of an exponent's domain, which stands in the place of the cut.
fn first_presented(design: &Design, exponent: f64) -> Option<BigInt> {
    let config = design.config();
    let presented = config.domain.iter().find(|presented| presented.n == exponent)?;
    let fraction = config.input.fraction_bits();
    Some(Exact::of_f64(presented.least).into_register(fraction, Rounding::Floor))
}

/// What the configuration moves a field by, beyond rounding.
fn steps_of(design: &Design, exponent: f64, name: Register) -> i32 {
    let steps = design.config().coefficient_steps.iter().find(|steps| steps.n == exponent);
    let field = steps.and_then(|steps| steps.moved().find(|&(field, _)| field == name));
    field.map_or(0, |(_, steps)| steps)
}

/// Cut and hand-over are the least x that are not below the ends of the fitted segments (in fewer bits, the nearest to
/// these), and each segment is moved up as far as keeps it below 1.
fn segments(design: &Design, real: &RealRow, row: &Row) -> Result<(), Complaint> {
    let config = design.config();
    let range = if config.cut == Cut::Balanced { Range::Balanced } else { Range::Level(config.q) };
    let count = config.segments;
    let fitted = minimax::segments(real.exponent, config.degree, count, range)
        .map_err(|error| Complaint { kind: Kind::Rom, text: error.to_string() })?;
    let least_x = |s: f64| {
        -(Exact::of_f64(s) - Exact::of_bits(1, 0)).into_register(config.input.fraction_bits(), Rounding::Floor)
    };
    let last = *fitted.ends.last().expect("a fit has a segment");
    // An x^n that is such a polynomial itself is cut into equal parts.
    let end_s = |segment: usize| match fitted.ends.len() {
        1 => last * (segment + 1) as f64 / count as f64,
        ends => fitted.ends[segment.min(ends - 1)],
    };
    // Where each segment ends: the next one's hand-over, and the cut.
    let name = |segment: usize| {
        if segment + 1 == count { Register::Cut } else { Register::HandOver(segment + 1) }
    };
    let exact: Vec<BigInt> = (0..count).map(|segment| least_x(end_s(segment))).collect();
    let stated: Vec<BigInt> =
        (0..count).map(|segment| stated_end(design, name(segment), exact[segment].clone())).collect();
    for (segment, stated) in stated.iter().enumerate() {
        let name = name(segment);
        let presented = first_presented(design, real.exponent).filter(|_| name == Register::Cut);
        let (wanted, got) = (presented.unwrap_or_else(|| stated.clone()), end(design, row, name));
        if wanted != got {
            let text = format!("n = {}: {name} is {got}, not {wanted}", real.exponent);
            return complain(Kind::Rom, text);
        }
    }
    if config.form == Form::Power {
        return Ok(());
    }
    let distance = |end: &BigInt| {
        let bits = i64::try_from(end).expect("an end is at most 1");
        1.0 - bits as f64 * config.input.ulp()
    };
    for segment in 0..count {
        let start = |ends: &[BigInt]| if segment == 0 { 0.0 } else { distance(&ends[segment - 1]) };
        let mut length = end_s(segment) - start(&exact);
        // Where an end had to move, the length is that between the new ends, if there is anything between them.
        let new = distance(&stated[segment]) - start(&stated);
        if exact != stated && new > 0.0 {
            length = new;
        }
        let name = Register::Shift(segment);
        let (reach, most) = (length * 2_f64.powi(row.get(name) as i32), 1.0 - 1.0 / 128.0);
        let kept = reach <= most || row.get(name) == 0;
        if !kept || (reach * 2.0 <= most && row.get(name) < 62) {
            let text = format!("n = {}: {name} {} brings {length} to {reach}", real.exponent, row.get(name));
            return complain(Kind::Rom, text);
        }
    }
    Ok(())
}

fn cut(design: &Design, real: &RealRow, row: &Row) -> Result<(), Complaint> {
    let config = design.config();
    let Some(segment) = real.segments.first() else {
        return Ok(());
    };
    let [_, k1, k2, k3, _] = segment.polynomial.c;
    let cubic = Centred { k1, k2, k3 };
    let got = end(design, row, Register::Cut);
    // Only where the multipliers are narrow.
    let greatest_u = if config.multiplier_operand_bits.is_some() { 2.0 - 1.0 / 128.0 } else { f64::INFINITY };
    let s = match config.cut {
        Cut::Epicentre | Cut::Balanced => real.epicentre,
        Cut::Minimum => cubic
            .first_minimum()
            .unwrap_or(1.0)
            .min(greatest_u / f64::from(segment.shift).exp2())
            .clamp(real.epicentre, 1.0),
    };
    // Half an output ulp, and where the arithmetic here cannot tell a value from it.
    let nothing = config.output.ulp() * (0.5 + 1e-9);
    let value = |s| cubic.value_at_s(s);
    // A Q as small as that ends the epicentre where there is nothing to show already.
    let s = if value(real.epicentre) < nothing { real.epicentre } else { s };
    if config.cut == Cut::Minimum && value(s) < nothing && s > real.epicentre {
        let got = i64::try_from(got).expect("a cut is at most 1");
        return cut_at_nothing(design, real, got, s);
    }
    // The least integer that is not below (1 − s)·2^fraction: minus the floor of minus it.
    let below = Exact::of_f64(s) - Exact::of_bits(1, 0);
    let wanted = -below.into_register(config.input.fraction_bits(), Rounding::Floor);
    let wanted = stated_end(design, Register::Cut, wanted);
    if wanted != got {
        let text = format!("n = {}: the cut is {got}, not {wanted}", real.exponent);
        return complain(Kind::Rom, text);
    }
    Ok(())
}

/// A polynomial that falls to half an output ulp is cut there: at the cut it is that much or more, at
/// the next x below it is not, unless that lies beyond the lowest s already. In fewer bits it is the next below one of
/// which that is true. (The slope times a few f64 ulp is what the arithmetic here may be off.)
fn cut_at_nothing(design: &Design, real: &RealRow, got: i64, lowest: f64) -> Result<(), Complaint> {
    let config = design.config();
    let half = config.output.ulp() / 2.0;
    let value = |x: i64| {
        let s = 1.0 - x as f64 * config.input.ulp();
        let off = 1e-14 * size(real, s, true);
        (real.segments.first().map_or(0.0, |first| first.polynomial.value_at_s(s)), off)
    };
    let input = config.input.fraction_bits();
    let dropped = config.widths[Register::Cut].map_or(0, |stated| input - stated.fraction_bits());
    let greatest = got + (1_i64 << dropped) - 1;
    let next = got - 1;
    let ((at, slack), (below, _)) = (value(greatest), value(next));
    let next_s = 1.0 - next as f64 * config.input.ulp();
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
