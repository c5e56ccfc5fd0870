//! Bits of registers that cannot change, and why: from the ROM's own integers, and from the exact reach of the lines.

use hw_model::datapath::front_end::Region;
use hw_model::datapath::reach::{PolynomialReach, Reach, TailReach};
use hw_model::datapath::{Datapath, RankRegister, Status};
use hw_model::registers::Register;

/// Bits that are always the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fixed {
    /// The bits.
    pub mask: u64,
    /// What they are.
    pub value: u64,
    /// Why.
    pub reason: String,
}

impl Fixed {
    pub(super) const fn nothing() -> Self {
        Self { mask: 0, value: 0, reason: String::new() }
    }
}

/// What is known of a data path's registers.
#[derive(Debug)]
pub struct Known<'a> {
    datapath: &'a Datapath,
    polynomial: Option<PolynomialReach>,
    tail: Option<TailReach>,
}

impl<'a> Known<'a> {
    /// Works the reaches out, which takes a moment.
    #[must_use]
    pub fn of(datapath: &'a Datapath) -> Self {
        Self { datapath, polynomial: datapath.polynomial_reach(), tail: datapath.tail_reach() }
    }

    /// The bits of a register that no sequence of requests changes; none where nothing is known. That a bit is not
    /// among them says nothing: values between the least and the greatest need not all be taken.
    #[must_use]
    pub fn fixed(&self, rank: usize, register: &RankRegister) -> Option<Fixed> {
        let format = register.format;
        let fixed = self.any(rank, register.register, &|bits| format.to_word(bits))?;
        let mask = fixed.mask & (u64::MAX >> (64 - format.width()));
        (mask != 0).then_some(Fixed { mask, ..fixed })
    }

    fn any(&self, rank: usize, register: Register, word: &dyn Fn(i64) -> u64) -> Option<Fixed> {
        let datapath = self.datapath;
        match register {
            // Behind the fetch, the register of a coefficient holds that of whichever segment answers.
            Register::C(_, power) if rank > 0 => {
                let segments = 0..datapath.segment_count();
                in_rom(datapath, &segments.map(|segment| Register::C(segment, power)).collect::<Vec<_>>(), word)
            }
            Register::C(..) | Register::Cut | Register::HandOver(_) | Register::Shift(_) => {
                in_rom(datapath, &[register], word)
            }
            Register::TailA | Register::TailB => in_rom(datapath, &[register], word),
            Register::V => Some(within(&self.polynomial.as_ref()?.v, word)),
            Register::T(stage) => Some(within(self.polynomial.as_ref()?.lines.get(stage - 1)?, word)),
            Register::TailX => Some(within(&self.tail.as_ref()?.x, word)),
            Register::Divisor => Some(within(&self.tail.as_ref()?.divisor, word)),
            Register::Remainder if Some(rank) == first_rank(datapath, register) => {
                Some(within(&self.tail.as_ref()?.first_remainder, word))
            }
            Register::Remainder => {
                let greatest = self.tail.as_ref()?.divisor.greatest.bits - 1;
                let reason = format!("a remainder is 0 to {greatest}, less than the greatest divisor");
                Some(between(0, greatest, word, reason))
            }
            Register::Intensity => {
                let greatest = datapath.output_one();
                Some(between(0, greatest, word, format!("an intensity is 0 to {greatest}")))
            }
            Register::Region => Some(of_regions(datapath)),
            Register::Digits => self.digits(rank, word),
            Register::Status => Some(self.flags(rank)),
            // x is whatever is asked. What stands in the ranks inside a line has no reach of its own yet.
            Register::X
            | Register::Distance(_)
            | Register::Beyond
            | Register::Partial(..)
            | Register::Product(_)
            | Register::Sum(_) => None,
        }
    }

    /// Dividend and quotient bits share a register. The dividend is x, moved up: the bits that come in below it are 0,
    /// and go up as quotient bits come in below them.
    fn digits(&self, rank: usize, word: &dyn Fn(i64) -> u64) -> Option<Fixed> {
        let divider = self.datapath.divider()?;
        let steps = (rank - first_rank(self.datapath, Register::Digits)?) as u32;
        let found = (steps * divider.digits_per_stage).min(u64::BITS - 1);
        let zeros = (1_u64 << divider.dividend_up.min(u64::BITS - 1)) - 1;
        if steps >= divider.digit_stages() {
            return Some(within(&self.tail.as_ref()?.quotient, word));
        }
        Some(Fixed { mask: zeros << found, value: 0, reason: "the dividend has zeros there".to_owned() })
    }

    /// Flags that are never set in this rank.
    fn flags(&self, rank: usize) -> Fixed {
        let datapath = self.datapath;
        let (input, one) = (datapath.formats().input, datapath.output_one());
        let last = rank + 1 == datapath.rank_count();
        let front_end = first_rank(datapath, Register::Region).is_some_and(|first| rank >= first) || last;
        let clamps = self.polynomial.as_ref().map_or(datapath.degree() > 0, |polynomial| {
            polynomial.last().least.bits < 0 || polynomial.last().greatest.bits > one
        });
        let can = |flag: Status| match flag {
            Status::NO_WORD => true,
            Status::ABOVE_ONE => front_end && input.max_bits() > datapath.front_end().greatest,
            Status::FACING_AWAY => front_end && input.is_signed(),
            Status::CLAMPED => last && clamps,
            _ => front_end,
        };
        let never = datapath.status_flags().iter().filter(|(flag, _)| !can(*flag));
        let names: Vec<&str> = never.clone().map(|(_, name)| *name).collect();
        let mask = never.fold(0, |mask, (flag, _)| mask | u64::from(flag.bits()));
        Fixed { mask, value: 0, reason: format!("never set here: {}", names.join(", ")) }
    }
}

/// The first rank that has a register.
fn first_rank(datapath: &Datapath, register: Register) -> Option<usize> {
    (0..datapath.rank_count()).find(|&rank| datapath.registers(rank).iter().any(|held| held.register == register))
}

/// Bits that are the same in every word of the ROM.
fn in_rom(datapath: &Datapath, fields: &[Register], word: &dyn Fn(i64) -> u64) -> Option<Fixed> {
    let rows = (0..datapath.rom().depth() as u32).map(|address| datapath.row(address));
    let values: Vec<u64> = rows.flat_map(|row| fields.iter().map(move |&field| row.get(field))).map(word).collect();
    let mask = same(values.iter().copied());
    Some(Fixed { mask, value: *values.first()?, reason: "every word of the ROM has the same there".to_owned() })
}

fn within(reach: &Reach, word: &dyn Fn(i64) -> u64) -> Fixed {
    let (least, greatest) = (reach.least.bits, reach.greatest.bits);
    between(least, greatest, word, format!("its values are {least} to {greatest} over every ROM row and every x"))
}

/// Bits that no two integers of the range differ in: those above the highest bit in which its ends do.
fn between(least: i64, greatest: i64, word: &dyn Fn(i64) -> u64, reason: String) -> Fixed {
    let differing = (least ^ greatest) as u64;
    let mask = u64::MAX.checked_shl(64 - differing.leading_zeros()).unwrap_or(0);
    Fixed { mask, value: word(least), reason }
}

/// Bits of the region's number that the regions of this data path have in common.
fn of_regions(datapath: &Datapath) -> Fixed {
    let regions = regions(datapath);
    let names: Vec<&str> = regions.iter().map(|region| region.name()).collect();
    let mask = same(regions.iter().map(|&region| region as u64));
    Fixed { mask, value: 0, reason: format!("its regions are {}", names.join(", ")) }
}

/// The regions that a data path has.
#[must_use]
pub fn regions(datapath: &Datapath) -> Vec<Region> {
    let polynomial = (datapath.degree() > 0).then_some(Region::Polynomial);
    let tail = datapath.divider().map(|_| Region::Tail);
    [Some(Region::Zero), polynomial, tail].into_iter().flatten().collect()
}

/// The bits in which all words are the same.
fn same(words: impl Iterator<Item = u64>) -> u64 {
    let (and, or) = words.fold((u64::MAX, 0), |(and, or), word| (and & word, or | word));
    and | !or
}
