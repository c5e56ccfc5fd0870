//! Many requests in one call: an address for all of them, or one for each.
//!
//! Those of one address go through the block engine, [`Datapath::answer_block`]; those of any address side by side
//! through [`Logic::evaluate`]. What is refused is found on the way, chunk by chunk.
//!
//! [`Datapath::answer_block`]: hw_model::datapath::Datapath::answer_block
//! [`Logic::evaluate`]: hw_model::datapath::Logic::evaluate

use hw_model::datapath::{Requests, Status};

use crate::error::Error;
use crate::handle::Model;

/// Requests of any address that are evaluated side by side.
const BLOCK: usize = 128;

/// x of one address that are converted together: few enough to stay in the nearest cache.
const CHUNK: usize = 1024;

/// Where requests find their ROM words.
#[derive(Debug, Clone, Copy)]
pub enum Addresses<'a, A = u32> {
    /// One address for all.
    One(A),
    /// An address for each.
    Each(&'a [A]),
}

/// Integers in which x can be given.
pub trait XBits: Copy + TryInto<i64> {
    /// The same values where they lie, if they are what the data path takes; others are converted, chunk by chunk.
    #[must_use]
    fn in_place(_: &[Self]) -> Option<&[i64]> {
        None
    }
}

impl XBits for i64 {
    fn in_place(xs: &[Self]) -> Option<&[i64]> {
        Some(xs)
    }
}

impl XBits for i32 {}
impl XBits for u32 {}
impl XBits for u64 {}

fn length(what: &'static str, got: usize, wanted: usize) -> Result<(), Error> {
    if got == wanted { Ok(()) } else { Err(Error::Length { what, got, wanted }) }
}

fn address<A: TryInto<u32>>(address: A) -> Result<u32, Error> {
    address.try_into().map_err(|_| Error::Address)
}

impl Model {
    /// Answers many requests: `intensities` and `status` take the words on these ports, one for each x.
    ///
    /// # Errors
    /// When lengths differ, an address is out of range, or the input format does not hold an x: the first such sample
    /// is named, and what was written until then means nothing.
    pub fn evaluate_all<A, X>(
        &self,
        addresses: Addresses<'_, A>,
        xs: &[X],
        intensities: &mut [i64],
        status: &mut [u8],
    ) -> Result<(), Error>
    where
        A: Copy + TryInto<u32>,
        X: XBits,
    {
        length("intensity", intensities.len(), xs.len())?;
        length("status", status.len(), xs.len())?;
        match addresses {
            Addresses::One(one) => self.evaluate_at(address(one)?, xs, intensities, status),
            Addresses::Each(addresses) => {
                length("address", addresses.len(), xs.len())?;
                let fill = |index: usize| Ok((address(addresses[index])?, self.held(bits(xs[index]))?));
                self.answer(xs.len(), fill, |index, intensity, flags| {
                    intensities[index] = intensity;
                    status[index] = flags.bits();
                })
            }
        }
    }

    fn evaluate_at<X: XBits>(
        &self,
        address: u32,
        xs: &[X],
        intensities: &mut [i64],
        status: &mut [u8],
    ) -> Result<(), Error> {
        let mut converted = [0; CHUNK];
        let places = intensities.chunks_mut(CHUNK).zip(status.chunks_mut(CHUNK));
        for (chunk, (given, (intensities, status))) in xs.chunks(CHUNK).zip(places).enumerate() {
            let xs = X::in_place(given).unwrap_or_else(|| {
                let converted = &mut converted[..given.len()];
                converted.iter_mut().zip(given).for_each(|(to, &x)| *to = bits(x));
                converted
            });
            self.all_held(xs).map_err(|(place, error)| error.at(chunk * CHUNK + place))?;
            self.datapath().answer_block(address, xs, intensities, status);
        }
        Ok(())
    }

    /// Whether the input format holds all of these; or the first that is refused, with its place.
    fn all_held(&self, xs: &[i64]) -> Result<(), (usize, Error)> {
        let input = self.datapath().formats().input;
        // Counted from the least, what the format holds is 0 to a number of ones alone. So the bits that any x has say
        // whether all fit, without a comparison in the loop: it becomes vector instructions on every processor.
        let least = input.min_bits();
        let ones = input.max_bits().wrapping_sub(least) as u64;
        let any = xs.iter().fold(0, |any, &x| any | x.wrapping_sub(least) as u64);
        if any & !ones == 0 {
            return Ok(());
        }
        let first = xs.iter().enumerate().find_map(|(place, &x)| self.held(x).err().map(|error| (place, error)));
        first.map_or(Ok(()), Err)
    }

    /// [`highlight`](Self::highlight) of many x, with one exponent for all or one for each.
    ///
    /// # Errors
    /// As there, with the first sample that is refused; when lengths differ.
    pub fn highlight_all(&self, exponents: Addresses<'_, f64>, xs: &[f64], values: &mut [f64]) -> Result<(), Error> {
        length("intensity", values.len(), xs.len())?;
        match exponents {
            Addresses::One(n) => self.highlight_at(self.address(n)?, xs, values),
            Addresses::Each(exponents) => {
                length("n", exponents.len(), xs.len())?;
                let fill = |index: usize| Ok((self.address(exponents[index])?, self.x_bits(xs[index])?));
                self.answer(xs.len(), fill, |index, intensity, _| values[index] = self.intensity(intensity))
            }
        }
    }

    fn highlight_at(&self, address: u32, xs: &[f64], values: &mut [f64]) -> Result<(), Error> {
        let (mut converted, mut intensities, mut status) = ([0; CHUNK], [0; CHUNK], [0; CHUNK]);
        for (chunk, (xs, values)) in xs.chunks(CHUNK).zip(values.chunks_mut(CHUNK)).enumerate() {
            let converted = &mut converted[..xs.len()];
            for (place, (to, &x)) in converted.iter_mut().zip(xs).enumerate() {
                *to = self.x_bits(x).map_err(|error| error.at(chunk * CHUNK + place))?;
            }
            self.datapath().answer_block(address, converted, &mut intensities, &mut status);
            for (value, &intensity) in values.iter_mut().zip(&intensities) {
                *value = self.intensity(intensity);
            }
        }
        Ok(())
    }

    /// Evaluates `count` requests, block by block: `fill` gives each, and `take` is told each result.
    fn answer(
        &self,
        count: usize,
        fill: impl Fn(usize) -> Result<(u32, i64), Error>,
        mut take: impl FnMut(usize, i64, Status),
    ) -> Result<(), Error> {
        let mut requests: Box<Requests<BLOCK, BLOCK>> = self.datapath().requests();
        for start in (0..count).step_by(BLOCK) {
            let length = BLOCK.min(count - start);
            for place in 0..length {
                let index = start + place;
                let (address, x) = fill(index).map_err(|error| error.at(index))?;
                (requests.addresses[place], requests.xs[place]) = (address, x);
            }
            // What an earlier block left behind the last request is answered and not looked at.
            self.logic().evaluate(self.datapath(), &mut requests, 0);
            for place in 0..length {
                take(start + place, requests.intensities()[place], requests.status(place));
            }
        }
        Ok(())
    }
}

/// What no i64 holds, no format holds either.
#[inline]
fn bits<X: TryInto<i64>>(x: X) -> i64 {
    x.try_into().unwrap_or(i64::MAX)
}
