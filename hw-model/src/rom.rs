//! The coefficient ROM: rows, how a row is packed into a word, and which address an exponent has.
//!
//! A row holds what the pipeline must know of one exponent. Fields that are the same in every row
//! (c0 = 1 in the centred form, say) are constants of the hardware and take no place in the word. The
//! others are packed from bit 0 upwards, in the order of [`FieldName::ALL`].
//!
//! The address port has one value more than the ROM has words, at least, so that "an exponent
//! without a ROM word" can be said: every address from the depth up means it.

use std::fmt;

use dashu_int::UBig;

use crate::exponents::Exponents;
use crate::format::QFormat;

/// The fields of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FieldName {
    /// Coefficient of v³: a, or k3·2^−3e.
    C3,
    /// Coefficient of v²: b, or k2·2^−2e.
    C2,
    /// Coefficient of v: c, or k1·2^−e.
    C1,
    /// Constant coefficient: d, or 1.
    C0,
    /// The least x at which the polynomial answers.
    Cut,
    /// The places s = 1 − x is moved up to become u.
    Shift,
    /// A of the tail x/(A − B·x).
    TailA,
    /// B of the tail.
    TailB,
    /// Coefficient of v³ of the second segment.
    C3Outer,
    /// Coefficient of v² of the second segment.
    C2Outer,
    /// Coefficient of v of the second segment.
    C1Outer,
    /// Constant coefficient of the second segment.
    C0Outer,
    /// The least x of the first segment, from which v counts in the second.
    HandOver,
    /// The places `hand_over` − x is moved up to become v in the second segment.
    ShiftOuter,
}

impl FieldName {
    /// Every field, in the order in which they are packed.
    pub const ALL: [Self; 14] = [
        Self::C3,
        Self::C2,
        Self::C1,
        Self::C0,
        Self::Cut,
        Self::Shift,
        Self::TailA,
        Self::TailB,
        Self::C3Outer,
        Self::C2Outer,
        Self::C1Outer,
        Self::C0Outer,
        Self::HandOver,
        Self::ShiftOuter,
    ];
    /// c0, c1, c2, c3 of the first segment.
    pub const COEFFICIENTS: [Self; 4] = [Self::C0, Self::C1, Self::C2, Self::C3];
    /// The same of the second.
    pub const OUTER_COEFFICIENTS: [Self; 4] =
        [Self::C0Outer, Self::C1Outer, Self::C2Outer, Self::C3Outer];

    /// The name used in files and RTL.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::C3 => "c3",
            Self::C2 => "c2",
            Self::C1 => "c1",
            Self::C0 => "c0",
            Self::Cut => "cut",
            Self::Shift => "shift",
            Self::TailA => "tail_a",
            Self::TailB => "tail_b",
            Self::C3Outer => "c3_outer",
            Self::C2Outer => "c2_outer",
            Self::C1Outer => "c1_outer",
            Self::C0Outer => "c0_outer",
            Self::HandOver => "hand_over",
            Self::ShiftOuter => "shift_outer",
        }
    }
}

impl fmt::Display for FieldName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The bits of one row, in the formats of the [`Layout`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Row {
    values: [i64; FieldName::ALL.len()],
}

impl Row {
    /// A row of zeros.
    pub(crate) const EMPTY: Self = Self { values: [0; FieldName::ALL.len()] };

    /// The bits of a field; 0 where the configuration has no such field.
    #[inline]
    #[must_use]
    pub const fn get(&self, name: FieldName) -> i64 {
        self.values[name as usize]
    }

    /// Sets the bits of a field.
    pub const fn set(&mut self, name: FieldName, bits: i64) {
        self.values[name as usize] = bits;
    }

    /// The first segment's shift count. It is at most ⌊log2 n⌋, less than 64.
    #[inline]
    #[must_use]
    pub const fn shift(&self) -> u32 {
        self.get(FieldName::Shift) as u32
    }

    /// The second segment's.
    #[inline]
    #[must_use]
    pub const fn shift_outer(&self) -> u32 {
        self.get(FieldName::ShiftOuter) as u32
    }

    /// The row with the second segment's coefficients in the places of the first's.
    #[inline]
    #[must_use]
    pub fn in_outer(mut self) -> Self {
        for (to, from) in FieldName::COEFFICIENTS.into_iter().zip(FieldName::OUTER_COEFFICIENTS) {
            self.set(to, self.get(from));
        }
        self
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
        /// Its bits.
        bits: i64,
    },
}

/// One field of the layout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// Which field.
    pub name: FieldName,
    /// Its format.
    pub format: QFormat,
    /// Stored or constant.
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
    pub fn of(rows: &[Row], formats: &[(FieldName, QFormat)]) -> Self {
        let mut word_width = 0;
        let fields = formats
            .iter()
            .map(|&(name, format)| {
                let first = rows.first().map_or(0, |row| row.get(name));
                let constant = rows.len() > 1 && rows.iter().all(|row| row.get(name) == first);
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
    pub fn field(&self, name: FieldName) -> Option<&Field> {
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
            Place::Stored { lsb } => {
                word | (UBig::from(field.format.to_word(row.get(field.name))) << lsb as usize)
            }
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
    pub fn new(exponents: Exponents, rows: Vec<Row>, formats: &[(FieldName, QFormat)]) -> Self {
        debug_assert_eq!(exponents.len(), rows.len());
        let layout = Layout::of(&rows, formats);
        Self { exponents, rows, layout }
    }

    /// Number of words.
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

    fn formats() -> Vec<(FieldName, QFormat)> {
        let format = |text: &str| text.parse().unwrap();
        vec![
            (FieldName::C3, format("Q17.18")),
            (FieldName::C2, format("UQ1.62")),
            (FieldName::C0, format("UQ1.0")),
            (FieldName::Cut, format("UQ0.23")),
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
                row.set(FieldName::C3, i);
                row.set(FieldName::C0, 1);
                row
            })
            .collect();
        let layout = Layout::of(&rows, &formats());
        assert_eq!(layout.word_width(), 35);
        let constant = |name| layout.field(name).unwrap().place;
        assert_eq!(constant(FieldName::C0), Place::Constant { bits: 1 });
        assert_eq!(constant(FieldName::C3), Place::Stored { lsb: 0 });
        assert_eq!(Layout::of(&rows[..1], &formats()).word_width(), 35 + 63 + 1 + 23);
    }
    #[test]
    fn a_rom_counts_words_and_bits_and_finds_its_exponents() {
        let rows: Vec<Row> = (1..4)
            .map(|i| {
                let mut row = Row::default();
                row.set(FieldName::C3, i);
                row
            })
            .collect();
        let rom = Rom::new("1,2.5,8".parse().unwrap(), rows.clone(), &formats());
        assert_eq!((rom.depth(), rom.address_width(), rom.bits()), (3, 2, 3 * 35));
        assert_eq!([1.0, 2.5, 8.0, 9.0].map(|n| rom.address_of(n)), [0, 1, 2, 3]);
        assert_eq!((rom.row(2), rom.row(3)), (Some(&rows[2]), None));
        let names: Vec<String> =
            rom.layout().fields().iter().map(|field| field.name.to_string()).collect();
        assert_eq!(names, ["c3", "c2", "c0", "cut"]);
        // One place more than words where these are a power of two.
        let four = Rom::new("1..=4".parse().unwrap(), vec![Row::default(); 4], &formats());
        assert_eq!(four.address_width(), 3);
    }

    /// Configurations, columns, RTL and documentation have these names.
    #[test]
    fn fields_have_their_names() {
        let names = |fields: [FieldName; 4]| fields.map(FieldName::name);
        assert_eq!(names(FieldName::COEFFICIENTS), ["c0", "c1", "c2", "c3"]);
        let outer = ["c0_outer", "c1_outer", "c2_outer", "c3_outer"];
        assert_eq!(names(FieldName::OUTER_COEFFICIENTS), outer);
        let others = [FieldName::Cut, FieldName::HandOver, FieldName::Shift, FieldName::ShiftOuter];
        assert_eq!(names(others), ["cut", "hand_over", "shift", "shift_outer"]);
        assert_eq!(format!("{:>7}", FieldName::TailA), " tail_a");
        assert_eq!(FieldName::TailB.name(), "tail_b");
    }
}
