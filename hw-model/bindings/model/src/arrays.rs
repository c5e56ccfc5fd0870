//! Many requests in one call: an address for all of them, or one for each.
//!
//! They go through the data path in blocks, side by side, with their status flags: the engine is [`Logic::evaluate`],
//! which sees for itself where a block has one address.
//!
//! [`Logic::evaluate`]: hw_model::datapath::Logic::evaluate

use hw_model::datapath::{Requests, Status};

use crate::error::Error;
use crate::handle::Model;

/// Requests that are evaluated side by side.
const BLOCK: usize = 128;

/// Where requests find their ROM words.
#[derive(Debug, Clone, Copy)]
pub enum Addresses<'a, A = u32> {
    /// One address for all.
    One(A),
    /// An address for each.
    Each(&'a [A]),
}

impl<A: Copy> Addresses<'_, A> {
    fn get(&self, index: usize) -> A {
        match self {
            Self::One(address) => *address,
            Self::Each(addresses) => addresses[index],
        }
    }

    fn check(&self, what: &'static str, wanted: usize) -> Result<(), Error> {
        match self {
            Self::Each(addresses) => length(what, addresses.len(), wanted),
            Self::One(_) => Ok(()),
        }
    }
}

fn length(what: &'static str, got: usize, wanted: usize) -> Result<(), Error> {
    if got == wanted { Ok(()) } else { Err(Error::Length { what, got, wanted }) }
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
        X: Copy + TryInto<i64>,
    {
        addresses.check("address", xs.len())?;
        length("intensity", intensities.len(), xs.len())?;
        length("status", status.len(), xs.len())?;
        let (least, greatest) = self.ends();
        let fill = |index: usize| {
            let address = addresses.get(index).try_into().map_err(|_| Error::Address)?;
            // What no i64 holds, no format holds.
            let x = xs[index].try_into().unwrap_or(i64::MAX);
            if (least..=greatest).contains(&x) { Ok((address, x)) } else { self.held(x).map(|x| (address, x)) }
        };
        self.answer(xs.len(), fill, |index, intensity, flags| {
            intensities[index] = intensity;
            status[index] = flags.bits();
        })
    }

    /// [`highlight`](Self::highlight) of many x, with one exponent for all or one for each.
    ///
    /// # Errors
    /// As there, with the first sample that is refused; when lengths differ.
    pub fn highlight_all(&self, exponents: Addresses<'_, f64>, xs: &[f64], values: &mut [f64]) -> Result<(), Error> {
        exponents.check("n", xs.len())?;
        length("intensity", values.len(), xs.len())?;
        let first = if let Addresses::One(n) = exponents { Some(self.address(n)?) } else { None };
        let fill = |index: usize| {
            let address = first.map_or_else(|| self.address(exponents.get(index)), Ok)?;
            Ok((address, self.x_bits(xs[index])?))
        };
        self.answer(xs.len(), fill, |index, intensity, _| values[index] = self.intensity(intensity))
    }

    fn ends(&self) -> (i64, i64) {
        let input = self.datapath().formats().input;
        (input.min_bits(), input.max_bits())
    }

    /// Evaluates `count` requests, block by block: `fill` gives each, and `take` is told each result.
    #[inline(always)]
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
            // Behind the last request stands what an earlier block left there; it is answered and not looked at. A
            // block that could have one address has one.
            let last = requests.addresses[length - 1];
            requests.addresses[length..].fill(last);
            self.logic().evaluate(self.datapath(), &mut requests, 0);
            for place in 0..length {
                take(start + place, requests.intensities()[place], requests.status(place));
            }
        }
        Ok(())
    }
}
