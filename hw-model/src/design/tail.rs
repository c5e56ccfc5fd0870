//! Widths, ROM fields and the divider of the tail.

use super::error::DesignError;
use super::parts::Parts;
use super::polynomial::surroundings;
use super::real_row::RealRow;
use crate::budget::tail::{self, StatedTail};
use crate::budget::{BudgetError, RowTail};
use crate::config::Config;
use crate::datapath::formats::TailFormats;
use crate::datapath::stage::{Fractions, MultiplyAdd};
use crate::datapath::tail::Divider;
use crate::format::{Overflow, QFormat};
use crate::quantise::quantise;
use crate::registers::Register;
use crate::rounding::Rounding;

pub(super) fn derive(config: &Config, rows: &[RealRow], parts: &mut Parts) -> Result<Option<Divider>, DesignError> {
    let real_rows: Vec<RowTail> = rows.iter().filter_map(|row| row_tail(config, row)).collect();
    if real_rows.is_empty() {
        return Ok(None);
    }
    let surroundings = surroundings(config);
    let stated = StatedTail {
        a: config.widths[Register::TailA],
        b: config.widths[Register::TailB],
        divisor: config.widths[Register::Divisor],
    };
    let widths = tail::widths(&real_rows, config.input, &surroundings, config.error_budget_ulp, &stated)?;
    let input = config.input.fraction_bits();
    for (bound, row) in parts.bounds.iter_mut().zip(&real_rows) {
        bound.tail = tail::bound(row, &widths, input, &surroundings);
    }
    add_coefficients(&real_rows, Register::TailA, widths.a, |row| row.a, parts)?;
    add_coefficients(&real_rows, Register::TailB, widths.b, |row| row.b, parts)?;

    let fraction = Divider::quotient_fraction(surroundings.output);
    // The greatest quotient: Q, or 1 without a polynomial, and the error that was allowed. Where that
    // stays below 1 the quotient needs no integer bit; a large budget may need several.
    let whole = rows.iter().any(|row| row.segments.is_empty());
    let error = parts.bounds.iter().fold(0.0_f64, |most, bound| most.max(bound.tail));
    let greatest = if whole { 1.0 } else { config.q } + (error + 1.0) * config.output.ulp();
    let digit_count = fraction + (greatest.log2().floor() + 1.0).max(0.0) as u32;
    let digits = QFormat::unsigned(digit_count as i32, 0).map_err(|source| BudgetError::TooWide {
        register: "digits",
        exponent: config.exponents.last(),
        source,
    })?;
    let fractions = Fractions {
        multiplicand: widths.b.fraction_bits(),
        variable: input,
        addend: widths.a.fraction_bits(),
        result: widths.divisor.fraction_bits(),
    };
    let divider = Divider {
        divisor: MultiplyAdd::aligned(fractions, true, config.rounding),
        // Not negative: the divisor has at least input − quotient fraction bits (see budget::tail).
        dividend_up: (fraction + widths.divisor.fraction_bits()).saturating_sub(input),
        digit_count,
        digits_per_stage: config.quotient_bits_per_stage,
        rounding: config.rounding,
    };
    let x_width = config.input.width();
    let line = divider.divisor.lane_bits(widths.b.width(), x_width, widths.a.width());
    parts.lane_bits.push(("the divisor", line));
    // Doubling a remainder takes a bit more than the divisor; the quotient gets a sticky bit.
    let division = (x_width + divider.dividend_up).max(widths.divisor.width() + 2).max(digit_count + 3);
    parts.lane_bits.push(("the division", division));
    parts.formats.tail = Some(TailFormats { a: widths.a, b: widths.b, divisor: widths.divisor, digits });
    Ok(Some(divider))
}

/// The divider is given x below the cut, or every x where there is no polynomial.
pub(super) fn row_tail(config: &Config, row: &RealRow) -> Option<RowTail> {
    let rational = row.tail.as_ref()?;
    let greatest = config.input.max_bits().min(config.input.one());
    let last = if !row.segments.is_empty() { (row.cut - 1).min(greatest).max(0) } else { greatest };
    let greatest_x = last as f64 * config.input.ulp();
    Some(RowTail { exponent: row.exponent, a: rational.a, b: rational.b, greatest_x })
}

fn add_coefficients(
    rows: &[RowTail],
    field: Register,
    format: QFormat,
    of: fn(&RowTail) -> f64,
    parts: &mut Parts,
) -> Result<(), DesignError> {
    let mut integers = Vec::with_capacity(rows.len());
    for row in rows {
        let integer = quantise(of(row), format, Rounding::NearestEven, Overflow::Refuse)
            .map_err(|source| DesignError::Quantise { field: field.name(), exponent: row.exponent, source })?;
        integers.push(integer);
    }
    parts.add_field(field, format, integers.into_iter());
    Ok(())
}
