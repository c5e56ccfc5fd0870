//! The files and figures of a stability report: for each part tables as CSV, everything as JSON, plots.

use hw_model::config::Form;
use hw_model::fit::Method;
use serde::Serialize;
use vectors::whole_file::OutputSet;

use super::written::{self, FilesError};

use crate::stability::coefficients::{ALL_DIGITS, CoefficientLosses, CoefficientWay, HALF_DIGITS, Set};
use crate::stability::conditioning::{Condition, Conditioning};
use crate::stability::edges::{Edge, EdgeReport};
use crate::stability::reference::{Function, ReferenceReport};
use crate::stability::seams::{SeamReport, SeamRow};
use plot::{Axis, Chart, Mark, ReferenceLine, Series};

/// The least value that is drawn on a logarithmic axis.
const LEAST_DRAWN: f64 = 1e-6;

/// The greatest exponent of the plots of digits: more decades than these have no room for their names.
const GREATEST_DRAWN: f64 = 1e9;

/// A table as CSV, under its name.
pub type NamedTable = (&'static str, Vec<u8>);

/// A part of the stability report.
pub trait PartFiles: Serialize {
    /// Its name, and that of its first table.
    const NAME: &'static str;

    /// Its tables, the one with every row first.
    ///
    /// # Errors
    /// When a row does not become CSV.
    fn tables(&self) -> Result<Vec<NamedTable>, FilesError>;

    /// Its pictures, without those that would have nothing to show.
    fn charts(&self) -> Vec<(&'static str, Chart)>;

    /// All of it as JSON.
    ///
    /// # Errors
    /// When it does not become JSON.
    fn json(&self) -> Result<String, FilesError> {
        written::json(&format!("{}.json", Self::NAME), self)
    }
}

/// Adds every file of a part to `set`, and returns their names, a picture's without its end.
///
/// # Errors
/// When a file cannot be written or a chart cannot be drawn.
pub fn write<P: PartFiles>(set: &mut OutputSet, part: &P) -> Result<Vec<String>, FilesError> {
    let mut names = Vec::new();
    for (name, csv) in part.tables()? {
        let name = format!("{name}.csv");
        set.write(&name, csv)?;
        names.push(name);
    }
    let name = format!("{}.json", P::NAME);
    set.write(&name, part.json()?)?;
    names.push(name);
    for (name, chart) in part.charts() {
        written::picture(set, name, &chart)?;
        names.push(name.to_owned());
    }
    Ok(names)
}

fn table<T: Serialize>(name: &'static str, rows: &[T]) -> Result<NamedTable, FilesError> {
    Ok((name, written::table(&format!("{name}.csv"), rows)?))
}

/// A chart against n; series without points are left out.
fn against_n(title: String, y_axis: Axis, series: Vec<Series>) -> Chart {
    let mut chart = Chart::new(title, Axis::log("exponent n"), y_axis);
    chart.series = series.into_iter().filter(|series| !series.points.is_empty()).collect();
    let exponents = || chart.series.iter().flat_map(|series| &series.points).map(|point| point.0);
    let (least, greatest) = (exponents().fold(f64::INFINITY, f64::min), exponents().fold(0.0, f64::max));
    if least < greatest {
        let dots = chart.series.iter().any(|series| series.mark == Mark::Points);
        // Half a dot on the edge would be cut off.
        let room = if dots { 1.1 } else { 1.0 };
        chart.x_axis.range = Some((least / room, greatest * room));
    }
    chart
}

fn drawable(charts: Vec<(&'static str, Chart)>) -> Vec<(&'static str, Chart)> {
    charts.into_iter().filter(|(_, chart)| !chart.series.is_empty()).collect()
}

impl PartFiles for CoefficientLosses {
    const NAME: &'static str = "coefficients";

    fn tables(&self) -> Result<Vec<NamedTable>, FilesError> {
        Ok(vec![table(Self::NAME, &self.rows)?, table("coefficients_thresholds", &self.thresholds)?])
    }

    fn charts(&self) -> Vec<(&'static str, Chart)> {
        drawable(vec![
            ("coefficients_hermite_power", losses(self, Method::Hermite, Set::Power)),
            ("coefficients_hermite_centred", losses(self, Method::Hermite, Set::Centred)),
            ("coefficients_three_point_power", losses(self, Method::ThreePoint, Set::Power)),
            ("coefficients_three_point_centred", losses(self, Method::ThreePoint, Set::Centred)),
        ])
    }
}

fn losses(report: &CoefficientLosses, method: Method, form: Set) -> Chart {
    let series = CoefficientWay::ALL.into_iter().enumerate().map(|(index, way)| {
        let of = report.rows.iter().filter(|row| (row.method, row.way, row.form) == (method, way, form));
        let drawn = of.filter(|row| row.n <= GREATEST_DRAWN);
        let points = drawn.map(|row| (row.n, row.digits_lost)).collect();
        Series::new(way_label(way), points, Mark::nth(index))
    });
    let names = match form {
        Set::Power => "a, b, c",
        Set::Centred => "k1, k2, k3",
    };
    let y_axis = Axis::linear("decimal digits lost").with_range(0.0, 18.0);
    let title = format!("Digits lost by {names} of {method}");
    let mut chart = against_n(title, y_axis, series.collect());
    chart.reference_lines = vec![ReferenceLine::new(HALF_DIGITS, "half"), ReferenceLine::new(ALL_DIGITS, "all")];
    chart
}

const fn way_label(way: CoefficientWay) -> &'static str {
    match way {
        CoefficientWay::PrintedConstant => "as printed, ln 2 = 0.6931471",
        CoefficientWay::Printed => "as printed, q = Q^(1/n)",
        CoefficientWay::Naive => "divided differences, 1 − q",
        CoefficientWay::Stable => "divided differences, expm1",
        CoefficientWay::Fit => "the project's fit",
    }
}

impl PartFiles for Conditioning {
    const NAME: &'static str = "conditioning";

    fn tables(&self) -> Result<Vec<NamedTable>, FilesError> {
        Ok(vec![table(Self::NAME, &self.conditions)?, table("conditioning_widths", &self.widths)?])
    }

    fn charts(&self) -> Vec<(&'static str, Chart)> {
        drawable(vec![("conditioning_forms", conditions(self)), ("conditioning_widths", widths(self))])
    }
}

fn conditions(report: &Conditioning) -> Chart {
    let curve = |index, name: &str, of: fn(&Condition) -> f64| {
        let rows = report.conditions.iter().filter(|row| row.method == Method::Hermite);
        Series::new(name, rows.map(|row| (row.n, of(row))).collect(), Mark::nth(index))
    };
    let series = vec![
        curve(0, "power form, worst of the epicentre", |row| row.power_epicentre),
        curve(1, "power form at x = 1", |row| row.power_at_one),
        curve(2, "k1 = 3a + 2b + c", |row| row.conversion),
        curve(3, "xⁿ itself, in x", |row| row.reference),
        curve(4, "centred form, worst of the epicentre", |row| row.centred_epicentre),
    ];
    against_n("Condition of hermite".to_owned(), Axis::log("Σ|term| / |sum|"), series)
}

fn widths(report: &Conditioning) -> Chart {
    let curve = |(index, (form, bits)): (usize, (Form, u32))| {
        let rows =
            report.widths.iter().filter(|row| (row.method, row.form, row.output_bits) == (Method::Hermite, form, bits));
        let points = rows.filter_map(|row| Some((row.greatest_n, f64::from(row.coefficient_bits?))));
        let form = match form {
            Form::Power => "power",
            Form::Centred => "centred",
        };
        Series::new(format!("{form}, {bits} bits of result"), points.collect(), Mark::nth(index))
    };
    let wanted = [(Form::Power, 20), (Form::Power, 8), (Form::Centred, 20), (Form::Centred, 8)];
    let series = wanted.into_iter().enumerate().map(curve).collect();
    let title = "Stored coefficient bits for a faithful result, hermite".to_owned();
    let mut chart = against_n(title, Axis::linear("bits in a ROM word"), series);
    chart.x_axis.label = "greatest exponent n".to_owned();
    chart
}

impl PartFiles for EdgeReport {
    const NAME: &'static str = "edges";

    fn tables(&self) -> Result<Vec<NamedTable>, FilesError> {
        Ok(vec![
            table(Self::NAME, &self.rows)?,
            table("edges_variants", &self.variants)?,
            table("edges_words", &self.words)?,
        ])
    }

    fn charts(&self) -> Vec<(&'static str, Chart)> {
        let own = |row: &Edge| row.variant == "as configured";
        let worst = |of: fn(&Edge) -> Option<f64>, wanted: &dyn Fn(&Edge) -> bool| {
            let mut points: Vec<(f64, f64)> = Vec::new();
            for row in self.rows.iter().filter(|row| wanted(row)) {
                let (Some(n), Some(error)) = (row.n, of(row)) else { continue };
                match points.last_mut() {
                    Some((last, most)) if *last == n => *most = most.max(error.abs()),
                    _ => points.push((n, error.abs())),
                }
            }
            points
        };
        // Variants that are alike in every point are one: floor and towards zero, where nothing is negative.
        let mut variants =
            vec![("as configured".to_owned(), worst(|row| row.bound_ulp, &own), worst(|row| row.method_ulp, &own))];
        for variant in self.variants.iter().filter(|variant| variant.name.starts_with("rounding")) {
            let of = |row: &Edge| row.variant == variant.name;
            let (bound, points) = (worst(|row| row.bound_ulp, &of), worst(|row| row.method_ulp, &of));
            match variants.iter_mut().find(|(_, bounds, errors)| (&bound, &points) == (bounds, errors)) {
                Some((name, ..)) => *name = format!("{name}, {}", variant.name.trim_start_matches("rounding ")),
                None => variants.push((variant.name.clone(), bound, points)),
            }
        }
        // Points and bound of one variant have one colour.
        let both = |(index, (name, bound, points))| {
            let series = |name, points, mark| Series { colour: Some(index), ..Series::new(name, points, mark) };
            [series(format!("proved bound, {name}"), bound, Mark::Dashed), series(name, points, Mark::Points)]
        };
        let series: Vec<Series> = variants.into_iter().enumerate().flat_map(both).collect();
        let title = format!("Worst error at the edges of x, {}", self.configuration);
        let points = series.iter().flat_map(|series| &series.points);
        let highest = points.map(|point| point.1).fold(0.5, f64::max);
        let y_axis = Axis::linear("error, output ulp").with_range(0.0, 1.1 * highest);
        drawable(vec![("edges", against_n(title, y_axis, series))])
    }
}

impl PartFiles for SeamReport {
    const NAME: &'static str = "seams";

    fn tables(&self) -> Result<Vec<NamedTable>, FilesError> {
        Ok(vec![table(Self::NAME, &self.rows)?, table("seams_hand_overs", &self.hand_overs)?])
    }

    fn charts(&self) -> Vec<(&'static str, Chart)> {
        let curve = |name: &str, mark, of: &dyn Fn(&SeamRow) -> Option<f64>| {
            let points = self.rows.iter().filter_map(|row| Some((row.n, of(row)?)));
            Series::new(name, points.collect(), mark)
        };
        let jumps = vec![
            curve("jump at the hand-over", Mark::Solid, &|row| row.hand_over_jump_ulp.map(|jump| jump as f64)),
            curve("highest rise", Mark::Dashed, &|row| Some(row.highest_rise_ulp as f64)),
            curve("deepest fall", Mark::Dotted, &|row| Some(-row.deepest_fall_ulp as f64)),
        ];
        let image = vec![curve("largest step", Mark::Solid, &|row| Some(row.image_step as f64))];
        let title = |what| format!("{what}, {}", self.configuration);
        let ulp = Axis::linear("step to the next x, ulp");
        let steps = Axis::linear("step of an 8-bit intensity");
        drawable(vec![
            ("seams_steps", against_n(title("Steps of the output"), ulp, jumps)),
            ("seams_image", against_n(title("Largest step of an image"), steps, image)),
        ])
    }
}

impl PartFiles for ReferenceReport {
    const NAME: &'static str = "reference";

    fn tables(&self) -> Result<Vec<NamedTable>, FilesError> {
        Ok(vec![table(Self::NAME, &self.rows)?, table("reference_totals", &self.totals)?])
    }

    fn charts(&self) -> Vec<(&'static str, Chart)> {
        let series = Function::ALL.into_iter().enumerate().map(|(index, function)| {
            let rows = self.rows.iter().filter(|row| row.function == function);
            let seen = rows.filter(|row| row.worst_ulp >= LEAST_DRAWN);
            let points = seen.map(|row| (row.n_from, row.worst_ulp)).collect();
            Series::new(function.name(), points, Mark::nth(index))
        });
        let y_axis = Axis::log("worst error, ulp of f64");
        let title = "xⁿ in f64 against exact integers".to_owned();
        let mut chart = against_n(title, y_axis, series.collect());
        chart.reference_lines = vec![ReferenceLine::new(0.5, "correctly rounded")];
        drawable(vec![("reference", chart)])
    }
}
