//! Sets of integers that are good in real arithmetic, on a few points.
//!
//! r + Σ d_i·w_i is the error after moving c_i by d_i: w_i = ±v^i units of c_i, r the error before. Over all
//! integers d the greatest |…| is least in a narrow valley (a step of c3 is nearly made up for by c2 and
//! c1), which steps to neighbours follow badly. So the highest coefficient goes through all of its reach, and for each
//! the others go through what lies around their least-squares answer to it; c0, where it is free, is set in the middle.

use hw_model::config::Form;
use hw_model::format::QFormat;
use hw_model::steps::Steps;

use super::piece::Piece;

/// Points of the range, denser towards its ends, where a best error is greatest.
const POINTS: i64 = 96;
/// Integers on either side of the least-squares answer of a coefficient, and of c1, which follows from the others.
const AROUND: [i32; 2] = [8, 4];
/// Sets that are worth the data path.
pub(super) const MOST: usize = 384;

/// The least-squares problem: errors and weights at each point.
struct Points {
    degree: usize,
    residual: Vec<f64>,
    /// Of c0, c1, …
    weights: Vec<Vec<f64>>,
}

/// The best sets, the best of them first; of equal ones that with the lesser steps.
pub(super) fn propose(piece: &Piece<'_>, reach: i32) -> Vec<Steps> {
    let Some(points) = Points::of(piece) else { return Vec::new() };
    let mut found: Vec<(f64, Steps)> = Vec::new();
    let reaches: Vec<i32> = piece.free.iter().map(|free| if *free { reach } else { 0 }).collect();
    let residual = points.residual.clone();
    points.extend(points.degree, &residual, Steps::default(), &reaches, &mut found);
    let size = |steps: &Steps| steps.iter().map(|step| step.abs()).sum::<i32>();
    found.sort_by(|(a, s), (b, t)| a.total_cmp(b).then_with(|| size(s).cmp(&size(t))).then_with(|| s.cmp(t)));
    found.truncate(MOST);
    found.into_iter().map(|(_, steps)| steps).collect()
}

/// The integers around a real one that are within reach of 0.
fn around(centre: f64, width: i32, reach: i32) -> std::ops::RangeInclusive<i32> {
    let centre = centre.round().clamp(-f64::from(reach), f64::from(reach)) as i32;
    (centre - width).max(-reach)..=(centre + width).min(reach)
}

impl Points {
    fn of(piece: &Piece<'_>) -> Option<Self> {
        let formats = piece.design.datapath().formats().polynomial?;
        let (first, last) = (piece.span.first, piece.span.last);
        let place = |i: i64| {
            let part = 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / POINTS as f64).cos();
            first + (part * (last - first) as f64).round() as i64
        };
        let mut xs: Vec<i64> = (0..=POINTS).map(|i| place(i).clamp(first, last)).collect();
        xs.dedup();
        let subtract = piece.design.config().form == Form::Centred;
        let sign = |power: usize| if subtract && power % 2 == 1 { -1.0 } else { 1.0 };
        let variables: Vec<f64> = xs.iter().map(|&x| piece.variable(x) as f64 * formats.v.ulp()).collect();
        let weight = |(power, format): (usize, &QFormat)| {
            let unit = sign(power) * format.ulp();
            variables.iter().map(|v| unit * v.powi(power as i32)).collect::<Vec<f64>>()
        };
        let weights: Vec<Vec<f64>> = formats.coefficients().iter().enumerate().map(weight).collect();
        let bits: Vec<f64> = piece.fields().map(|field| piece.row.get(field) as f64).collect();
        let residual = xs.iter().enumerate().map(|(at, &x)| {
            let terms = (0..=piece.degree).map(|power| bits[power] * weights[power][at]);
            terms.sum::<f64>() - piece.reference(x)
        });
        Some(Self { degree: piece.degree, residual: residual.collect(), weights })
    }

    /// Goes on from the steps of the powers above `power`, whose residual this is.
    fn extend(&self, power: usize, residual: &[f64], steps: Steps, reaches: &[i32], found: &mut Vec<(f64, Steps)>) {
        let with = |by: i32| {
            let mut steps = steps;
            steps[power] = by;
            steps
        };
        if power == 0 {
            let (low, high) =
                residual.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |r, &e| (r.0.min(e), r.1.max(e)));
            for d0 in around(-0.5 * (low + high) / self.weights[0][0], 1, reaches[0]) {
                let by = f64::from(d0) * self.weights[0][0];
                found.push(((high + by).max(-(low + by)), with(d0)));
            }
            return;
        }
        let range = if power == self.degree {
            -reaches[power]..=reaches[power]
        } else {
            // Together with the next below, as far as there is one that is not c0.
            let (both, width) = if power > 1 { (vec![power, power - 1], AROUND[0]) } else { (vec![1], AROUND[1]) };
            around(self.answer(residual, &both), width, reaches[power])
        };
        for by in range {
            let after = self.moved(residual, power, by);
            self.extend(power - 1, &after, with(by), reaches, found);
        }
    }

    fn moved(&self, residual: &[f64], power: usize, steps: i32) -> Vec<f64> {
        let by = f64::from(steps);
        residual.iter().zip(&self.weights[power]).map(|(r, w)| r + by * w).collect()
    }

    /// The first of the real steps of these coefficients (one or two) that make the sum of squares least.
    fn answer(&self, residual: &[f64], powers: &[usize]) -> f64 {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let first = &self.weights[powers[0]];
        let (aa, ar) = (dot(first, first), dot(first, residual));
        let answer = match powers.get(1).map(|&power| &self.weights[power]) {
            None => -ar / aa,
            Some(second) => {
                let (ab, bb, br) = (dot(first, second), dot(second, second), dot(second, residual));
                (ab * br - bb * ar) / (aa * bb - ab * ab)
            }
        };
        if answer.is_finite() { answer } else { 0.0 }
    }
}
