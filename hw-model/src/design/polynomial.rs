//! Widths, ROM fields and lines of the polynomial.

use super::doubt::Doubt;
use super::error::DesignError;
use super::parts::Parts;
use super::real_row::RealRow;
use crate::budget::error::{FractionBits, Sensitivity, Surroundings, chosen};
use crate::budget::range::{Carried, Range, ranges};
use crate::budget::search::Search;
use crate::budget::{BudgetError, RowPolynomial};
use crate::config::{Config, Form};
use crate::datapath::formats::PolynomialFormats;
use crate::datapath::front_end::Variable;
use crate::datapath::stage::{Fractions, MultiplyAdd, Stages};
use crate::format::QFormat;
use crate::quantise::{quantise_moved, real, round_scaled};
use crate::registers::{MAX_DEGREE, Register, Table};
use crate::rounding::Rounding;
use crate::steps::Steps;

/// Coefficients are constants of the design: they are rounded to the nearest whatever the lines do.
const COEFFICIENT_ROUNDING: Rounding = Rounding::NearestEven;

pub(super) fn derive(
    config: &Config,
    rows: &[RealRow],
    parts: &mut Parts,
) -> Result<Option<(Variable, Stages)>, DesignError> {
    if !config.method.has_polynomial() {
        return Ok(None);
    }
    let pieces = pieces(config, rows);
    let surroundings = surroundings(config);
    let sensitivities: Vec<Sensitivity> =
        pieces.iter().map(|piece| Sensitivity::of(piece.row, &surroundings)).collect();
    let mut pinned = Table::default();
    for register in chosen(config.degree) {
        pinned[register] = stated(config, register).map(QFormat::fraction_bits);
    }
    let search = Search {
        degree: config.degree,
        sensitivities: &sensitivities,
        surroundings,
        pinned,
        operand_bits: config.multiplier_operand_bits,
        budget: config.error_budget_ulp,
    };
    let bits = search.run()?;
    for (piece, of_piece) in pieces.iter().zip(search.bounds(&bits)) {
        // The row's is that of its worst segment.
        if let Some(bound) = parts.bounds.get_mut(piece.address)
            && of_piece.total() >= bound.coefficient + bound.datapath
        {
            (bound.coefficient, bound.datapath) = (of_piece.coefficient, of_piece.datapath);
        }
    }
    let (coefficients, rom_rows) = quantise_rows(config, &pieces, &bits, parts)?;
    let formats = line_formats(config, &rom_rows, &coefficients, &bits, parts)?;
    check_operands(config, &formats)?;
    front_end_fields(config, rows, parts)?;
    parts.formats.polynomial = Some(formats);
    Ok(Some(lines(config, &formats, parts)))
}

/// The polynomial of one segment of a row.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    address: usize,
    segment: usize,
    pub(super) row: RowPolynomial,
}

/// The polynomials of all rows: the first segments, then the second ones, and so on.
pub(super) fn pieces(config: &Config, rows: &[RealRow]) -> Vec<Piece> {
    let mut pieces = Vec::with_capacity(rows.len() * config.segments);
    for segment in 0..config.segments {
        for (address, row) in rows.iter().enumerate() {
            let polynomial = row_polynomial(config, row, segment);
            pieces.extend(polynomial.map(|row| Piece { address, segment, row }));
        }
    }
    for steps in &config.coefficient_steps {
        // Rows stand in the order of the exponents.
        let Some(address) = config.exponents.position(steps.n) else { continue };
        for piece in pieces.iter_mut().filter(|piece| piece.address == address) {
            piece.row.steps = steps.of(piece.segment);
        }
    }
    pieces
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
        register => config.widths[register],
    }
}

/// A segment in the variable of the form. In the centred form v = (s − start)·2^e, so c_i becomes c_i·2^−ie
/// (exact in binary floating point). The region reaches from the start to where the segment ends; what the polynomial
/// is fed where it does not answer, v = 0 or the greatest x, belongs to the range as well.
pub(super) fn row_polynomial(config: &Config, row: &RealRow, segment: usize) -> Option<RowPolynomial> {
    let real = row.segments.get(segment)?;
    let (one, ulp) = (config.input.one(), config.input.ulp());
    let greatest = config.input.max_bits().min(one);
    let least = row.least_of_segment(segment);
    let last = if segment == 0 { greatest } else { real.start - 1 };
    let answers = least <= greatest.min(last);
    let (coefficients, v) = match config.form {
        Form::Power => (row.power, (least.min(greatest) as f64 * ulp, greatest as f64 * ulp)),
        Form::Centred => {
            let scale = |power: usize| (-f64::from(power as u32 * real.shift)).exp2();
            let c = real.polynomial.c;
            let length = (real.start - least) as f64 * ulp;
            let v = if answers { length * f64::from(real.shift).exp2() } else { 0.0 };
            (std::array::from_fn(|power| c[power] * scale(power)), (0.0, v))
        }
    };
    let (exponent, shift, degree) = (row.exponent, real.shift, config.degree);
    Some(RowPolynomial { exponent, shift, degree, coefficients, steps: Steps::default(), v, answers })
}

/// Quantises every coefficient, moves it by its steps, adds the ROM fields, and returns the rows as the ROM has them.
fn quantise_rows(
    config: &Config,
    pieces: &[Piece],
    bits: &FractionBits,
    parts: &mut Parts,
) -> Result<(Vec<QFormat>, Vec<RowPolynomial>), DesignError> {
    let mut rom_rows: Vec<RowPolynomial> = pieces.iter().map(|piece| piece.row).collect();
    let mut formats = Vec::new();
    // The highest power first: the packing order of the ROM word.
    for power in (0..=config.degree).rev() {
        let register = Register::C(0, power);
        let fraction = bits[register];
        let refuse = |exponent: f64| move |source| DesignError::Quantise { field: register.name(), exponent, source };
        let mut range = Range::zero();
        for Piece { row, .. } in pieces {
            let scaled = round_scaled(row.coefficients[power], fraction, COEFFICIENT_ROUNDING)
                .map_err(refuse(row.exponent))?
                + i128::from(row.steps[power]);
            let value = scaled as f64 * (-f64::from(fraction)).exp2();
            range = range.with((value, value), row.exponent);
        }
        let format = range.format(register.name(), fraction, stated(config, register))?;
        // Segments take places of their own in the word, of the same format.
        for segment in 0..config.segments {
            parts.fields.push((Register::C(segment, power), format));
        }
        for (Piece { address, segment, row }, rom_row) in pieces.iter().zip(&mut rom_rows) {
            let (value, steps) = (row.coefficients[power], row.steps[power]);
            let integer = quantise_moved(value, format, COEFFICIENT_ROUNDING, steps).map_err(refuse(row.exponent))?;
            rom_row.coefficients[power] = real(integer, format);
            if let Some(row) = parts.rom_rows.get_mut(*address) {
                row.set(Register::C(*segment, power), integer);
            }
        }
        formats.insert(0, format);
    }
    Ok((formats, rom_rows))
}

fn line_formats(
    config: &Config,
    rom_rows: &[RowPolynomial],
    coefficients: &[QFormat],
    bits: &FractionBits,
    parts: &mut Parts,
) -> Result<PolynomialFormats, DesignError> {
    let surroundings = surroundings(config);
    let degree = config.degree;
    let fractions: Vec<u32> = (1..=degree)
        .map(|stage| if stage == degree { surroundings.output } else { bits[Register::T(stage)] })
        .collect();
    let v_fraction = bits[Register::V];
    let carried = Carried {
        v: if surroundings.centred { surroundings.line_error(v_fraction) } else { 0.0 },
        lines: fractions.iter().map(|&fraction| surroundings.line_error(fraction)).collect(),
    };
    let ranges = ranges(rom_rows, surroundings.centred, &carried);
    // The ranges are a little wider than what is reached: a stated format that does not hold one may still
    // hold every value, which only the data path can tell.
    let mut format = |line: usize, name, fraction, stated: Option<QFormat>| {
        let refusal = match (ranges[line].format(name, fraction, stated), stated) {
            (Err(refusal @ BudgetError::Overflow { .. }), Some(stated)) => (stated, refusal),
            (format, _) => return format,
        };
        let (stated, refusal) = refusal;
        parts.doubts.push(Doubt { line, stated, refusal });
        Ok(stated)
    };
    let v_stated = if surroundings.centred { config.widths[Register::V] } else { None };
    let v = format(0, variable_name(config), v_fraction, v_stated)?;
    let mut t = Vec::with_capacity(degree);
    for (stage, fraction) in (1..).zip(fractions) {
        let register = Register::T(stage);
        t.push(format(stage, register.name(), fraction, config.widths[register])?);
    }
    Ok(PolynomialFormats::new(v, coefficients, &t))
}

/// The variable's name in messages.
fn variable_name(config: &Config) -> &'static str {
    if config.form == Form::Centred { "u" } else { "x" }
}

/// Refuses an operand that the configuration's multipliers do not take.
fn check_operands(config: &Config, formats: &PolynomialFormats) -> Result<(), BudgetError> {
    let Some(most) = config.multiplier_operand_bits else { return Ok(()) };
    let multiplicands = (1..=formats.degree()).map(|stage| {
        let register = if stage == 1 { Register::C(0, formats.degree()) } else { Register::T(stage - 1) };
        (register.name(), formats.multiplicand(stage))
    });
    let mut operands = std::iter::once((variable_name(config), formats.v)).chain(multiplicands);
    match operands.find(|(_, format)| format.width() > most) {
        Some((register, format)) => Err(BudgetError::OperandTooWide { register, format, most }),
        None => Ok(()),
    }
}

/// The cut of every row, and the shift in the centred form.
fn front_end_fields(config: &Config, rows: &[RealRow], parts: &mut Parts) -> Result<(), DesignError> {
    let integer_format = |register: Register, of: &dyn Fn(&RealRow) -> i64, fraction, stated: Option<QFormat>| {
        // Backwards, for the first of equal ones.
        let (bits, exponent) =
            rows.iter().rev().map(|row| (of(row), row.exponent)).max_by_key(|row| row.0).unwrap_or((0, 1.0));
        let greatest = bits as f64 * (-f64::from(fraction)).exp2();
        let fraction = stated.map_or(fraction, QFormat::fraction_bits);
        Range::zero().with((0.0, greatest), exponent).format(register.name(), fraction, stated)
    };
    let fraction = config.input.fraction_bits();
    let up = |format: QFormat| fraction - format.fraction_bits();
    let stated = config.widths[Register::Cut].filter(|_| config.domain.is_empty());
    let cut = integer_format(Register::Cut, &|row| row.cut, fraction, stated)?;
    parts.add_field(Register::Cut, cut, rows.iter().map(|row| row.cut >> up(cut)));
    parts.formats.cut = Some(cut);
    if config.segments > 1 {
        let further = |row: &RealRow| row.segments.iter().skip(1).map(|s| s.start).max();
        let greatest = |row: &RealRow| further(row).unwrap_or(0);
        let stated = config.widths[Register::HandOver(1)];
        parts.formats.hand_over = Some(integer_format(Register::HandOver(1), &greatest, fraction, stated)?);
    }
    for segment in 0..config.segments {
        if let Some(format) = parts.formats.hand_over.filter(|_| segment > 0) {
            let start = |row: &RealRow| row.segments.get(segment).map_or(0, |s| s.start);
            let bits = rows.iter().map(|row| start(row) >> up(format));
            parts.add_field(Register::HandOver(segment), format, bits);
        }
        if config.form == Form::Centred {
            let register = Register::Shift(segment);
            let of = |row: &RealRow| row.segments.get(segment).map_or(0, |s| s.shift.into());
            let shift = integer_format(register, &of, 0, None)?;
            parts.add_field(register, shift, rows.iter().map(of));
        }
    }
    Ok(())
}

/// The variable and the multiply-add lines, and the lanes they need.
fn lines(config: &Config, formats: &PolynomialFormats, parts: &mut Parts) -> (Variable, Stages) {
    let (v, input) = (formats.v.fraction_bits(), config.input.fraction_bits());
    let variable = match config.form {
        Form::Power => Variable::X,
        Form::Centred => {
            Variable::U { up: v.saturating_sub(input), drop: input.saturating_sub(v), rounding: config.rounding }
        }
    };
    // s·2^e before its rounding has the bits of u and those dropped; one more for the carry.
    let before_rounding = formats.v.width() + input.saturating_sub(v) + 2;
    parts.lane_bits.push(("the front end", before_rounding.max(config.input.width() + 1)));
    let stages = (1..=formats.degree()).map(|stage| {
        let (multiplicand, addend) = (formats.multiplicand(stage), formats.addend(stage));
        let fractions = Fractions {
            multiplicand: multiplicand.fraction_bits(),
            variable: v,
            addend: addend.fraction_bits(),
            result: formats.t()[stage - 1].fraction_bits(),
        };
        let line = MultiplyAdd::aligned(fractions, config.form == Form::Centred, config.rounding);
        let bits = line.lane_bits(multiplicand.width(), formats.v.width(), addend.width());
        parts.lane_bits.push((STAGE_NAMES[stage - 1], bits));
        line
    });
    (variable, Stages::new(stages))
}

/// The stages' names in messages.
const STAGE_NAMES: [&str; MAX_DEGREE] = ["stage 1", "stage 2", "stage 3", "stage 4"];
