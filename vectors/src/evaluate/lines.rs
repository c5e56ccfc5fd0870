//! Lines of numbers as text: of an f64 the shortest decimal that no other f64 has, without `.0`.

use hw_model::format::QFormat;
use hw_model::quantise::real;

use super::digits::{Decimals, HEAD, ZEROS, eight_digits};

/// The texts of a column of numbers, in memory that is used again.
///
/// A processor that reads bytes while those that wrote them are under way waits for these: so a column is written as a
/// whole before its texts are taken into lines.
#[derive(Default)]
pub(super) struct Texts(Vec<zmij::Buffer>);

impl Texts {
    /// Of these numbers; nothing for NaN.
    pub(super) fn of(&mut self, numbers: impl ExactSizeIterator<Item = f64>) -> Vec<&str> {
        self.0.resize_with(numbers.len(), zmij::Buffer::new);
        self.0.iter_mut().zip(numbers).map(|(buffer, number)| shortest(buffer, number)).collect()
    }
}

#[inline]
fn shortest(buffer: &mut zmij::Buffer, number: f64) -> &str {
    if number.is_nan() {
        return "";
    }
    buffer.format_finite(number)
}

/// A short text that is written often.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word {
    bytes: [u8; WORD],
    count: usize,
}

/// The most bytes of a [`Word`], such as an f64 from 1 to 10¹⁵ without an exponent.
const WORD: usize = 24;

impl Word {
    /// Of a text, without what is too long.
    pub(super) fn new(text: &str) -> Self {
        let mut bytes = [0; WORD];
        let count = bytes.iter_mut().zip(text.bytes()).map(|(to, byte)| *to = byte).count();
        Self { bytes, count }
    }

    /// Of a number from 1 to 10¹⁵.
    pub(super) fn number(number: f64) -> Self {
        Self::new(without_point(shortest(&mut zmij::Buffer::new(), number)))
    }
}

fn without_point(text: &str) -> &str {
    text.strip_suffix(".0").unwrap_or(text)
}

/// The most bytes of a line: eight fields, none longer than 24, and what separates them.
const LONGEST: usize = 200;
/// The most bytes that are written at a time.
const PIECE: usize = 32;

/// Room for lines, which is used again.
#[derive(Default)]
pub(super) struct Room(Vec<u8>);

impl Room {
    /// Begins so many lines.
    pub(super) fn lines(&mut self, count: usize) -> Lines<'_> {
        let size = count * LONGEST + PIECE;
        self.0.resize(size.max(self.0.len()), 0);
        Lines { room: &mut self.0, end: 0 }
    }
}

/// Lines under way, and the room behind them.
pub(super) struct Lines<'a> {
    room: &'a mut [u8],
    end: usize,
}

impl Lines<'_> {
    /// What was written.
    pub(super) fn written(&self) -> &[u8] {
        &self.room[..self.end]
    }

    /// A byte.
    #[inline]
    pub(super) fn byte(&mut self, byte: u8) {
        self.room[self.end] = byte;
        self.end += 1;
    }

    /// A number as text, without `.0`.
    #[inline(always)]
    pub(super) fn number(&mut self, text: &str) {
        self.text(without_point(text));
    }

    /// A short text.
    #[inline(always)]
    fn text(&mut self, text: &str) {
        let text = text.as_bytes();
        let place = self.place();
        match text.len() {
            8..=24 => in_pieces::<8>(text, place),
            2..=6 => in_pieces::<2>(text, place),
            length => place[..length].copy_from_slice(text),
        }
        self.end += text.len();
    }

    /// A short text.
    #[inline(always)]
    pub(super) fn word(&mut self, word: &Word) {
        self.place()[..WORD].copy_from_slice(&word.bytes);
        self.end += word.count;
    }

    /// An exponent, where there is one.
    pub(super) fn exponent(&mut self, exponent: Option<f64>) {
        if let Some(exponent) = exponent {
            self.number(shortest(&mut zmij::Buffer::new(), exponent));
        }
    }

    /// A whole number.
    #[inline(always)]
    pub(super) fn whole(&mut self, number: i64) {
        match number {
            0..10 => self.byte(b'0' + number as u8),
            10..100_000_000 => {
                let digits = eight_digits(number as u64);
                let zeros = digits.trailing_zeros() / 8;
                self.place()[..8].copy_from_slice(&((digits | ZEROS) >> (8 * zeros)).to_le_bytes());
                self.end += 8 - zeros as usize;
            }
            _ => self.text(&number.to_string()),
        }
    }

    /// The real value of bits in a format, whose decimals are in this place of a column.
    #[inline(always)]
    pub(super) fn fixed(&mut self, decimals: &Decimals, index: usize, bits: i64, format: QFormat) {
        let Some(([head, high, low], count)) = decimals.text(index) else {
            return self.number(shortest(&mut zmij::Buffer::new(), real(bits, format)));
        };
        let place = self.place();
        place[..8].copy_from_slice(&head.to_le_bytes());
        place[HEAD..][..8].copy_from_slice(&(high | ZEROS).to_le_bytes());
        place[HEAD + 8..][..8].copy_from_slice(&(low | ZEROS).to_le_bytes());
        self.end += count;
    }

    #[inline(always)]
    fn place(&mut self) -> &mut [u8] {
        &mut self.room[self.end..self.end + PIECE]
    }
}

/// Copies one to three times as many bytes as a piece has, as three pieces that may overlap: there is no choice in it
/// by the length, which no processor could foresee.
#[inline(always)]
fn in_pieces<const PIECE: usize>(text: &[u8], place: &mut [u8]) {
    let last = text.len() - PIECE;
    for start in [0, last.min(PIECE), last] {
        place[start..][..PIECE].copy_from_slice(&text[start..][..PIECE]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn written(write: impl Fn(&mut Lines<'_>)) -> String {
        let mut room = Room::default();
        let mut lines = room.lines(1);
        write(&mut lines);
        String::from_utf8(lines.written().to_vec()).unwrap()
    }

    fn shortest_of(number: f64) -> String {
        let text = zmij::Buffer::new().format(number).to_owned();
        text.strip_suffix(".0").unwrap_or(&text).to_owned()
    }

    #[test]
    fn every_value_of_a_format_is_its_shortest_text() {
        // Ties have at most 18 fraction bits; of the longer ones every 37th.
        for format in [
            "UQ1.15", "UQ1.14", "UQ1.8", "UQ1.1", "UQ1.0", "UQ0.15", "UQ1.16", "Q2.13", "UQ1.17", "UQ1.18", "UQ0.23",
            "UQ1.23", "UQ0.24", "UQ1.25",
        ] {
            let format: QFormat = format.parse().unwrap();
            let step = if format.fraction_bits() > 18 { 37 } else { 1 };
            let all: Vec<i64> = (format.min_bits()..=format.max_bits()).step_by(step).collect();
            let mut decimals = Decimals::default();
            for column in all.chunks(1001) {
                decimals.of(column.iter().copied(), format);
                for (index, &bits) in column.iter().enumerate() {
                    let text = written(|lines| lines.fixed(&decimals, index, bits, format));
                    assert_eq!(text, shortest_of(real(bits, format)), "{bits} in {format}");
                }
            }
        }
    }

    proptest! {
        #[test]
        fn numbers_are_as_they_are_always_written(
            whole in prop_oneof![any::<i64>(), 0_i64..1 << 40, 0_i64..2000],
            n in prop_oneof![
                1.0..1e15,
                (1_u32..100_000).prop_map(f64::from),
                (2_u32..999).prop_map(|n| f64::from(n) / 2.0)
            ],
            text in "[a-z]{0,32}",
        ) {
            prop_assert_eq!(written(|lines| lines.whole(whole)), whole.to_string());
            prop_assert_eq!(written(|lines| lines.exponent(Some(n))), shortest_of(n));
            prop_assert_eq!(written(|lines| lines.word(&Word::number(n))), shortest_of(n));
            prop_assert_eq!(written(|lines| lines.word(&Word::new("polynomial"))), "polynomial");
            prop_assert_eq!(written(|lines| lines.exponent(None)), "");
            prop_assert_eq!(written(|lines| lines.text(&text)), text);
        }

        #[test]
        fn a_column_is_each_of_its_numbers(numbers in prop::collection::vec(any::<f64>(), 0..70)) {
            let mut texts = Texts::default();
            // Memory that is used again holds nothing of what was there.
            let _ = texts.of([1.5; 70].into_iter());
            let texts = texts.of(numbers.iter().copied());
            for (number, text) in numbers.iter().zip(texts) {
                let wanted = if number.is_nan() { String::new() } else { shortest_of(*number) };
                if number.is_finite() || number.is_nan() {
                    prop_assert_eq!(written(|lines| lines.number(text)), wanted);
                }
            }
        }
    }
}
