//! Widths of the divider: A, B and D = A − B·x share one number of fraction bits d.
//!
//! g = x/D changes by g/D for each unit of D. Both g and D⁻¹ grow with x, so the worst place is the
//! upper end of the tail, where D is at least q/Q ≥ 1 for a tail and 1 for schlick. d is the least
//! for which (δA + x·δB + ρD)·g/D plus the rounding of the quotient stays within the budget, and for
//! which the dividend x·2^(k + d − f) is an integer: d ≥ f − k.

use super::error::{Surroundings, coefficient_error};
use super::range::Range;
use super::{BudgetError, RowTail};
use crate::datapath::tail::Divider;
use crate::format::QFormat;

/// The formats of the divider, and the fraction bits they share.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TailWidths {
    /// The format of A, the addend of D = A − B·x.
    pub a: QFormat,
    /// The format of B, the multiplicand of D = A − B·x.
    pub b: QFormat,
    /// The format of the divisor D.
    pub divisor: QFormat,
}

/// Stated formats of the divider.
#[derive(Debug, Clone, Copy, Default)]
pub struct StatedTail {
    /// The format stated for A, if one is.
    pub a: Option<QFormat>,
    /// The format stated for B, if one is.
    pub b: Option<QFormat>,
    /// The format stated for D, if one is.
    pub divisor: Option<QFormat>,
}

/// Fraction bits of A, B and D.
#[derive(Debug, Clone, Copy)]
struct Bits {
    a: u32,
    b: u32,
    divisor: u32,
}

/// The error bound of one row with these formats, in output ulp.
#[must_use]
pub fn bound(row: &RowTail, widths: &TailWidths, input: u32, surroundings: &Surroundings) -> f64 {
    let [a, b, divisor] = [widths.a, widths.b, widths.divisor].map(QFormat::fraction_bits);
    bound_of_bits(row, Bits { a, b, divisor }, input, surroundings)
}

/// What A, B, D and the rounding of the quotient add to the bound, in output ulp; A, B and D with
/// `fewer` fraction bits less than these formats have. Their sum is the bound.
#[must_use]
pub fn shares(row: &RowTail, widths: &TailWidths, fewer: u32, input: u32, surroundings: &Surroundings) -> [f64; 4] {
    let x = row.greatest_x;
    if x == 0.0 {
        return [0.0; 4];
    }
    let [a, b, divisor] =
        [widths.a, widths.b, widths.divisor].map(|format| format.fraction_bits().saturating_sub(fewer));
    let errors = [
        coefficient_error(row.a, a),
        x * coefficient_error(row.b, b),
        surroundings.rounding_error(divisor, (b + input).max(a)),
    ];
    let least = (row.a - row.b * x - errors.iter().sum::<f64>()).max(f64::MIN_POSITIVE);
    let ulp = (-f64::from(surroundings.output)).exp2();
    let [a, b, divisor] = errors.map(|error| error * x / (least * least) / ulp);
    [a, b, divisor, surroundings.line_error(surroundings.output) / ulp]
}

fn bound_of_bits(row: &RowTail, bits: Bits, input: u32, surroundings: &Surroundings) -> f64 {
    let x = row.greatest_x;
    if x == 0.0 {
        return 0.0;
    }
    let whole = (bits.b + input).max(bits.a);
    let line = |fraction| surroundings.line_error(fraction);
    let rounding = if bits.divisor >= whole { 0.0 } else { line(bits.divisor) };
    let error = coefficient_error(row.a, bits.a) + x * coefficient_error(row.b, bits.b) + rounding;
    // The divisor itself may be smaller by the error: bound the quotient's change with that.
    let divisor = (row.a - row.b * x - error).max(f64::MIN_POSITIVE);
    let ulp = (-f64::from(surroundings.output)).exp2();
    (error * x / (divisor * divisor) + line(surroundings.output)) / ulp
}

/// The formats of the divider.
///
/// # Errors
/// When the budget cannot be kept, or a stated format does not hold its values.
pub fn widths(
    rows: &[RowTail],
    input: QFormat,
    surroundings: &Surroundings,
    budget: f64,
    stated: &StatedTail,
) -> Result<TailWidths, BudgetError> {
    let quotient = Divider::quotient_fraction(surroundings.output);
    let least = input.fraction_bits().saturating_sub(quotient);
    if let Some(stated) = stated.divisor.filter(|format| format.fraction_bits() < least) {
        return Err(BudgetError::TooFewFractionBits { register: "divisor", stated, least });
    }
    let stated_bits = |format: Option<QFormat>, d| format.map_or(d, QFormat::fraction_bits);
    let choose = |d: u32| Bits {
        a: stated_bits(stated.a, d),
        b: stated_bits(stated.b, d),
        divisor: stated_bits(stated.divisor, d).max(least),
    };
    let worst = |bits: Bits| {
        rows.iter()
            .map(|row| (bound_of_bits(row, bits, input.fraction_bits(), surroundings), row.exponent))
            .fold((0.0, 1.0), |worst, row| if row.0 > worst.0 { row } else { worst })
    };
    // 14 bits beyond the output's: an error of 2^−14 ulp, as in the search for the polynomial.
    let most = surroundings.output + 14;
    let bits = (least..=most.max(least)).map(choose).find(|&bits| worst(bits).0 <= budget).ok_or_else(|| {
        let (needed, exponent) = worst(choose(most.max(least)));
        let what = "the divider's widths";
        BudgetError::NotKept { budget, what, needed, exponent }
    })?;
    formats(rows, bits, stated)
}

fn formats(rows: &[RowTail], bits: Bits, stated: &StatedTail) -> Result<TailWidths, BudgetError> {
    let mut ranges = [Range::zero(); 3];
    for row in rows {
        let n = row.exponent;
        // One ulp above: A, B and D may have been rounded up.
        let up = |value: f64, fraction: u32| value + (-f64::from(fraction)).exp2();
        ranges[0] = ranges[0].with((0.0, up(row.a, bits.a)), n);
        ranges[1] = ranges[1].with((0.0, if row.b == 0.0 { 0.0 } else { up(row.b, bits.b) }), n);
        // D falls from A at x = 0; the remainder is less than D.
        let greatest = up(up(row.a, bits.a), bits.divisor);
        ranges[2] = ranges[2].with((0.0, greatest), n);
    }
    let [a, b, divisor] = ranges;
    Ok(TailWidths {
        a: a.format("tail_a", bits.a, stated.a)?,
        b: b.format("tail_b", bits.b, stated.b)?,
        divisor: divisor.format("divisor", bits.divisor, stated.divisor)?,
    })
}
