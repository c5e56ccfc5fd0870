//! Many requests side by side, each of any exponent: their results, and the values that ranks of registers hold
//! when they are asked for.
//!
//! The results are computed in loops over arrays of one constant length, which have no choice in them but that
//! of the region, and that one is selected. What a rank shows of a request follows from its address and x alone,
//! so nothing but these is kept: [`Requests::flight`] computes it again.

use multiversion::multiversion;

use crate::rom::{FieldName, Row};
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

/// So many requests and their results. Fill in addresses and x; [`Logic::evaluate`] does the rest.
#[derive(Debug, Clone)]
pub struct Requests<const N: usize> {
    /// ROM addresses.
    pub addresses: [u32; N],
    /// x, bits in the input format.
    pub xs: [i64; N],
    /// The words of the addresses, where they are not all the same.
    words: Words<N>,
    results: Results<N>,
}

#[derive(Debug, Clone)]
struct Results<const N: usize> {
    intensities: [i64; N],
    /// Flags.
    status: [i64; N],
    /// [`Region`]s.
    regions: [i64; N],
}

/// A list for each field of the ROM.
#[derive(Debug, Clone)]
struct Words<const N: usize> {
    fields: [[i64; N]; FieldName::ALL.len()],
    /// 1 where the address has a word.
    known: [i64; N],
}

/// Where a loop over requests finds their words.
trait Fetched: Copy {
    fn get(&self, name: FieldName, request: usize) -> i64;
    fn known(&self, request: usize) -> bool;
}

impl<const N: usize> Fetched for &Words<N> {
    #[inline(always)]
    fn get(&self, name: FieldName, request: usize) -> i64 {
        self.fields[name as usize][request]
    }
    #[inline(always)]
    fn known(&self, request: usize) -> bool {
        self.known[request] != 0
    }
}

/// The one word of all requests: nothing is fetched in the loop.
#[derive(Clone, Copy)]
struct OneWord {
    row: Row,
    known: bool,
}

impl Fetched for OneWord {
    #[inline(always)]
    fn get(&self, name: FieldName, _: usize) -> i64 {
        self.row.get(name)
    }
    #[inline(always)]
    fn known(&self, _: usize) -> bool {
        self.known
    }
}

impl Datapath {
    /// Room for requests.
    #[must_use]
    pub fn requests<const N: usize>(&self) -> Box<Requests<N>> {
        Box::new(Requests {
            addresses: [0; N],
            xs: [0; N],
            words: Words { fields: [[0; N]; FieldName::ALL.len()], known: [0; N] },
            results: Results { intensities: [0; N], status: [0; N], regions: [0; N] },
        })
    }
}

impl<const N: usize> Requests<N> {
    /// The intensities.
    #[must_use]
    pub const fn intensities(&self) -> &[i64; N] {
        &self.results.intensities
    }

    /// The flags of a result.
    #[must_use]
    pub const fn status(&self, request: usize) -> Status {
        Status::of_bits(self.results.status[request] as u8)
    }

    /// One request on its own, with every value that a rank may show of it.
    #[must_use]
    pub fn flight(&self, datapath: &Datapath, logic: &Logic, request: usize) -> Flight {
        let mut flight = datapath.flight();
        logic.enter(datapath, self.addresses[request], self.xs[request], &mut flight);
        flight
    }

    /// The one word of all, or their words collected.
    fn fetch(&mut self, datapath: &Datapath) -> Option<OneWord> {
        let first = self.addresses[0];
        if self.addresses.iter().fold(0, |differ, address| differ | (address ^ first)) == 0 {
            let known = datapath.rom.row(first);
            let row = *known.unwrap_or_else(|| datapath.row_at(0));
            return Some(OneWord { row, known: known.is_some() });
        }
        let mut rows = [datapath.row_at(0); N];
        for ((row, known), &address) in
            rows.iter_mut().zip(&mut self.words.known).zip(&self.addresses)
        {
            let found = datapath.rom.row(address);
            *known = i64::from(found.is_some());
            *row = found.unwrap_or(row);
        }
        for field in datapath.rom.layout().fields() {
            let values = &mut self.words.fields[field.name as usize];
            for (value, row) in values.iter_mut().zip(rows) {
                *value = row.get(field.name);
            }
        }
        None
    }
}

impl Logic {
    /// Evaluates every request.
    pub fn evaluate<const N: usize>(&self, datapath: &Datapath, requests: &mut Requests<N>) {
        let two = datapath.has_two_segments();
        let one_word = requests.fetch(datapath);
        let Requests { xs, words, results, .. } = requests;
        match one_word {
            Some(word) => self.answer_all(datapath.narrow, two, word, xs, results),
            None => self.answer_all(datapath.narrow, two, &*words, xs, results),
        }
    }

    fn answer_all<F: Fetched, const N: usize>(
        &self,
        narrow: bool,
        two: bool,
        words: F,
        xs: &[i64; N],
        results: &mut Results<N>,
    ) {
        let lines = &self.lines;
        match (self.plain, narrow, two) {
            (Some((Rounding::NearestUp, true)), _, false) => centred(lines, &words, xs, results),
            (Some((Rounding::NearestUp, true)), _, true) => {
                two_segments(lines, &words, xs, results);
            }
            (Some((Rounding::NearestUp, false)), _, false) => power(lines, &words, xs, results),
            (_, true, _) => lines.answer::<i64, Anything, F, true, N>(&words, xs, results),
            (_, false, _) => lines.answer::<i128, Anything, F, true, N>(&words, xs, results),
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn centred<F: Fetched, const N: usize>(
    lines: &Lines,
    words: &F,
    xs: &[i64; N],
    results: &mut Results<N>,
) {
    lines.answer::<i64, Plain<true, true>, F, false, N>(words, xs, results);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn two_segments<F: Fetched, const N: usize>(
    lines: &Lines,
    words: &F,
    xs: &[i64; N],
    results: &mut Results<N>,
) {
    lines.answer::<i64, Plain<true, true>, F, true, N>(words, xs, results);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn power<F: Fetched, const N: usize>(
    lines: &Lines,
    words: &F,
    xs: &[i64; N],
    results: &mut Results<N>,
) {
    lines.answer::<i64, Plain<true, false>, F, false, N>(words, xs, results);
}

impl Lines {
    /// `TWO`: there may be a second segment.
    #[inline(always)]
    fn answer<L: Lane, K: Known, F: Fetched, const TWO: bool, const N: usize>(
        &self,
        words: &F,
        xs: &[i64; N],
        results: &mut Results<N>,
    ) {
        self.polynomials::<L, K, F, TWO, N>(words, xs, results);
        if results.regions.contains(&(Region::Tail as i64)) {
            self.tails::<L, K, F, N>(words, xs, results);
        }
    }

    /// All but the division, in one loop: what one line gives the next need not be stored between.
    #[inline(always)]
    fn polynomials<L: Lane, K: Known, F: Fetched, const TWO: bool, const N: usize>(
        &self,
        words: &F,
        xs: &[i64; N],
        results: &mut Results<N>,
    ) {
        // Where there is no polynomial, all its operands are 0, and what is computed of them too.
        let stages = self.stages.unwrap_or([MultiplyAdd::NOTHING; 3]);
        let lines = K::lines(Self { stages: Some(stages), ..*self });
        let Self { front_end, stages: Some([stage1, stage2, stage3]), output_one, .. } = lines
        else {
            return;
        };
        let (input_one, one) = (L::from_bits(front_end.one), L::from_bits(output_one));
        // Copied: a loop that writes must not have to read it again.
        let words = *words;
        for (request, &given) in xs.iter().enumerate() {
            let field = |name| L::from_bits(words.get(name, request));
            let given = L::from_bits(given);
            let x = front_end.clamp_input(given);
            let region = front_end.region(given, field(FieldName::Cut));
            let region = if words.known(request) { region } else { Region::Zero };
            let hand_over = field(FieldName::HandOver);
            let outer = TWO && front_end.is_outer(x, region, hand_over);
            let start = if outer { hand_over } else { input_one };
            // Both are loaded: a choice of the address would not fit into vectors.
            let either = |first, second| {
                let (first, second) = (words.get(first, request), words.get(second, request));
                L::from_bits(if outer { second } else { first })
            };
            let shift = either(FieldName::Shift, FieldName::ShiftOuter).to_bits() as u32;
            let v = front_end.variable(x, region, start, shift);
            let (c3, c2) = (
                either(FieldName::C3, FieldName::C3Outer),
                either(FieldName::C2, FieldName::C2Outer),
            );
            let t1 = stage1.apply(c3, v, c2);
            let t2 = stage2.apply(t1, v, either(FieldName::C1, FieldName::C1Outer));
            let t3 = stage3.apply(t2, v, either(FieldName::C0, FieldName::C0Outer));
            let answers = region == Region::Polynomial;
            let answered = clamp(t3, one);
            let status = Status::default()
                .with(Status::NO_WORD, !words.known(request))
                .with(Status::ABOVE_ONE, given > input_one)
                .with(Status::FACING_AWAY, given < L::ZERO)
                .with(
                    Status::OUT_OF_DOMAIN,
                    words.known(request) && front_end.outside(given, region),
                )
                .with(Status::CLAMPED, answers && answered != t3);
            results.regions[request] = region as i64;
            results.status[request] = status.bits().into();
            results.intensities[request] = if answers { answered.to_bits() } else { 0 };
        }
    }

    #[inline(always)]
    fn tails<L: Lane, K: Known, F: Fetched, const N: usize>(
        &self,
        words: &F,
        xs: &[i64; N],
        results: &mut Results<N>,
    ) {
        let Self { front_end, divider: Some(divider), output_one, .. } = K::lines(*self) else {
            return;
        };
        let mut divisors = [L::ONE; N];
        let mut remainders = [L::ZERO; N];
        let mut digits = [L::ZERO; N];
        for request in 0..N {
            let x = front_end.clamp_input(L::from_bits(xs[request]));
            let answers = results.regions[request] == Region::Tail as i64;
            let x = front_end.tail_x(x, if answers { Region::Tail } else { Region::Zero });
            let [a, b] = [FieldName::TailA, FieldName::TailB]
                .map(|name| L::from_bits(words.get(name, request)));
            let begun = divider.begin(x, a, b);
            (divisors[request], remainders[request]) = (begun.divisor, begun.remainder);
            digits[request] = begun.digits;
        }
        for _ in 0..divider.digit_count {
            let lanes = divisors.iter().zip(&mut remainders).zip(&mut digits);
            for ((&divisor, remainder), digits) in lanes {
                let next =
                    divider.digit(Division { divisor, remainder: *remainder, digits: *digits });
                (*remainder, *digits) = (next.remainder, next.digits);
            }
        }
        let one = L::from_bits(output_one);
        for request in 0..N {
            let (divisor, remainder) = (divisors[request], remainders[request]);
            let division = Division { divisor, remainder, digits: digits[request] };
            let quotient = divider.finish(division, one).to_bits();
            let answers = results.regions[request] == Region::Tail as i64;
            let other = results.intensities[request];
            results.intensities[request] = if answers { quotient } else { other };
        }
    }
}
