//! Where pipeline and reference differ, and by how many display codes.
//!
//! Blue where the pipeline is darker, orange where it is brighter: with light grey between them, a pair that every
//! common colour vision deficiency tells apart. One code of difference is already a colour, so that nothing hides in
//! the grey, and a pale one, as the scale reaches to four codes at least.

use rayon::prelude::*;

use super::shading::Picture;
use super::sheet::{Sheet, SheetError};
use plot::canvas::{Anchor, Canvas};

/// Equal codes.
const EQUAL: [u8; 3] = [0xec, 0xec, 0xec];
/// The least and the greatest difference, darker and brighter.
const DARKER: [[u8; 3]; 2] = [[0xb4, 0xd6, 0xe8], [0x05, 0x30, 0x61]];
const BRIGHTER: [[u8; 3]; 2] = [[0xfd, 0xd2, 0xa8], [0x8c, 0x2d, 0x04]];

/// Of the scale, in pixels.
const SCALE_WIDTH: f64 = 340.0;
const SCALE_HEIGHT: f64 = 46.0;
/// The most fields of the scale on either side of 0, and the most that all have their number.
const MOST_FIELDS: i32 = 8;
const MOST_NUMBERED: i32 = 4;
/// The least end of a scale that follows from the differences: a difference of one code never looks like a great one.
const LEAST_END: u16 = 4;

/// ScenePipeline minus reference of each pixel: of its three colours the one that differs most.
fn signed(pipeline: &Picture, reference: &Picture) -> Vec<i32> {
    let difference = |(one, other): (&[u16; 3], &[u16; 3])| {
        let of = |colour: usize| i32::from(one[colour]) - i32::from(other[colour]);
        [of(1), of(2)].into_iter().fold(of(0), |most, d| if d.abs() > most.abs() { d } else { most })
    };
    pipeline.codes.par_iter().zip(&reference.codes).map(difference).collect()
}

/// The end of the scale, in codes: the one that is asked for, or the greatest difference, but not too small.
pub(super) fn end_of(asked: Option<u16>, greatest: u16) -> u16 {
    asked.map_or(greatest.max(LEAST_END), |end| end.max(1))
}

/// The colour of a difference, where `end` (at least 1) is the end of the scale. What is greater has the colour of the
/// end.
fn colour(difference: i32, end: i32) -> [u8; 3] {
    let [least, most] = match difference.signum() {
        0 => return EQUAL,
        -1 => DARKER,
        _ => BRIGHTER,
    };
    let span = (end - 1).max(1);
    let part = difference.abs().min(end) - 1;
    std::array::from_fn(|index| {
        let (least, most) = (i32::from(least[index]), i32::from(most[index]));
        (least + (most - least) * part / span) as u8
    })
}

/// The difference of each pixel as its colour, where `end` (at least 1) is the end of the scale.
pub(super) fn heat(pipeline: &Picture, reference: &Picture, end: u16) -> Vec<[u8; 3]> {
    let end = i32::from(end.max(1));
    signed(pipeline, reference).into_iter().map(|difference| colour(difference, end)).collect()
}

/// The differences as a PNG, with their scale below. It ends at `asked` codes, the same for several pictures, or
/// without that at the greatest difference there is, four codes at least.
///
/// # Errors
/// When the words of the scale cannot be drawn, or the file not be encoded.
pub fn heat_map(pipeline: &Picture, reference: &Picture, asked: Option<u16>) -> Result<Vec<u8>, SheetError> {
    let differences = signed(pipeline, reference);
    let greatest = differences.par_iter().map(|difference| difference.abs()).max().unwrap_or(0);
    let end = i32::from(end_of(asked, greatest.try_into().unwrap_or(u16::MAX)));
    let colours: Vec<[u8; 3]> = differences.par_iter().map(|&difference| colour(difference, end)).collect();
    let scale = Sheet::drawn(&scale(end, greatest > end, pipeline.bits))?;
    let (width, height) = (pipeline.width as usize, pipeline.height as usize);
    let (scale_width, scale_height) = scale.size();
    let mut sheet = Sheet::new(width.max(scale_width), height + scale_height);
    let left = (sheet.size().0 - width) / 2;
    sheet.put((left, 0), width, &colours);
    sheet.put_sheet(((sheet.size().0 - scale_width) / 2, height), &scale);
    sheet.to_png()
}

/// The scale to ±`end` codes; `beyond` where some differences are greater.
fn scale(end: i32, beyond: bool, bits: u32) -> String {
    let side = end.min(MOST_FIELDS);
    let every = if side <= MOST_NUMBERED { 1 } else { 2 };
    let width = SCALE_WIDTH / f64::from(2 * side + 1);
    let mut canvas = Canvas::new();
    for field in -side..=side {
        let difference = field * end / side;
        let [red, green, blue] = colour(difference, end);
        let left = f64::from(field + side) * width;
        canvas.block((left, 18.0), (width + 0.5, 12.0), &format!("#{red:02x}{green:02x}{blue:02x}"));
        if field.abs() == side || (field % every == 0 && field.abs() + every <= side) {
            let sign = match (difference < 0, beyond && field.abs() == side) {
                (true, false) => "−",
                (false, false) => "+",
                (true, true) => "≤ −",
                (false, true) => "≥ +",
            };
            let text = match difference {
                0 => "0".to_owned(),
                _ => format!("{sign}{}", difference.abs()),
            };
            canvas.text((left + width / 2.0, SCALE_HEIGHT - 2.0), &text, Anchor::Middle, 12.0);
        }
    }
    let words = format!("pipeline − reference, in display codes of {bits} bits");
    canvas.text((SCALE_WIDTH / 2.0, 11.0), &words, Anchor::Middle, 12.0);
    canvas.finish((SCALE_WIDTH, SCALE_HEIGHT), "scale", &words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_code_differs_from_none_and_signs_from_each_other() {
        for greatest in [1, 2, 7, 200, 4095] {
            let of = |difference| colour(difference, greatest);
            assert_eq!(of(0), EQUAL);
            // A scale that ends at one code has one colour on either side.
            let last = usize::from(greatest > 1);
            assert_eq!((of(greatest), of(-greatest)), (BRIGHTER[last], DARKER[last]));
            for difference in 1..=greatest {
                assert_ne!(of(difference), EQUAL);
                assert_ne!(of(difference), of(-difference));
            }
            assert_eq!(of(greatest + 7), of(greatest));
        }
    }

    /// The colours of a few codes stay those of a small difference, whatever the greatest one is.
    #[test]
    fn a_code_is_pale_unless_the_scale_is_asked_to_end_there() {
        for greatest in [0, 1, 2, 4] {
            let end = i32::from(end_of(None, greatest));
            assert_eq!((end, colour(1, end), colour(-1, end)), (4, BRIGHTER[0], DARKER[0]));
        }
        assert_eq!((end_of(None, 45), end_of(Some(8), 45), end_of(Some(0), 45)), (45, 8, 1));
    }

    #[test]
    fn the_scale_has_its_numbers() {
        let numbers = |end, beyond| {
            let drawn = scale(end, beyond, 8);
            ["+4", "+3", "+45", "≥ +8", "≤ −8", "+28"]
                .map(|text| drawn.split(['<', '>']).any(|piece| piece.trim() == text))
        };
        assert_eq!(numbers(4, false), [true, true, false, false, false, false]);
        assert_eq!(numbers(45, false), [false, false, true, false, false, false]);
        assert_eq!(numbers(8, true)[3..5], [true, true]);
    }
}
