//! The measured error of a design over the range that was asked for.
//!
//! A few hundred x of each row decide first, and every x at which anything ever failed; a design that passes them is
//! measured at every x of the range. Below its cut, which is not the same in all designs, a zero tail errs by x^n, most
//! at the x beside the cut, so that the x further down need no look.

use hw_model::config::Tail;
use hw_model::datapath::Block;
use hw_model::design::Design;
use hw_model::highlight::phong;
use rayon::prelude::*;

use crate::sweep::estimate;
use vectors::progress::Progress;

/// x that make one piece of work for a thread.
const PIECE: i64 = 1 << 16;
/// Pieces of a row, so that all the places where it fails are learnt at once.
const LEAST_PIECES: i64 = 16;
/// x of a row that decide first.
const SPREAD: i64 = 320;
/// The last x below 1, every one of them.
const NEAREST: i64 = 24;

/// An error and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// As a fraction of full intensity.
    pub error: f64,
    /// The address of the ROM row.
    pub address: u32,
    /// The bits of x.
    pub x: i64,
}

/// The x of a row that have been chosen, and x^n there.
#[derive(Debug, Clone, Default)]
struct Chosen {
    xs: Vec<i64>,
    powers: Vec<f64>,
}

/// What designs of the same polynomials are measured by, wherever their rows end.
pub(super) struct Judge {
    /// The least x of each row that was asked for.
    least: Vec<i64>,
    chosen: Vec<Chosen>,
    /// Addresses, those that failed last in front.
    order: Vec<u32>,
    pub error: f64,
}

impl Judge {
    /// For designs with the polynomials of this one; `least` is the least x of each row.
    pub(super) fn new(design: &Design, least: &[i64], error: f64) -> Self {
        let mut judge = Self {
            least: least.to_vec(),
            chosen: vec![Chosen::default(); least.len()],
            order: (0..least.len() as u32).collect(),
            error,
        };
        for address in 0..least.len() as u32 {
            let Some((first, last)) = judge.span(design, address) else { continue };
            let spread =
                (0..=SPREAD).map(|i| first + (i128::from(last - first) * i128::from(i) / i128::from(SPREAD)) as i64);
            let near = last - NEAREST..=last;
            let mut xs: Vec<i64> = spread.chain(near).collect();
            xs.retain(|x| (first..=last).contains(x));
            xs.sort_unstable();
            xs.dedup();
            for x in xs {
                judge.choose(design, address, x);
            }
        }
        judge
    }

    /// The first and the last x of a row that can have the greatest error; none where no x of the row was asked for.
    fn span(&self, design: &Design, address: u32) -> Option<(i64, i64)> {
        let greatest = design.datapath().front_end().greatest;
        let (least, row) = (self.least[address as usize], &design.rows()[address as usize]);
        let all = design.config().tail == Tail::Rational;
        let first = if all { least } else { least.max((row.cut - 1).min(greatest)) };
        (first <= greatest).then_some((first, greatest))
    }

    /// True where x beside the ends of the row's segments break the error.
    fn fails_beside_ends(&self, design: &Design, address: u32) -> bool {
        let row = &design.rows()[address as usize];
        let Some((first, last)) = self.span(design, address) else { return false };
        let starts = row.segments.iter().skip(1).map(|segment| segment.start);
        let ends = std::iter::once(row.cut).chain(starts).flat_map(|end| [end - 1, end]);
        let mut ends = ends;
        ends.by_ref().filter(|x| (first..=last).contains(x)).any(|x| {
            let shown = design.datapath().evaluate(address, x).intensity as f64 * design.config().output.ulp();
            (shown - phong(row.exponent, x as f64 * design.config().input.ulp())).abs() > self.error
        })
    }

    /// Asks this x first from now on.
    pub(super) fn choose(&mut self, design: &Design, address: u32, x: i64) {
        let exponent = design.rows()[address as usize].exponent;
        let chosen = &mut self.chosen[address as usize];
        chosen.xs.push(x);
        chosen.powers.push(phong(exponent, x as f64 * design.config().input.ulp()));
    }

    /// Whether the chosen x keep the error.
    pub(super) fn may_pass(&mut self, design: &Design) -> bool {
        let ulp = design.config().output.ulp();
        let mut block = Block::default();
        let failed = self.order.iter().position(|&address| {
            let Chosen { xs, powers } = &self.chosen[address as usize];
            design.datapath().evaluate_block(address, xs, &mut block);
            let mut both = block.intensities.iter().zip(powers);
            both.any(|(&bits, power)| (bits as f64 * ulp - power).abs() > self.error)
                || self.fails_beside_ends(design, address)
        });
        if let Some(at) = failed {
            self.order[..=at].rotate_right(1);
        }
        failed.is_none()
    }

    /// The greatest error of every piece of every row, over every x.
    pub(super) fn measured(&self, design: &Design, progress: &dyn Progress) -> Vec<Place> {
        let pieces: Vec<(u32, i64, i64)> = (0..self.least.len() as u32)
            .filter_map(|address| Some((address, self.span(design, address)?)))
            .flat_map(|(address, (first, last))| {
                // Rows of few x have as many pieces as matter, too.
                let length = ((last - first) / LEAST_PIECES + 1).min(PIECE);
                let starts = (first..=last).step_by(length as usize);
                starts.map(move |start| (address, start, last.min(start + length - 1)))
            })
            .collect();
        pieces
            .into_par_iter()
            .map(|(address, first, last)| {
                let place = worst(design, address, first, last);
                progress.advance((last - first + 1) as u64);
                place
            })
            .collect()
    }
}

/// The greatest of all pieces, the first of equal ones.
pub(super) fn greatest(pieces: &[Place]) -> Option<Place> {
    pieces.iter().copied().reduce(|worst, row| if row.error > worst.error { row } else { worst })
}

/// Estimates of x^n spare the reference wherever it could not make the greatest error.
fn worst(design: &Design, address: u32, first: i64, last: i64) -> Place {
    const BLOCK: usize = 2048;
    let exponent = design.rows()[address as usize].exponent;
    let (input, output) = (design.config().input.ulp(), design.config().output.ulp());
    let (mut block, mut powers) = (Block::default(), Vec::with_capacity(BLOCK));
    let mut xs = Vec::with_capacity(BLOCK);
    let mut worst = Place { error: 0.0, address, x: first };
    for start in (first..=last).step_by(BLOCK) {
        xs.clear();
        xs.extend(start..=last.min(start + BLOCK as i64 - 1));
        design.datapath().evaluate_block(address, &xs, &mut block);
        powers.resize(xs.len(), 0.0);
        // x^n is at most 1; what the estimates drop and the differences round is far below 4 ulp of 1.
        let slack = estimate(exponent, &xs, input, &mut powers) + 4.0 * f64::EPSILON;
        let errors = block.intensities.iter().zip(&powers);
        let errors = errors.map(|(&bits, power)| (bits as f64 * output - power).abs());
        let greatest = errors.clone().fold(0.0, f64::max);
        if greatest + slack <= worst.error {
            continue;
        }
        for (index, estimate) in errors.enumerate() {
            if estimate + slack >= greatest - slack {
                let exact = phong(exponent, xs[index] as f64 * input);
                let error = (block.intensities[index] as f64 * output - exact).abs();
                if error > worst.error {
                    worst = Place { error, address, x: xs[index] };
                }
            }
        }
    }
    worst
}
