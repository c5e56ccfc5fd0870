//! `blysk coefficients`: the real coefficients of a method, as a table or as source.

use std::io::Write;

use anyhow::bail;
use clap::{Args as ClapArgs, ValueEnum, value_parser};
use hw_model::exponents::Exponents;
use hw_model::fit::minimax::{Range, segments};
use hw_model::fit::{Curve, Levels, Method, fit};
use hw_model::highlight::{Cubic, Rational};
use hw_model::registers::{CUBIC, MAX_DEGREE, MAX_SEGMENTS};

use super::methods::Methods;
use super::out::{Out, Outcome};
use super::table::{self, Cell, Rows};
use analysis::source::{Approximation, Language, source};

/// Print the real coefficients of a method, as numbers or as source for a shader.
///
/// A cubic is printed as a·x³ + b·x² + c·x + d and as 1 − s(k1 − s(k2 − s·k3)) with s = 1 − x. Of a ratio
/// x/(A − B·x) the column a has A and the column b has B.
///
/// With --segments or --degree it is polynomials of least greatest error (minimax), down to where x^n is that error,
/// and zero below. Segment k is c0 − v(c1 − v(c2 − …)), v = s − start, from s = start to s = end.
///
/// As source (glsl, hlsl, c, rust) it is a table with a row for each exponent and a function blysk_highlight(row, x) in
/// f32: a cubic down to its minimum and zero below, a ratio, or both. Comments say the greatest error, measured.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk coefficients --method hermite --exponents 2.5,64,1e9 --format csv\n          \
                        blysk coefficients --method minimax --segments 2 --exponents 8,64 --format glsl")]
pub(super) struct Args {
    #[arg(long, value_name = "METHOD", help = format!("The method: one of {}, or all.", Method::list()))]
    method: Methods,
    /// The exponents, such as 1..=256, 1,2,8,64 or 2.5,1e6.
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    exponents: Exponents,
    /// Polynomials of minimax, whose ends are part of the fit, 1 to 8 [default with --degree: 1].
    #[arg(long, value_name = "COUNT", value_parser = value_parser!(u64).range(1..=MAX_SEGMENTS as u64))]
    segments: Option<u64>,
    /// Their degree, 1 to 4 [default with --segments: 3].
    #[arg(long, value_name = "DEGREE", value_parser = value_parser!(u64).range(1..=MAX_DEGREE as u64))]
    degree: Option<u64>,
    /// Q, the level where the epicentre ends.
    #[arg(long, default_value_t = Levels::default().q(), conflicts_with_all = ["segments", "degree"])]
    q: f64,
    /// G, the lower level of three_point.
    #[arg(long, default_value_t = Levels::default().g(), conflicts_with_all = ["segments", "degree"])]
    g: f64,
    /// How to print: numbers (table, csv, json) or source.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// How coefficients are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Format {
    /// For people, at most 100 columns wide, with 5 digits.
    #[default]
    Table,
    /// Comma-separated values with a header, with 17 digits.
    Csv,
    /// An array of objects, with 17 digits.
    Json,
    /// A function for OpenGL 3.30, ES 3.00 and later, in f32.
    Glsl,
    /// A function for Direct3D, in f32.
    Hlsl,
    /// A function for C99 and C++, in f32.
    C,
    /// A function for Rust, in f32.
    Rust,
}

impl Format {
    /// As a table, or in a language.
    const fn kind(self) -> Result<table::Format, Language> {
        match self {
            Self::Table => Ok(table::Format::Table),
            Self::Csv => Ok(table::Format::Csv),
            Self::Json => Ok(table::Format::Json),
            Self::Glsl => Err(Language::Glsl),
            Self::Hlsl => Err(Language::Hlsl),
            Self::C => Err(Language::C),
            Self::Rust => Err(Language::Rust),
        }
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let fitted = args.fitted()?;
    match args.format.kind() {
        // Five digits keep nine columns within 100 characters, and four keep those of segments.
        Ok(format) => match fitted {
            Some((degree, count)) => of_segments(&args.exponents, degree, count)?.print(out, format, 4)?,
            None => of_methods(args)?.print(out, format, 5)?,
        },
        Err(language) => {
            let approximation = args.approximation(fitted)?;
            let command = args.command(approximation, language);
            out.write_all(source(approximation, &args.exponents, language, &command)?.as_bytes())?;
        }
    }
    Ok(Outcome::Good)
}

impl Args {
    /// Degree and number of the segments, where these are asked for.
    fn fitted(&self) -> anyhow::Result<Option<(usize, usize)>> {
        if self.segments.is_none() && self.degree.is_none() {
            return Ok(None);
        }
        if self.method.0 != [Method::Minimax] {
            bail!("--segments and --degree are of minimax alone; say --method minimax");
        }
        let given = |number: Option<u64>, otherwise: usize| number.map_or(otherwise, |number| number as usize);
        Ok(Some((given(self.degree, CUBIC), given(self.segments, 1))))
    }

    fn approximation(&self, fitted: Option<(usize, usize)>) -> anyhow::Result<Approximation> {
        match (fitted, self.method.0.as_slice()) {
            (Some((degree, count)), _) => Ok(Approximation::Segments { degree, count }),
            (None, &[method]) => Ok(Approximation::Method(method, Levels::new(self.q, self.g)?)),
            _ => bail!("a source has one method; say one of {} with --method", Method::list()),
        }
    }

    /// The command line, for the comment at the top of a source.
    fn command(&self, approximation: Approximation, language: Language) -> String {
        let of_method = match approximation {
            Approximation::Method(method, levels) => {
                let changed = |name, value: f64, default: f64| {
                    if value == default { String::new() } else { format!(" --{name} {value}") }
                };
                let default = Levels::default();
                format!("{method}{}{}", changed("q", levels.q(), default.q()), changed("g", levels.g(), default.g()))
            }
            Approximation::Segments { degree, count } => {
                format!("{} --segments {count} --degree {degree}", Method::Minimax)
            }
        };
        let (exponents, language) = (&self.exponents, language.name());
        format!("blysk coefficients --method {of_method} --exponents {exponents} --format {language}")
    }
}

fn of_methods(args: &Args) -> anyhow::Result<Rows> {
    let levels = Levels::new(args.q, args.g)?;
    let mut rows = Rows::new(&["method", "n", "a", "b", "c", "d", "k1", "k2", "k3"]);
    for &method in &args.method.0 {
        for exponent in args.exponents.iter() {
            let curve = fit(method, exponent, levels)?.curve;
            for (method, values) in lines(method, &curve) {
                let mut row = vec![Cell::from(method.to_string()), Cell::Exponent(exponent)];
                row.extend(values.map(Cell::from));
                rows.push(row);
            }
        }
    }
    Ok(rows)
}

/// One line for a curve, two for the composite: its cubic and its tail.
fn lines(method: Method, curve: &Curve) -> Vec<(Method, [Option<f64>; 7])> {
    let cubic = |cubic: &Cubic| {
        let (power, k) = (&cubic.power, &cubic.centred);
        [power.a, power.b, power.c, power.d, k.k1, k.k2, k.k3].map(Some)
    };
    let ratio = |ratio: &Rational| [Some(ratio.a), Some(ratio.b), None, None, None, None, None];
    match curve {
        Curve::Cubic(curve) => vec![(method, cubic(curve))],
        Curve::Rational(curve) => vec![(method, ratio(curve))],
        Curve::Composite { epicentre, tail } => {
            vec![(Method::Hermite, cubic(epicentre)), (Method::Rational, ratio(tail))]
        }
    }
}

/// A line for each segment. Where x^n is such a polynomial itself, there is one.
fn of_segments(exponents: &Exponents, degree: usize, count: usize) -> anyhow::Result<Rows> {
    let coefficients = (0..=degree).map(|power| format!("c{power}"));
    let columns: Vec<String> =
        ["n", "segment", "start", "end"].map(str::to_owned).into_iter().chain(coefficients).collect();
    let mut rows = Rows { columns, rows: Vec::new() };
    rows.columns.push("error".to_owned());
    for exponent in exponents.iter() {
        let fitted = segments(exponent, degree, count, Range::Balanced)?;
        for (index, (segment, end)) in fitted.segments.iter().zip(&fitted.ends).enumerate() {
            let mut row = vec![Cell::Exponent(exponent), Cell::Integer(index as i64)];
            row.extend([segment.start, *end].map(Cell::from));
            row.extend(segment.c[..=degree].iter().map(|&c| Cell::from(c)));
            row.push(Cell::from(fitted.error));
            rows.push(row);
        }
    }
    Ok(rows)
}
