//! How ports are laid side by side in one memory word.

use dashu_int::UBig;
use hw_model::datapath::Datapath;
use hw_model::format::QFormat;
use hw_model::rom::{Layout, Place};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Why a layout that was read is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// The width is another one than that of all fields.
    #[error("width: {width}; its fields have {bits} bits together")]
    Width {
        /// The width as stated.
        width: u32,
        /// Bits of the fields.
        bits: u64,
    },
    /// A field lies elsewhere.
    #[error("field `{name}`: below what stands before it, {format} is bits {msb} to {lsb}")]
    Place {
        /// The name of the field.
        name: String,
        /// The format that the layout gives the field.
        format: QFormat,
        /// The highest bit it should have.
        msb: u32,
        /// The lowest bit it should have.
        lsb: u32,
    },
    /// The layout has other fields than the word needs.
    #[error("fields: from the highest bits down they are {wanted}")]
    Names {
        /// The names of the fields that the word needs, in order.
        wanted: String,
    },
}

/// One field of a word.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WordField {
    /// The port or ROM field.
    pub name: String,
    /// Its format; the bits are two's complement where it is signed.
    pub format: QFormat,
    /// Its highest bit in the word.
    pub msb: u32,
    /// Its lowest bit in the word.
    pub lsb: u32,
}

/// The fields of a word, from the highest bits down, as in a Verilog concatenation.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WordLayout {
    /// Bits of the word.
    pub width: u32,
    /// The fields, from the lowest bit upwards.
    pub fields: Vec<WordField>,
}

impl WordLayout {
    /// The layout of a stimulus word, `{address, x}`: the address above x.
    #[must_use]
    pub fn stimulus(datapath: &Datapath) -> Self {
        let address = QFormat::field(datapath.rom().address_width());
        Self::of(&[("address", address), ("x", datapath.formats().input)])
    }

    /// The layout of an expected word, `{status, intensity}`: the status above the intensity.
    #[must_use]
    pub fn expected(datapath: &Datapath) -> Self {
        let status = QFormat::field(datapath.status_width());
        Self::of(&[("status", status), ("intensity", datapath.formats().output)])
    }

    /// The stored fields of a ROM word, as [`Layout::pack`] packs them.
    #[must_use]
    pub fn rom(layout: &Layout) -> Self {
        let stored = layout.fields().iter().rev().filter_map(|field| match field.place {
            Place::Stored { lsb } => Some(WordField {
                name: field.name.to_string(),
                format: field.format,
                msb: lsb + field.format.width() - 1,
                lsb,
            }),
            Place::Constant { .. } => None,
        });
        Self { width: layout.word_width(), fields: stored.collect() }
    }

    fn of(ports: &[(&str, QFormat)]) -> Self {
        let width = ports.iter().map(|(_, format)| format.width()).sum();
        let mut above = width;
        let fields = ports.iter().map(|&(name, format)| {
            let msb = above - 1;
            above -= format.width();
            WordField { name: name.to_owned(), format, msb, lsb: above }
        });
        Self { width, fields: fields.collect() }
    }

    /// Checks that the fields lie side by side and are the whole word: what a layout that was read may say of its
    /// width is then no more than its fields have.
    ///
    /// # Errors
    /// Says which field lies elsewhere, and where it should.
    pub fn check(&self) -> Result<(), LayoutError> {
        let bits = self.fields.iter().map(|field| u64::from(field.format.width())).sum::<u64>();
        if bits != u64::from(self.width) {
            return Err(LayoutError::Width { width: self.width, bits });
        }
        let mut above = self.width;
        for WordField { name, format, msb, lsb } in &self.fields {
            let expected = above - format.width();
            if (*msb, *lsb) != (above - 1, expected) {
                let (name, msb) = (name.clone(), above - 1);
                return Err(LayoutError::Place { name, format: *format, msb, lsb: expected });
            }
            above = expected;
        }
        Ok(())
    }

    /// Checks that the fields have these names, from the highest bits down.
    ///
    /// # Errors
    /// When they have others.
    pub fn check_names(&self, names: &[&'static str]) -> Result<(), LayoutError> {
        let found = self.fields.iter().map(|field| field.name.as_str());
        if found.eq(names.iter().copied()) {
            return Ok(());
        }
        Err(LayoutError::Names { wanted: names.join(", ") })
    }

    /// Hex digits of a word; a word without bits still takes one.
    #[must_use]
    pub fn digits(&self) -> usize {
        self.width.div_ceil(4).max(1) as usize
    }

    /// The word of these bits, given in the order of the fields. For the port words, which have at
    /// most 80 bits.
    #[must_use]
    pub fn pack(&self, bits: &[i64]) -> u128 {
        debug_assert_eq!(bits.len(), self.fields.len());
        self.fields
            .iter()
            .zip(bits)
            .fold(0, |word, (field, &bits)| word | u128::from(field.format.to_word(bits)) << field.lsb)
    }

    /// The bits of a port word, in the order of the fields, as [`pack`](Self::pack) packed them.
    pub fn unpack_ports(&self, word: u128) -> impl Iterator<Item = i64> {
        self.fields.iter().map(move |field| field.format.from_word((word >> field.lsb) as u64))
    }

    /// The bits of a word, in the order of the fields; what lies above the width is ignored.
    #[must_use]
    pub fn unpack(&self, word: &UBig) -> Vec<i64> {
        let bits = |field: &WordField| {
            let low = (word >> field.lsb as usize) & UBig::from(u64::MAX);
            // Masked to 64 bits just above, so the conversion cannot fail.
            field.format.from_word(u64::try_from(low).unwrap_or_default())
        };
        self.fields.iter().map(bits).collect()
    }
}
