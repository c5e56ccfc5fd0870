//! Decimal digits, eight in a word, and the shortest decimals of many binary fractions side by side.

use hw_model::format::QFormat;
use multiversion::multiversion;

/// Eight times the digit 0.
pub(super) const ZEROS: u64 = u64::from_le_bytes(*b"00000000");

/// The digits of a number below 10⁸, the first in the lowest byte. Each step parts every number in two, in place: by
/// 10 000, by 100, by 10.
#[inline(always)]
pub(super) const fn eight_digits(number: u64) -> u64 {
    let ten_thousands = (number * 3_518_437_209) >> 45;
    let fours = ten_thousands | ((number - 10_000 * ten_thousands) << 32);
    let hundreds = ((fours * 10_486) >> 20) & 0x0000_007f_0000_007f;
    let twos = hundreds | ((fours - 100 * hundreds) << 16);
    let tens = ((twos * 103) >> 10) & 0x000f_000f_000f_000f;
    tens | ((twos - 10 * tens) << 8)
}

/// The shortest decimals of a column of numbers from 0 to 1, in memory that is used again: of each the text up to the
/// first decimal, and the [digits](eight_digits) of the next eight and eight. No text is there for a number that is not
/// from 0 to 1, or so long or small that 17 decimals need not be enough.
#[derive(Debug, Default)]
pub(super) struct Decimals {
    heads: Vec<u64>,
    high: Vec<u64>,
    low: Vec<u64>,
}

impl Decimals {
    /// Of bits in a format.
    pub(super) fn of(&mut self, bits: impl ExactSizeIterator<Item = i64>, format: QFormat) {
        self.heads.clear();
        self.heads.extend(bits.map(|bits| bits as u64));
        self.high.resize(self.heads.len(), 0);
        self.low.resize(self.heads.len(), 0);
        match BITS.checked_sub(format.fraction_bits()) {
            Some(places) => write_all(places, &mut self.heads, &mut self.high, &mut self.low),
            None => self.heads.fill(0),
        }
    }

    /// The text of a number, and how many of its bytes count; none where another way is needed.
    #[inline(always)]
    pub(super) fn text(&self, index: usize) -> Option<([u64; 3], usize)> {
        let text = [self.heads[index], self.high[index], self.low[index]];
        let [head, high, low] = text;
        // Up to the last digit that is not 0; where there is none, the point goes as well.
        let behind_head = 16 - ((u128::from(low) << 64) | u128::from(high)).leading_zeros() as usize / 8;
        let count = if behind_head == 0 && head >> 16 == u64::from(b'0') { 1 } else { HEAD + behind_head };
        (head != 0).then_some((text, count))
    }
}

/// The bytes of a head: a digit, the point, and a digit.
pub(super) const HEAD: usize = 3;

/// The most fraction bits of a number; others are brought to so many.
const BITS: u32 = 24;
/// What is left of a decimal is counted in 2⁻¹⁵ of its last place.
const PARTS: u32 = BITS - 9;
const ALL_PARTS: u64 = (1 << PARTS) - 1;
/// 2⁻⁵⁴ in parts of 10⁻¹⁷, rounded down.
const NEAR: u64 = 10_u64.pow(17) >> (54 - PARTS);

/// Writes the [`shortest`] decimals of all numbers, which stand where their heads are wanted.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn write_all(places: u32, heads: &mut [u64], high: &mut [u64], low: &mut [u64]) {
    for ((head, high), low) in heads.iter_mut().zip(high).zip(low) {
        [*head, *high, *low] = shortest(*head, places);
    }
}

/// The head and the digits of a number, which is brought to 24 fraction bits by so many places.
///
/// An f64 from 2⁻ᵏ to 2¹⁻ᵏ is the nearest f64 of every number within 2⁻⁵³⁻ᵏ of it. From 1/16 up that is more than half
/// of 10⁻¹⁷, so the shortest decimal is a multiple of 10⁻¹⁷: or of 10⁻¹⁶ or 10⁻¹⁵ where the nearest of those is so
/// near. None is exactly so near, which would take more decimals; and a power of two, next to which f64 are nearer, is
/// a multiple itself. With 15 fraction bits or fewer, every number is a multiple of 10⁻¹⁵.
#[inline(always)]
const fn shortest(number: u64, places: u32) -> [u64; 3] {
    let one = 1 << (BITS - places);
    let least = if places >= BITS - 15 { 0 } else { one >> 4 };
    let moved = (number << places) & ((1 << BITS) - 1);
    // Nine decimals, eight more, and what is left.
    let nine = moved * 5_u64.pow(9);
    let eight = (nine & ALL_PARTS) * 100_000_000;
    let (nine, eight, rest) = (nine >> PARTS, eight >> PARTS, eight & ALL_PARTS);
    let two = eight - 100 * ((eight * 1_374_389_535) >> 37);
    let ten = (two * 103) >> 10;
    let exact = (two << PARTS) | rest;
    let of_ten = exact - ((10 * ten) << PARTS);
    // The nearest multiples, a tie to the even one.
    let hundreds: u64 = if exact > (50 << PARTS) { 100 << PARTS } else { 0 };
    let tens: u64 = exact - of_ten + if of_ten + (ten & 1) > (5 << PARTS) { 10 << PARTS } else { 0 };
    let units = exact - rest + if rest + (two & 1) > (1 << (PARTS - 1)) { 1 << PARTS } else { 0 };
    let zeros = (moved < 1 << 23) as u32 + (moved < 1 << 22) as u32 + (moved < 1 << 21) as u32;
    let near = NEAR >> zeros;
    let nearest = if tens.abs_diff(exact) <= near { tens } else { units };
    let nearest = if hundreds.abs_diff(exact) <= near { hundreds } else { nearest };
    let eight = eight - two + (nearest >> PARTS);
    let carry = (eight == 100_000_000) as u64;
    let nine = nine + carry;
    let first = (nine * 1_441_151_881) >> 57;
    let head = (ZEROS & 0xff_00ff) | (b'.' as u64) << 8 | (number == one) as u64 | first << 16;
    let head = if number >= least && number <= one { head } else { 0 };
    [head, eight_digits(nine - 100_000_000 * first), eight_digits(eight - 100_000_000 * carry)]
}
