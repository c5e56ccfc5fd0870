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
use super::tail::Division;

/// Requests side by side.
pub const REQUESTS: usize = 256;

type Values = [i64; REQUESTS];

/// Requests and their values. Fill in addresses and x; [`Logic::evaluate`] does the rest.
#[derive(Debug, Clone)]
pub struct Requests {
    /// ROM addresses.
    pub addresses: [u32; REQUESTS],
    /// x, bits in the input format.
    pub xs: Values,
    row: Coefficients,
    /// 1 where the address has a word.
    known: Values,
    clamped_xs: Values,
    regions: Values,
    /// The flags of the front end, and of the result.
    status: [Values; 2],
    v: Values,
    t: [Values; 3],
    tail_x: Values,
    divisions: Vec<Divisions>,
    intensities: Values,
}

/// What was collected from the ROM.
#[derive(Debug, Clone)]
struct Coefficients {
    c: [Values; 4],
    cut: Values,
    /// Where v counts from: 1, or where the first segment hands over to the second.
    start: Values,
    shift: Values,
    /// 1 where the second segment answers.
    outer: Values,
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
            cut: ZEROS,
            start: [self.front_end.one; REQUESTS],
            shift: ZEROS,
            outer: ZEROS,
            tail: [ZEROS; 2],
        };
        Box::new(Requests {
            addresses: [0; REQUESTS],
            xs: ZEROS,
            row,
            known: ZEROS,
            clamped_xs: ZEROS,
            regions: ZEROS,
            status: [ZEROS; 2],
            v: ZEROS,
            t: [ZEROS; 3],
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
            outer: self.row.outer[request] != 0,
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
        match (self.plain, datapath.narrow) {
            (Some((Rounding::NearestUp, true)), _) => centred(&self.lines, requests),
            (Some((Rounding::NearestUp, false)), _) => power(&self.lines, requests),
            (_, true) => requests.evaluate::<i64, Anything>(&self.lines),
            (_, false) => requests.evaluate::<i128, Anything>(&self.lines),
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn centred(lines: &Lines, requests: &mut Requests) {
    requests.evaluate::<i64, Plain<true, true>>(lines);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn power(lines: &Lines, requests: &mut Requests) {
    requests.evaluate::<i64, Plain<true, false>>(lines);
}

impl Requests {
    fn collect(&mut self, datapath: &Datapath) {
        let Coefficients { c, cut, shift, tail, .. } = &mut self.row;
        let tail_is_there = datapath.divider.is_some();
        for (request, &address) in self.addresses.iter().enumerate() {
            let known = datapath.rom.row(address);
            self.known[request] = i64::from(known.is_some());
            let row = known.unwrap_or_else(|| datapath.row_at(0));
            for (values, name) in c.iter_mut().zip(FieldName::COEFFICIENTS) {
                values[request] = row.get(name);
            }
            cut[request] = row.get(FieldName::Cut);
            shift[request] = row.get(FieldName::Shift);
            if tail_is_there {
                tail[0][request] = row.get(FieldName::TailA);
                tail[1][request] = row.get(FieldName::TailB);
            }
        }
        if datapath.has_two_segments() {
            self.collect_second_segment(datapath);
        }
    }

    /// The second segment's coefficients instead, where it answers.
    fn collect_second_segment(&mut self, datapath: &Datapath) {
        let front_end = &datapath.front_end;
        let Coefficients { c, start, shift, outer, .. } = &mut self.row;
        for (request, (&address, &x)) in self.addresses.iter().zip(&self.xs).enumerate() {
            let known = self.known[request] != 0;
            let row = datapath.row_at(if known { address } else { 0 });
            let region = front_end.region(x, row.get(FieldName::Cut));
            let hand_over = row.get(FieldName::HandOver);
            let second = known && front_end.is_outer(front_end.clamp_input(x), region, hand_over);
            let names =
                if second { FieldName::OUTER_COEFFICIENTS } else { FieldName::COEFFICIENTS };
            for (values, name) in c.iter_mut().zip(names) {
                values[request] = row.get(name);
            }
            start[request] = if second { hand_over } else { front_end.one };
            shift[request] = row.get(if second { FieldName::ShiftOuter } else { FieldName::Shift });
            outer[request] = second.into();
        }
    }

    #[inline(always)]
    fn evaluate<L: Lane, K: Known>(&mut self, lines: &Lines) {
        self.front_end::<L, K>(lines);
        self.polynomial::<L, K>(lines);
        self.tail::<L, K>(lines);
        self.results::<L, K>(lines);
    }

    #[inline(always)]
    fn front_end<L: Lane, K: Known>(&mut self, lines: &Lines) {
        let front_end = K::lines(*lines).front_end;
        for request in 0..REQUESTS {
            let given = L::from_bits(self.xs[request]);
            let x = front_end.clamp_input(given);
            let region = front_end.region(given, L::from_bits(self.row.cut[request]));
            let known = self.known[request] != 0;
            let region = if known { region } else { Region::Zero };
            let status = Status::default()
                .with(Status::NO_WORD, !known)
                .with(Status::ABOVE_ONE, given > L::from_bits(front_end.one))
                .with(Status::FACING_AWAY, given < L::ZERO);
            let v = {
                let start = L::from_bits(self.row.start[request]);
                front_end.variable(x, region, start, self.row.shift[request] as u32)
            };
            self.clamped_xs[request] = x.to_bits();
            self.regions[request] = region as i64;
            self.status[0][request] = status.bits().into();
            self.v[request] = v.to_bits();
            self.tail_x[request] = front_end.tail_x(x, region).to_bits();
        }
    }

    #[inline(always)]
    fn polynomial<L: Lane, K: Known>(&mut self, lines: &Lines) {
        let Lines { stages: Some([stage1, stage2, stage3]), .. } = K::lines(*lines) else {
            return;
        };
        let ([c0, c1, c2, c3], [t1, t2, t3]) = (&self.row.c, &mut self.t);
        for request in 0..REQUESTS {
            let lane = |values: &Values| L::from_bits(values[request]);
            let v = lane(&self.v);
            let first = stage1.apply(lane(c3), v, lane(c2));
            let second = stage2.apply(first, v, lane(c1));
            let third = stage3.apply(second, v, lane(c0));
            t1[request] = first.to_bits();
            t2[request] = second.to_bits();
            t3[request] = third.to_bits();
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
    }

    #[inline(always)]
    fn results<L: Lane, K: Known>(&mut self, lines: &Lines) {
        let Lines { divider, output_one, .. } = K::lines(*lines);
        let one = L::from_bits(output_one);
        let polynomial = Region::Polynomial as i64;
        for request in 0..REQUESTS {
            let t3 = self.t[2][request];
            let answered = clamp(L::from_bits(t3), one).to_bits();
            let answers = self.regions[request] == polynomial;
            let clamped = Status::default().with(Status::CLAMPED, answers && answered != t3);
            self.status[1][request] = self.status[0][request] | i64::from(clamped.bits());
            self.intensities[request] = if answers { answered } else { 0 };
        }
        if let (Some(divider), Some(last)) = (divider, self.divisions.last()) {
            for request in 0..REQUESTS {
                let quotient = divider.finish(last.get::<L>(request), one).to_bits();
                let answers = self.regions[request] == Region::Tail as i64;
                let other = self.intensities[request];
                self.intensities[request] = if answers { quotient } else { other };
            }
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
