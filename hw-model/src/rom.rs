//! The coefficient ROM: rows, how a row is packed into a word, and which address an exponent has.
//!
//! A row holds what the pipeline must know of one exponent. Fields that are the same in every row
//! (c0 = 1 in the centred form, say) are constants of the hardware and take no place in the word. The
//! others are packed from bit 0 upwards, in the order of [`Register::in_rom`].
//!
//! The address port has one value more than the ROM has words, at least, so that "an exponent
//! without a ROM word" can be said: every address from the depth up means it.

use dashu_int::UBig;

use crate::exponents::Exponents;
use crate::format::QFormat;
use crate::registers::{MAX_DEGREE, Register};

/// The bits of one row, in the formats of the [`Layout`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Row {
    values: [i64; Register::ROM_COUNT],
}

impl Row {
    /// A row of zeros.
    pub(crate) const EMPTY: Self = Self { values: [0; Register::ROM_COUNT] };

    /// The bits of a field; 0 where the configuration has no such field, and for a register that is in no ROM.
    #[inline(always)]
    #[must_use]
    pub const fn get(&self, field: Register) -> i64 {
        self.at(field.index())
    }

    /// The bits of the field at a place in [`Register::all`]. Who reads one field of many rows finds its place before
    /// the loop: compilers ask in the loop for the segment of a field that has none, which harms nothing, and is a jump
    /// on memory nobody wrote in the eyes of Valgrind.
    #[inline(always)]
    #[must_use]
    pub(crate) const fn at(&self, index: usize) -> i64 {
        if index < Register::ROM_COUNT { self.values[index] } else { 0 }
    }

    /// Sets the bits of a field; of a register that is in no ROM there are none to set.
    pub const fn set(&mut self, field: Register, bits: i64) {
        self.set_at(field.index(), bits);
    }

    /// The same at a place in [`Register::all`], for a loop over rows.
    pub(crate) const fn set_at(&mut self, index: usize, bits: i64) {
        if index < Register::ROM_COUNT {
            self.values[index] = bits;
        }
    }

    /// The shift count of a segment. It is at most ⌊log2 n⌋ or 62, less than 64.
    #[inline(always)]
    #[must_use]
    pub const fn shift(&self, segment: usize) -> u32 {
        self.get(Register::Shift(segment)) as u32
    }

    /// The row with a segment's coefficients in the places of the first's.
    #[inline]
    #[must_use]
    pub fn in_segment(mut self, segment: usize) -> Self {
        for power in 0..=MAX_DEGREE {
            self.set(Register::C(0, power), self.get(Register::C(segment, power)));
        }
        self
    }
}

/// Where the data path finds the fields of a request's row.
pub trait Fetched {
    /// The bits of a field; 0 where the configuration has no such field.
    fn get(&self, field: Register) -> i64;
    /// False where the address has no word, and the fields are those of another one.
    fn known(&self) -> bool;
    /// True where it is known beforehand that the polynomial answers, whatever x is.
    #[inline(always)]
    fn is_polynomial(&self) -> bool {
        false
    }
}

impl Fetched for Row {
    #[inline(always)]
    fn get(&self, field: Register) -> i64 {
        Self::get(self, field)
    }
    #[inline(always)]
    fn known(&self) -> bool {
        true
    }
}

impl Default for Row {
    fn default() -> Self {
        Self::EMPTY
    }
}

/// Where a field lives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In the word, from this bit upwards.
    Stored {
        /// The field's lowest bit in the word.
        lsb: u32,
    },
    /// The same in every row: a constant of the hardware.
    Constant {
        /// The field's value in every row, as bits in its format.
        bits: i64,
    },
}

/// One field of the layout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// The name, which says what the field is for.
    pub name: Register,
    /// The format of its bits.
    pub format: QFormat,
    /// Where it lives: in the word, or in the hardware as a constant.
    pub place: Place,
}

/// How a row is packed into a word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layout {
    fields: Vec<Field>,
    word_width: u32,
}

impl Layout {
    /// The layout of these rows: a field that never changes is a constant, unless there is only one
    /// row (every field would be one, and the ROM image empty).
    #[must_use]
    pub fn of(rows: &[Row], formats: &[(Register, QFormat)]) -> Self {
        let mut word_width = 0;
        let mut formats = formats.to_vec();
        formats.sort_by_key(|(name, _)| name.index());
        let fields = formats
            .into_iter()
            .map(|(name, format)| {
                let index = name.index();
                let first = rows.first().map_or(0, |row| row.at(index));
                let constant = rows.len() > 1 && rows.iter().all(|row| row.at(index) == first);
                let place = if constant {
                    Place::Constant { bits: first }
                } else {
                    let lsb = word_width;
                    word_width += format.width();
                    Place::Stored { lsb }
                };
                Field { name, format, place }
            })
            .collect();
        Self { fields, word_width }
    }

    /// The fields the configuration has, in packing order.
    #[must_use]
    pub fn fields(&self) -> &[Field] {
        &self.fields
    }

    /// One field, where the configuration has it.
    #[must_use]
    pub fn field(&self, name: Register) -> Option<&Field> {
        self.fields.iter().find(|field| field.name == name)
    }

    /// Bits of a word.
    #[must_use]
    pub const fn word_width(&self) -> u32 {
        self.word_width
    }

    /// The word of a row.
    #[must_use]
    pub fn pack(&self, row: &Row) -> UBig {
        self.fields.iter().fold(UBig::ZERO, |word, field| match field.place {
            Place::Constant { .. } => word,
            Place::Stored { lsb } => word | (UBig::from(field.format.to_word(row.get(field.name))) << lsb as usize),
        })
    }

    /// The row of a word; bits above the word's width are ignored.
    #[must_use]
    pub fn unpack(&self, word: &UBig) -> Row {
        let mut row = Row::default();
        for field in &self.fields {
            let bits = match field.place {
                Place::Constant { bits } => bits,
                Place::Stored { lsb } => {
                    let low = (word >> lsb as usize) & UBig::from(u64::MAX);
                    // Masked to 64 bits just above, so the conversion cannot fail.
                    field.format.from_word(u64::try_from(low).unwrap_or_default())
                }
            };
            row.set(field.name, bits);
        }
        row
    }
}

/// The ROM of one configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Rom {
    exponents: Exponents,
    rows: Vec<Row>,
    layout: Layout,
}

impl Rom {
    /// The ROM with one row for each exponent, in order.
    #[must_use]
    pub fn new(exponents: Exponents, rows: Vec<Row>, formats: &[(Register, QFormat)]) -> Self {
        debug_assert_eq!(exponents.len(), rows.len());
        let layout = Layout::of(&rows, formats);
        Self { exponents, rows, layout }
    }

    /// Number of words, which is the number of exponents.
    #[must_use]
    pub const fn depth(&self) -> usize {
        self.rows.len()
    }

    /// How a word is made up.
    #[must_use]
    pub const fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The exponents, in the order of their addresses.
    #[must_use]
    pub const fn exponents(&self) -> &Exponents {
        &self.exponents
    }

    /// Every row, in the order of their addresses.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The row at an address, where there is one.
    #[inline]
    #[must_use]
    pub fn row(&self, address: u32) -> Option<&Row> {
        self.rows.get(address as usize)
    }

    /// The address of an exponent; for one without a word, the first address past the end.
    #[inline]
    #[must_use]
    pub fn address_of(&self, exponent: f64) -> u32 {
        self.exponents.position(exponent).unwrap_or(self.depth()) as u32
    }

    /// Bits of the address port: enough for every word and one address more.
    #[must_use]
    pub const fn address_width(&self) -> u32 {
        usize::BITS - self.depth().leading_zeros()
    }

    /// Bits the ROM stores: depth times word width.
    #[must_use]
    pub const fn bits(&self) -> u64 {
        self.depth() as u64 * self.layout.word_width() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn formats() -> Vec<(Register, QFormat)> {
        let format = |text: &str| text.parse().unwrap();
        vec![
            (Register::C(0, 3), format("Q17.18")),
            (Register::C(0, 2), format("UQ1.62")),
            (Register::C(0, 0), format("UQ1.0")),
            (Register::Cut, format("UQ0.23")),
        ]
    }

    proptest! {
        #[test]
        fn a_word_comes_back(values in prop::collection::vec((any::<i64>(), any::<i64>(), any::<i64>()), 1..9)) {
            let mut rows = Vec::new();
            for (c3, c2, cut) in values {
                let mut row = Row::default();
                for ((name, format), bits) in formats().into_iter().zip([c3, c2, 1, cut]) {
                    row.set(name, format.from_word(bits as u64));
                }
                rows.push(row);
            }
            let layout = Layout::of(&rows, &formats());
            for row in &rows {
                let word = layout.pack(row);
                prop_assert!(word < UBig::ONE << layout.word_width() as usize);
                prop_assert_eq!(layout.unpack(&word), *row);
            }
        }
    }

    #[test]
    fn a_field_that_never_changes_takes_no_place() {
        let rows: Vec<Row> = (0..4)
            .map(|i| {
                let mut row = Row::default();
                row.set(Register::C(0, 3), i);
                row.set(Register::C(0, 0), 1);
                row
            })
            .collect();
        let layout = Layout::of(&rows, &formats());
        assert_eq!(layout.word_width(), 35);
        let constant = |name| layout.field(name).unwrap().place;
        assert_eq!(constant(Register::C(0, 0)), Place::Constant { bits: 1 });
        assert_eq!(constant(Register::C(0, 3)), Place::Stored { lsb: 0 });
        assert_eq!(Layout::of(&rows[..1], &formats()).word_width(), 35 + 63 + 1 + 23);
    }
    #[test]
    fn a_rom_counts_words_and_bits_and_finds_its_exponents() {
        let rows: Vec<Row> = (1..4)
            .map(|i| {
                let mut row = Row::default();
                row.set(Register::C(0, 3), i);
                row
            })
            .collect();
        let rom = Rom::new("1,2.5,8".parse().unwrap(), rows.clone(), &formats());
        assert_eq!((rom.depth(), rom.address_width(), rom.bits()), (3, 2, 3 * 35));
        assert_eq!([1.0, 2.5, 8.0, 9.0].map(|n| rom.address_of(n)), [0, 1, 2, 3]);
        assert_eq!((rom.row(2), rom.row(3)), (Some(&rows[2]), None));
        let names: Vec<String> = rom.layout().fields().iter().map(|field| field.name.to_string()).collect();
        assert_eq!(names, ["c3", "c2", "c0", "cut"]);
        // One place more than words where these are a power of two.
        let four = Rom::new("1..=4".parse().unwrap(), vec![Row::default(); 4], &formats());
        assert_eq!(four.address_width(), 3);
    }
}
