//! `blysk coefficients`: the real coefficients of a method.

use clap::Args as ClapArgs;
use hw_model::exponents::Exponents;
use hw_model::fit::{Curve, Levels, Method, fit};

use super::out::{Out, Outcome};
use super::table::{Cell, Format, Rows};

/// Print the real coefficients of a method.
///
/// A cubic is printed as a·x³ + b·x² + c·x + d and as 1 − s(k1 − s(k2 − s·k3)) with s = 1 − x. Of a ratio
/// x/(A − B·x) the column a has A and the column b has B.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk coefficients --method hermite --exponents 2.5,64,1e9 --format csv")]
pub(super) struct Args {
    #[arg(long, value_name = "METHOD", help = format!("The method: one of {}.", Method::list()))]
    method: Method,
    /// The exponents, such as 1..=256, 1,2,8,64 or 2.5,1e6.
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    exponents: Exponents,
    /// Q, the level where the epicentre ends.
    #[arg(long, default_value_t = Levels::default().q())]
    q: f64,
    /// G, the lower level of three_point.
    #[arg(long, default_value_t = Levels::default().g())]
    g: f64,
    /// How to print: table (5 digits), csv or json (17 digits).
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let levels = Levels::new(args.q, args.g)?;
    let mut rows = Rows::new(&["method", "n", "a", "b", "c", "d", "k1", "k2", "k3"]);
    for exponent in args.exponents.iter() {
        let curve = fit(args.method, exponent, levels)?.curve;
        for (method, values) in lines(args.method, &curve) {
            let mut row = vec![Cell::from(method.to_string()), Cell::Exponent(exponent)];
            row.extend(values.map(Cell::from));
            rows.push(row);
        }
    }
    // Five digits keep nine columns within 100 characters.
    rows.print(out, args.format, 5)?;
    Ok(Outcome::Good)
}

/// One line for a curve, two for the composite: its cubic and its tail.
fn lines(method: Method, curve: &Curve) -> Vec<(Method, [Option<f64>; 7])> {
    let cubic = |cubic: &hw_model::highlight::Cubic| {
        let (power, k) = (&cubic.power, &cubic.centred);
        [power.a, power.b, power.c, power.d, k.k1, k.k2, k.k3].map(Some)
    };
    let ratio = |ratio: &hw_model::highlight::Rational| [Some(ratio.a), Some(ratio.b), None, None, None, None, None];
    match curve {
        Curve::Cubic(curve) => vec![(method, cubic(curve))],
        Curve::Rational(curve) => vec![(method, ratio(curve))],
        Curve::Composite { epicentre, tail } => {
            vec![(Method::Hermite, cubic(epicentre)), (Method::Rational, ratio(tail))]
        }
    }
}
