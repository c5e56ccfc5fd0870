//! Many requests side by side, each of any exponent, with every value that ranks of registers would hold.
//!
//! Each value has an array of its own, all of one constant length and in one place, so that a compiler sees that
//! they do not overlap. Coefficients are collected from the ROM first; what follows is the same for every
//! request and needs no choice but that of its region, which is selected.

use multiversion::multiversion;

use crate::rom::FieldName;
use crate::rounding::{Lane, Rounding};

use super::block::Lines;
use super::clamp::clamp;
use super::flight::{Flight, Logic};
use super::front_end::Region;
use super::ranks::Datapath;
use super::run::{Anything, Known, Plain};
use super::signals::Status;
use super::stage::MultiplyAdd;
use super::tail::Division;

/// Requests side by side.
pub const REQUESTS: usize = 128;

type Values = [i64; REQUESTS];

/// Requests and their values. Fill in addresses and x; [`Logic::evaluate`] does the rest.
#[derive(Debug, Clone)]
pub struct Requests {
    /// ROM addresses.
    pub addresses: [u32; REQUESTS],
    /// x, bits in the input format.
    pub xs: Values,
    row: Coefficients,
    /// The address that all coefficients were collected of, where it is one.
    collected: Option<u32>,
    /// 1 where the address has a word.
    known: Values,
    clamped_xs: Values,
    regions: Values,
    /// The flags of the front end, and of the result.
    status: [Values; 2],
    v: Values,
    t: [Values; 3],
    /// 1 where the second segment answers.
    outer: Values,
    tail_x: Values,
    divisions: Vec<Divisions>,
    intensities: Values,
}

/// What was collected from the ROM.
#[derive(Debug, Clone)]
struct Coefficients {
    c: [Values; 4],
    shift: Values,
    cut: Values,
    /// Of the second segment, where there is one.
    outer_c: [Values; 4],
    outer_shift: Values,
    hand_over: Values,
    tail: [Values; 2],
}

/// The registers of a rank of the divider.
#[derive(Debug, Clone)]
struct Divisions {
    divisors: Values,
    remainders: Values,
    digits: Values,
}

const ZEROS: Values = [0; REQUESTS];

impl Datapath {
    /// Room for requests.
    #[must_use]
    pub fn requests(&self) -> Box<Requests> {
        let division = Divisions { divisors: ZEROS, remainders: ZEROS, digits: ZEROS };
        let row = Coefficients {
            c: [ZEROS; 4],
            shift: ZEROS,
            cut: ZEROS,
            outer_c: [ZEROS; 4],
            outer_shift: ZEROS,
            hand_over: ZEROS,
            tail: [ZEROS; 2],
        };
        Box::new(Requests {
            addresses: [0; REQUESTS],
            xs: ZEROS,
            row,
            collected: None,
            known: ZEROS,
            clamped_xs: ZEROS,
            regions: ZEROS,
            status: [ZEROS; 2],
            v: ZEROS,
            t: [ZEROS; 3],
            outer: ZEROS,
            tail_x: ZEROS,
            divisions: vec![division; self.divider_ranks()],
            intensities: ZEROS,
        })
    }
}

impl Requests {
    /// The intensities.
    #[must_use]
    pub const fn intensities(&self) -> &[i64; REQUESTS] {
        &self.intensities
    }

    /// The flags of a result.
    #[must_use]
    pub const fn status(&self, request: usize) -> Status {
        Status::of_bits(self.status[1][request] as u8)
    }

    /// One request on its own.
    #[must_use]
    pub fn flight(&self, request: usize) -> Flight {
        let known = self.known[request] != 0;
        let division = |rank: &Divisions| Division {
            divisor: rank.divisors[request],
            remainder: rank.remainders[request],
            digits: rank.digits[request],
        };
        Flight {
            address: self.addresses[request],
            row: if known { self.addresses[request] } else { 0 },
            x: self.xs[request],
            clamped_x: self.clamped_xs[request],
            outer: self.outer[request] != 0,
            region: match self.regions[request] {
                1 => Region::Polynomial,
                2 => Region::Tail,
                _ => Region::Zero,
            },
            status: [
                Status::default().with(Status::NO_WORD, !known),
                Status::of_bits(self.status[0][request] as u8),
                Status::of_bits(self.status[1][request] as u8),
            ],
            v: self.v[request],
            t: [0, 1, 2].map(|stage| self.t[stage][request]),
            tail_x: self.tail_x[request],
            divisions: self.divisions.iter().map(division).collect(),
            intensity: self.intensities[request],
        }
    }
}

impl Logic {
    /// Evaluates every request.
    pub fn evaluate(&self, datapath: &Datapath, requests: &mut Requests) {
        requests.collect(datapath);
        match (self.plain, datapath.narrow, datapath.has_two_segments()) {
            (Some((Rounding::NearestUp, true)), _, false) => centred(&self.lines, requests),
            (Some((Rounding::NearestUp, true)), _, true) => two_segments(&self.lines, requests),
            (Some((Rounding::NearestUp, false)), _, false) => power(&self.lines, requests),
            (_, true, _) => requests.evaluate::<i64, Anything, true>(&self.lines),
            (_, false, _) => requests.evaluate::<i128, Anything, true>(&self.lines),
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn centred(lines: &Lines, requests: &mut Requests) {
    requests.evaluate::<i64, Plain<true, true>, false>(lines);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn two_segments(lines: &Lines, requests: &mut Requests) {
    requests.evaluate::<i64, Plain<true, true>, true>(lines);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn power(lines: &Lines, requests: &mut Requests) {
    requests.evaluate::<i64, Plain<true, false>, false>(lines);
}

impl Requests {
    /// Collects coefficients, unless they are those that stand there already, as in a sweep.
    fn collect(&mut self, datapath: &Datapath) {
        let first = self.addresses[0];
        let same = self.addresses.iter().fold(0, |differ, address| differ | (address ^ first)) == 0;
        if same && self.collected == Some(first) {
            return;
        }
        self.collected = same.then_some(first);
        let Coefficients { c, shift, cut, outer_c, outer_shift, hand_over, tail } = &mut self.row;
        for (request, &address) in self.addresses.iter().enumerate() {
            let known = datapath.rom.row(address);
            self.known[request] = i64::from(known.is_some());
            let row = known.unwrap_or_else(|| datapath.row_at(0));
            for (values, name) in c.iter_mut().zip(FieldName::COEFFICIENTS) {
                values[request] = row.get(name);
            }
            shift[request] = row.get(FieldName::Shift);
            cut[request] = row.get(FieldName::Cut);
            if datapath.has_two_segments() {
                for (values, name) in outer_c.iter_mut().zip(FieldName::OUTER_COEFFICIENTS) {
                    values[request] = row.get(name);
                }
                outer_shift[request] = row.get(FieldName::ShiftOuter);
                hand_over[request] = row.get(FieldName::HandOver);
            }
            if datapath.divider.is_some() {
                tail[0][request] = row.get(FieldName::TailA);
                tail[1][request] = row.get(FieldName::TailB);
            }
        }
    }

    /// `TWO`: there may be a second segment.
    #[inline(always)]
    fn evaluate<L: Lane, K: Known, const TWO: bool>(&mut self, lines: &Lines) {
        self.polynomial::<L, K, TWO>(lines);
        self.tail::<L, K>(lines);
    }

    /// All but the division, in one loop: what one line gives the next need not be stored between.
    #[inline(always)]
    fn polynomial<L: Lane, K: Known, const TWO: bool>(&mut self, lines: &Lines) {
        // Where there is no polynomial, all its operands are 0, and what is computed of them too.
        let stages = lines.stages.unwrap_or([MultiplyAdd::NOTHING; 3]);
        let lines = K::lines(Lines { stages: Some(stages), ..*lines });
        let Lines { front_end, stages: Some([stage1, stage2, stage3]), output_one, .. } = lines
        else {
            return;
        };
        let (input_one, one) = (L::from_bits(front_end.one), L::from_bits(output_one));
        let row = &self.row;
        let ([c0, c1, c2, c3], [d0, d1, d2, d3]) = (&row.c, &row.outer_c);
        for request in 0..REQUESTS {
            let given = L::from_bits(self.xs[request]);
            let x = front_end.clamp_input(given);
            let known = self.known[request] != 0;
            let region = front_end.region(given, L::from_bits(row.cut[request]));
            let region = if known { region } else { Region::Zero };
            let hand_over = L::from_bits(row.hand_over[request]);
            let outer = TWO && front_end.is_outer(x, region, hand_over);
            let start = if outer { hand_over } else { input_one };
            let (inner, other) = (row.shift[request], row.outer_shift[request]);
            let shift = if outer { other } else { inner } as u32;
            let v = front_end.variable(x, region, start, shift);
            let either = |first: &Values, second: &Values| {
                let (first, second) = (first[request], second[request]);
                L::from_bits(if outer { second } else { first })
            };
            let t1 = stage1.apply(either(c3, d3), v, either(c2, d2));
            let t2 = stage2.apply(t1, v, either(c1, d1));
            let t3 = stage3.apply(t2, v, either(c0, d0));
            let answers = region == Region::Polynomial;
            let answered = clamp(t3, one);
            let status = Status::default()
                .with(Status::NO_WORD, !known)
                .with(Status::ABOVE_ONE, given > input_one)
                .with(Status::FACING_AWAY, given < L::ZERO);
            let result = status.with(Status::CLAMPED, answers && answered != t3);
            self.clamped_xs[request] = x.to_bits();
            self.regions[request] = region as i64;
            self.outer[request] = outer.into();
            self.status[0][request] = status.bits().into();
            self.status[1][request] = result.bits().into();
            self.v[request] = v.to_bits();
            self.tail_x[request] = front_end.tail_x(x, region).to_bits();
            self.t[0][request] = t1.to_bits();
            self.t[1][request] = t2.to_bits();
            self.t[2][request] = t3.to_bits();
            self.intensities[request] = if answers { answered.to_bits() } else { 0 };
        }
    }

    #[inline(always)]
    fn tail<L: Lane, K: Known>(&mut self, lines: &Lines) {
        let Some(divider) = K::lines(*lines).divider else { return };
        let [a, b] = &self.row.tail;
        if let Some(first) = self.divisions.first_mut() {
            for request in 0..REQUESTS {
                let [x, a, b] = [self.tail_x[request], a[request], b[request]].map(L::from_bits);
                first.put(request, divider.begin(x, a, b));
            }
        }
        for rank in 1..self.divisions.len() {
            let (before, from) = self.divisions.split_at_mut(rank);
            let (Some(before), Some(after)) = (before.last(), from.first_mut()) else { return };
            after.clone_from(before);
            for _ in 0..divider.digits_of_stage(rank as u32 - 1) {
                for request in 0..REQUESTS {
                    after.put(request, divider.digit(after.get::<L>(request)));
                }
            }
        }
        let Some(last) = self.divisions.last() else { return };
        let one = L::from_bits(lines.output_one);
        for request in 0..REQUESTS {
            let quotient = divider.finish(last.get::<L>(request), one).to_bits();
            let answers = self.regions[request] == Region::Tail as i64;
            let other = self.intensities[request];
            self.intensities[request] = if answers { quotient } else { other };
        }
    }
}

impl Divisions {
    #[inline(always)]
    fn put<L: Lane>(&mut self, request: usize, division: Division<L>) {
        let Division { divisor, remainder, digits } = division.narrowed();
        self.divisors[request] = divisor;
        self.remainders[request] = remainder;
        self.digits[request] = digits;
    }

    #[inline(always)]
    fn get<L: Lane>(&self, request: usize) -> Division<L> {
        let [divisor, remainder, digits] =
            [&self.divisors, &self.remainders, &self.digits].map(|values| values[request]);
        Division { divisor, remainder, digits }.widened()
    }
}
