//! What `blysk stability` prints for people: a screen or two for each part.

use std::io::Write;

use hw_model::config::Form;
use hw_model::fit::Method;

use super::table::{Cell, Format, Rows, digits, write_folded};
use analysis::stability::coefficients::{self, CoefficientLosses, STEPS_PER_DECADE, Threshold};
use analysis::stability::conditioning::{Conditioning, OUTPUT_BITS, Widths};
use analysis::stability::edges::{Edge, EdgeReport};
use analysis::stability::reference::ReferenceReport;
use analysis::stability::seams::{SeamReport, SeamRow};

/// Digits of a number in these tables.
const SHORT: usize = 3;

/// A number in few digits, or a dash.
fn short(value: Option<f64>) -> Cell {
    Cell::from(value.map_or_else(|| "-".to_owned(), brief))
}

fn brief(value: f64) -> String {
    if value.abs() >= 1e4 { format!("{value:.1e}") } else { digits(value, SHORT) }
}

pub(super) fn coefficients(report: &CoefficientLosses, out: &mut dyn Write) -> anyhow::Result<()> {
    write_folded(
        out,
        &format!(
            "Digits of f64 (15.95) that coefficients lose, the worst of each form, against {} bits; n is \
             found to a step of {STEPS_PER_DECADE} in a decade. Beside 1, 2 and 3 a coefficient vanishes: \
             the distance within which half of its digits are lost.",
            report.exact_bits
        ),
    )?;
    writeln!(out)?;
    let mut rows = Rows::new(&["method", "way", "form", "to 1e9", "half from n", "all from n", "beside 1", "2", "3"]);
    let of = |like: &Threshold, toward| {
        let same = |other: &&Threshold| {
            (other.method, other.way, other.form, other.toward) == (like.method, like.way, like.form, Some(toward))
        };
        report.thresholds.iter().find(same).and_then(|found| found.half)
    };
    for method in coefficients::methods() {
        for row in report.thresholds.iter().filter(|row| row.method == method) {
            if row.toward.is_some() {
                continue;
            }
            rows.push(vec![
                Cell::from(method.name()),
                row.way.name().into(),
                row.form.name().into(),
                Cell::from(format!("{:.1}", row.most)),
                short(row.half),
                short(row.all),
                short(of(row, 1.0)),
                short(of(row, 2.0)),
                short(of(row, 3.0)),
            ]);
        }
    }
    rows.print(out, Format::Table, SHORT)
}

pub(super) fn conditioning(report: &Conditioning, out: &mut dyn Write) -> anyhow::Result<()> {
    writeln!(out, "Condition of hermite, the sum of the terms' sizes over the size of their sum\n")?;
    let mut rows = Rows::new(&["n", "power, x = 1", "power, epicentre", "centred, epicentre", "k1 = 3a+2b+c"]);
    let decades = report
        .conditions
        .iter()
        .filter(|row| row.method == Method::Hermite && (row.n.log10() - row.n.log10().round()).abs() < 1e-9);
    for row in decades {
        let mut cells = vec![Cell::from(brief(row.n))];
        cells.extend(
            [row.power_at_one, row.power_epicentre, row.centred_epicentre, row.conversion]
                .map(|value| Cell::from(brief(value))),
        );
        rows.push(cells);
    }
    rows.print(out, Format::Table, SHORT)?;
    writeln!(
        out,
        "\nWidths for a faithful result, hermite, exponents 1 to n (three in each octave of them):\n\
         stored coefficient bits, the widest multiplier, partial products of all three; x as wide as the\n\
         result and n together\n"
    )?;
    let mut rows =
        Rows::new(&["result", "n up to", "power: bits", "multiplier", "area", "centred: bits", "multiplier", "area"]);
    for bits in OUTPUT_BITS {
        let of = |form| {
            let same = move |row: &&Widths| (row.method, row.output_bits, row.form) == (Method::Hermite, bits, form);
            report.widths.iter().filter(same)
        };
        for (power, centred) in of(Form::Power).zip(of(Form::Centred)) {
            let mut cells = vec![Cell::from(format!("{bits} bits")), Cell::from(brief(power.greatest_n))];
            for row in [power, centred] {
                let number =
                    |value: Option<u32>| Cell::from(value.map_or_else(|| "-".to_owned(), |value| value.to_string()));
                cells.push(match row.refused {
                    Some(_) => "refused".into(),
                    None => number(row.coefficient_bits),
                });
                cells.push(row.widest_multiplier.clone().unwrap_or_else(|| "-".to_owned()).into());
                cells.push(number(row.multiplier_area));
            }
            rows.push(cells);
        }
    }
    rows.print(out, Format::Table, SHORT)?;
    for bits in OUTPUT_BITS {
        for (form, name) in [(Form::Power, "power"), (Form::Centred, "centred")] {
            let first = report.widths.iter().find_map(|row| {
                let same = (row.method, row.output_bits, row.form) == (Method::Hermite, bits, form);
                same.then_some(())?;
                Some((row.greatest_n, row.refused.as_ref()?))
            });
            if let Some((n, reason)) = first {
                let from = format!("refused: {name}, {bits} bits, from n = {}: ", brief(n));
                write_folded(out, &format!("{from}{reason}"))?;
            }
        }
    }
    Ok(())
}

pub(super) fn edges(report: &EdgeReport, out: &mut dyn Write) -> anyhow::Result<()> {
    writeln!(out, "{}: answers at the edges; errors in output ulp\n", report.configuration)?;
    let mut rows = Rows::new(&["variant", "budget", "bound", "answers", "failures", "worst, to the method"]);
    for variant in report.variants.iter().filter(|variant| variant.refused.is_none()) {
        rows.push(vec![
            Cell::from(variant.name.clone()),
            Cell::from(brief(variant.budget_ulp)),
            short(variant.bound_ulp),
            Cell::from(variant.answers as i64),
            Cell::from(variant.failures as i64),
            short(variant.worst_method_ulp),
        ]);
    }
    rows.print(out, Format::Table, SHORT)?;
    for variant in &report.variants {
        if let Some(reason) = &variant.refused {
            write_folded(out, &format!("refused: {}: {reason}", variant.name))?;
        }
    }
    writeln!(out, "\nas configured, by x\n")?;
    cases(report).print(out, Format::Table, SHORT)?;
    writeln!(out, "\nROM fields at the edges of their formats\n")?;
    let mut rows = Rows::new(&["field", "format", "edge", "passages", "overflowing", "outcome"]);
    for word in &report.words {
        rows.push(vec![
            Cell::from(word.field),
            word.format.clone().into(),
            word.edge.into(),
            Cell::from(word.passages as i64),
            Cell::from(word.overflowing as i64),
            word.outcome.clone().into(),
        ]);
    }
    rows.print(out, Format::Table, SHORT)?;
    for row in report.rows.iter().filter(|row| !row.holds).take(8) {
        write_folded(out, &failure(row))?;
    }
    let verdict = if report.holds() { "holds" } else { "DOES NOT HOLD" };
    Ok(writeln!(out, "\nevery answer within its bound, with its flags: {verdict}")?)
}

fn failure(row: &Edge) -> String {
    let n = row.n.map_or_else(|| "no exponent".to_owned(), |n| format!("n = {n}"));
    format!(
        "FAILS: {}: {n} (address {}), x = {} ({}): {} ({}), flags {}, {} ulp from the method, bound {}",
        row.variant,
        row.address,
        row.x,
        row.case,
        row.intensity,
        row.intensity_bits,
        row.status,
        row.method_ulp.map_or_else(|| "-".to_owned(), brief),
        row.bound_ulp.map_or_else(|| "-".to_owned(), brief)
    )
}

/// Each kind of x: the worst over the exponents, and the flags that were met.
fn cases(report: &EdgeReport) -> Rows {
    let mut rows = Rows::new(&["x", "answers", "to the method", "to x^n", "at n", "flags", "failures"]);
    let own: Vec<&Edge> = report.rows.iter().filter(|row| row.variant == "as configured").collect();
    let mut kinds: Vec<(&str, bool)> = Vec::new();
    for row in &own {
        if !kinds.contains(&(row.case, row.n.is_some())) {
            kinds.push((row.case, row.n.is_some()));
        }
    }
    // Addresses without a word all give zero: one line.
    let outside = own.iter().copied().filter(|row| row.n.is_none()).collect::<Vec<_>>();
    for (case, _) in kinds.into_iter().filter(|(_, has_word)| *has_word) {
        let of: Vec<&Edge> = own.iter().copied().filter(|row| row.case == case && row.n.is_some()).collect();
        rows.push(case_line(case, &of));
    }
    rows.push(case_line("any, no ROM word", &outside));
    rows
}

fn case_line(case: &str, rows: &[&Edge]) -> Vec<Cell> {
    let worst = rows
        .iter()
        .filter_map(|row| Some((row.error_ulp?.abs(), row.n)))
        .reduce(|worst, row| if row.0 > worst.0 { row } else { worst });
    let method = rows.iter().filter_map(|row| row.method_ulp).map(f64::abs).reduce(f64::max);
    let mut flags: Vec<&str> = rows.iter().map(|row| row.status.as_str()).collect();
    flags.sort_unstable();
    flags.dedup();
    vec![
        Cell::from(case),
        Cell::from(rows.len() as i64),
        short(method),
        short(worst.map(|worst| worst.0)),
        short(worst.and_then(|worst| worst.1)),
        Cell::from(flags.join(" ")),
        Cell::from(rows.iter().filter(|row| !row.holds).count() as i64),
    ]
}

pub(super) fn seams(report: &SeamReport, out: &mut dyn Write) -> anyhow::Result<()> {
    const MOST_ROWS: usize = 24;
    writeln!(
        out,
        "{}: {} exponents, every pair of neighbouring x: {} pairs\n",
        report.configuration,
        report.rows.len(),
        report.pairs
    )?;
    let falling = report.rows.iter().filter(|row| row.falls > 0).count();
    let falls: u64 = report.rows.iter().map(|row| row.falls).sum();
    writeln!(out, "the output falls at          {falls} pairs, of {falling} exponents")?;
    if let Some(row) = worst(report, |row| row.deepest_fall_ulp) {
        let place = place(row, row.deepest_fall_x);
        writeln!(out, "deepest fall                 {} ulp {place}", row.deepest_fall_ulp)?;
    }
    if let Some(row) = worst(report, |row| row.hand_over_jump_ulp.unwrap_or(0).abs())
        && let Some(jump) = row.hand_over_jump_ulp
    {
        let place = place(row, row.hand_over_x);
        writeln!(out, "largest jump at a hand-over  {jump:+} ulp {place}")?;
    }
    if let Some(row) = worst(report, |row| row.image_step) {
        let place = place(row, row.image_step_x);
        writeln!(out, "largest step of an image     {} of 255 {place}", row.image_step)?;
    }
    let image: u64 = report.rows.iter().map(|row| row.image_falls).sum();
    writeln!(out, "an image falls at            {image} pairs\n")?;
    let few = report.rows.len() <= MOST_ROWS;
    let shown = report.rows.iter().filter(|row| few || row.n.log2().fract() == 0.0);
    let mut rows = Rows::new(&["n", "falls", "within a part", "deepest", "at x", "hand-over", "at x", "image step"]);
    for row in shown {
        rows.push(vec![
            Cell::Exponent(row.n),
            Cell::from(row.falls as i64),
            Cell::from(row.falls_within_part as i64),
            Cell::from(row.deepest_fall_ulp),
            position(row.deepest_fall_x),
            row.hand_over_jump_ulp.map_or_else(|| "-".into(), |jump| format!("{jump:+}").into()),
            position(row.hand_over_x),
            Cell::from(row.image_step),
        ]);
    }
    rows.print(out, Format::Table, 9)?;
    if !few {
        writeln!(out, "(powers of two; csv, json and --out have every exponent)")?;
    }
    Ok(())
}

fn worst(report: &SeamReport, of: fn(&SeamRow) -> i64) -> Option<&SeamRow> {
    let most = report.rows.iter().reduce(|most, row| if of(row) > of(most) { row } else { most });
    most.filter(|row| of(row) > 0)
}

fn position(x: Option<f64>) -> Cell {
    Cell::from(x.map_or_else(|| "-".to_owned(), |x| digits(x, 8)))
}

fn place(row: &SeamRow, x: Option<f64>) -> String {
    let x = x.map_or_else(String::new, |x| format!(", x = {}", digits(x, 12)));
    format!("at n = {}{x}", row.n)
}

pub(super) fn reference(report: &ReferenceReport, out: &mut dyn Write) -> anyhow::Result<()> {
    writeln!(
        out,
        "x^n in f64 against exact integers, n up to 65 536, integers, halves and quarters of them (no exact\n\
         integers exist for others): structured cases, and {} drawn from seed {}\n",
        report.random_samples, report.seed
    )?;
    let mut rows = Rows::new(&["function", "powers", "not nearest", "worst, ulp", "at n", "at x", "promised"]);
    for row in &report.totals {
        rows.push(vec![
            Cell::from(row.function.name()),
            Cell::from(row.samples as i64),
            Cell::from(row.not_nearest as i64),
            Cell::from(digits(row.worst_ulp, 7)),
            Cell::from(digits(row.worst_n, 8)),
            Cell::from(digits(row.worst_x, 8)),
            short(row.function.promised_ulp()),
        ]);
    }
    rows.print(out, Format::Table, SHORT)?;
    let verdict = if report.holds() { "holds" } else { "DOES NOT HOLD" };
    Ok(writeln!(out, "\nthe reference is as exact as it says: {verdict}")?)
}
