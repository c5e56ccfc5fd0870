//! The fewest rows of a ROM that serve exponents which are near each other.
//!
//! The source has a row for every exponent of the scene: where its configuration has none, one is added
//! ([`with_words`]). An exponent may be served by any row of the source whose display codes, over every x that the
//! scene presents with that exponent, differ by at most the allowed from those of its own row. Of these rows the run
//! around its own counts. So each exponent has an interval of rows, and the fewest rows that meet every interval are
//! found by taking, again and again, a row of the interval that ends first which all that overlap its end have too.
//!
//! Intervals are found at some x, and what is taken is held against every x; a row that fails there is left out of its
//! interval, and the search begins again. What comes out is proved once more by the certificate.

use hw_model::config::Config;
use hw_model::datapath::Block;
use hw_model::design::Design;
use hw_model::exponents::{Exponents, ExponentsError};
use rayon::prelude::*;

use super::certificate::Display;
use super::derive::AskedRow;
use crate::render::Codes;
use crate::scene::Image;
use vectors::progress::Progress;

/// x^n is tried from 1 to e^−16, in this many steps of its logarithm.
const STEPS: u32 = 2048;
const FURTHEST: f64 = 16.0;
/// And at this many places of equal distance.
const EVEN: i64 = 1024;
/// x that are evaluated together.
const PIECE: i64 = 1 << 14;

/// The configuration with a word for each of these exponents. Steps of coefficients count last places of formats that
/// other exponents may change: they go where words are added.
///
/// # Errors
/// When the exponents are no list.
pub fn with_words(config: &Config, exponents: impl Iterator<Item = f64>) -> Result<Config, ExponentsError> {
    let mut list = config.exponents.as_slice().to_vec();
    list.extend(exponents.filter(|&n| config.exponents.position(n).is_none()));
    let mut config = config.clone();
    if list.len() > config.exponents.len() {
        list.sort_by(f64::total_cmp);
        list.dedup();
        config.exponents = Exponents::new(list)?;
        config.coefficient_steps = Vec::new();
    }
    Ok(config)
}

/// Which words a source has beside those of the configuration that was asked for, as a sentence.
pub(super) fn words_beside(asked: &Config, source: &Config) -> Option<String> {
    let beside = source.exponents.iter().filter(|&n| asked.exponents.position(n).is_none());
    let beside: Vec<String> = beside.map(|n| n.to_string()).collect();
    let name = &asked.name;
    (!beside.is_empty()).then(|| {
        format!("The source is {name} with words for n = {} beside its own, which {name} has not.", beside.join(", "))
    })
}

/// For each of these rows, which are served by themselves, the exponent of the row of the source that serves it when
/// rows are as few as `allowed` codes permit.
#[must_use]
pub fn serve(source: &Design, rows: &[AskedRow], display: Display, allowed: u16, progress: &dyn Progress) -> Vec<f64> {
    let image = Image { width: 1, height: 1, display_bits: display.bits, transfer: display.transfer };
    let comparison = Comparison { source, codes: Codes::new(&image), allowed };
    let mut wishes: Vec<Wish> = rows.par_iter().map(|row| comparison.wish(row)).collect();
    loop {
        let chosen = fewest(&wishes);
        let mut failed = false;
        for (wish, &row) in wishes.iter_mut().zip(&chosen) {
            if !comparison.holds(wish, row, progress) {
                wish.leave_out(row);
                failed = true;
            }
        }
        if !failed {
            let exponents = source.rom().exponents().as_slice();
            return chosen.iter().filter_map(|&row| exponents.get(row).copied()).collect();
        }
    }
}

/// The rows of the source that may serve an exponent.
#[derive(Debug, Clone)]
struct Wish {
    own: usize,
    /// The least x, in the input's unit.
    least: i64,
    first: usize,
    last: usize,
    /// The greatest difference of each of them, from `first` on, in display codes at some x.
    costs: Vec<u16>,
    /// Rows that were held against every x.
    held: Vec<usize>,
}

impl Wish {
    fn has(&self, row: usize) -> bool {
        (self.first..=self.last).contains(&row)
    }

    fn cost(&self, row: usize) -> u16 {
        row.checked_sub(self.first).and_then(|place| self.costs.get(place)).copied().unwrap_or(u16::MAX)
    }

    /// Leaves out a row that is not its own, and those beyond it.
    fn leave_out(&mut self, row: usize) {
        if row < self.own {
            self.costs.drain(..=row - self.first);
            self.first = row + 1;
        } else {
            self.last = row - 1;
        }
    }
}

/// For each wish the row that serves it.
fn fewest(wishes: &[Wish]) -> Vec<usize> {
    let mut taken: Vec<usize> = Vec::new();
    let mut open: Vec<&Wish> = wishes.iter().collect();
    while let Some(end) = open.iter().map(|wish| wish.last).min() {
        let (group, rest): (Vec<&Wish>, Vec<&Wish>) = open.into_iter().partition(|wish| wish.first <= end);
        // All of the group have the rows from here to the end: of these the one that costs least.
        let first = group.iter().map(|wish| wish.first).max().unwrap_or(end);
        let worst = |row: &usize| group.iter().map(|wish| wish.cost(*row)).max();
        taken.extend((first..=end).min_by_key(worst));
        open = rest;
    }
    let nearest = |wish: &Wish| {
        let ones = taken.iter().copied().filter(|&row| wish.has(row));
        ones.min_by_key(|&row| (wish.cost(row), row.abs_diff(wish.own))).unwrap_or(wish.own)
    };
    wishes.iter().map(nearest).collect()
}

struct Comparison<'a> {
    source: &'a Design,
    codes: Codes,
    allowed: u16,
}

impl Comparison<'_> {
    fn wish(&self, asked: &AskedRow) -> Wish {
        let own = asked.address as usize;
        let xs = self.some_x(asked.demand.exponent, asked.least);
        let wanted = self.codes_of(own, &xs);
        let cost = |row: usize| apart(&wanted, &self.codes_of(row, &xs));
        let below = (0..own).rev().map(cost).take_while(|&cost| cost <= self.allowed);
        let mut costs: Vec<u16> = below.collect();
        let first = own - costs.len();
        costs.reverse();
        costs.push(0);
        costs.extend((own + 1..self.source.rom().depth()).map(cost).take_while(|&cost| cost <= self.allowed));
        Wish { own, least: asked.least, first, last: first + costs.len() - 1, costs, held: vec![own] }
    }

    /// x between the least and the greatest: where x^n falls, and evenly.
    fn some_x(&self, n: f64, least: i64) -> Vec<i64> {
        let greatest = self.source.datapath().front_end().greatest;
        let falling = (0..=STEPS).map(|step| {
            let sigma = FURTHEST * f64::from(step) / f64::from(STEPS);
            crate::render::bits(core_math::exp(-sigma / n), self.source.config().input)
        });
        let evenly = (0..=EVEN).map(|step| least + (greatest - least) / EVEN * step);
        falling.chain(evenly).filter(|x| (least..=greatest).contains(x)).collect()
    }

    fn codes_of(&self, row: usize, xs: &[i64]) -> Vec<u16> {
        let mut block = Block::default();
        self.source.datapath().evaluate_block(row as u32, xs, &mut block);
        let output = self.source.config().output;
        block.intensities.iter().map(|&bits| self.codes.of(hw_model::quantise::real(bits, output))).collect()
    }

    /// A row serves an exponent at every x that is presented.
    fn holds(&self, wish: &mut Wish, row: usize, progress: &dyn Progress) -> bool {
        if wish.held.contains(&row) {
            return true;
        }
        let greatest = self.source.datapath().front_end().greatest;
        let (least, own) = (wish.least, wish.own);
        let holds = (0..=(greatest - least) / PIECE).into_par_iter().all(|piece| {
            let first = least + piece * PIECE;
            let xs: Vec<i64> = (first..=(first + PIECE - 1).min(greatest)).collect();
            progress.advance(xs.len() as u64);
            apart(&self.codes_of(own, &xs), &self.codes_of(row, &xs)) <= self.allowed
        });
        if holds {
            wish.held.push(row);
        }
        holds
    }
}

/// The greatest difference of codes.
fn apart(one: &[u16], other: &[u16]) -> u16 {
    one.iter().zip(other).map(|(one, other)| one.abs_diff(*other)).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicU64;

    use super::*;
    use crate::scene::Transfer;
    use crate::specialise::{Demand, certify, derive, rows, served_rows, serving};

    fn wish(own: usize, first: usize, last: usize) -> Wish {
        let costs = (first..=last).map(|row| row.abs_diff(own) as u16).collect();
        Wish { own, least: 0, first, last, costs, held: Vec::new() }
    }

    /// Of every set of rows, the smallest that meets all intervals, by trying all sets.
    fn fewest_by_trying(wishes: &[Wish]) -> u32 {
        let meets = |set: &u32| wishes.iter().all(|wish| (wish.first..=wish.last).any(|row| set >> row & 1 == 1));
        (0..1_u32 << 12).filter(meets).map(u32::count_ones).min().unwrap()
    }

    proptest::proptest! {
        #[test]
        fn no_set_of_rows_is_smaller(list in proptest::collection::vec((0_usize..12, 0_usize..4, 0_usize..4), 1..7)) {
            let wishes: Vec<Wish> =
                list.iter().map(|&(own, down, up)| wish(own, own.saturating_sub(down), (own + up).min(11))).collect();
            let chosen = fewest(&wishes);
            let mut rows = chosen.clone();
            rows.sort_unstable();
            rows.dedup();
            proptest::prop_assert!(wishes.iter().zip(&chosen).all(|(wish, &row)| wish.has(row)));
            proptest::prop_assert_eq!(rows.len() as u32, fewest_by_trying(&wishes));
        }
    }

    fn demand(exponent: f64, least: f64) -> Demand {
        Demand { exponent, least, greatest: 1.0 }
    }

    /// Rows are shared where codes allow it, and what is proved of that is so, one x after the other.
    #[test]
    fn near_exponents_share_a_row() {
        let json = r#"{"name": "s", "method": "minimax", "segments": 2, "cut": "balanced", "exponents": "8,9,60",
            "input": "UQ1.12", "output": "UQ1.10"}"#;
        let config = Config::from_json(json).unwrap();
        let demands = [demand(8.7, 0.0), demand(8.8, 0.3), demand(9.1, 0.2), demand(60.0, 0.0), demand(60.5, 0.9)];
        let source = Design::new(with_words(&config, demands.iter().map(|of| of.exponent)).unwrap()).unwrap();
        assert_eq!(source.rom().depth(), 7);
        let display = Display { bits: 8, transfer: Transfer::Linear };
        let own = rows(&source, &demands).unwrap();
        let bar = AtomicU64::new(0);
        let mut counts = Vec::new();
        for allowed in [0, 5, 60] {
            let served = serve(&source, &own, display, allowed, &bar);
            let rows = served_rows(&source, &demands, &served).unwrap();
            counts.push(serving(&rows).len());
            let small = derive(&source, &rows, "small").unwrap();
            let (_, parts) = certify(&source, &small, &rows, display, Some(allowed), &bar).unwrap();
            let codes = Codes::new(&Image { width: 1, height: 1, display_bits: 8, transfer: Transfer::Linear });
            for (part, row) in parts.iter().zip(&rows) {
                let answer = |design: &Design, n: f64, x: i64| {
                    let address = design.rom().exponents().position(n).unwrap() as u32;
                    let bits = design.datapath().evaluate(address, x).intensity;
                    codes.of(hw_model::quantise::real(bits, design.config().output))
                };
                let apart = |x: i64| answer(&source, part.n, x).abs_diff(answer(&small, row.serving, x));
                let worst = (part.first..=part.last).map(apart).max().unwrap();
                assert!(worst <= allowed, "n = {}", part.n);
                if let Some(shown) = part.served {
                    assert_eq!((shown.row, shown.codes), (row.serving, worst));
                }
            }
        }
        assert_eq!(counts[0], 5);
        assert!(counts[1] == 2 && counts[2] <= 2, "{counts:?}");
    }
}
