//! Claims on standard output. Shortened numbers stay bounds: lower ends are cut off, upper ends rounded up.

use std::io::Write;

use hw_model::fit::Method;

use crate::table::{Cell, Format, Rows, digits};
use bounds::certify::certificate::Claim;
use bounds::certify::claim::{Claims, Enclosure, EveryClaim, ExponentClaim, Finding, Stretch};
use bounds::certify::hardware::{HardwareClaim, HardwareRow, Overall, Worst};

/// More exponents than that are summed up in a table.
const MOST_LISTED: usize = 24;

/// The relative width that is promised where the error does not nearly vanish.
const NARROW: f64 = 1e-6;

/// Digits of a bound in a table.
const DIGITS: usize = 9;

pub(crate) fn claim(claim: &Claim, format: Format, out: &mut dyn Write) -> anyhow::Result<()> {
    match (claim, format) {
        (Claim::Exponents(claims), Format::Table) => exponents_table(claims, out),
        (Claim::EveryExponent(claims), Format::Table) => every_table(claims, out),
        (Claim::Hardware(claim), Format::Table) => hardware_table(claim, out),
        (claim, format) => rows(claim).print(out, format, 17),
    }
}

/// Everything that is claimed, a line for each bound or exponent.
pub(crate) fn rows(claim: &Claim) -> Rows {
    match claim {
        Claim::Exponents(claims) => exponent_rows(&claims.claims),
        Claim::EveryExponent(claims) => every_rows(&claims.claims),
        Claim::Hardware(claim) => hardware_rows(claim),
    }
}

/// The positive `value` with this number of significant digits, never greater (never less with `up`).
///
/// Every f64 is a finite decimal number, of which 800 digits are all.
pub(super) fn shortened(value: f64, up: bool) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let all = format!("{value:.800e}");
    let (mantissa, exponent) = all.split_once('e').unwrap_or((&all, "0"));
    let mut figures: Vec<u8> = mantissa.bytes().filter(u8::is_ascii_digit).map(|d| d - b'0').collect();
    let rest = figures.split_off(DIGITS.min(figures.len()));
    let mut power: i32 = exponent.parse().unwrap_or(0);
    if up && rest.iter().any(|&digit| digit > 0) {
        let nines = figures.iter().rev().take_while(|&&digit| digit == 9).count();
        let from = figures.len() - nines;
        figures[from..].fill(0);
        match from.checked_sub(1) {
            Some(last) => figures[last] += 1,
            None => {
                figures[0] = 1;
                power += 1;
            }
        }
    }
    let text: String = figures.iter().map(|digit| char::from(b'0' + digit)).collect();
    match power {
        -6..0 => format!("0.{}{text}", "0".repeat((-power - 1) as usize)),
        0 => format!("{}.{}", &text[..1], &text[1..]),
        _ => format!("{}.{}e{power}", &text[..1], &text[1..]),
    }
}

fn ends(lower: f64, upper: f64) -> [Cell; 2] {
    [Cell::from(shortened(lower, false)), Cell::from(shortened(upper, true))]
}

fn no_cells() -> [Cell; 2] {
    [Cell::None, Cell::None]
}

fn exponents_table(claims: &Claims<ExponentClaim>, out: &mut dyn Write) -> anyhow::Result<()> {
    let Claims { levels, claims } = claims;
    let count = |method: Method, region: Stretch| {
        claims.iter().filter(|claim| claim.method == method && claim.region == region).count()
    };
    let listed = claims.iter().all(|claim| count(claim.method, claim.region) <= MOST_LISTED);
    let (chosen, said): (Vec<&ExponentClaim>, _) = if listed {
        (claims.iter().collect(), "Errors of the methods")
    } else {
        (greatest(claims), "The exponent with the greatest absolute error of each method")
    };
    writeln!(out, "{said}, Q = {}, G = {}:\n", levels.q(), levels.g())?;
    let columns = ["method", "region", "n", "|f-x^n| from", "to", "|f/x^n-1| from", "to"];
    let mut rows = Rows::new(&columns);
    for claim in chosen {
        let mut row =
            vec![Cell::from(claim.method.to_string()), Cell::from(claim.region.name()), Cell::Exponent(claim.n)];
        row.extend(ends(claim.absolute.lower(), claim.absolute.upper()));
        let relative = claim.relative.as_ref();
        row.extend(relative.map_or_else(no_cells, |found| ends(found.lower(), found.upper())));
        rows.push(row);
    }
    rows.print(out, Format::Table, DIGITS)?;
    let found = claims.iter().flat_map(|claim| [Some(&claim.absolute), claim.relative.as_ref()]);
    let (mut narrow, mut wide, mut exact, mut widest) = (0_u32, 0_u32, 0_u32, 0.0_f64);
    for finding in found.flatten() {
        match finding {
            Finding::Exact => exact += 1,
            Finding::Enclosed(enclosure) if enclosure.relative_width() <= NARROW => {
                narrow += 1;
                widest = widest.max(enclosure.relative_width());
            }
            Finding::Enclosed(_) => wide += 1,
        }
    }
    writeln!(out)?;
    if narrow > 0 {
        writeln!(out, "{}, relative width at most {}", counted(narrow), shortened(widest, true))?;
    }
    if wide > 0 {
        let counted = counted(wide);
        writeln!(out, "{counted} wider than {NARROW:e}: the error nearly vanishes there (csv has each)")?;
    }
    if exact > 0 {
        writeln!(out, "maxima that are 0, because the method gives x^n itself: {exact}")?;
    }
    Ok(())
}

fn counted(enclosures: u32) -> String {
    if enclosures == 1 { "1 enclosure".to_owned() } else { format!("{enclosures} enclosures") }
}

/// The claim with the greatest absolute error of each method and region.
pub(super) fn greatest(claims: &[ExponentClaim]) -> Vec<&ExponentClaim> {
    let mut chosen: Vec<&ExponentClaim> = Vec::new();
    for claim in claims {
        let same = |other: &&ExponentClaim| (other.method, other.region) == (claim.method, claim.region);
        match chosen.iter().position(same) {
            Some(at) if chosen[at].absolute.upper() < claim.absolute.upper() => chosen[at] = claim,
            Some(_) => {}
            None => chosen.push(claim),
        }
    }
    chosen
}

fn finding_cells(finding: Option<&Finding>) -> [Cell; 4] {
    match finding {
        Some(Finding::Enclosed(found)) => {
            [found.lower.into(), found.upper.into(), found.relative_width().into(), found.witness.sigma.into()]
        }
        Some(Finding::Exact) => [Cell::Real(0.0), Cell::Real(0.0), Cell::None, Cell::None],
        None => [Cell::None, Cell::None, Cell::None, Cell::None],
    }
}

fn exponent_rows(claims: &[ExponentClaim]) -> Rows {
    let mut rows = Rows::new(&[
        "method",
        "n",
        "region",
        "absolute_lower",
        "absolute_upper",
        "absolute_width",
        "absolute_sigma",
        "relative_lower",
        "relative_upper",
        "relative_width",
        "relative_sigma",
        "exact",
    ]);
    for claim in claims {
        let mut row =
            vec![Cell::from(claim.method.to_string()), Cell::Exponent(claim.n), Cell::from(claim.region.name())];
        row.extend(finding_cells(Some(&claim.absolute)));
        row.extend(finding_cells(claim.relative.as_ref()));
        row.push(Cell::Flag(claim.absolute == Finding::Exact));
        rows.push(row);
    }
    rows
}

fn every_table(claims: &Claims<EveryClaim>, out: &mut dyn Write) -> anyhow::Result<()> {
    let Claims { levels, claims } = claims;
    let (q, g) = (levels.q(), levels.g());
    writeln!(out, "Every real n >= 1 on the epicentre, x^n >= Q; Q = {q}, G = {g}:")?;
    for EveryClaim { method, absolute, relative } in claims {
        writeln!(out, "\n{method}")?;
        for (name, found) in [("|f - x^n|", absolute), ("|f/x^n - 1|", relative)] {
            let (lower, upper) = (shortened(found.lower, false), shortened(found.upper, true));
            let boxes = found.partition.bytes().filter(|&sign| sign == b'0').count();
            writeln!(out, "  sup {name:11}  [{lower}, {upper}]  {}", place(found))?;
            writeln!(out, "  {:15}  proved by {boxes} boxes of (1/n, -n ln x)", "")?;
        }
    }
    Ok(())
}

/// Where the witness of a claim for every n is.
fn place(found: &Enclosure) -> String {
    let power = found.witness.level();
    match found.witness.h {
        Some(h) if h > 0.0 => format!("at n = {}, x^n = {}", digits(1.0 / h, 6), digits(power, 6)),
        _ => format!("in the limit n -> infinity, x^n = {}", digits(power, 6)),
    }
}

fn every_rows(claims: &[EveryClaim]) -> Rows {
    let mut rows = Rows::new(&["method", "error", "lower", "upper", "width", "h", "sigma", "boxes"]);
    for EveryClaim { method, absolute, relative } in claims {
        for (name, found) in [("absolute", absolute), ("relative", relative)] {
            let boxes = found.partition.bytes().filter(|&sign| sign == b'0').count();
            rows.push(vec![
                Cell::from(method.to_string()),
                Cell::from(name),
                found.lower.into(),
                found.upper.into(),
                found.relative_width().into(),
                found.witness.h.into(),
                found.witness.sigma.into(),
                Cell::Integer(boxes as i64),
            ]);
        }
    }
    rows
}

fn hardware_table(claim: &HardwareClaim, out: &mut dyn Write) -> anyhow::Result<()> {
    let HardwareClaim { configuration, points, epicentre, full_range, rows } = claim;
    let count = rows.len();
    writeln!(out, "{}: {points} points, every x in [0, 1] of {count} exponents", configuration.name)?;
    writeln!(out, "greatest |output - x^n|, by exhaustion, between")?;
    hardware_lines("epicentre", epicentre, rows, |row| row.epicentre, out)?;
    hardware_lines("all of [0, 1]", full_range, rows, |row| row.full_range, out)?;
    writeln!(out, "the reference, x^n correctly rounded, is off by at most 2^-54, which is within")?;
    Ok(())
}

fn hardware_lines(
    name: &str,
    overall: &Overall,
    rows: &[HardwareRow],
    of: fn(&HardwareRow) -> Worst,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let (lower, upper) = (shortened(overall.lower, false), shortened(overall.upper, true));
    writeln!(out, "  {name:13}  {lower} and {upper}")?;
    if let Some(row) = rows.iter().find(|row| row.n == overall.n) {
        let Worst { x, output, .. } = of(row);
        writeln!(out, "  {:13}  at n = {}, x = {x:#x}, output {output:#x}", "", row.n)?;
    }
    Ok(())
}

fn hardware_rows(claim: &HardwareClaim) -> Rows {
    let mut rows = Rows::new(&[
        "n",
        "epicentre_from",
        "epicentre_lower",
        "epicentre_upper",
        "epicentre_x",
        "epicentre_output",
        "full_range_lower",
        "full_range_upper",
        "full_range_x",
        "full_range_output",
    ]);
    let worst = |worst: Worst| [worst.lower.into(), worst.upper.into(), worst.x.into(), worst.output.into()];
    for row in &claim.rows {
        let mut cells = vec![Cell::Exponent(row.n), Cell::from(row.epicentre_from)];
        cells.extend(worst(row.epicentre));
        cells.extend(worst(row.full_range));
        rows.push(cells);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn shortened_by_hand() {
        assert_eq!(shortened(0.005_544_539_929_021, false), "0.00554453992");
        assert_eq!(shortened(0.005_544_539_929_021, true), "0.00554453993");
        assert_eq!(shortened(0.999_999_999_9, true), "1.00000000");
        assert_eq!(shortened(0.5, true), "0.500000000");
        // 2^−30 is 9.31322574615478515625e−10.
        assert_eq!(shortened((-30.0_f64).exp2(), false), "9.31322574e-10");
        assert_eq!(shortened((-30.0_f64).exp2(), true), "9.31322575e-10");
        assert_eq!(shortened(0.0, true), "0");
    }

    proptest! {
        #[test]
        fn shortened_numbers_are_still_bounds(value in 1e-12_f64..10.0) {
            let (low, high): (f64, f64) =
                (shortened(value, false).parse().unwrap(), shortened(value, true).parse().unwrap());
            prop_assert!(low <= value && value <= high);
            prop_assert!(high - low <= 1.1e-8 * value);
        }
    }
}
