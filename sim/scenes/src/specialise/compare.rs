//! Every (n, x) of a domain through both data paths, and every x outside through the smaller one.

use hw_model::datapath::Status;
use hw_model::design::Design;
use hw_model::quantise::real;
use rayon::prelude::*;
use vectors::limits::{Sweep, TooManyInputs};

use super::certificate::{Display, Part, Proved, Served};
use super::derive::AskedRow;
use super::refused::Refused;
use crate::render::Codes;
use crate::scene::{DISPLAY_BITS, Image};
use vectors::progress::Progress;

/// x that are looked at together.
const PIECE: i64 = 1 << 14;
/// x that are evaluated side by side.
const REQUESTS: usize = 128;

/// How many x the rows have, all of which are gone through.
///
/// # Errors
/// When they are too many.
pub fn points(source: &Design, rows: &[AskedRow]) -> Result<u64, TooManyInputs> {
    let per_row = source.datapath().front_end().greatest as u128 + 1;
    Sweep::Specialise.within(per_row * rows.len() as u128, source.config().input)
}

/// Goes through every x of the rows.
///
/// # Errors
/// When they are too many, a part has no word, an x that should be refused is answered, or answers differ by more than
/// `allowed` codes (by anything, without it).
pub fn certify(
    source: &Design,
    specialised: &Design,
    rows: &[AskedRow],
    display: Display,
    allowed: Option<u16>,
    progress: &dyn Progress,
) -> Result<(Proved, Vec<Part>), Refused> {
    points(source, rows)?;
    if !DISPLAY_BITS.contains(&display.bits) {
        let problem = format!("{} bits; a scene has 8, 10 or 12", display.bits);
        return Err(Refused::Field { field: "display.bits".to_owned(), problem });
    }
    let codes = Codes::new(&Image { width: 1, height: 1, display_bits: display.bits, transfer: display.transfer });
    let mut greatest_codes = 0;
    let mut parts = Vec::new();
    let shared = rows.iter().any(|row| row.serving != row.demand.exponent);
    for (index, row) in rows.iter().enumerate() {
        let of_row = rows.iter().filter(|other| other.serving == row.serving);
        let refused_below = of_row.map(|other| other.least).min().unwrap_or(row.least);
        let pair = Pair::new(source, specialised, row, refused_below, &codes).map_err(|problem| Refused::Part {
            index,
            n: row.demand.exponent,
            problem,
        })?;
        let found = pair.all(progress);
        let fails = |problem: String| Refused::Part { index, n: row.demand.exponent, problem };
        if let Some(x) = found.answered {
            return Err(fails(format!("x = {x} lies outside the domain and is not refused")));
        }
        greatest_codes = greatest_codes.max(found.codes);
        match allowed {
            None if found.differing > 0 => {
                return Err(fails(format!("{} answers differ", found.differing)));
            }
            Some(allowed) if found.codes > allowed => {
                return Err(fails(format!("codes differ by {}, and {allowed} may", found.codes)));
            }
            _ => {}
        }
        parts.push(pair.part(row, &found, shared));
    }
    let proved = match allowed {
        None => Proved::BitIdentical,
        Some(allowed) => Proved::Codes { allowed, greatest: greatest_codes },
    };
    Ok((proved, parts))
}

/// An exponent in the source, and the row that answers for it.
struct Pair<'a> {
    designs: [&'a Design; 2],
    addresses: [u32; 2],
    codes: &'a Codes,
    /// The first and the last x of the domain.
    domain: (i64, i64),
    /// Every x below this is refused; 0 where none is.
    refused_below: i64,
}

/// What comes out for one x: the intensity in its output's unit, and the flags.
type Answer = (i64, Status);

/// What was found over some x.
#[derive(Debug, Clone, Copy, Default)]
struct Found {
    points: u64,
    differing: u64,
    greatest: f64,
    codes: u16,
    refused: u64,
    /// An x that should have been refused.
    answered: Option<i64>,
}

impl Found {
    fn and(self, other: Self) -> Self {
        Self {
            points: self.points + other.points,
            differing: self.differing + other.differing,
            greatest: self.greatest.max(other.greatest),
            codes: self.codes.max(other.codes),
            refused: self.refused + other.refused,
            answered: self.answered.or(other.answered),
        }
    }
}

impl<'a> Pair<'a> {
    fn new(
        source: &'a Design,
        specialised: &'a Design,
        row: &AskedRow,
        refused_below: i64,
        codes: &'a Codes,
    ) -> Result<Self, String> {
        let designs = [source, specialised];
        let place = |design: &Design, exponent: f64| {
            let place = design.rom().exponents().position(exponent);
            place.map(|place| place as u32).ok_or_else(|| format!("{} has no word", design.config().name))
        };
        let addresses = [place(source, row.demand.exponent)?, place(specialised, row.serving)?];
        if source.config().input != specialised.config().input {
            return Err("the two take x in different formats".to_owned());
        }
        let greatest = source.datapath().front_end().greatest;
        let guarded = specialised.datapath().front_end().guarded;
        // Without a guard every x is answered, and so every x is looked at.
        let (first, refused_below) = if guarded { (row.least, refused_below) } else { (0, 0) };
        Ok(Self { designs, addresses, codes, domain: (first, greatest), refused_below })
    }

    fn all(&self, progress: &dyn Progress) -> Found {
        let last = self.domain.1;
        (0..=last / PIECE)
            .into_par_iter()
            .map(|piece| {
                let (first, end) = (piece * PIECE, ((piece + 1) * PIECE - 1).min(last));
                let (low, high) = self.domain;
                let mut found = Found::default();
                if first < self.refused_below {
                    found = found.and(self.outside(first, end.min(self.refused_below - 1)));
                }
                if end >= low {
                    found = found.and(self.inside(first.max(low), end.min(high)));
                }
                progress.advance((end - first + 1) as u64);
                found
            })
            .reduce(Found::default, Found::and)
    }

    fn inside(&self, first: i64, last: i64) -> Found {
        let formats = self.designs.map(|design| design.config().output);
        let [source, specialised] = [0, 1].map(|which| self.answers(which, first, last));
        let mut found = Found { points: source.len() as u64, ..Found::default() };
        for (&wanted, &got) in source.iter().zip(&specialised) {
            if formats[0] == formats[1] && wanted == got {
                continue;
            }
            let numbers = [real(wanted.0, formats[0]), real(got.0, formats[1])];
            if numbers[0] == numbers[1] && wanted.1 == got.1 {
                continue;
            }
            found.differing += 1;
            found.greatest = found.greatest.max((numbers[0] - numbers[1]).abs());
            let [wanted, got] = numbers.map(|number| self.codes.of(number));
            found.codes = found.codes.max(wanted.abs_diff(got));
        }
        found
    }

    fn outside(&self, first: i64, last: i64) -> Found {
        let refused = (0, Status::OUT_OF_DOMAIN);
        let mut found = Found::default();
        for (x, answer) in (first..).zip(self.answers(1, first, last)) {
            if answer == refused {
                found.refused += 1;
            } else {
                found.answered = found.answered.or(Some(x));
            }
        }
        found
    }

    /// What one of the two answers to every x of a piece.
    fn answers(&self, which: usize, first: i64, last: i64) -> Vec<Answer> {
        let datapath = self.designs[which].datapath();
        let logic = datapath.logic();
        let mut requests = datapath.requests::<REQUESTS, REQUESTS>();
        requests.addresses = [self.addresses[which]; REQUESTS];
        let mut answers = Vec::with_capacity((last - first + 1) as usize);
        for begin in (first..=last).step_by(REQUESTS) {
            for (x, place) in (begin..).zip(&mut requests.xs) {
                *place = x;
            }
            logic.evaluate(datapath, &mut requests, 0);
            let count = REQUESTS.min((last - begin + 1) as usize);
            let answer = |index: usize| (requests.intensities()[index], requests.status(index));
            answers.extend((0..count).map(answer));
        }
        answers
    }

    fn part(&self, row: &AskedRow, found: &Found, shared: bool) -> Part {
        let Found { points, differing, greatest, refused, .. } = *found;
        let (first, last) = self.domain;
        let (n, least) = (row.demand.exponent, row.demand.least);
        let served = shared.then_some(Served { row: row.serving, codes: found.codes });
        Part { n, least, first, last, points, differing, greatest, refused, served }
    }
}
