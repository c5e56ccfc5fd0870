//! Widths, ROM fields and lines of the polynomial.

use super::doubt::Doubt;
use super::{DesignError, Outer, Parts, RealRow};
use crate::budget::error::{FractionBits, Register, Sensitivity, Surroundings};
use crate::budget::range::{Carried, Range, ranges};
use crate::budget::search::Search;
use crate::budget::{BudgetError, RowPolynomial};
use crate::config::{Config, Form};
use crate::datapath::formats::PolynomialFormats;
use crate::datapath::front_end::Variable;
use crate::datapath::stage::{Fractions, MultiplyAdd};
use crate::fit::Method;
use crate::format::QFormat;
use crate::quantise::{quantise_moved, real, round_scaled};
use crate::rom::FieldName;
use crate::rounding::Rounding;

/// Coefficients are constants of the design: they are rounded to the nearest whatever the lines do.
const COEFFICIENT_ROUNDING: Rounding = Rounding::NearestEven;

/// c0, c1, c2, c3 with the registers and ROM fields they live in, of the first segment and of the second.
const COEFFICIENTS: [(Register, FieldName, FieldName); 4] = [
    (Register::C0, FieldName::C0, FieldName::C0Outer),
    (Register::C1, FieldName::C1, FieldName::C1Outer),
    (Register::C2, FieldName::C2, FieldName::C2Outer),
    (Register::C3, FieldName::C3, FieldName::C3Outer),
];

pub(super) fn derive(
    config: &Config,
    rows: &[RealRow],
    parts: &mut Parts,
) -> Result<Option<(Variable, [MultiplyAdd; 3])>, DesignError> {
    if config.method == Method::Schlick {
        return Ok(None);
    }
    let pieces = Pieces::of(config, rows);
    let surroundings = surroundings(config);
    let sensitivities: Vec<Sensitivity> =
        pieces.all().map(|row| Sensitivity::of(row, &surroundings)).collect();
    let search = Search {
        sensitivities: &sensitivities,
        surroundings,
        pinned: Register::ALL.map(|register| stated(config, register).map(QFormat::fraction_bits)),
        operand_bits: config.multiplier_operand_bits,
        budget: config.error_budget_ulp,
    };
    let bits = search.run()?;
    for (address, of_piece) in pieces.addresses().zip(search.bounds(&bits)) {
        // The row's is that of its worse segment.
        if let Some(bound) = parts.bounds.get_mut(address)
            && of_piece.total() >= bound.coefficient + bound.datapath
        {
            (bound.coefficient, bound.datapath) = (of_piece.coefficient, of_piece.datapath);
        }
    }
    let (coefficients, rom_rows) = quantise_rows(config, &pieces, &bits, parts)?;
    let formats = line_formats(config, &rom_rows, coefficients, &bits, parts)?;
    check_operands(config, &formats)?;
    front_end_fields(config, rows, parts)?;
    outer_fields(&pieces, coefficients, parts);
    parts.formats.polynomial = Some(formats);
    Ok(Some(lines(config, &formats, parts)))
}

/// The polynomials of all rows: the first segments, and the second ones where rows have them.
pub(super) struct Pieces {
    first: Vec<RowPolynomial>,
    outer: Vec<Option<RowPolynomial>>,
}

impl Pieces {
    pub(super) fn of(config: &Config, rows: &[RealRow]) -> Self {
        let mut pieces = Self {
            first: rows.iter().filter_map(|row| row_polynomial(config, row)).collect(),
            outer: rows.iter().map(|row| row_outer(config, row)).collect(),
        };
        for steps in &config.coefficient_steps {
            // Rows stand in the order of the exponents.
            let Some(address) = config.exponents.position(steps.n) else { continue };
            if let Some(first) = pieces.first.get_mut(address) {
                first.steps = steps.first();
            }
            if let Some(Some(outer)) = pieces.outer.get_mut(address) {
                outer.steps = steps.outer();
            }
        }
        pieces
    }

    /// All of them, the first segments first.
    pub(super) fn all(&self) -> impl Iterator<Item = RowPolynomial> {
        self.first.iter().copied().chain(self.outer.iter().flatten().copied())
    }

    /// The rows that they belong to, in the same order.
    fn addresses(&self) -> impl Iterator<Item = usize> {
        let outer = self.outer.iter().enumerate().filter(|(_, outer)| outer.is_some());
        (0..self.first.len()).chain(outer.map(|(address, _)| address))
    }
}

/// What surrounds the polynomial: input, output, form and rounding.
pub(super) fn surroundings(config: &Config) -> Surroundings {
    Surroundings {
        input: config.input.fraction_bits(),
        output: config.output.fraction_bits(),
        centred: config.form == Form::Centred,
        rounding: config.rounding,
    }
}

pub(super) fn stated(config: &Config, register: Register) -> Option<QFormat> {
    match register {
        // x in the power form is the input as it comes.
        Register::V if config.form == Form::Power => Some(config.input),
        Register::V => config.widths.u,
        Register::C3 => config.widths.c3,
        Register::C2 => config.widths.c2,
        Register::C1 => config.widths.c1,
        Register::C0 => config.widths.c0,
        Register::T1 => config.widths.t1,
        Register::T2 => config.widths.t2,
    }
}

/// The row in the variable of the form. In the centred form u = s·2^e, so k_i becomes k_i·2^−ie
/// (exact in binary floating point). The region reaches from 1 to the cut; what the polynomial is fed
/// where it does not answer, u = 0 or the greatest x, belongs to the range as well.
pub(super) fn row_polynomial(config: &Config, row: &RealRow) -> Option<RowPolynomial> {
    let cubic = row.polynomial.as_ref()?;
    let (one, ulp) = (config.input.one(), config.input.ulp());
    let greatest = config.input.max_bits().min(one);
    // The first segment ends where it hands over.
    let cut = row.cut.max(row.hand_over);
    let answers = cut <= greatest;
    let in_u = |s: i64| s as f64 * ulp * f64::from(row.shift).exp2();
    let (coefficients, v) = match config.form {
        Form::Power => {
            let power = &cubic.power;
            let v = (cut.min(greatest) as f64 * ulp, greatest as f64 * ulp);
            ([power.d, power.c, power.b, power.a], v)
        }
        Form::Centred => {
            let scale = |power: u32| (-f64::from(power * row.shift)).exp2();
            let k = &cubic.centred;
            let v = (0.0, if answers { in_u(one - cut) } else { 0.0 });
            ([1.0, k.k1 * scale(1), k.k2 * scale(2), k.k3 * scale(3)], v)
        }
    };
    let (exponent, shift) = (row.exponent, row.shift);
    Some(RowPolynomial { exponent, shift, coefficients, steps: [0; 4], v, answers })
}

/// The second segment of a row, in v = (hand_over − x)·2^shift.
fn row_outer(config: &Config, row: &RealRow) -> Option<RowPolynomial> {
    let Outer { segment, shift } = row.outer.as_ref()?;
    let scale = |power: i32| (-f64::from(power * *shift as i32)).exp2();
    let [c0, c1, c2, c3] = segment.c;
    let greatest = config.input.max_bits().min(config.input.one());
    let answers = row.cut < row.hand_over && row.cut <= greatest;
    let length = (row.hand_over - row.cut).max(0) as f64 * config.input.ulp();
    Some(RowPolynomial {
        exponent: row.exponent,
        shift: *shift,
        coefficients: [c0, c1 * scale(1), c2 * scale(2), c3 * scale(3)],
        steps: [0; 4],
        v: (0.0, if answers { length * f64::from(*shift).exp2() } else { 0.0 }),
        answers,
    })
}

/// Quantises every coefficient, moves it by its steps, adds the ROM fields, and returns the rows as the ROM has them.
fn quantise_rows(
    config: &Config,
    pieces: &Pieces,
    bits: &FractionBits,
    parts: &mut Parts,
) -> Result<([QFormat; 4], Vec<RowPolynomial>), DesignError> {
    let rows: Vec<RowPolynomial> = pieces.all().collect();
    let mut rom_rows = rows.clone();
    let mut formats = Vec::new();
    // c3 first: the packing order of the ROM word.
    for (index, (register, field, outer)) in COEFFICIENTS.into_iter().enumerate().rev() {
        let fraction = bits[register as usize];
        let refuse = |exponent: f64| {
            move |source| DesignError::Quantise { field: field.name(), exponent, source }
        };
        let mut range = Range::zero();
        for row in &rows {
            let scaled = round_scaled(row.coefficients[index], fraction, COEFFICIENT_ROUNDING)
                .map_err(refuse(row.exponent))?
                + i128::from(row.steps[index]);
            let value = scaled as f64 * (-f64::from(fraction)).exp2();
            range = range.with((value, value), row.exponent);
        }
        let format = range.format(field.name(), fraction, stated(config, register))?;
        let mut integers = Vec::with_capacity(rows.len());
        for (row, rom_row) in rows.iter().zip(&mut rom_rows) {
            let (value, steps) = (row.coefficients[index], row.steps[index]);
            let integer = quantise_moved(value, format, COEFFICIENT_ROUNDING, steps)
                .map_err(refuse(row.exponent))?;
            rom_row.coefficients[index] = real(integer, format);
            integers.push(integer);
        }
        let further = integers.split_off(pieces.first.len());
        parts.add_field(field, format, integers.into_iter());
        // The rest of the addresses are those of the second segments.
        for (address, integer) in pieces.addresses().skip(pieces.first.len()).zip(further) {
            if let Some(row) = parts.rom_rows.get_mut(address) {
                row.set(outer, integer);
            }
        }
        formats.insert(0, format);
    }
    let formats = std::array::from_fn(|index| formats[index]);
    Ok((formats, rom_rows))
}

/// The second segments' coefficients take places of their own in the word, of the same formats.
fn outer_fields(pieces: &Pieces, coefficients: [QFormat; 4], parts: &mut Parts) {
    if pieces.outer.iter().any(Option::is_some) {
        for (index, (_, _, outer)) in COEFFICIENTS.into_iter().enumerate().rev() {
            parts.fields.push((outer, coefficients[index]));
        }
    }
}

fn line_formats(
    config: &Config,
    rom_rows: &[RowPolynomial],
    coefficients: [QFormat; 4],
    bits: &FractionBits,
    parts: &mut Parts,
) -> Result<PolynomialFormats, DesignError> {
    let of = |register: Register| bits[register as usize];
    let surroundings = surroundings(config);
    let lines = [of(Register::T1), of(Register::T2), surroundings.output];
    let carried = Carried {
        v: if surroundings.centred { surroundings.line_error(of(Register::V)) } else { 0.0 },
        lines: lines.map(|fraction| surroundings.line_error(fraction)),
    };
    let [v, t1, t2, t3] = ranges(rom_rows, surroundings.centred, &carried);
    let v_stated = if surroundings.centred { config.widths.u } else { None };
    // The ranges are a little wider than what is reached: a stated format that does not hold one may still
    // hold every value, which only the data path can tell.
    let mut format = |index: usize, range: &Range, register, fraction, stated: Option<QFormat>| {
        let refusal = match (range.format(register, fraction, stated), stated) {
            (Err(refusal @ BudgetError::Overflow { .. }), Some(stated)) => (stated, refusal),
            (format, _) => return format,
        };
        let (stated, refusal) = refusal;
        parts.doubts.push(Doubt { line: index, stated, refusal });
        Ok(stated)
    };
    let v_name = if surroundings.centred { "u" } else { "x" };
    Ok(PolynomialFormats {
        v: format(0, &v, v_name, of(Register::V), v_stated)?,
        coefficients,
        t1: format(1, &t1, "t1", lines[0], config.widths.t1)?,
        t2: format(2, &t2, "t2", lines[1], config.widths.t2)?,
        t3: t3.format("t3", lines[2], None)?,
    })
}

/// Refuses an operand that the configuration's multipliers do not take.
fn check_operands(config: &Config, formats: &PolynomialFormats) -> Result<(), BudgetError> {
    let Some(most) = config.multiplier_operand_bits else { return Ok(()) };
    let v = if config.form == Form::Centred { "u" } else { "x" };
    let operands =
        [(v, formats.v), ("c3", formats.coefficients[3]), ("t1", formats.t1), ("t2", formats.t2)];
    match operands.into_iter().find(|(_, format)| format.width() > most) {
        Some((register, format)) => Err(BudgetError::OperandTooWide { register, format, most }),
        None => Ok(()),
    }
}

/// The cut of every row, and the shift in the centred form.
fn front_end_fields(
    config: &Config,
    rows: &[RealRow],
    parts: &mut Parts,
) -> Result<(), DesignError> {
    let integer_format = |register, of: fn(&RealRow) -> i64, fraction, stated: Option<QFormat>| {
        // Backwards, for the first of equal ones.
        let (bits, exponent) = rows
            .iter()
            .rev()
            .map(|row| (of(row), row.exponent))
            .max_by_key(|row| row.0)
            .unwrap_or((0, 1.0));
        let greatest = bits as f64 * (-f64::from(fraction)).exp2();
        let fraction = stated.map_or(fraction, QFormat::fraction_bits);
        Range::zero().with((0.0, greatest), exponent).format(register, fraction, stated)
    };
    let fraction = config.input.fraction_bits();
    let up = |format: QFormat| fraction - format.fraction_bits();
    let stated = config.widths.cut.filter(|_| config.domain.is_empty());
    let cut = integer_format("cut", |row| row.cut, fraction, stated)?;
    parts.add_field(FieldName::Cut, cut, rows.iter().map(|row| row.cut >> up(cut)));
    parts.formats.cut = Some(cut);
    if config.form == Form::Centred {
        let shift = integer_format("shift", |row| row.shift.into(), 0, None)?;
        parts.add_field(FieldName::Shift, shift, rows.iter().map(|row| row.shift.into()));
        parts.formats.shift = Some(shift);
    }
    if rows.iter().any(|row| row.outer.is_some()) {
        let stated = config.widths.hand_over;
        let hand_over = integer_format("hand_over", |row| row.hand_over, fraction, stated)?;
        parts.add_field(
            FieldName::HandOver,
            hand_over,
            rows.iter().map(|row| row.hand_over >> up(hand_over)),
        );
        parts.formats.hand_over = Some(hand_over);
        let of = |row: &RealRow| row.outer.map_or(0, |outer| outer.shift.into());
        let shift = integer_format("shift_outer", of, 0, None)?;
        parts.add_field(FieldName::ShiftOuter, shift, rows.iter().map(of));
        parts.formats.shift_outer = Some(shift);
    }
    Ok(())
}

/// The variable and the three multiply-add lines, and the lanes they need.
fn lines(
    config: &Config,
    formats: &PolynomialFormats,
    parts: &mut Parts,
) -> (Variable, [MultiplyAdd; 3]) {
    let (v, input) = (formats.v.fraction_bits(), config.input.fraction_bits());
    let variable = match config.form {
        Form::Power => Variable::X,
        Form::Centred => Variable::U {
            up: v.saturating_sub(input),
            drop: input.saturating_sub(v),
            rounding: config.rounding,
        },
    };
    // s·2^e before its rounding has the bits of u and those dropped; one more for the carry.
    let before_rounding = formats.v.width() + input.saturating_sub(v) + 2;
    parts.lane_bits.push(("the front end", before_rounding.max(config.input.width() + 1)));
    let [c0, c1, c2, c3] = formats.coefficients;
    let meets = [
        ("stage 1", c3, c2, formats.t1.fraction_bits()),
        ("stage 2", formats.t1, c1, formats.t2.fraction_bits()),
        ("stage 3", formats.t2, c0, config.output.fraction_bits()),
    ];
    let stages = meets.map(|(name, multiplicand, addend, result)| {
        let fractions = Fractions {
            multiplicand: multiplicand.fraction_bits(),
            variable: v,
            addend: addend.fraction_bits(),
            result,
        };
        let line = MultiplyAdd::aligned(fractions, config.form == Form::Centred, config.rounding);
        let bits = line.lane_bits(multiplicand.width(), formats.v.width(), addend.width());
        parts.lane_bits.push((name, bits));
        line
    });
    (variable, stages)
}
