//! Many requests side by side, each of any exponent: their results, and the values that ranks of registers hold
//! when they are asked for.
//!
//! The results are computed in loops over arrays of one constant length, which have no choice in them but that
//! of the region, and that one is selected. What a rank shows of a request follows from its address and x alone,
//! so nothing but these is kept: [`Requests::flight`] computes it again.

use multiversion::multiversion;

use crate::registers::Register;
use crate::rom::{Fetched, Place, Row};
use crate::rounding::{Lane, Rounding};

use super::compose::{Anything, Cubics, Known, Lines, Plain};
use super::flight::{Flight, Logic};
use super::front_end::Region;
use super::keep::{Registers, Whole};
use super::parts::Datapath;
use super::signals::Status;

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
    fields: [[i64; W]; Register::ROM_COUNT],
    /// 1 where the address has a word.
    known: [i64; W],
    /// The address that all of them are of: a sweep need not fetch again.
    all_of: Option<u32>,
}

/// Where a loop over requests finds the word of each.
trait FetchedOfEach {
    fn of(&self, request: usize) -> impl Fetched;
}

/// The word of one of them.
struct Word<'a, const W: usize> {
    words: &'a Words<W>,
    request: usize,
}

impl<const W: usize> Fetched for Word<'_, W> {
    #[inline(always)]
    fn get(&self, field: Register) -> i64 {
        self.words.fields[field.index()][self.request]
    }
    #[inline(always)]
    fn known(&self) -> bool {
        self.words.known[self.request] != 0
    }
}

impl<const W: usize> FetchedOfEach for Words<W> {
    #[inline(always)]
    fn of(&self, request: usize) -> impl Fetched {
        Word { words: self, request }
    }
}

/// The one word of all requests: nothing is fetched in the loop.
impl FetchedOfEach for &Row {
    #[inline(always)]
    fn of(&self, _: usize) -> impl Fetched {
        **self
    }
}

/// Up to this number of requests, a loop over them becomes vector instructions only where all that it reads is in
/// lists.
const FEW: usize = 8;

impl<const W: usize> Words<W> {
    /// Of one row: what is the same in all rows need not be collected again.
    fn of(row: &Row) -> Self {
        let mut fields = [[0; W]; Register::ROM_COUNT];
        for field in Register::in_rom() {
            fields[field.index()] = [row.get(field); W];
        }
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
                let index = field.name.index();
                for (value, row) in self.fields[index].iter_mut().zip(rows) {
                    *value = row.at(index);
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
                Some(word) => self.answer_all(datapath, &word, xs, results),
                None => self.answer_all(datapath, words, xs, results),
            }
        }
        start + W
    }

    #[inline(always)]
    fn answer_all<F: FetchedOfEach, const W: usize>(
        &self,
        datapath: &Datapath,
        words: &F,
        xs: &[i64; W],
        results: Results<'_, W>,
    ) {
        let Results { intensities, status, regions } = results;
        let one_segment = datapath.segment_count() == 1;
        let answer = match (self.plain, datapath.narrow && self.lines.are_cubics()) {
            (Some((Rounding::NearestUp, true)), _) if one_segment => answer::<i64, Plain<true, true, 1>, F, W>,
            (Some((Rounding::NearestUp, true)), _) => answer::<i64, Plain<true, true, 2>, F, W>,
            (Some((Rounding::NearestUp, false)), _) => answer::<i64, Plain<true, false, 2>, F, W>,
            (_, true) => answer::<i64, Cubics, F, W>,
            (_, false) if datapath.narrow => answer::<i64, Anything, F, W>,
            (_, false) => answer::<i128, Anything, F, W>,
        };
        answer(&self.lines, words, xs, intensities, status, regions);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn answer<L: Lane, K: Known, F: FetchedOfEach, const W: usize>(
    lines: &Lines,
    words: &F,
    xs: &[i64; W],
    intensities: &mut [i64; W],
    status: &mut [i64; W],
    regions: &mut [i64; W],
) {
    let lines = K::lines(*lines);
    // All but the division, in one loop: what one line gives the next need not be stored between.
    for (request, &given) in xs.iter().enumerate() {
        let row = words.of(request);
        let composed = lines.compose::<L, K, Whole>(&row, L::from_bits(given), &Registers::WHOLE);
        regions[request] = composed.entered.region as i64;
        status[request] = composed.status.bits().into();
        intensities[request] = composed.intensity.to_bits();
    }
    if lines.divider.is_some() && regions.contains(&(Region::Tail as i64)) {
        lines.tails::<L, F, W>(words, xs, intensities, regions);
    }
}

impl Lines {
    #[inline(always)]
    fn tails<L: Lane, F: FetchedOfEach, const W: usize>(
        &self,
        words: &F,
        xs: &[i64; W],
        intensities: &mut [i64; W],
        regions: &[i64; W],
    ) {
        let Some(divider) = &self.divider else { return };
        let answers = |request: usize| regions[request] == Region::Tail as i64;
        let operands = |request: usize| {
            let x = self.front_end.clamp_input(L::from_bits(xs[request]));
            let region = if answers(request) { Region::Tail } else { Region::Zero };
            let row = words.of(request);
            let [a, b] = [Register::TailA, Register::TailB].map(|name| L::from_bits(row.get(name)));
            [self.front_end.tail_x(x, region), a, b]
        };
        let divisions = divider.divide::<L, L, Whole, W>(W, operands, self.output_one, &Registers::WHOLE, |_, _| {});
        let quotients = divisions.quotients().iter().zip(regions);
        for (intensity, (quotient, &region)) in intensities.iter_mut().zip(quotients) {
            let answers = region == Region::Tail as i64;
            *intensity = if answers { quotient.to_bits() } else { *intensity };
        }
    }
}
