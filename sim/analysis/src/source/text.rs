//! The source: a comment that says what it computes and how well, a table, and a function.

use hw_model::exponents::Exponents;
use rayon::prelude::*;

use super::approximation::Approximation;
use super::language::{Kind, Language};
use super::measured::{Measured, Worst, measured};
use super::piecewise::{Piecewise, SourceError};

/// Numbers of a table: compilers of shaders take no more, and most take less.
const MOST: usize = 1 << 16;

/// One row of the table.
struct Row {
    exponent: f64,
    function: Piecewise,
    measured: Measured,
}

/// Where the numbers of a row stand.
#[derive(Clone, Copy)]
struct Layout {
    degree: usize,
    segments: usize,
    tail: bool,
}

impl Layout {
    /// Numbers of a segment: its end, its start, and the coefficients.
    const fn segment(self) -> usize {
        self.degree + 3
    }

    /// Numbers of a row.
    const fn row(self) -> usize {
        self.segments * self.segment() + if self.tail { 2 } else { 0 }
    }
}

/// The source for these exponents. `command` is the command line that made it.
///
/// # Errors
/// When an exponent is out of range, a coefficient is beyond f32, or the table too long.
pub fn source(
    approximation: Approximation,
    exponents: &Exponents,
    language: Language,
    command: &str,
) -> Result<String, SourceError> {
    let degree = approximation.degree();
    let first = Piecewise::nearest(&approximation.pieces(exponents.first())?, degree, exponents.first())?;
    let layout = Layout { degree, segments: first.segments.len(), tail: first.tail.is_some() };
    let numbers = layout.row() * exponents.len();
    if numbers > MOST {
        return Err(SourceError::Long { numbers, most: MOST });
    }
    let row = |&exponent: &f64| {
        let function = Piecewise::nearest(&approximation.pieces(exponent)?, degree, exponent)?;
        let measured = measured(&function, exponent, approximation.level())?;
        Ok(Row { exponent, function, measured })
    };
    let rows = exponents.as_slice().par_iter().map(row).collect::<Result<Vec<_>, SourceError>>()?;
    let table = rows.iter().enumerate().map(|(place, row)| lines_of(language, place, row)).collect::<Vec<_>>();
    Ok([
        heading(approximation, layout, &rows, command),
        language.table(numbers, &joined(&table)),
        function(language, layout),
    ]
    .join("\n"))
}

/// Comments and lines of numbers of all rows, with commas between the numbers.
fn joined(rows: &[(String, Vec<String>)]) -> String {
    let rows: Vec<String> = rows.iter().map(|(said, lines)| format!("{said}\n{}", lines.join(",\n"))).collect();
    // A comment ends its line, so that the comma stands before it.
    rows.join(",\n")
}

/// The comment of a row, and its lines of numbers.
fn lines_of(language: Language, place: usize, row: &Row) -> (String, Vec<String>) {
    let Row { exponent, function, measured } = row;
    let said = format!(
        "    // row {place}: n = {exponent}; greatest error {:.3e} on the highlight, {:.3e} on [0, 1]",
        measured.highlight.error, measured.whole.error
    );
    (said, function.lines().map(|line| numbers(language, &line)).collect())
}

fn numbers(language: Language, line: &[f32]) -> String {
    let numbers: Vec<String> = line.iter().map(|&value| language.number(value)).collect();
    format!("    {}", numbers.join(", "))
}

fn heading(approximation: Approximation, layout: Layout, rows: &[Row], command: &str) -> String {
    let worst = |of: fn(&Measured) -> Worst| {
        let greater = |a: &&Row, b: &&Row| of(&a.measured).error.total_cmp(&of(&b.measured).error);
        rows.iter().max_by(greater).map_or(String::new(), |row| {
            let Worst { error, x } = of(&row.measured);
            format!("{error:.3e} (n = {}, x = {x:?})", row.exponent)
        })
    };
    let count = rows.iter().map(|row| row.measured.count).max().unwrap_or(0);
    let mut lines = vec![
        format!("x^n of a highlight, by {}.", approximation.said()),
        format!("Made by: {command}"),
        String::new(),
        format!("blysk_highlight(row, x): row 0 to {} is the exponent, x = cos of the angle.", rows.len() - 1),
        format!("Greatest error against x^n, measured in f32 at up to {count} x of each row:"),
        format!("  on the highlight's own range, x^n >= {}: {}", approximation.level(), worst(|found| found.highlight)),
        format!("  on [0, 1]: {}", worst(|found| found.whole)),
        String::new(),
    ];
    lines.extend(layout.said());
    lines.iter().map(|line| format!("// {line}").trim_end().to_owned() + "\n").collect()
}

impl Layout {
    /// What the numbers of a row are.
    fn said(self) -> Vec<String> {
        let mut lines = Vec::new();
        if self.segments > 0 {
            lines
                .push("Numbers of a segment, with s = 1 - x and v = s - start: the s where it ends, start, and".into());
            lines.push(format!("c0 to c{} of {}.", self.degree, self.polynomial(|power| format!("c{power}"))));
            lines.push(match self.tail {
                true => "Beyond the end the tail x/(a + b s) answers: the last two numbers of a row.".into(),
                false => "Beyond the last end it is 0.".into(),
            });
        } else {
            lines.push("Numbers of a row: a and b of x/(a + b s), s = 1 - x, and 1 where that is more.".into());
        }
        lines
    }

    /// c0 - v*(c1 - v*(c2 - …)), each coefficient as `name` has it.
    fn polynomial(self, name: impl Fn(usize) -> String) -> String {
        let inner = |text: String, power| format!("{} - v * {}", name(power), wrapped(&text));
        (0..self.degree).rev().fold(name(self.degree), inner)
    }
}

/// In brackets, where it is a difference.
fn wrapped(text: &str) -> String {
    if text.contains(" - ") { format!("({text})") } else { text.to_owned() }
}

/// The function that reads the table.
fn function(language: Language, layout: Layout) -> String {
    let Layout { segments, tail, .. } = layout;
    let table = language.table_name();
    let at = |offset: usize| format!("{table}[{}]", if offset == 0 { "at".into() } else { format!("at + {offset}") });
    let one = language.number(1.0);
    let kind = if segments > 1 { Kind::Moving } else { Kind::Place };
    let mut body = vec![
        language.clamped_x(),
        language.declared(Kind::Real, "s", &format!("{one} - x")),
        language.declared(kind, "at", &format!("row * {}", layout.row())),
    ];
    // x/(a + b s), and 1 where that is more.
    let below =
        |place: usize| language.declared(Kind::Real, "below", &format!("{} + {} * s", at(place), at(place + 1)));
    let ratio = language.choice("below > x", "x / below", &one);
    if segments == 0 {
        body.extend([below(0), language.last(&ratio)]);
    } else {
        let beyond = format!("s > {}", at(0));
        body.extend((1..segments).map(|_| language.when(&beyond, &format!("at += {};", layout.segment()))));
        let lines = match tail {
            true => vec![below(layout.segment()), language.returned(&ratio)],
            false => vec![language.returned(&language.number(0.0))],
        };
        body.push(language.block(&beyond, &lines));
        body.push(language.declared(Kind::Real, "v", &format!("s - {}", at(1))));
        body.push(language.declared(Kind::Real, "value", &layout.polynomial(|power| at(power + 2))));
        body.push(language.last(&language.clamped("value")));
    }
    let body: Vec<String> = body.iter().map(|line| format!("    {line}")).collect();
    format!("{}{}\n}}\n", language.head(), body.join("\n"))
}
