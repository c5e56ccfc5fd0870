//! The corners of one row.

use std::ops::RangeInclusive;

use hw_model::datapath::front_end::Region;
use hw_model::datapath::{RankRegister, Signals};
use hw_model::design::Design;
use hw_model::quantise::{real, round_scaled};
use hw_model::registers::Register;
use hw_model::rounding::Rounding;

use super::lattice::{Lattice, climb, powers_apart};
use super::ties;
use crate::faults::fault::line_name;
use crate::kind::Kind;
use crate::reference::reference;
use crate::stimulus::rounds::Point;

/// How hard the searches look.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Lattice points in each part of the range.
    points: i64,
    /// True when the best lattice point is a start and not the answer.
    refine: bool,
}

impl Effort {
    /// About half a million lattice points for the whole ROM.
    pub fn for_depth(depth: usize) -> Self {
        let points = ((1 << 18) / depth.max(1) as i64).clamp(32, 512);
        Self { points, refine: depth <= 4096 }
    }
}

/// The corners of one row, those that matter most first.
pub fn corners(design: &Design, address: u32, effort: Effort) -> Vec<Point> {
    let survey = Survey::new(design, address, effort);
    let mut list = List::new(design);
    let ties = survey.ties();
    head(&survey, &ties, &mut list);
    let head_len = list.corners.len();
    rest(&survey, &ties, &mut list);
    let mut corners = list.corners;
    let rest = &mut corners[head_len..];
    if !rest.is_empty() {
        rest.rotate_left(address as usize % rest.len());
    }
    corners
}

/// The corners that every row contributes first.
fn head(survey: &Survey<'_>, ties: &[Point], list: &mut List) {
    list.add(Kind::One, survey.greatest);
    list.extend(survey.cut.map(|cut| Point { kind: Kind::Cut, x: cut }));
    list.extend(survey.cut.map(|cut| Point { kind: Kind::BesideCut, x: cut - 1 }));
    for &x in &survey.hand_overs {
        list.add(Kind::HandOver, x);
        list.add(Kind::BesideHandOver, x - 1);
    }
    list.extend(survey.worst(survey.polynomial.as_ref(), Kind::WorstPolynomial));
    for outer in &survey.outer {
        list.extend(survey.worst(Some(outer), Kind::WorstPolynomial));
    }
    list.add(Kind::Zero, 0);
    list.extend(survey.worst(survey.below.as_ref(), Kind::WorstTail));
    list.add(Kind::BesideOne, survey.greatest - 1);
    list.extend(ties.first().copied());
}

fn rest(survey: &Survey<'_>, ties: &[Point], list: &mut List) {
    let input = survey.design.config().input;
    list.add(Kind::BesideOne, survey.greatest + 1);
    list.add(Kind::BesideZero, 1);
    list.extend(survey.cut.map(|cut| Point { kind: Kind::BesideCut, x: cut + 1 }));
    for &x in &survey.hand_overs {
        list.add(Kind::BesideHandOver, x + 1);
    }
    for x in [survey.q, survey.q - 1, survey.q + 1] {
        list.add(Kind::Q, x);
    }
    list.extend(ties.iter().copied());
    for x in [input.max_bits(), -1, input.min_bits()] {
        list.add(Kind::FormatEnd, x);
    }
    list.extend(survey.quotients());
    list.extend(survey.extremes());
}

/// Corners in order, each x once, only those the input format holds.
struct List {
    lowest: i64,
    highest: i64,
    corners: Vec<Point>,
}

impl List {
    fn new(design: &Design) -> Self {
        let input = design.config().input;
        Self { lowest: input.min_bits(), highest: input.max_bits(), corners: Vec::new() }
    }

    fn add(&mut self, kind: Kind, x: i64) {
        let held = (self.lowest..=self.highest).contains(&x);
        if held && self.corners.iter().all(|corner| corner.x != x) {
            self.corners.push(Point { kind, x });
        }
    }

    fn extend(&mut self, corners: impl IntoIterator<Item = Point>) {
        for Point { kind, x } in corners {
            self.add(kind, x);
        }
    }
}

/// A range of x that one part of the pipeline answers, and where the searches look in it.
struct Part {
    range: RangeInclusive<i64>,
    lattice: Lattice,
}

impl Part {
    fn new(range: RangeInclusive<i64>, effort: Effort) -> Option<Self> {
        (!range.is_empty()).then(|| Self { lattice: Lattice::new(&range, effort.points), range })
    }
}

/// One row, and what the data path does at every lattice point of it.
struct Survey<'a> {
    design: &'a Design,
    address: u32,
    effort: Effort,
    greatest: i64,
    /// The cut, where there is a polynomial.
    cut: Option<i64>,
    /// Where segments hand over, from x = 1 downwards; only those within [0, 1] and above the cut.
    hand_overs: Vec<i64>,
    /// q in the input's unit.
    q: i64,
    polynomial: Option<Part>,
    /// The further segments, from x = 1 downwards.
    outer: Vec<Part>,
    below: Option<Part>,
}

impl<'a> Survey<'a> {
    fn new(design: &'a Design, address: u32, effort: Effort) -> Self {
        let datapath = design.datapath();
        let greatest = datapath.front_end().greatest;
        let row = datapath.row(address);
        let cut = (datapath.degree() > 0).then(|| datapath.front_end().cut(&row));
        let from = cut.unwrap_or(greatest + 1);
        let mut hand_overs = Vec::new();
        let mut outer = Vec::new();
        let mut first = from;
        for segment in (1..datapath.segment_count()).rev() {
            let hand_over = datapath.front_end().hand_over(&row, segment).min(greatest + 1);
            if hand_over > first {
                outer.insert(0, first..=hand_over - 1);
                hand_overs.insert(0, hand_over);
                first = hand_over;
            }
        }
        let fraction = design.config().input.fraction_bits();
        let p = design.rows().get(address as usize).map_or(0.0, |row| row.epicentre);
        // p lies in (0, 1), so it rounds to 0..=one.
        let p = round_scaled(p, fraction, Rounding::NearestEven).unwrap_or(0) as i64;
        Self {
            design,
            address,
            effort,
            greatest,
            cut,
            q: design.config().input.one() - p,
            hand_overs,
            polynomial: Part::new(first..=greatest, effort),
            outer: outer.into_iter().filter_map(|range| Part::new(range, effort)).collect(),
            below: Part::new(0..=greatest.min(from - 1), effort),
        }
    }

    fn last(&self, x: i64) -> Signals {
        self.design.datapath().evaluate(self.address, x)
    }

    /// The x of a part with the greatest score: the best lattice point, then uphill from there.
    fn best<S: PartialOrd>(&self, part: &Part, score: impl Fn(i64) -> S) -> Option<i64> {
        let mut best: Option<(S, i64)> = None;
        for &x in &part.lattice.points {
            let reached = score(x);
            if best.as_ref().is_none_or(|(best, _)| reached > *best) {
                best = Some((reached, x));
            }
        }
        let (_, x) = best?;
        Some(self.refined(x, part, score))
    }

    fn refined<S: PartialOrd>(&self, x: i64, part: &Part, score: impl Fn(i64) -> S) -> i64 {
        match self.effort.refine {
            true => climb(x, part.lattice.step, &part.range, score),
            false => x,
        }
    }

    fn worst(&self, part: Option<&Part>, kind: Kind) -> Option<Point> {
        let part = part?;
        let exponent = self.design.rows().get(self.address as usize)?.exponent;
        let config = self.design.config();
        let error = |x| {
            let intensity = real(self.last(x).intensity, config.output);
            (intensity - reference(exponent, x, config.input)).abs()
        };
        self.best(part, error).map(|x| Point { kind, x })
    }

    /// For each line that rounds, the x nearest to a tie, of the lattice and a few more.
    fn ties(&self) -> Vec<Point> {
        let lines = ties::lines(self.design.datapath());
        let mut nearest: Vec<Option<(f64, i64)>> = vec![None; lines.len()];
        let polynomial = self.polynomial.iter().chain(&self.outer);
        let parts =
            polynomial.map(|part| (Region::Polynomial, part)).chain(self.below.iter().map(|part| (Region::Tail, part)));
        for (region, part) in parts {
            let lattice = part.lattice.points.iter().copied();
            for x in lattice.chain(powers_apart(&part.range, self.greatest)) {
                let last = self.last(x);
                for (line, nearest) in lines.iter().zip(&mut nearest) {
                    let distance = line.distance(&last);
                    let nearer = nearest.is_none_or(|(least, _)| distance < least);
                    if line.region() == region && nearer {
                        *nearest = Some((distance, x));
                    }
                }
            }
        }
        let corner = |(line, nearest): (&ties::Line, Option<(f64, i64)>)| {
            nearest.map(|(_, x)| Point { kind: Kind::Tie(line_name(line.register())), x })
        };
        lines.iter().zip(nearest).filter_map(corner).collect()
    }

    /// The ends of the divider. The quotient rises with x, so the last 0 is found by halving.
    fn quotients(&self) -> Vec<Point> {
        let (Some(part), Some(_)) = (&self.below, self.design.datapath().divider()) else {
            return Vec::new();
        };
        let quotient = |x| self.last(x).division.digits;
        let (mut zero, mut beyond) = (0, *part.range.end());
        while beyond - zero > 1 {
            let middle = zero + (beyond - zero) / 2;
            if quotient(middle) == 0 { zero = middle } else { beyond = middle }
        }
        let mut corners = vec![Point { kind: Kind::QuotientZero, x: zero }];
        let greatest = self.best(part, quotient);
        corners.extend(greatest.map(|x| Point { kind: Kind::QuotientGreatest, x }));
        corners
    }

    /// The least and greatest value of every register that a rank behind the first computes.
    fn extremes(&self) -> Vec<Point> {
        let mut registers = self.registers();
        for part in self.polynomial.iter().chain(&self.below) {
            for &x in &part.lattice.points {
                let passage = self.design.datapath().passage(self.address, x);
                for extreme in &mut registers {
                    let bits = extreme.register.bits(&passage[extreme.rank]);
                    extreme.take(bits, x);
                }
            }
        }
        registers.iter().flat_map(|extreme| self.ends(extreme)).collect()
    }

    fn registers(&self) -> Vec<Extreme> {
        let datapath = self.design.datapath();
        let mut list = Vec::new();
        for rank in 1..datapath.rank_count() {
            let computed = datapath.registers(rank).into_iter().filter(|register| {
                register.computed && !matches!(register.register, Register::Region | Register::Status)
            });
            list.extend(computed.map(|register| Extreme { rank, register, ends: None }));
        }
        list
    }

    fn ends(&self, extreme: &Extreme) -> Vec<Point> {
        let Some([(_, least), (_, greatest)]) = extreme.ends else {
            return Vec::new();
        };
        let bits = |x| {
            let passage = self.design.datapath().passage(self.address, x);
            i128::from(extreme.register.bits(&passage[extreme.rank]))
        };
        let (rank, name) = (extreme.rank, extreme.register.name());
        let refined = |x, sign: i128| {
            let parts = [&self.polynomial, &self.below];
            let part = parts.into_iter().flatten().find(|part| part.range.contains(&x));
            part.map_or(x, |part| self.refined(x, part, |x| sign * bits(x)))
        };
        vec![
            Point { kind: Kind::Least(rank, name), x: refined(least, -1) },
            Point { kind: Kind::Greatest(rank, name), x: refined(greatest, 1) },
        ]
    }
}

/// A register and where its ends were found: (bits, x), least and greatest.
struct Extreme {
    rank: usize,
    register: RankRegister,
    ends: Option<[(i64, i64); 2]>,
}

impl Extreme {
    fn take(&mut self, bits: i64, x: i64) {
        let [least, greatest] = self.ends.get_or_insert([(bits, x); 2]);
        if bits < least.0 {
            *least = (bits, x);
        }
        if bits > greatest.0 {
            *greatest = (bits, x);
        }
    }
}
