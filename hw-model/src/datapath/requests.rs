//! Many requests side by side, each of any exponent: their results, and the values that ranks of registers hold
//! when they are asked for.
//!
//! The results are computed in loops over arrays of one constant length, which have no choice in them but that
//! of the region, and that one is selected. What a rank shows of a request follows from its address and x alone,
//! so nothing but these is kept: [`Requests::flight`] computes it again.

use multiversion::multiversion;

use crate::rom::{FieldName, Place, Row};
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

/// `N` requests and their results, of which `W` are evaluated together. Fill in addresses and x;
/// [`Logic::evaluate`] does the rest.
#[derive(Debug, Clone)]
pub struct Requests<const N: usize, const W: usize> {
    /// The ROM address of each request.
    pub addresses: [u32; N],
    /// x, bits in the input format.
    pub xs: [i64; N],
    intensities: [i64; N],
    /// The status flags of each result, as in [`Status`](super::signals::Status).
    status: [i64; N],
    /// The [`Region`] that answers each request, as its number.
    regions: [i64; N],
    /// The words of the addresses under evaluation.
    words: Words<W>,
}

/// Where the results of `W` requests go.
struct Results<'a, const W: usize> {
    intensities: &'a mut [i64; W],
    status: &'a mut [i64; W],
    regions: &'a mut [i64; W],
}

/// A list for each field of the ROM.
#[derive(Debug, Clone)]
struct Words<const W: usize> {
    fields: [[i64; W]; FieldName::ALL.len()],
    /// 1 where the address has a word.
    known: [i64; W],
    /// The address that all of them are of: a sweep need not fetch again.
    all_of: Option<u32>,
}

/// Where a loop over requests finds their words.
trait Fetched {
    fn get(&self, name: FieldName, request: usize) -> i64;
    fn known(&self, request: usize) -> bool;
}

impl<const W: usize> Fetched for Words<W> {
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
impl Fetched for Row {
    #[inline(always)]
    fn get(&self, name: FieldName, _: usize) -> i64 {
        self.get(name)
    }
    #[inline(always)]
    fn known(&self, _: usize) -> bool {
        true
    }
}

/// Up to this number of requests, a loop over them becomes vector instructions only where all that it reads is in
/// lists.
const FEW: usize = 8;

impl<const W: usize> Words<W> {
    /// Of one row: what is the same in all rows need not be collected again.
    fn of(row: &Row) -> Self {
        let fields = FieldName::ALL.map(|name| [row.get(name); W]);
        Self { fields, known: [0; W], all_of: None }
    }

    /// The one word of all these addresses, or none and their words collected.
    #[inline(always)]
    fn fetch<'a>(&mut self, datapath: &'a Datapath, addresses: &[u32; W]) -> Option<&'a Row> {
        let first = addresses[0];
        let differ = addresses.iter().fold(0, |differ, address| differ | (address ^ first));
        let one_word = datapath.rom.row(first).filter(|_| differ == 0);
        if W > FEW && one_word.is_some() {
            return one_word;
        }
        let all_of = (differ == 0).then_some(first);
        if all_of.is_none() || self.all_of != all_of {
            self.all_of = all_of;
            self.collect(datapath, addresses);
        }
        None
    }

    fn collect(&mut self, datapath: &Datapath, addresses: &[u32; W]) {
        let mut rows = [datapath.row_at(0); W];
        for ((row, known), &address) in rows.iter_mut().zip(&mut self.known).zip(addresses) {
            let found = datapath.rom.row(address);
            *known = i64::from(found.is_some());
            *row = found.unwrap_or(row);
        }
        for field in datapath.rom.layout().fields() {
            if let Place::Stored { .. } = field.place {
                let values = &mut self.fields[field.name as usize];
                for (value, row) in values.iter_mut().zip(rows) {
                    *value = row.get(field.name);
                }
            }
        }
    }
}

impl Datapath {
    /// Empty requests (address 0, x = 0) for this data path, to be filled in and evaluated.
    #[must_use]
    pub fn requests<const N: usize, const W: usize>(&self) -> Box<Requests<N, W>> {
        const { assert!(0 < W && W <= N) };
        Box::new(Requests {
            addresses: [0; N],
            xs: [0; N],
            intensities: [0; N],
            status: [0; N],
            regions: [0; N],
            words: Words::of(self.row_at(0)),
        })
    }
}

impl<const N: usize, const W: usize> Requests<N, W> {
    /// The intensities of the last evaluation, bits in the output format, in the order of the requests.
    #[must_use]
    pub const fn intensities(&self) -> &[i64; N] {
        &self.intensities
    }

    /// The flags of a result.
    #[must_use]
    pub const fn status(&self, request: usize) -> Status {
        Status::of_bits(self.status[request] as u8)
    }

    /// The part of the pipeline that answered a request.
    #[must_use]
    pub const fn region(&self, request: usize) -> Region {
        match self.regions[request] {
            1 => Region::Polynomial,
            2 => Region::Tail,
            _ => Region::Zero,
        }
    }

    /// One request on its own, with every value that a rank may show of it.
    #[must_use]
    pub fn flight(&self, datapath: &Datapath, logic: &Logic, request: usize) -> Flight {
        let mut flight = datapath.flight();
        logic.enter(datapath, self.addresses[request], self.xs[request], &mut flight);
        flight
    }
}

impl Logic {
    /// Evaluates `W` requests from `start` on, or the last `W` of all where there are not so many.
    /// Returns where they end.
    #[inline]
    pub fn evaluate<const N: usize, const W: usize>(
        &self,
        datapath: &Datapath,
        requests: &mut Requests<N, W>,
        start: usize,
    ) -> usize {
        let start = start.min(N - W);
        let Requests { addresses, xs, intensities, status, regions, words } = requests;
        if let (Some(addresses), Some(xs), Some(intensities), Some(status), Some(regions)) = (
            addresses[start..].first_chunk::<W>(),
            xs[start..].first_chunk::<W>(),
            intensities[start..].first_chunk_mut::<W>(),
            status[start..].first_chunk_mut::<W>(),
            regions[start..].first_chunk_mut::<W>(),
        ) {
            let results = Results { intensities, status, regions };
            match words.fetch(datapath, addresses) {
                Some(word) => self.answer_all(datapath, word, xs, results),
                None => self.answer_all(datapath, words, xs, results),
            }
        }
        start + W
    }

    #[inline(always)]
    fn answer_all<F: Fetched, const W: usize>(
        &self,
        datapath: &Datapath,
        words: &F,
        xs: &[i64; W],
        results: Results<'_, W>,
    ) {
        let Results { intensities, status, regions } = results;
        let answer = match (self.plain, datapath.narrow, datapath.has_two_segments()) {
            (Some((Rounding::NearestUp, true)), _, false) => {
                answer::<i64, Plain<true, true>, F, false, W>
            }
            (Some((Rounding::NearestUp, true)), _, true) => {
                answer::<i64, Plain<true, true>, F, true, W>
            }
            (Some((Rounding::NearestUp, false)), _, _) => {
                answer::<i64, Plain<true, false>, F, true, W>
            }
            (_, true, _) => answer::<i64, Anything, F, true, W>,
            (_, false, _) => answer::<i128, Anything, F, true, W>,
        };
        answer(&self.lines, words, xs, intensities, status, regions);
    }
}

/// `TWO`: there may be a second segment.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn answer<L: Lane, K: Known, F: Fetched, const TWO: bool, const W: usize>(
    lines: &Lines,
    words: &F,
    xs: &[i64; W],
    intensities: &mut [i64; W],
    status: &mut [i64; W],
    regions: &mut [i64; W],
) {
    lines.polynomials::<L, K, F, TWO, W>(words, xs, intensities, status, regions);
    if lines.divider.is_some() && regions.contains(&(Region::Tail as i64)) {
        lines.tails::<L, K, F, W>(words, xs, intensities, regions);
    }
}

impl Lines {
    /// All but the division, in one loop: what one line gives the next need not be stored between.
    #[inline(always)]
    fn polynomials<L: Lane, K: Known, F: Fetched, const TWO: bool, const W: usize>(
        &self,
        words: &F,
        xs: &[i64; W],
        intensities: &mut [i64; W],
        flags: &mut [i64; W],
        regions: &mut [i64; W],
    ) {
        // Where there is no polynomial, all its operands are 0, and what is computed of them too.
        let stages = self.stages.unwrap_or([MultiplyAdd::NOTHING; 3]);
        let lines = K::lines(Self { stages: Some(stages), ..*self });
        let Self { front_end, stages: Some([stage1, stage2, stage3]), output_one, .. } = lines
        else {
            return;
        };
        let (input_one, one) = (L::from_bits(front_end.one), L::from_bits(output_one));
        for (request, &given) in xs.iter().enumerate() {
            let field = |name| L::from_bits(words.get(name, request));
            let given = L::from_bits(given);
            let x = front_end.clamp_input(given);
            let region = front_end.region(given, field(FieldName::Cut) << front_end.cut_up);
            let region = if words.known(request) { region } else { Region::Zero };
            let hand_over = field(FieldName::HandOver) << front_end.hand_over_up;
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
            regions[request] = region as i64;
            flags[request] = status.bits().into();
            intensities[request] = if answers { answered.to_bits() } else { 0 };
        }
    }

    #[inline(always)]
    fn tails<L: Lane, K: Known, F: Fetched, const W: usize>(
        &self,
        words: &F,
        xs: &[i64; W],
        intensities: &mut [i64; W],
        regions: &[i64; W],
    ) {
        let Self { front_end, divider: Some(divider), output_one, .. } = K::lines(*self) else {
            return;
        };
        let mut divisors = [L::ONE; W];
        let mut remainders = [L::ZERO; W];
        let mut digits = [L::ZERO; W];
        for request in 0..W {
            let x = front_end.clamp_input(L::from_bits(xs[request]));
            let answers = regions[request] == Region::Tail as i64;
            let x = front_end.tail_x(x, if answers { Region::Tail } else { Region::Zero });
            let [a, b] = [FieldName::TailA, FieldName::TailB]
                .map(|name| L::from_bits(words.get(name, request)));
            let begun = divider.begin(x, a, b);
            (divisors[request], remainders[request]) = (begun.divisor, begun.remainder);
            digits[request] = begun.digits;
        }
        for _ in 0..divider.digit_count {
            divider.digit_of_all(&divisors, &mut remainders, &mut digits);
        }
        let one = L::from_bits(output_one);
        for request in 0..W {
            let (divisor, remainder) = (divisors[request], remainders[request]);
            let division = Division { divisor, remainder, digits: digits[request] };
            let quotient = divider.finish(division, one).to_bits();
            let answers = regions[request] == Region::Tail as i64;
            let other = intensities[request];
            intensities[request] = if answers { quotient } else { other };
        }
    }
}
